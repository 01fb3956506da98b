# SPDX-License-Identifier: GPL-3.0-or-later
"""Every shader node of every Blender is supported, or refused by name; the document says which."""

import bpy
import node_coverage
import node_document
import pytest
import record_nodes
import recordings
from conftest import add_square, messages, new_material

RECORDINGS = recordings.stored(record_nodes.FOLDER)


@pytest.mark.parametrize("version", RECORDINGS)
def test_nothing_is_undeclared(core, version):
    assert node_coverage.undeclared(RECORDINGS[version]) == []


def test_recording_of_this_blender_is_up_to_date(scene):
    version = recordings.version()
    how = (
        "`python tests/addon/record_nodes.py`, or `blender -b --factory-startup --python "
        "tests/addon/record_nodes.py` where bpy is no module, writes the recording"
    )
    assert version in RECORDINGS, f"nobody has recorded the nodes of Blender {version}: {how}"
    assert record_nodes.recording() == RECORDINGS[version], f"not as recorded: {how}"


def test_what_is_refused_is_not_in_the_table_as_well(core):
    declared = set(node_coverage.core_nodes())
    apart = (set(node_coverage.REFUSED), node_coverage.NOT_FOR_CYCLES, node_coverage.FLATTENED)
    assert [kind for group in apart for kind in group & declared] == []


def test_what_is_refused_is_in_some_blender():
    """Or else it is misspelt."""
    there = {e["type"] for recording in RECORDINGS.values() for e in recording.values()}
    declared = {*node_coverage.REFUSED, *node_coverage.NOT_FOR_CYCLES, *node_coverage.FLATTENED}
    assert declared | set(node_coverage.RENAMED) <= there


def test_document_is_up_to_date(core):
    assert node_document.DOCUMENT.read_text() == node_document.document(), (
        "run tests/addon/node_document.py --write"
    )


def test_new_entries_are_noticed(core):
    """As if Blender had got a node, sockets and an operation, and an input another type."""
    nodes = {name: dict(entry) for name, entry in RECORDINGS["5.0"].items()}
    gamma, math = nodes["ShaderNodeGamma"], nodes["ShaderNodeMath"]
    nodes["ShaderNodeNew"] = {**gamma, "type": "NEW_NODE"}
    color, exponent = gamma["inputs"]
    gamma["inputs"] = [color, [exponent[0], "RGBA"], ["New Input", "VALUE"]]
    gamma["outputs"] = [*gamma["outputs"], ["New Output", "VALUE"]]
    operations = [*math["settings"]["operation"], "NEW_OPERATION"]
    math["settings"] = {"operation": operations, "new_setting": ["A"]}
    assert sorted(node_coverage.undeclared(nodes)) == [
        "item MATH.new_setting.A",
        "item MATH.operation.NEW_OPERATION",
        "node NEW_NODE",
        "socket GAMMA.New Input",
        "socket GAMMA.New Output",
        "type GAMMA.Gamma RGBA",
    ]


def refused_kinds():
    """(bl_idname, node.type) of the refused nodes of this Blender that have an output."""
    tree = new_material("Refused").node_tree
    for name in sorted(dir(bpy.types)):
        kind = getattr(bpy.types, name)
        if isinstance(kind, type) and issubclass(kind, bpy.types.ShaderNode):
            try:
                node = tree.nodes.new(name)
            except RuntimeError:
                continue
            if node.type in node_coverage.REFUSED and any(o.enabled for o in node.outputs):
                yield name, node.type


def test_what_is_refused_is_named(scene, core):
    """Each in a material of its own: the warnings say which."""
    kinds = dict(refused_kinds())
    for name in kinds:
        material = new_material(name)
        tree = material.node_tree
        node = tree.nodes.new(name)
        output = next(o for o in node.outputs if o.enabled)
        end = tree.nodes.new("ShaderNodeOutputMaterial")
        tree.links.new(output, end.inputs["Surface"])
        if name.startswith("ShaderNodeVolume") and output.type == "SHADER":
            tree.links.new(output, end.inputs["Volume"])
        add_square(name).data.materials.append(material)
    bpy.ops.render.render()
    said = "\n".join(messages("WARNING"))
    assert [name for name in kinds if f"'{name}'" not in said] == []
