# SPDX-License-Identifier: GPL-3.0-or-later
"""A small scene as plain arguments of SceneBuilder."""

import janus_core
import numpy as np
import pytest

IDENTITY = np.eye(4)


def shader(kind: str, **inputs) -> dict:
    node = {"name": "Shader", "type": kind, "inputs": inputs, "properties": {}}
    return {"nodes": [node], "surface": {"link": ["Shader", "BSDF"]}}


def translation(x, y, z) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


PLANE = {
    "positions": np.array([(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], dtype=np.float32),
    "triangles": np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32),
}


def fill(builder) -> None:
    """A floor below the camera, lit by a lamp near its +x side."""
    builder.set_mesh("mesh", name="Floor", **PLANE)
    builder.set_material("m", name="Paint", graph=shader("BSDF_DIFFUSE", Color=[0.8, 0.5, 0.2, 1]))
    builder.set_instance("floor", name="Floor", mesh="mesh", transform=IDENTITY, materials=["m"])
    builder.set_light("lamp", name="Lamp", type="POINT", transform=translation(1.5, 0, 0.5))
    builder.set_camera(
        name="Camera", transform=translation(0, 0, 4), window=(-0.5, 0.5, -0.25, 0.25)
    )


def sky(builder, pixels, **arguments):
    """A world of a picture."""
    builder.set_image("sky", name="Sky", pixels=pixels, **arguments)
    map_node = {"name": "Map", "type": "TEX_ENVIRONMENT", "properties": {"image": "sky"}}
    shader = {"name": "Shader", "type": "BACKGROUND"}
    shader["inputs"] = {"Color": {"link": ["Map", "Color"]}, "Strength": 2.0}
    graph = {"nodes": [map_node, shader], "surface": {"link": ["Shader", "Background"]}}
    builder.set_world(name="World", graph=graph)


SETTINGS = {"width": 32, "height": 16, "samples": 4, "max_bounces": 4}


def render(scene, **changes):
    settings = janus_core.RenderSettings(**{**SETTINGS, **changes})
    session = janus_core.RenderSession(scene, settings)
    session.start()
    session.finish()
    return session


def endless(scene):
    settings = janus_core.RenderSettings(**{**SETTINGS, "samples": 1 << 30})
    return janus_core.RenderSession(scene, settings)


@pytest.fixture
def builder():
    builder = janus_core.SceneBuilder()
    fill(builder)
    return builder
