# SPDX-License-Identifier: GPL-3.0-or-later
"""What rays meet, what holds out, and what is named because it is rendered otherwise."""

import bpy
import pytest
from conftest import add_square, messages, new_material


def test_unsupported_things_are_named(scene, export):
    square = add_square("Square")
    bpy.ops.object.volume_add()
    material = new_material("Foggy")
    output = material.node_tree.nodes.new("ShaderNodeOutputMaterial")
    for kind, socket in (("VolumeScatter", "Volume"), ("Displacement", "Displacement")):
        node = material.node_tree.nodes.new(f"ShaderNode{kind}")
        material.node_tree.links.new(node.outputs[0], output.inputs[socket])
    material.displacement_method = "BOTH"
    square.data.materials.append(material)
    scene.world = bpy.data.worlds.new("Sky")
    scene.world.cycles.max_bounces = 3
    export()
    text = "\n".join(messages())
    for expected in (
        "Object 'Volume': volumes",
        "Material 'Foggy': volumes",
        "Material 'Foggy', node 'Material Output': displacement of the surface itself",
    ):
        assert expected in text, text
    material.displacement_method = "BUMP"
    export()
    assert "displacement" not in "\n".join(messages())
    assert any("Object 'Sky': the world's own limit" in text for text in messages("INFO"))


def test_settings_of_cycles_alone_are_named(scene, export):
    add_square("Plain")
    far, soft, softer = add_square("Far"), add_square("Soft"), add_square("Softer")
    far.cycles.use_distance_cull = far.cycles.use_camera_cull = True
    scene.cycles.use_distance_cull = True
    soft.cycles.shadow_terminator_offset = 0.2
    softer.cycles.shadow_terminator_geometry_offset = 0.3
    scene.cycles.use_fast_gi = True
    export()
    found = messages()
    assert len(found) == 3
    assert "Object 'Far': Distance Cull" in found[0]
    assert "Object 'Soft': offsets of the shadow terminator" in found[1]
    assert "Object 'Softer': offsets of the shadow terminator" in found[2]
    assert any("Fast GI" in text for text in messages("INFO"))


def test_findings_are_counted_not_repeated(scene, export):
    for x in range(5):
        square = add_square()
        square.name = f"Square {x}"
        square.cycles.shadow_terminator_offset = 0.2 * (x == 1)
    export()
    assert len(messages()) == 1


RAYS = ("camera", "diffuse", "glossy", "transmission", "shadow")


def hidden_from(instance):
    return {ray for ray in RAYS if not instance[f"visible_{ray}"]}


@pytest.mark.parametrize("ray", RAYS)
def test_ray_visibility(scene, export, ray):
    setattr(add_square(), f"visible_{ray}", False)
    assert hidden_from(export().by_name()["Square"]) == {ray}
    assert not messages()


def test_who_instances_an_object_may_hide_it_too(scene, export):
    collection = bpy.data.collections.new("Source")
    collection.objects.link(bpy.data.objects.new("Inside", add_square("Plain").data))
    collection.objects["Inside"].visible_glossy = False
    for name, ray in (("A", "shadow"), ("B", "diffuse")):
        empty = bpy.data.objects.new(name, None)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        setattr(empty, f"visible_{ray}", False)
        scene.collection.objects.link(empty)
    found = [hidden_from(i) for i in export().instances.values() if i["name"] == "Inside"]
    assert sorted(map(sorted, found)) == [["diffuse", "glossy"], ["glossy", "shadow"]]


def test_indirect_only_collections_are_hidden_from_the_camera(scene, export):
    collection = bpy.data.collections.new("Behind")
    scene.collection.children.link(collection)
    collection.objects.link(bpy.data.objects.new("Square", add_square("Plain").data))
    layer = scene.view_layers[0].layer_collection.children["Behind"]
    layer.indirect_only = True
    instances = export().by_name()
    assert hidden_from(instances["Square"]) == {"camera"}
    assert hidden_from(instances["Plain"]) == set()
    assert not messages()


def held(recorder, name):
    return [i["holdout"] for i in recorder.instances.values() if i["name"] == name]


def test_holdout_objects(scene, export):
    add_square("Hole").is_holdout = True
    add_square("Plain")
    recorder = export()
    assert (held(recorder, "Hole"), held(recorder, "Plain")) == ([True], [False])
    assert not messages()


def test_holdout_collections_do_not_pass_it_on(scene, export):
    """As in Blender, where each collection of the view layer has a switch of its own."""
    outer, inner = (bpy.data.collections.new(name) for name in ("Outer", "Inner"))
    scene.collection.children.link(outer)
    outer.children.link(inner)
    mesh = add_square("Plain").data
    outer.objects.link(bpy.data.objects.new("In outer", mesh))
    inner.objects.link(bpy.data.objects.new("In inner", mesh))
    layer = scene.view_layers[0].layer_collection.children["Outer"]
    names = ("In outer", "In inner", "Plain")
    layer.holdout = True
    recorder = export()
    assert [held(recorder, name) for name in names] == [[True], [False], [False]]
    layer.holdout, layer.children["Inner"].holdout = False, True
    recorder = export()
    assert [held(recorder, name) for name in names] == [[False], [True], [False]]
    assert not messages()


def test_who_instances_an_object_says_whether_it_holds_out(scene, export):
    """As in Cycles, where the instanced object itself has no say."""
    collection = bpy.data.collections.new("Source")
    for name in ("Inside", "Hole"):
        collection.objects.link(bpy.data.objects.new(name, add_square(f"{name} alone").data))
    collection.objects["Hole"].is_holdout = True
    for name in ("A", "B"):
        empty = bpy.data.objects.new(name, None)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        empty.is_holdout = name == "B"
        scene.collection.objects.link(empty)
    recorder = export()
    assert sorted(held(recorder, "Inside")) == sorted(held(recorder, "Hole")) == [False, True]
