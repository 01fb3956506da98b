# SPDX-License-Identifier: GPL-3.0-or-later
"""What shaders read of meshes and objects, as the exporter sends it."""

import bpy
import numpy as np
import pytest
from conftest import add_square, messages, new_material, part


@pytest.fixture
def square(scene, fake_core):
    """A square of material Paint."""
    obj = add_square()
    material = new_material("Paint")
    material.node_tree.nodes.new("ShaderNodeOutputMaterial")
    obj.data.materials.append(material)
    return obj


def test_edges_become_points(square, fake_core, export):
    attribute = square.data.attributes.new("Edge", "FLOAT", "EDGE")
    attribute.data.foreach_set("value", np.arange(4, dtype=np.float32))
    ends = [tuple(edge.vertices) for edge in square.data.edges]
    fake_core.reads["Paint"] = ["attribute:Edge"]
    (sent,) = export().mesh_of("Square")["attributes"]
    assert sent["domain"] == "POINT"
    expected = [np.mean([i for i in range(4) if v in ends[i]]) for v in range(4)]
    assert sent["values"].ravel() == pytest.approx(expected)


def test_rotations_on_edges_are_named(square, fake_core, export):
    square.data.attributes.new("Turn", "QUATERNION", "EDGE")
    fake_core.reads["Paint"] = ["attribute:Turn"]
    assert "attributes" not in export().mesh_of("Square")
    (message,) = messages("WARNING")
    assert "Square" in message and "Turn" in message


def test_what_is_computed_comes_with_its_edges(square, fake_core, export):
    fake_core.reads["Paint"] = ["pointiness"]
    sent = export().mesh_of("Square")
    assert [a["key"] for a in sent["attributes"]] == ["normal", "pointiness"]
    assert sent["edges"].shape == (4, 2)


def test_tangents_of_a_face_of_five(scene, square, fake_core, export):
    mesh = bpy.data.meshes.new("Five")
    corners = [(0, 0, 0), (2, 0, 0), (3, 1, 0), (1, 2, 0), (0, 1, 0)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3, 4)])
    flat = np.array(corners, np.float32)[:, :2]
    mesh.uv_layers.new(name="UVMap").uv.foreach_set("vector", flat.ravel())
    mesh.materials.append(square.data.materials[0])
    square.data = mesh
    fake_core.reads["Paint"] = ["tangent:", "tangent_sign:UVMap"]
    tangent, sign = export().mesh_of("Square")["attributes"]
    assert tangent["values"] == pytest.approx(np.tile([1, 0, 0, 1], (5, 1)), abs=1e-5)
    assert sign["values"] == pytest.approx(np.ones((5, 1)))
    assert messages("WARNING") == [] and len(mesh.polygons) == 1


def test_properties_of_objects(square, fake_core, export):
    """The object's, then its mesh's; a name may be a path. What is no number is passed over."""
    square["A"], square["B"], square["C"] = 0.5, "text", [1, 2]
    square.data["A"], square.data["B"] = 9.0, 7.0
    square.color = (0.1, 0.2, 0.3, 0.4)
    names = ("A", "B", "C", "color", "color[0]", "D")
    fake_core.reads["Paint"] = [f"object:{name}" for name in names]
    (instance,) = export().instances.values()
    found = {key.removeprefix("object:"): value for key, value in instance["attributes"].items()}
    assert found["A"] == (0.5, 0.5, 0.5, 1.0)
    assert found["B"] == (7.0, 7.0, 7.0, 1.0)
    assert found["C"] == (1.0, 2.0, 0.0, 1.0)
    assert found["color"] == pytest.approx((0.1, 0.2, 0.3, 0.4))
    assert found["color[0]"] == found["D"] == (0.0, 0.0, 0.0, 0.0)


def test_view_layers(scene):
    scene["A"] = 2
    value = part("sync.properties").view_layer_value
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    assert value(graph, "A") == (2.0, 2.0, 2.0, 1.0)
    assert value(graph, "render.resolution_x")[0] == scene.render.resolution_x
    assert value(graph, "B") == (0.0, 0.0, 0.0, 0.0)
