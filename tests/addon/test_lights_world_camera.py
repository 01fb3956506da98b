# SPDX-License-Identifier: GPL-3.0-or-later
"""Lights, the world and the camera as the exporter sends them."""

import math

import bpy
import numpy as np
import pytest
from conftest import add_light, add_square, environment, messages, new_material, picture
from mathutils import Matrix, Vector


def one_light(recorder):
    assert len(recorder.lights) == 1
    return next(iter(recorder.lights.values()))


def test_point_light(scene, export):
    light = add_light("POINT", "Lamp")
    light.location = (1, 2, 3)
    light.data.energy = 500.0
    light.data.color = (1.0, 0.5, 0.25)
    light.data.shadow_soft_size = 0.3
    light.data.use_soft_falloff = False
    sent = one_light(export())
    assert (sent["name"], sent["type"], sent["energy"]) == ("Lamp", "POINT", 500.0)
    assert sent["color"] == (1.0, 0.5, 0.25)
    assert sent["radius"] == pytest.approx(0.3) and sent["soft_falloff"] is False
    assert list(sent["transform"][:3, 3]) == [1, 2, 3]
    assert sent["normalize"] is True and sent["exposure"] == 0.0
    assert sent["visible_camera"] is light.visible_camera
    assert sent["visible_diffuse"] and sent["visible_glossy"] and sent["visible_transmission"]


def test_rules_of_lights(scene, export):
    light = add_light("POINT", "Lamp").data
    sent = one_light(export())
    assert sent["cast_shadow"] is True and sent["max_bounces"] == 1024
    light.use_shadow = False
    light.cycles.max_bounces = 3
    light.cycles.use_multiple_importance_sampling = False
    sent = one_light(export())
    assert sent["cast_shadow"] is False and sent["max_bounces"] == 3
    assert not messages()
    assert any("mirrors show this light" in text for text in messages("INFO"))


@pytest.mark.parametrize("method", ["NONE", "AUTO", "FRONT", "BACK", "FRONT_BACK"])
def test_emission_sampling(scene, export, method):
    material = new_material()
    material.cycles.emission_sampling = method
    add_square().data.materials.append(material)
    (sent,) = export().materials.values()
    assert sent["sample_emission"] is (method != "NONE")


def test_bump_map_correction_is_named(scene, export):
    material = new_material()
    add_square().data.materials.append(material)
    export()
    assert not any("bump map correction" in text for text in messages())
    material.cycles.use_bump_map_correction = False
    export()
    assert any("bump map correction" in text for text in messages("WARNING"))


@pytest.mark.parametrize("ray", ["camera", "diffuse", "glossy", "transmission"])
def test_ray_visibility_of_lights_and_worlds(scene, export, ray):
    light = add_light("POINT", "Lamp")
    scene.world = world = bpy.data.worlds.new("Sky")
    for other in ("camera", "diffuse", "glossy", "transmission"):
        setattr(light, f"visible_{other}", other != ray)
        setattr(world.cycles_visibility, other, other != ray)
    recorder = export()
    for sent in (one_light(recorder), recorder.world):
        hidden = {name for name, value in sent.items() if value is False and "visible" in name}
        assert hidden == {f"visible_{ray}"}
    assert "visible_shadow" not in one_light(recorder)
    assert not messages()


def test_area_spot_and_sun(scene, export):
    area = add_light("AREA", "Area").data
    area.shape, area.size, area.size_y, area.spread = "RECTANGLE", 2.0, 3.0, 1.0
    spot = add_light("SPOT", "Spot").data
    spot.spot_size, spot.spot_blend, spot.use_square = 0.5, 0.25, True
    add_light("SUN", "Sun").data.angle = 0.1
    lights = export().by_name("lights")
    sent = lights["Area"]
    assert (sent["shape"], sent["size"], sent["size_y"], sent["spread"]) == ("RECTANGLE", 2, 3, 1)
    sent = lights["Spot"]
    assert (sent["spot_size"], sent["spot_blend"], sent["spot_square"]) == (0.5, 0.25, True)
    assert lights["Sun"]["angle"] == pytest.approx(0.1)


def test_newer_light_settings(scene, export):
    light = add_light("POINT").data
    if not hasattr(light, "exposure"):
        pytest.skip("this Blender has no light exposure")
    light.exposure, light.normalize = 2.0, False
    light.use_temperature, light.temperature = True, 3000.0
    light.color = (0.5, 1.0, 1.0)
    sent = one_light(export())
    assert sent["exposure"] == 2.0 and sent["normalize"] is False
    red, green, blue = light.temperature_color
    assert sent["color"] == pytest.approx((0.5 * red, green, blue))
    assert red > blue


def test_light_nodes(scene, export):
    light = add_light("POINT").data
    if light.node_tree is None:
        assert one_light(export())["graph"] is None
        light.use_nodes = True
    light.node_tree.nodes["Emission"].inputs["Strength"].default_value = 3.0
    graph = one_light(export())["graph"]
    assert [node["type"] for node in graph["nodes"]] == ["EMISSION"]
    assert graph["nodes"][0]["inputs"]["Strength"] == 3.0


def test_portals_emit_nothing(scene, export):
    light = add_light("AREA")
    light.data.cycles.is_portal = True
    assert export().lights == {}


def test_lights_in_collection_instances(scene, export):
    collection = bpy.data.collections.new("Lamps")
    light = add_light("POINT")
    scene.collection.objects.unlink(light)
    collection.objects.link(light)
    for x in (1.0, 2.0):
        empty = bpy.data.objects.new("Empty", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        empty.location.x = x
        scene.collection.objects.link(empty)
    places = sorted(item["transform"][0, 3] for item in export().lights.values())
    assert places == [1.0, 2.0]


def test_no_world_is_black(scene, export):
    scene.world = None
    assert export().world == {"name": "", "graph": None}


def test_view_layers_may_be_without_the_world(scene, export):
    scene.world = bpy.data.worlds.new("Sky")
    scene.view_layers[0].use_sky = False
    assert export().world == {"name": "", "graph": None}


def test_world_nodes_and_plain_color(scene, export):
    scene.world = world = bpy.data.worlds.new("Sky")
    if bpy.app.version < (5, 0, 0):
        world.color = (0.1, 0.2, 0.3)
        node = export().world["graph"]["nodes"][0]
        assert node["inputs"]["Color"] == pytest.approx([0.1, 0.2, 0.3, 1.0])
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 0, 0, 1)
    sent = export().world
    assert sent["name"] == "Sky"
    assert sent["graph"]["surface"] == {"link": ["Background", "Background"]}
    assert sent["graph"]["nodes"][0]["inputs"]["Color"] == [1, 0, 0, 1]


def test_square_spots_are_round(scene, export):
    add_light("SPOT", "Spot").data.use_square = True
    export()
    assert any("Spot" in message and "round" in message for message in messages("INFO"))


def test_unsupported_nodes_of_worlds_are_named(scene, core):
    texture = environment(scene, picture(np.ones((2, 4, 4))))
    texture.projection = "MIRROR_BALL"
    tree = scene.world.node_tree
    occlusion = tree.nodes.new("ShaderNodeAmbientOcclusion")
    bpy.ops.render.render()
    assert messages("WARNING") == []
    tree.links.new(occlusion.outputs["Color"], texture.inputs["Vector"])
    bpy.ops.render.render()
    (message,) = messages("WARNING")
    assert "Sky" in message and "AMBIENT_OCCLUSION" in message


def test_world_of_nodes(scene, export):
    """Flattened as materials are, with all its pictures; what Light Path is asked comes along."""
    first = picture(np.ones((2, 4, 4)))
    texture = environment(scene, first)
    tree = scene.world.node_tree
    other, mix = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeMixShader")
    other.image = picture(np.ones((2, 4, 4)))
    path, second = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeBackground")
    inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    inner.interface.new_socket("Sky", in_out="OUTPUT", socket_type="NodeSocketColor")
    bright = inner.nodes.new("ShaderNodeHueSaturation")
    inner.links.new(bright.outputs[0], inner.nodes.new("NodeGroupOutput").inputs[0])
    group = tree.nodes.new("ShaderNodeGroup")
    group.node_tree = inner
    tree.links.new(other.outputs[0], second.inputs["Color"])
    tree.links.new(group.outputs[0], texture.inputs["Vector"])
    tree.links.new(path.outputs["Is Camera Ray"], mix.inputs[0])
    tree.links.new(tree.nodes["Background"].outputs[0], mix.inputs[1])
    tree.links.new(second.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.get_output_node("CYCLES").inputs["Surface"])
    recorder = export()
    nodes = {node["name"]: node for node in recorder.world["graph"]["nodes"]}
    kinds = sorted(node["type"] for node in nodes.values())
    assert kinds == sorted(
        ["MIX_SHADER", "LIGHT_PATH", "BACKGROUND", "BACKGROUND", "HUE_SAT"]
        + 2 * ["TEX_ENVIRONMENT"]
    )
    top = nodes[recorder.world["graph"]["surface"]["link"][0]]
    assert top["inputs"]["Fac"]["link"] == ["Light Path", "Is Camera Ray"]
    assert "Group/Hue/Saturation/Value" in nodes
    used = {n["properties"]["image"] for n in nodes.values() if n["type"] == "TEX_ENVIRONMENT"}
    assert used == set(recorder.images) and len(used) == 2
    assert messages("WARNING") == []


def test_material_without_nodes(scene, export):
    if bpy.app.version >= (5, 0, 0):
        pytest.skip("use_nodes means nothing from Blender 5.0 on")
    material = bpy.data.materials.new("Plain")
    material.diffuse_color = (0.1, 0.2, 0.3, 1.0)
    add_square().data.materials.append(material)
    graph = next(iter(export().materials.values()))["graph"]
    assert graph["nodes"][0]["type"] == "BSDF_DIFFUSE"
    assert graph["nodes"][0]["inputs"]["Color"] == pytest.approx([0.1, 0.2, 0.3, 1.0])


def screen_position(scene, point):
    """Where Blender sees a world point, 0 to 1 from the bottom left: its own projection."""
    from bpy_extras.object_utils import world_to_camera_view

    return world_to_camera_view(scene, scene.camera, Vector(point))[:2]


def window_position(camera, point):
    """The same by what was sent to the core."""
    local = np.linalg.inv(camera["transform"]) @ np.array([*point, 1.0])
    x, y = local[:2] / -local[2]
    left, right, bottom, top = camera["window"]
    return (x - left) / (right - left), (y - bottom) / (top - bottom)


@pytest.mark.parametrize("size", [(160, 90), (90, 160)])
@pytest.mark.parametrize("fit", ["AUTO", "HORIZONTAL", "VERTICAL"])
def test_camera_window(scene, export, size, fit):
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.pixel_aspect_x = 1.5
    data = scene.camera.data
    data.lens, data.sensor_fit, data.sensor_height = 35.0, fit, 20.0
    data.shift_x, data.shift_y = 0.1, -0.2
    data.clip_start, data.clip_end = 0.5, 50.0
    scene.camera.matrix_world = Matrix.LocRotScale(
        (1, 2, 8), Matrix.Rotation(0.3, 3, (1, 1, 0)), (2, 3, 4)
    )
    sent = export().camera
    assert (sent["type"], sent["clip_start"], sent["clip_end"]) == ("PERSP", 0.5, 50.0)
    axes = sent["transform"][:3, :3]
    assert axes.T @ axes == pytest.approx(np.eye(3), abs=1e-6)
    scene.camera.scale = (1, 1, 1)  # world_to_camera_view does not take a scale out
    bpy.context.view_layer.update()
    for point in ((0, 0, 0), (1, -1, 0.5), (-2, 1, 1)):
        assert window_position(sent, point) == pytest.approx(
            screen_position(scene, point), abs=1e-5
        )


def test_default_camera_window(scene, export):
    left, right, bottom, top = export().camera["window"]
    data = scene.camera.data
    assert right == pytest.approx(0.5 * data.sensor_width / data.lens) == pytest.approx(-left)
    assert top == pytest.approx(0.75 * right) == pytest.approx(-bottom)
    assert math.isclose(2 * math.atan(right), data.angle_x, rel_tol=1e-5)


def test_camera_without_depth_of_field(scene, export):
    scene.camera.data.dof.aperture_fstop = 1.0
    assert export().camera.get("aperture_radius", 0.0) == 0.0


def test_orthographic_window(scene, export):
    data = scene.camera.data
    data.type, data.ortho_scale = "ORTHO", 3.0
    data.shift_x, data.shift_y = 0.1, -0.2
    scene.camera.matrix_world = Matrix.LocRotScale(
        (1, 2, 8), Matrix.Rotation(0.3, 3, (1, 1, 0)), None
    )
    sent = export().camera
    assert sent["type"] == "ORTHO"
    left, right, bottom, top = sent["window"]
    assert (right - left, top - bottom) == pytest.approx((3.0, 2.25))
    for point in ((0, 0, 0), (1, -1, 0.5), (-2, 1, 1)):
        x, y = (np.linalg.inv(sent["transform"]) @ np.array([*point, 1.0]))[:2]
        position = (x - left) / (right - left), (y - bottom) / (top - bottom)
        assert position == pytest.approx(screen_position(scene, point), abs=1e-5)


def panorama_settings(camera):
    return camera.data if hasattr(camera.data, "panorama_type") else camera.data.cycles


@pytest.mark.parametrize("kind, focal_length", [("PERSP", 0.08), ("ORTHO", 1.0), ("PANO", 0.08)])
def test_lens(scene, export, kind, focal_length):
    data = scene.camera.data
    data.type, data.lens = kind, 80.0
    panorama_settings(scene.camera).panorama_type = "EQUIRECTANGULAR"
    dof = data.dof
    dof.use_dof, dof.aperture_fstop, dof.focus_distance = True, 4.0, 2.5
    dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio = 6, 0.25, 2.0
    sent = export().camera
    assert sent["aperture_radius"] == pytest.approx(focal_length / 8.0)
    assert sent["focus_distance"] == 2.5
    assert sent["aperture_blades"] == 6
    assert (sent["aperture_rotation"], sent["aperture_ratio"]) == (0.25, 2.0)
    dof.aperture_fstop = 0.0  # as wide as can be, but no division by zero
    assert 0.0 < export().camera["aperture_radius"] < float("inf")


def test_focus_object_and_bone(scene, export):
    """The distance counts along the view axis, not along the line to the object."""
    dof = scene.camera.data.dof
    dof.use_dof, dof.focus_distance = True, 100.0
    square = add_square()
    square.location = (3, 0, 1)
    dof.focus_object = square
    assert export().camera["focus_distance"] == pytest.approx(4.0)

    armature = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    scene.collection.objects.link(armature)
    armature.location = (0, 0, 0.5)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    bone = armature.data.edit_bones.new("Bone")
    bone.head, bone.tail = (0, 0, 1.5), (0, 1, 1.5)
    bpy.ops.object.mode_set(mode="OBJECT")
    dof.focus_object = armature
    assert export().camera["focus_distance"] == pytest.approx(4.5)
    dof.focus_subtarget = "Bone"
    assert export().camera["focus_distance"] == pytest.approx(3.0)
