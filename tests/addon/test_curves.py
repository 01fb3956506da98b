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


def fur(kind, **settings):
    """A material of one closure: (material, its node)."""
    material = new_material("Fur")
    tree = material.node_tree
    closure, end = tree.nodes.new(kind), tree.nodes.new("ShaderNodeOutputMaterial")
    for name, value in settings.items():
        setattr(closure, name, value)
    tree.links.new(closure.outputs[0], end.inputs["Surface"])
    return material, closure


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
    hair.data.attributes.new("Map", "FLOAT2", "CURVE").data.foreach_set("vector", [1, 2, 3, 4])
    keys = [
        "attribute:tint",
        "uv:",
        "uv:Map",
        "uv:none",
        "curve_intercept",
        "curve_length",
        "curve_radius",
        "attribute:none",
    ]
    fake_core.reads = {"Fur": keys}
    arrays = export().mesh_of("Hair")
    assert arrays["radii"] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])
    found = {a["key"]: (a["domain"], np.ravel(a["values"]).tolist()) for a in arrays["attributes"]}
    assert found["attribute:tint"] == ("FACE", [7, 8])
    assert found["uv:"] == found["uv:Map"] == ("FACE", [1, 2, 3, 4])
    assert found["curve_intercept"] == ("POINT", [0, 0.5, 1, 0, 1])
    assert found["curve_length"] == ("FACE", [2, 1])
    assert found["curve_radius"][1] == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5])
    assert found.keys().isdisjoint(("attribute:none", "uv:none"))


def test_view_layers_may_be_without_hair_or_surfaces(scene, export):
    add_curves()
    add_hair(add_square("Lawn"))
    layer = scene.view_layers[0]
    layer.use_strand = False
    assert list(export().by_name()) == ["Lawn"]
    layer.use_strand, layer.use_solid = True, False
    recorder = export()
    assert sorted(i["name"] for i in recorder.instances.values()) == ["Hair", "Lawn"]
    assert all("curves" in mesh for mesh in recorder.meshes.values())


def test_particle_hair(scene, export):
    lawn = add_square("Lawn")
    lawn.location = (4, 0, 0)
    for name in ("Soil", "Grass", "Moss"):
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


@pytest.mark.parametrize("shape, middle", [(0.0, 0.5), (0.5, 0.25), (-0.5, 0.5**0.5)])
def test_shape_of_hair(scene, shape, middle):
    lawn = add_square("Lawn")
    settings = {"root_radius": 2.0, "tip_radius": 0.0, "radius_scale": 1.0, "shape": shape}
    add_hair(lawn, use_close_tip=False, hair_length=1.0, render_step=1, **settings)
    evaluated = lawn.evaluated_get(bpy.context.evaluated_depsgraph_get())
    arrays = part("sync.curves").particle_hair(evaluated, False, frozenset(), 0)
    assert arrays["radii"][:3] == pytest.approx([1.0, middle, 0.0], rel=0.1, abs=1e-6)


def test_viewports_show_less_hair(scene):
    lawn = add_square("Lawn")
    steps = {"render_step": 3, "display_step": 1, "display_percentage": 50}
    add_hair(lawn, child_type="SIMPLE", child_percent=4, rendered_child_count=4, **steps)
    evaluated = lawn.evaluated_get(bpy.context.evaluated_depsgraph_get())
    shown = part("sync.curves").particle_hair(evaluated, True, frozenset(), 0)
    assert np.diff(shown["curves"]).tolist() == [3] * 10  # of 5 particles with 4 children


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
    """Fur in a slot of its own, too, which no face has."""
    hair = add_curves()
    material, closure = fur("ShaderNodeBsdfHairPrincipled", model="CHIANG")
    hair.data.materials.append(material)
    info = material.node_tree.nodes.new("ShaderNodeHairInfo")
    material.node_tree.links.new(info.outputs["Intercept"], closure.inputs["Roughness"])
    lawn = add_square("Lawn")
    lawn.data.materials.append(bpy.data.materials.new("Soil"))
    lawn.data.materials.append(material)
    add_hair(lawn, material=2)
    add_points(scene, 3)
    bpy.ops.render.render()
    assert messages() == []


def test_what_hair_is_not_is_named(scene, core):
    add_curves().data.materials.append(fur("ShaderNodeBsdfHairPrincipled", model="HUANG")[0])
    add_square("Rug").data.materials.append(fur("ShaderNodeBsdfHair")[0])
    bpy.ops.render.render()
    said = "\n".join(messages())
    assert "its model HUANG is not supported yet; CHIANG is used" in said
    assert "Object 'Rug': its closures of hair are made for hair" in said


def test_what_nodes_make_has_no_hair_of_its_own(scene, export):
    """Instances of the lawn's own mesh that its nodes make."""
    lawn = add_square("Lawn")
    add_hair(lawn)
    tree = bpy.data.node_groups.new("Copies", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    cube, copies = (
        tree.nodes.new("GeometryNodeMeshCube"),
        tree.nodes.new("GeometryNodeInstanceOnPoints"),
    )
    join = tree.nodes.new("GeometryNodeJoinGeometry")
    tree.links.new(start.outputs[0], copies.inputs["Points"])
    tree.links.new(cube.outputs[0], copies.inputs["Instance"])
    tree.links.new(copies.outputs[0], join.inputs[0])
    tree.links.new(start.outputs[0], join.inputs[0])
    tree.links.new(join.outputs[0], end.inputs[0])
    lawn.modifiers.new("Nodes", "NODES").node_group = tree
    recorder = export()
    shown = ["curves" in recorder.meshes[i["mesh"]] for i in recorder.instances.values()]
    assert len(shown) == 6 and sum(shown) == 1  # the lawn, its hair, and four cubes


def test_poly_curves_are_straight(scene, export):
    curves = add_curves().data
    if not hasattr(curves, "set_types"):
        pytest.skip("this Blender lets no script set the type of curves")
    curves.set_types(type="POLY")
    assert export().mesh_of("Hair")["straight"] == part("sync.curves").HAS_STRAIGHT
