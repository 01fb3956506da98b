# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of passes and strategies, drawn into a layout that checks what it is given."""

from types import SimpleNamespace

import bpy
import pytest
from conftest import part


class Layout:
    """Records what is drawn. All of its parts share one list; each has its own alert."""

    def __init__(self, drawn=None):
        self.drawn = [] if drawn is None else drawn
        self.alert = False

    def _part(self, **_):
        layout = Layout(self.drawn)
        layout.alert = self.alert
        return layout

    row = column = box = _part

    def prop(self, data, name, **_):
        assert name in data.bl_rna.properties
        self.drawn.append(name)

    def prop_search(self, data, name, search_data, search_name, **_):
        assert name in data.bl_rna.properties and search_name in search_data.bl_rna.properties
        self.drawn.append(name)

    def template_list(self, kind, _id, data, name, active_data, active_name, **_):
        assert getattr(bpy.types, kind, None)
        assert name in data.bl_rna.properties and active_name in active_data.bl_rna.properties
        self.drawn.append(name)

    def operator(self, name, **_):
        module, operator = name.split(".")
        assert operator in dir(getattr(bpy.ops, module))
        self.drawn.append(name)
        return SimpleNamespace()

    def menu(self, name, **_):
        assert getattr(bpy.types, name, None)

    def label(self, text, icon="NONE"):
        self.drawn.append((text, icon, self.alert))

    def separator(self):
        pass


def draw(name, **context):
    """What the panel draws: names of properties and operators, (text, icon, alert) of labels."""
    panel = getattr(bpy.types, name)
    stub = SimpleNamespace(layout=Layout())
    stub.column = lambda: panel.column(stub)
    for helper in ("_draw_counts", "suffix"):
        if hasattr(panel, helper):
            setattr(stub, helper, getattr(panel, helper))
    scene = bpy.context.scene
    context = {"scene": scene, "view_layer": scene.view_layers[0], "engine": "JANUS"} | context
    panel.draw(stub, SimpleNamespace(**context))
    return stub.layout.drawn


def test_light_passes_are_laid_out_as_in_cycles(scene):
    drawn = draw("JANUS_VIEWLAYER_PT_passes_light")
    table = part("sync.passes")
    assert [name for name in drawn if name not in dir(scene.view_layers[0].janus)] == [
        *(toggle for toggle, _, _ in table.LIGHT_PASSES),
        "use_pass_ambient_occlusion",  # of data, but there is where Cycles has it
    ]
    assert {toggle for toggle, _, _ in table.READY_MADE} < set(drawn)


def test_data_passes_and_cryptomatte(scene):
    table, layer = part("sync.passes"), scene.view_layers[0]
    drawn = draw("JANUS_VIEWLAYER_PT_passes_data")
    switches = {names[0] for names in (*table.DATA_PASSES, *table.OWN_DATA_PASSES)}
    switches.remove("use_pass_ambient_occlusion")  # see above
    assert switches | {"use_pass_combined", "pass_alpha_threshold"} == set(drawn)
    drawn = draw("JANUS_VIEWLAYER_PT_passes_cryptomatte")
    assert "pass_cryptomatte_depth" in drawn and len(drawn) == 4
    assert all(hasattr(layer, name) for name in drawn)


def test_aovs(scene):
    layer = scene.view_layers[0]
    shown = ["aovs", "scene.view_layer_add_aov", "scene.view_layer_remove_aov"]
    assert draw("JANUS_VIEWLAYER_PT_passes_aov") == shown
    layer.aovs.add().name = "Direct"
    assert draw("JANUS_VIEWLAYER_PT_passes_aov") == shown
    layer.janus.use_pass_direct = True
    *drawn, problem = draw("JANUS_VIEWLAYER_PT_passes_aov")
    assert drawn == shown and "another pass" in problem[0] and problem[2]


def test_previews_are_of_what_is_chosen(scene):
    drawn = []
    layout = SimpleNamespace(template_preview=drawn.append)
    items = {
        "MATERIAL": bpy.data.materials.new("Paint"),
        "WORLD": bpy.data.worlds.new("Sky"),
        "LIGHT": bpy.data.lights.new("Lamp", "POINT"),
    }
    for kind, item in items.items():
        panel = getattr(bpy.types, f"JANUS_{kind}_PT_preview")
        context = {"material": None, "world": None, "light": None, "engine": "JANUS"}
        assert not panel.poll(SimpleNamespace(**context))
        context = SimpleNamespace(**(context | {kind.lower(): item}))
        assert panel.poll(context)
        panel.draw(SimpleNamespace(layout=layout, shown=panel.shown), context)
    assert drawn == list(items.values())


def test_light_groups(scene):
    assert "lightgroups" in draw("JANUS_VIEWLAYER_PT_passes_lightgroups")
    world = bpy.data.worlds.new("Sky")
    assert "lightgroup" in draw("JANUS_OBJECT_PT_lightgroup", object=scene.camera)
    assert "lightgroup" in draw("JANUS_WORLD_PT_lightgroup", world=world)
    if hasattr(bpy.types, "OBJECT_PT_shading"):
        assert bpy.types.JANUS_OBJECT_PT_lightgroup.bl_parent_id == "OBJECT_PT_shading"
        assert "JANUS" in bpy.types.OBJECT_PT_shading.COMPAT_ENGINES


def test_a_bad_expression_is_said_below_its_field(scene, fake_core):
    name = "JANUS_VIEWLAYER_PT_passes_expressions"
    assert "expression" not in draw(name)
    bpy.ops.janus.add_light_path_expression()
    item = scene.view_layers[0].janus.expressions[0]
    assert draw(name)[-2:] == ["name", "expression"]
    item.expression = "DE"
    message = ("'DE' does not begin with a light", "ERROR", True)
    assert draw(name)[-2:] == ["expression", message]
    item.name = ""
    assert ("The pass needs a name", "ERROR", True) in draw(name)


def test_the_list_marks_bad_expressions(scene, fake_core):
    bpy.ops.janus.add_light_path_expression()
    layer = scene.view_layers[0]
    item = layer.janus.expressions[0]
    icons = []
    for expression in ("LDE", "DE"):
        item.expression = expression
        layout = Layout()
        layout.prop = lambda data, name, icon="NONE", **_: icons.append(icon)
        layout.row = lambda layout=layout: layout
        bpy.types.JANUS_UL_light_path_expressions.draw_item(
            None, SimpleNamespace(view_layer=layer), layout, None, item, 0, None, "", 0, 0
        )
        assert layout.alert == (expression == "DE")
    assert icons == ["NONE"] * 3 + ["ERROR"] + ["NONE"] * 2


def test_strategies_are_shown_without_weights_only(scene, fake_core):
    name = "JANUS_RENDER_PT_bidirectional"
    drawn = draw(name)
    assert "strategies" not in drawn
    assert {"next_event", "connection_mode", "janus.render_strategies"} < set(drawn)
    scene.janus.heuristic = "NONE"
    scene.janus.strategies = "all of them"
    message = ("'all of them' is no list of pairs s,t", "ERROR", True)
    drawn = draw(name)
    assert drawn[drawn.index("strategies") + 1] == message


def test_adding_and_removing_expressions(scene, fake_core):
    janus = scene.view_layers[0].janus
    for _ in range(3):
        bpy.ops.janus.add_light_path_expression()
    names = [item.name for item in janus.expressions]
    assert len(set(names)) == 3 and janus.active_expression == 2
    bpy.ops.janus.remove_light_path_expression()
    assert [item.name for item in janus.expressions] == names[:2]
    assert janus.active_expression == 1
    bpy.ops.render.render()
    assert [name for name, _ in fake_core.settings.expressions] == names[:2]
    bpy.ops.janus.remove_light_path_expression()
    bpy.ops.janus.remove_light_path_expression()
    assert not bpy.ops.janus.remove_light_path_expression.poll()


def test_expressions_are_saved_with_the_file(scene, fake_core, tmp_path):
    janus = scene.view_layers[0].janus
    janus.use_pass_caustics = True
    bpy.ops.janus.add_light_path_expression()
    janus.expressions[0].expression = "DE"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    janus = bpy.context.scene.view_layers[0].janus
    assert janus.use_pass_caustics and janus.expressions[0].message
    assert janus.expressions[0].expression == "DE"


@pytest.mark.parametrize("engine, shown", [("JANUS", True), ("CYCLES", False)])
def test_in_the_render_menu_of_janus(scene, engine, shown):
    scene.render.engine = engine
    layout = Layout()
    menu = SimpleNamespace(layout=layout)
    part("operators.strategies")._draw_in_menu(menu, SimpleNamespace(scene=scene))
    assert ("janus.render_strategies" in layout.drawn) == shown


def test_what_the_scene_makes_impossible_is_said_at_the_field(scene, fake_core):
    name = "JANUS_RENDER_PT_bidirectional"

    def said():
        drawn = draw(name)
        after = drawn[drawn.index("next_event") + 1]
        return after[0] if isinstance(after, tuple) else ""

    janus = scene.janus
    janus.integrator = "LT"
    assert said() == ""
    janus.next_event = False
    assert "(t=0)" in said()
    scene.camera.data.dof.use_dof = True
    assert said() == ""
    scene.camera.data.type = "ORTHO"
    assert "(t=0)" in said()
    janus.integrator = "PT"
    lamp = bpy.data.lights.new("Bulb", "POINT")
    lamp.shadow_soft_size = 0.0
    assert said() == ""  # it is nowhere
    scene.collection.objects.link(bpy.data.objects.new("Bulb", lamp))
    assert "'Bulb'" in said()
    janus.integrator, janus.heuristic, janus.strategies = "BDPT", "NONE", "0,* 0,3"
    assert ("No path hits a light without a size (s=0), such as 'Bulb'", "ERROR", True) in draw(
        name
    )
    janus.integrator = "PT"
    lamp.shadow_soft_size = 0.1
    assert said() == ""


def test_no_panel_hides_what_blender_keeps_in_it(addon):
    """An attribute that a Panel of Blender has is the user's text, not ours, in a drawn panel."""
    kept = {p.identifier for p in bpy.types.Panel.bl_rna.properties}
    kept = {name for name in kept if not name.startswith("bl_")} | {"layout", "text", "is_popover"}
    ours = [cls for cls in bpy.types.Panel.__subclasses__() if cls.__name__.startswith("JANUS_")]
    assert len(ours) > 10
    for cls in ours:
        assert not kept & set(vars(cls)), cls.__name__


@pytest.mark.parametrize("where", ["render", "viewport"])
def test_denoising_is_greyed_with_the_reason(scene, monkeypatch, where):
    """The layout is one for all, so that what the panel sets in its parts is seen."""
    layout = Layout()
    layout.column = layout.row = lambda **_: layout
    suffix, prefix = ("", "denoising") if where == "render" else ("viewport_", "preview_denoising")
    panel = getattr(bpy.types, f"JANUS_RENDER_PT_sampling_{suffix}denoise")
    assert panel.bl_parent_id == f"JANUS_RENDER_PT_sampling_{where}"
    stub = SimpleNamespace(
        layout=layout, column=lambda: layout, switch=panel.switch, prefix=panel.prefix
    )
    context = SimpleNamespace(scene=scene)
    names = ["input_passes", "prefilter", "quality"] + ["start_sample"] * (where == "viewport")
    for reason, lines in ((None, []), ("No library.", [("No library.", "INFO", False)])):
        monkeypatch.setattr(part("render.denoise"), "unavailable", lambda reason=reason: reason)
        for use in (False, True):
            setattr(scene.janus, panel.switch, use)
            layout.drawn.clear()
            panel.draw_header(stub, context)
            assert layout.drawn == [panel.switch] and layout.enabled is (reason is None)
            layout.drawn.clear()
            layout.enabled = None
            panel.draw(stub, context)
            assert layout.drawn == [*lines, *(f"{prefix}_{name}" for name in names)]
            assert layout.enabled is (reason is None) and layout.active is use


def test_a_view_layer_can_leave_denoising_out(scene):
    drawn = draw("JANUS_VIEWLAYER_PT_filter")
    assert drawn == ["use_sky", "use_solid", "use_strand", "use_motion_blur", "use_denoising"]
    assert "use_denoising" in scene.view_layers[0].janus.bl_rna.properties


def test_what_makes_scenes_lighter(scene):
    names = ["simplify_subdivision", "simplify_child_particles"]
    drawn = draw("JANUS_RENDER_PT_simplify_viewport")
    assert drawn[:2] == names and set(drawn[2:]) <= {"use_simplify_normals"}
    assert draw("JANUS_RENDER_PT_simplify_render") == [f"{name}_render" for name in names]


def test_the_compositor_has_its_device(scene):
    for device, more in (("CPU", []), ("GPU", ["compositor_precision"])):
        scene.render.compositor_device = device
        assert draw("JANUS_RENDER_PT_performance_compositor") == ["compositor_device", *more]


def test_panels_stand_in_the_order_of_cycles(addon):
    labels = {}
    for panel in part("ui").CLASSES:
        if hasattr(panel, "bl_context") and not hasattr(panel, "bl_parent_id") and panel.bl_label:
            labels.setdefault(panel.bl_context, []).append(panel.bl_label)
    assert labels["render"] == [
        "Janus Report",  # below all others by its bl_order
        *("Sampling", "Light Paths", "Bidirectional", "Simplify", "Motion Blur", "Film"),
        "Performance",
    ]
    assert labels["view_layer"] == ["Override", "Passes", "Filter"]
    assert labels["world"] == ["Preview", "Surface", "Mist Pass", "Ray Visibility", "Light Group"]


def polled(name, **context):
    names = ("object", "camera", "light", "world", "material")
    context = dict.fromkeys(names) | {"engine": "JANUS"} | context
    return bool(getattr(bpy.types, name).poll(SimpleNamespace(**context)))


def test_ray_visibility_of_objects(scene):
    name = "JANUS_OBJECT_PT_ray_visibility"
    rays = ("camera", "diffuse", "glossy", "transmission", "shadow")
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    square = bpy.data.objects.new("Square", bpy.data.meshes.new("Square"))
    empty = bpy.data.objects.new("Empty", None)
    assert draw(name, object=square) == [f"visible_{ray}" for ray in rays]
    assert draw(name, object=lamp) == [f"visible_{ray}" for ray in rays[:-1]]
    assert polled(name, object=square) and polled(name, object=lamp)
    assert not polled(name) and not polled(name, object=empty)
    assert not polled(name, object=scene.camera)
    empty.instance_type = "COLLECTION"
    assert polled(name, object=empty)
    assert bpy.types.OBJECT_PT_visibility.COMPAT_ENGINES >= {"JANUS"}


def test_shadow_catchers_are_below_holdouts(scene):
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))

    def drawn(obj, engine="JANUS"):
        panel = SimpleNamespace(layout=Layout())
        part("ui.data").draw_shadow_catcher(panel, SimpleNamespace(object=obj, engine=engine))
        return panel.layout.drawn

    assert drawn(lamp) == ["is_shadow_catcher"]
    assert drawn(scene.camera) == drawn(lamp, "CYCLES") == []


def test_ray_visibility_of_worlds(scene):
    name, world = "JANUS_WORLD_PT_ray_visibility", bpy.data.worlds.new("Sky")
    assert not polled(name)
    if hasattr(world, "cycles_visibility"):
        assert polled(name, world=world)
        assert draw(name, world=world) == ["camera", "diffuse", "glossy", "transmission"]


def test_settings_of_lights_and_materials(scene):
    lamp, material = bpy.data.lights.new("Lamp", "POINT"), bpy.data.materials.new("Paint")
    assert draw("JANUS_LIGHT_PT_settings", light=lamp) == ["max_bounces", "use_shadow"]
    drawn = draw("JANUS_MATERIAL_PT_settings", material=material)
    assert drawn == ["pass_index", "emission_sampling"]


def test_panoramas(scene):
    name, camera = "JANUS_CAMERA_PT_panorama", scene.camera.data
    assert not polled(name) and not polled(name, camera=camera)
    camera.type = "PANO"
    assert polled(name, camera=camera)
    settings = part("sync.panorama").panorama(camera)
    settings.panorama_type = "EQUIRECTANGULAR"
    sides = ["latitude_min", "latitude_max", "longitude_min", "longitude_max"]
    assert draw(name, camera=camera) == ["panorama_type", *sides]
    settings.panorama_type = "MIRRORBALL"
    assert draw(name, camera=camera) == ["panorama_type"]
