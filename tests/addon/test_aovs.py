# SPDX-License-Identifier: GPL-3.0-or-later
"""AOVs: which nodes are sent, and what Blender gets."""

import bpy
import numpy as np
import pytest
from conftest import add_square, messages, new_material, part


@pytest.fixture
def layer(scene):
    layer = scene.view_layers[0]
    for name, kind in (("Tint", "COLOR"), ("Mask", "VALUE")):
        aov = layer.aovs.add()
        aov.name, aov.type = name, kind
    return layer


def write(tree, name, color=(0.1, 0.2, 0.3, 1.0), value=0.5):
    node = tree.nodes.new("ShaderNodeOutputAOV")
    node.aov_name = name
    node.inputs["Color"].default_value, node.inputs["Value"].default_value = color, value
    return node


@pytest.fixture
def tree(layer):
    material = new_material("Paint")
    add_square("Square").data.materials.append(material)
    tree = material.node_tree
    shader, output = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("BsdfDiffuse", "OutputMaterial")
    )
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return tree


def aovs_of(builder, name="Paint"):
    """What was sent of a material: [(name of the AOV, inputs)] and the other nodes, by type."""
    graph = next(m for m in builder.materials.values() if m["name"] == name)["aovs"]
    if graph is None:
        return [], []
    ends = [n for n in graph["nodes"] if n["type"] == "OUTPUT_AOV"]
    assert graph["surface"] is None and all(set(n["properties"]) == {"aov_name"} for n in ends)
    found = [(n["properties"]["aov_name"], n["inputs"]) for n in ends]
    return sorted(found, key=str), [n["type"] for n in graph["nodes"] if n not in ends]


def test_inputs_are_those_of_the_type(export, tree):
    for name in ("Tint", "Mask", "Unknown", ""):
        write(tree, name)
    found, others = aovs_of(export())
    assert found == [
        ("Mask", {"Value": 0.5}),
        ("Tint", {"Color": pytest.approx([0.1, 0.2, 0.3, 1.0])}),
    ]
    assert others == []


def test_surfaces_are_as_without(export, tree):
    write(tree, "Tint")
    (material,) = export().materials.values()
    assert [node["type"] for node in material["graph"]["nodes"]] == ["BSDF_DIFFUSE"]


def test_what_is_linked_comes_along(export, tree):
    end = write(tree, "Tint")
    fresnel = tree.nodes.new("ShaderNodeFresnel")
    tree.links.new(fresnel.outputs[0], end.inputs["Color"])
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["UV"], end.inputs["Value"])
    found, others = aovs_of(export())
    assert found == [("Tint", {"Color": {"link": ["Fresnel", "Fac"]}})]
    assert others == ["FRESNEL"]


def test_groups_write_each_time(export, tree):
    inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    write(inner, "Mask")
    outer = bpy.data.node_groups.new("Outer", "ShaderNodeTree")
    outer.nodes.new("ShaderNodeGroup").node_tree = inner
    for muted in (False, False, True):
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree, node.mute = outer, muted
    found, _ = aovs_of(export())
    assert found == [("Mask", {"Value": 0.5})] * 2


def test_muted_nodes_write_from_blender_5_on(export, tree):
    write(tree, "Mask").mute = True
    found, _ = aovs_of(export())
    assert len(found) == (bpy.app.version >= (5, 0, 0))


def test_material_without_output_writes(export, tree):
    tree.nodes.remove(tree.get_output_node("CYCLES"))
    write(tree, "Mask")
    assert len(aovs_of(export())[0]) == 1


def test_worlds_write(export, scene, tree):
    scene.world = bpy.data.worlds.new("Sky")
    if bpy.app.version < (5, 0, 0):
        scene.world.use_nodes = True
    write(scene.world.node_tree, "Mask", value=2.0)
    (end,) = export().world["aovs"]["nodes"]
    assert end["inputs"] == {"Value": 2.0}


def test_settings_name_them(export, layer, fake_core):
    export()
    assert fake_core.settings.aovs == [("Tint", "COLOR"), ("Mask", "VALUE")]
    assert messages() == []


def test_viewports_do_not_need_them(scene, tree, fake_core):
    write(tree, "Mask")
    builder = fake_core.SceneBuilder()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    cache = part("sync.cache").SceneCache(builder)
    part("sync.scene_sync").sync_objects(builder, depsgraph, cache, part("report").DiagnosticsLog())
    assert aovs_of(builder) == ([], [])


def test_blender_gets_them(scene, layer, tree, core):
    scene.camera.location = (0.0, 0.0, 1.0)  # nothing but the square
    write(tree, "Tint", (0.25, 0.5, 2.0, 0.0))
    write(tree, "Mask", value=-3.0)
    scene.janus.samples = 4
    final = part("render.final")
    final.keep_passes_of.add(scene.name_full)
    try:
        bpy.ops.render.render()
        kept = final.kept_passes.pop(layer.name)
    finally:
        final.keep_passes_of.clear()
    assert messages("ERROR") == [] and kept["Tint"].shape[2] == 4
    assert np.allclose(kept["Tint"][4:8, 6:10], (0.25, 0.5, 2.0, 1.0), atol=1e-6)
    assert np.allclose(kept["Mask"][4:8, 6:10], -3.0, atol=1e-6)


def test_names_of_other_passes_are_taken(scene, layer):
    table = part("sync.passes")
    layer.aovs[0].name = "Caustics"
    assert [aov.name for aov in table.aovs(layer)] == ["Caustics", "Mask"]
    layer.janus.use_pass_caustics = True
    assert [aov.name for aov in table.aovs(layer)] == ["Mask"]
    assert table.unsupported(layer) == [
        "The AOV 'Caustics' is not rendered: another pass has its name"
    ]
    names = [found.name for found in table.requested(scene, layer)]
    assert len(names) == len(set(names))
