# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on says only in some versions of Blender: the tests with Blender run in one."""

import numpy as np
import pytest

from .conftest import IDENTITY, PLANE, render

SLANTED = [0.6, 0.0, 0.8]


def shown(builder, node, output, transform=IDENTITY):
    """What a node gives on the floor, as light; of some attributes."""
    lamp = {"Color": {"link": ["Node", output]}, "Strength": 1.0}
    emission = {"name": "Lamp", "type": "EMISSION", "inputs": lamp, "properties": {}}
    graph = {"nodes": [{"name": "Node", **node}, emission]}
    graph["surface"] = {"link": ["Lamp", "Emission"]}
    builder.set_world(name="", graph=None)
    builder.set_material("m", name="Paint", graph=graph)
    attributes = [
        {"key": "normal", "domain": "POINT", "values": np.tile(SLANTED, (4, 1))},
        {"key": "tangent:", "domain": "POINT", "values": np.tile([1.0, 0.0, 0.0, 1.0], (4, 1))},
    ]
    builder.set_mesh("mesh", name="M", **PLANE, attributes=attributes)
    builder.set_instance("floor", name="Floor", mesh="mesh", transform=transform, materials=["m"])
    picture = render(builder.commit()).snapshot()
    return picture[picture.shape[0] // 2, picture.shape[1] // 2, :3]


@pytest.mark.parametrize("space", ["TANGENT", "OBJECT", "WORLD"])
def test_green_of_directx_points_down(builder, space):
    """Blender 5.1+."""

    def mapped(convention, green):
        properties = {"space": space, "uv_map": "", "convention": convention}
        inputs = {"Strength": 1.0, "Color": [0.7, green, 0.9, 1.0]}
        node = {"type": "NORMAL_MAP", "inputs": inputs, "properties": properties}
        return shown(builder, node, "Normal")

    usual = mapped("OPENGL", 0.75)
    assert usual[1] > 0.2
    assert mapped("DIRECTX", 0.25) == pytest.approx(usual, abs=1e-6)
    assert mapped("DIRECTX", 0.75)[1] == 0.0  # light below zero is none


@pytest.mark.parametrize("in_world", [False, True])
def test_normals_of_vertices_as_attribute(builder, in_world):
    """In world space in Blender 5.1+; a scaling leaves them as long as they are."""
    properties = {"attribute_type": "GEOMETRY", "attribute_name": "N"}
    if in_world:
        properties["world_normals"] = True
    node = {"type": "ATTRIBUTE", "inputs": {}, "properties": properties}
    transform = np.eye(4)
    transform[:3, :3] = 2.0 * np.array([[0.8, -0.6, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    expected = [0.48, 0.36, 0.8] if in_world else SLANTED
    assert shown(builder, node, "Vector", transform) == pytest.approx(expected, abs=1e-5)
