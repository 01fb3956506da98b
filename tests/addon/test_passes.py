# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes: what the core is asked for, and what Blender's result and files get."""

import bpy
import numpy as np
import pytest
from conftest import add_light, add_square, messages, part

LONG_NAMES = bpy.app.version >= (5, 0, 0)


@pytest.fixture
def layer(scene):
    return scene.view_layers[0]


def add_expression(layer, name, text):
    item = layer.janus.expressions.add()
    item.name, item.expression = name, text
    return item


def saved_layers(path):
    """Pixels by name of the pass, from the multilayer file that Blender writes of its result."""
    exr = pytest.importorskip("janus_core.exr")
    scene = bpy.context.scene
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    layers, _ = exr.read_layers(path)
    return {name.partition(".")[2]: pixels for name, pixels in layers.items()}


def test_every_light_pass_is_asked_for_in_the_words_of_the_core(scene, layer, fake_core):
    table = part("sync.passes").LIGHT_PASSES
    for toggle, _, _ in table:
        setattr(layer, toggle, True)
    bpy.ops.render.render()
    assert fake_core.settings.light_passes == [
        *("DiffDir", "DiffInd", "DiffCol", "GlossDir", "GlossInd", "GlossCol"),
        *("TransDir", "TransInd", "TransCol", "Emit", "Env"),
    ]


def test_names_are_those_of_cycles(scene, layer):
    """The compositor finds its sockets by name, so files made for Cycles must find the same."""
    engine = pytest.importorskip("cycles.engine")
    passes = part("sync.passes")
    for toggle, _, _ in passes.LIGHT_PASSES:
        setattr(layer, toggle, True)
    layer.lightgroups.add(name="Key")
    ours = {found.name for found in passes.requested(scene, layer)}
    theirs = {(name, letters) for name, letters, _ in engine.list_render_passes(scene, layer)}
    assert len(ours) == 12 and {(name, "RGB") for name in ours} <= theirs


def test_ready_made_expressions(scene, layer, fake_core):
    janus = layer.janus
    janus.use_pass_direct = janus.use_pass_indirect = True
    janus.use_pass_interreflections = janus.use_pass_caustics = True
    layer.lightgroups.add(name="Key")
    add_expression(layer, "Mirrored", "LD+SE")
    add_expression(layer, "Off", "LE").enabled = False
    bpy.ops.render.render()
    assert fake_core.settings.expressions == [
        ("Direct", "L.E"),
        ("Indirect", "L..+E"),
        ("Diffuse Inter-Reflections", "LDD+E"),
        ("Caustics", "L(S|G)+D.*E"),
        ("Combined_Key", "L{Key}.*E"),
        ("Mirrored", "LD+SE"),
    ]


def test_all_passes_are_in_the_file(scene, layer, fake_core, tmp_path):
    layer.use_pass_diffuse_direct = layer.use_pass_environment = True
    layer.janus.use_pass_caustics = True
    add_expression(layer, "LS+DE of the ring", "LS+DE")
    bpy.ops.render.render()
    layers = saved_layers(tmp_path / "all.exr")
    diffuse, environment = ("Diffuse Direct", "Environment") if LONG_NAMES else ("DiffDir", "Env")
    # The number of each in the list of the core, see FakeSession.snapshot().
    expected = {"Caustics": 1, "LS+DE of the ring": 2, diffuse: 3, environment: 4}
    assert set(layers) == {"Combined", *expected}
    for name, number in expected.items():
        assert layers[name].shape == (12, 16, 3) and np.all(layers[name] == number)
    assert layers["Combined"][0, 0] == pytest.approx(fake_core.color)


def test_passes_fit_into_a_border(scene, layer, fake_core, tmp_path):
    layer.use_pass_emit = True
    render = scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x = 0.25, 0.75
    render.border_min_y, render.border_max_y = 0.5, 1.0
    bpy.ops.render.render()
    pixels = saved_layers(tmp_path / "border.exr")["Emission" if LONG_NAMES else "Emit"]
    expected = np.zeros((12, 16, 3))
    expected[6:12, 4:12] = 1.0
    assert np.array_equal(pixels, expected)


def test_each_view_layer_has_its_own(scene, layer, fake_core):
    layer.janus.use_pass_direct = True
    second = scene.view_layers.new("Second")
    second.janus.use_pass_caustics = True
    asked = []
    fake_core.script = lambda session: asked.append(session.settings.expressions)
    scene.janus.samples = 1
    bpy.ops.render.render()
    assert sorted(asked) == [[("Caustics", "L(S|G)+D.*E")], [("Direct", "L.E")]]


def test_a_bad_expression_says_so_where_it_was_typed(scene, layer, fake_core):
    item = add_expression(layer, "Odd", "DE")
    assert item.message == "'DE' does not begin with a light"
    item.expression = "LDE"
    assert item.message == ""


def test_a_bad_expression_ends_the_render_and_is_named(scene, layer, fake_core):
    add_expression(layer, "Odd", "DE")
    with pytest.raises(RuntimeError, match="'Odd': 'DE' does not begin with a light"):
        bpy.ops.render.render()
    assert fake_core.sessions == []
    layer.janus.expressions[0].enabled = False
    bpy.ops.render.render()


@pytest.mark.parametrize(
    "name, reason",
    [
        ("", "needs a name"),
        ("Combined", "another pass"),
        ("Direct", "another pass"),
        ("Twice", "another pass"),
        ("Combined_Key", "another pass"),
        ("Diffuse Direct", "another pass"),
        ("a.b", "no dot"),
        ("é" * 32, "too long"),
    ],
)
def test_names_that_a_pass_cannot_have(scene, layer, fake_core, name, reason):
    layer.lightgroups.add(name="Key")
    layer.janus.use_pass_direct = True
    add_expression(layer, "Twice", "LE")
    add_expression(layer, "Caustics", "LS+DE")  # free as long as the ready-made one is off
    add_expression(layer, name, "LDE")
    with pytest.raises(RuntimeError, match=reason):
        bpy.ops.render.render()


def test_too_many_passes(scene, layer, fake_core):
    for number in range(65):
        add_expression(layer, f"Pass {number}", "LE")
    with pytest.raises(RuntimeError, match=r"65 passes.*64"):
        bpy.ops.render.render()


def test_what_the_core_refuses_reaches_the_user(scene, fake_core, monkeypatch, capfd):
    def refuse(**_):
        raise fake_core.SceneError("strategies: needs the heuristic NONE")

    monkeypatch.setattr(fake_core, "RenderSettings", refuse)
    with pytest.raises(RuntimeError, match="strategies: needs the heuristic NONE"):
        bpy.ops.render.render()
    assert messages("ERROR") == ["strategies: needs the heuristic NONE"]
    assert "Traceback" not in capfd.readouterr().err


def test_light_groups(scene, layer, export):
    """Of lamps, surfaces and the world; names that are left of removed groups are none."""
    add_light("POINT", "Lamp").lightgroup = "Key"
    add_square("Panel").lightgroup = "Key"
    add_square("Lost").lightgroup = "Gone"
    scene.world = bpy.data.worlds.new("Sky")
    scene.world.lightgroup = "Sky"
    for name in ("Key", "Sky"):
        layer.lightgroups.add(name=name)
    built = export()
    assert built.by_name("lights")["Lamp"]["light_group"] == "Key"
    assert built.by_name()["Panel"]["light_group"] == "Key"
    assert built.by_name()["Lost"]["light_group"] == ""
    assert built.world["light_group"] == "Sky"


def test_strategies_count_without_weights_only(scene, fake_core):
    janus = scene.janus
    janus.strategies = "0,* 1,2"
    bpy.ops.render.render()
    assert fake_core.settings.strategies == ""
    janus.heuristic = "NONE"
    bpy.ops.render.render()
    assert fake_core.settings.strategies == "0,* 1,2" and fake_core.settings.heuristic == "NONE"
    assert janus.strategies_message == ""
    janus.strategies = "everything"
    assert janus.strategies_message == "'everything' is no list of pairs s,t"


@pytest.mark.parametrize("name, value", [("connection_mode", "CLASSIC"), ("heuristic", "NONE")])
def test_what_cannot_be_merged_is_not(scene, fake_core, name, value):
    scene.janus.use_merging, scene.janus.merge_radius = True, 0.25
    bpy.ops.render.render()
    assert fake_core.settings.merge_radius == 0.25
    setattr(scene.janus, name, value)
    bpy.ops.render.render()
    assert fake_core.settings.merge_radius == 0.0 and vars(fake_core.settings)[name] == value


def test_scripts_can_have_the_passes(scene, layer, fake_core):
    layer.janus.use_pass_direct = True
    final = part("render.final")
    kept = final.kept_passes
    bpy.ops.render.render()
    assert kept == {}
    final.keep_passes_of.add(scene.name_full)
    bpy.ops.render.render()
    assert set(kept[layer.name]) == {"Combined", "Direct"}
    assert np.all(kept[layer.name]["Direct"] == 1.0)
    final.keep_passes_of.clear()
    kept.clear()


def test_instances_are_in_the_group_of_what_is_instanced(scene, layer, export):
    """Not of who instances it, as in Cycles."""
    panel = add_square("Panel")
    panel.lightgroup = "Key"
    collection = bpy.data.collections.new("Panels")
    collection.objects.link(panel)
    scene.collection.objects.unlink(panel)
    empty = bpy.data.objects.new("Rig", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    empty.lightgroup = "Rim"
    scene.collection.objects.link(empty)
    for name in ("Key", "Rim"):
        layer.lightgroups.add(name=name)
    assert export().by_name()["Panel"]["light_group"] == "Key"
