# SPDX-License-Identifier: GPL-3.0-or-later
"""Every shader node of this Blender is supported, or refused by name; the document says which."""

import bpy
import node_coverage
import pytest
from conftest import add_square, messages, new_material


def test_nothing_is_undeclared(scene, core):
    assert node_coverage.undeclared() == []


def test_what_is_refused_is_not_in_the_table_as_well(core):
    declared = set(node_coverage.core_nodes())
    apart = (set(node_coverage.REFUSED), node_coverage.NOT_FOR_CYCLES, node_coverage.FLATTENED)
    assert [kind for group in apart for kind in group & declared] == []


@pytest.mark.skipif(bpy.app.version[:2] != (5, 0), reason="the document is that of Blender 5.0")
def test_document_is_up_to_date(scene, core):
    assert node_coverage.DOCUMENT.read_text() == node_coverage.document(), (
        "run tests/addon/node_coverage.py --write"
    )


def test_new_entries_are_noticed(scene, core, monkeypatch):
    """As if Blender had got a node, a socket and an operation."""
    nodes = node_coverage.blender_nodes()
    nodes["NEW_NODE"] = nodes["GAMMA"]
    nodes["GAMMA"][0]["inputs"].append("New Input")
    nodes["MATH"][0]["settings"]["operation"].append("NEW_OPERATION")
    monkeypatch.setattr(node_coverage, "blender_nodes", lambda: nodes)
    expected = ["item MATH.operation.NEW_OPERATION", "node NEW_NODE", "socket GAMMA.New Input"]
    found = node_coverage.undeclared()
    assert sorted(set(found)) == sorted({*expected, "socket NEW_NODE.New Input"} & set(found))
    assert set(expected) <= set(found)


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
