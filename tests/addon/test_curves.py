# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair curves, particle hair and point clouds as the exporter sends them."""

import bpy
import numpy as np
import pytest
from conftest import add_square, messages, new_material, part


def add_curves(counts=(3, 2), name="Hair"):
    """Curves up along z, a metre apart along x."""
    curves = bpy.data.hair_curves.new(name)
    curves.add_curves(list(counts))
    x = np.repeat(np.arange(len(counts)), counts)
    z = np.concatenate([np.arange(count) for count in counts])
    places = np.stack([x, 0.0 * x, z], axis=1).astype(np.float32)
    curves.attributes["position"].data.foreach_set("vector", places.ravel())
    obj = bpy.data.objects.new(name, curves)
    bpy.context.scene.collection.objects.link(obj)
    return obj


def add_hair(obj, count=5, **settings):
    obj.modifiers.new("Hair", "PARTICLE_SYSTEM")
    system = obj.particle_systems[0]
    system.settings.type, system.settings.count = "HAIR", count
    for name, value in settings.items():
        setattr(system.settings, name, value)
    return system.settings


def add_points(scene, places, name="Points"):
    """A mesh that nodes make points of."""
    obj = add_square(name)
    tree = bpy.data.node_groups.new("Points", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    points, output = tree.nodes.new("GeometryNodePoints"), tree.nodes.new("NodeGroupOutput")
    points.inputs["Count"].default_value = places
    points.inputs["Radius"].default_value = 0.25
    tree.links.new(points.outputs[0], output.inputs[0])
    obj.modifiers.new("Nodes", "NODES").node_group = tree
    return obj


def test_curves(scene, export):
    hair = add_curves()
    hair.location = (1, 2, 3)
    hair.data.materials.append(bpy.data.materials.new("Fur"))
    recorder = export()
    arrays = recorder.mesh_of("Hair")
    assert arrays["curves"].tolist() == [0, 3, 5]
    assert arrays["positions"].shape == (5, 3) and arrays["positions"][2].tolist() == [0, 0, 2]
    assert arrays["radii"] == pytest.approx(np.full(5, 0.005))
    assert arrays["attributes"] == [] and not arrays["straight"]
    assert recorder.materials_of("Hair") == ["Fur"]
    assert recorder.by_name()["Hair"]["transform"][:3, 3].tolist() == [1, 2, 3]
    assert messages() == []


def test_radii_and_attributes_of_curves(scene, export, fake_core):
    hair = add_curves()
    hair.data.materials.append(new_material("Fur"))
    radius = hair.data.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", [0.1, 0.2, 0.3, 0.4, 0.5])
    hair.data.attributes.new("tint", "FLOAT", "CURVE").data.foreach_set("value", [7, 8])
    keys = ["attribute:tint", "curve_intercept", "curve_length", "curve_radius", "attribute:none"]
    fake_core.reads = {"Fur": keys}
    arrays = export().mesh_of("Hair")
    assert arrays["radii"] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])
    found = {a["key"]: (a["domain"], np.ravel(a["values"]).tolist()) for a in arrays["attributes"]}
    assert found["attribute:tint"] == ("FACE", [7, 8])
    assert found["curve_intercept"] == ("POINT", [0, 0.5, 1, 0, 1])
    assert found["curve_length"] == ("FACE", [2, 1])
    assert found["curve_radius"][1] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])
    assert "attribute:none" not in found


def test_view_layers_may_be_without_hair(scene, export):
    add_curves()
    add_hair(add_square("Lawn"))
    scene.view_layers[0].use_strand = False
    assert list(export().by_name()) == ["Lawn"]


def test_particle_hair(scene, export):
    lawn = add_square("Lawn")
    lawn.location = (4, 0, 0)
    for name in ("Soil", "Grass"):
        lawn.data.materials.append(bpy.data.materials.new(name))
    add_hair(
        lawn,
        hair_length=1.0,
        render_step=2,
        material=2,
        root_radius=2.0,
        tip_radius=1.0,
        radius_scale=0.1,
        use_close_tip=True,
    )
    recorder = export()
    instances = [i for i in recorder.instances.values() if i["name"] == "Lawn"]
    surface, hair = sorted(instances, key=lambda i: "curves" in recorder.meshes[i["mesh"]])
    assert np.array_equal(surface["transform"], hair["transform"])
    assert hair["materials"] == surface["materials"]
    arrays = recorder.meshes[hair["mesh"]]
    assert arrays["curves"].tolist() == [5 * i for i in range(6)]
    positions = arrays["positions"].reshape(5, 5, 3)
    assert np.abs(positions[:, 0, 2]).max() < 1e-4  # of the object, on the surface
    assert np.abs(positions[:, 0, :2]).max() <= 1.001
    assert positions[:, -1, 2] == pytest.approx(np.full(5, 1.0), abs=0.05)
    radii = arrays["radii"].reshape(5, 5)
    assert radii[:, 0] == pytest.approx(np.full(5, 0.1))
    assert radii[:, 2] == pytest.approx(np.full(5, 0.075), rel=0.02)
    assert (radii[:, -1] == 0.0).all()  # closed
    assert arrays["material_indices"].tolist() == [1] * 5
    assert messages() == []


def test_children_take_the_place_of_particles(scene, export):
    lawn = add_square("Lawn")
    add_hair(lawn, child_type="SIMPLE", rendered_child_count=3, render_step=1)
    recorder = export()
    hair = next(m for m in recorder.meshes.values() if "curves" in m)
    assert len(hair["curves"]) == 5 * 3 + 1


def test_hair_of_a_hidden_emitter(scene, export):
    lawn = add_square("Lawn")
    add_hair(lawn)
    lawn.show_instancer_for_render = False
    recorder = export()
    assert ["curves" in m for m in recorder.meshes.values()] == [True]


@pytest.mark.parametrize("hidden", ["modifier", "render_type"])
def test_hair_that_is_not_shown(scene, export, hidden):
    lawn = add_square("Lawn")
    settings = add_hair(lawn)
    if hidden == "modifier":
        lawn.modifiers[0].show_render = False
    else:
        settings.render_type = "NONE"
    assert ["curves" in m for m in export().meshes.values()] == [False]


def test_where_hair_grows(scene, export, fake_core):
    lawn = add_square("Lawn")
    lawn.data.uv_layers.new(name="Map")
    lawn.data.materials.append(new_material("Grass"))
    add_hair(lawn, render_step=1)
    fake_core.reads = {"Grass": ["uv:", "generated", "curve_intercept"]}
    hair = next(m for m in export().meshes.values() if "curves" in m)
    found = {a["key"]: a for a in hair["attributes"]}
    roots = hair["positions"][hair["curves"][:-1]]
    assert found["uv:"]["domain"] == "FACE"
    assert found["uv:"]["values"] == pytest.approx(0.5 * roots[:, :2] + 0.5, abs=1e-3)
    assert found["generated"]["values"][:, :2] == pytest.approx(0.5 * roots[:, :2] + 0.5, abs=1e-3)
    assert found["curve_intercept"]["values"].tolist() == pytest.approx([0, 0.5, 1] * 5, abs=1e-3)


def test_points(scene, export):
    add_points(scene, 4)
    arrays = export().mesh_of("Points")
    assert arrays["positions"].shape == (4, 3)
    assert arrays["radii"].tolist() == [0.25] * 4
    assert messages() == []


def test_moving_hair(scene, export):
    scene.render.use_motion_blur = True
    hair = add_curves()
    hair.keyframe_insert("location", frame=0)
    hair.location.x = 2.0
    hair.keyframe_insert("location", frame=2)
    lawn = add_square("Lawn")
    add_hair(lawn)
    lawn.keyframe_insert("location", frame=0)
    lawn.location.y = 2.0
    lawn.keyframe_insert("location", frame=2)
    scene.frame_set(1)
    recorder = export()
    assert recorder.motion_of("Hair")[-1][0, 3] > recorder.motion_of("Hair")[0][0, 3]
    moved = [key for key, item in recorder.instances.items() if item["name"] == "Lawn"]
    assert len(moved) == 2 and all(key in recorder.instance_motion for key in moved)


def test_bent_hair_moves_its_keys(scene, export):
    scene.render.use_motion_blur = True
    hair = add_curves()
    tree = bpy.data.node_groups.new("Bend", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    move, time = (
        tree.nodes.new("GeometryNodeSetPosition"),
        tree.nodes.new("GeometryNodeInputSceneTime"),
    )
    tree.links.new(start.outputs[0], move.inputs["Geometry"])
    tree.links.new(time.outputs["Frame"], move.inputs["Offset"])
    tree.links.new(move.outputs[0], end.inputs[0])
    hair.modifiers.new("Nodes", "NODES").node_group = tree
    scene.frame_set(3)
    recorder = export()
    assert list(recorder.mesh_motion)
    positions = next(iter(recorder.mesh_motion.values()))["positions"]
    assert positions[-1][0, 0] - positions[0][0, 0] == pytest.approx(0.5, abs=1e-4)
    assert next(iter(recorder.mesh_motion.values()))["normals"] is None


def test_native_core_takes_it_all(scene, core):
    hair = add_curves()
    hair.data.materials.append(new_material("Fur"))
    tree = hair.data.materials[0].node_tree
    closure = tree.nodes.new("ShaderNodeBsdfHairPrincipled")
    closure.model = "CHIANG"
    info, end = tree.nodes.new("ShaderNodeHairInfo"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(info.outputs["Intercept"], closure.inputs["Roughness"])
    tree.links.new(closure.outputs[0], end.inputs["Surface"])
    add_hair(add_square("Lawn"))
    add_points(scene, 3)
    bpy.ops.render.render()
    assert messages() == []


def test_the_other_model_is_named(scene, core):
    hair = add_curves()
    hair.data.materials.append(new_material("Fur"))
    tree = hair.data.materials[0].node_tree
    closure = tree.nodes.new("ShaderNodeBsdfHairPrincipled")
    closure.model = "HUANG"
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(closure.outputs[0], end.inputs["Surface"])
    bpy.ops.render.render()
    assert "its model HUANG is not supported yet; CHIANG is used" in "\n".join(messages())


def test_poly_curves_are_straight(scene, export):
    add_curves().data.set_types(type="POLY")
    assert export().mesh_of("Hair")["straight"] == part("sync.curves").HAS_STRAIGHT
