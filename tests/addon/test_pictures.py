# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as the exporter sends them."""

import bpy
import numpy as np
import pytest
from conftest import environment, messages, part, picture


def test_world_image_of_floats(scene, export):
    pixels = np.random.default_rng(1).uniform(0.0, 9.0, (2, 4, 4))
    environment(scene, picture(pixels, float_buffer=True)).interpolation = "Closest"
    recorder = export()
    ((key, sent),) = recorder.images.items()
    node = next(n for n in recorder.world["graph"]["nodes"] if n["type"] == "TEX_ENVIRONMENT")
    assert node["properties"]["image"] == key
    assert node["properties"]["interpolation"] == "Closest"
    assert node["properties"]["projection"] == "EQUIRECTANGULAR"
    assert sent["name"] == "Picture" and sent["srgb"] is False
    assert sent["pixels"] == pytest.approx(pixels, rel=1e-6)


@pytest.mark.parametrize(
    ("space", "srgb"), [("sRGB", True), ("Non-Color", False), ("Linear Rec.709", False)]
)
def test_world_image_of_bytes(scene, export, space, srgb):
    pixels = np.zeros((2, 4, 4))
    pixels[..., 0], pixels[..., 3] = np.arange(8).reshape(2, 4) / 255.0, 1.0
    pixels[1, 3] = (100 / 255, 0, 0, 128 / 255)
    environment(scene, picture(pixels, space))
    (sent,) = export().images.values()
    assert sent["srgb"] is srgb
    expected = np.arange(8)
    # Cycles multiplies colours by alpha, in bytes; what is no colour it leaves alone.
    expected[7] = 100 if space == "Non-Color" else 50
    assert 255 * sent["pixels"][..., 0].ravel() == pytest.approx(expected, abs=1e-4)
    assert messages("WARNING") == []


def test_other_color_spaces_are_converted(scene, export):
    environment(scene, picture([[[0.2, 0.4, 0.6, 1.0]]], "ACEScg"))
    (sent,) = export().images.values()
    assert sent["srgb"] is False
    # AP1 to Rec.709, from D60 to D65; rows add up to 1.
    matrix = [[1.7050, -0.6218, -0.0833], [-0.1303, 1.1408, -0.0105], [-0.0240, -0.1290, 1.1530]]
    assert sent["pixels"][0, 0, :3] == pytest.approx(np.array(matrix) @ [0.2, 0.4, 0.6], abs=2e-3)
    assert messages("WARNING") == []
    assert "Janus" not in " ".join(image.name for image in bpy.data.images)  # nothing is left


def test_color_spaces_that_cannot_be_converted_are_named(scene, export, monkeypatch):
    monkeypatch.setattr(part("sync.image"), "kind_of_space", lambda space: "UNKNOWN")
    environment(scene, picture(np.ones((1, 1, 4))))
    assert next(iter(export().images.values()))["srgb"] is False
    (message,) = messages("WARNING")
    assert "Picture" in message and "Environment Texture" in message and "sRGB" in message


def test_world_without_its_image(scene, core):
    """The core names the node; nothing else happens."""
    image = bpy.data.images.new("Gone", 4, 2)
    image.source, image.filepath = "FILE", "/nowhere/gone.hdr"
    for broken in (None, image):
        environment(scene, broken)
        part("report").forget()
        bpy.ops.render.render()
        (message,) = messages("WARNING")
        assert "Environment Texture" in message and "missing" in message
