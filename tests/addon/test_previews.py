# SPDX-License-Identifier: GPL-3.0-or-later
"""Previews of materials, worlds and lights, as Blender asks for them."""

import bpy
import numpy as np
import pytest
from conftest import part


def picture(item) -> np.ndarray:
    """The preview that Blender makes of a data-block, RGBA from 0 to 1."""
    item.asset_mark()
    item.preview_ensure()
    item.asset_generate_preview()
    width, height = item.preview.image_size
    return np.array(item.preview.image_pixels_float[:], np.float32).reshape(height, width, 4)


def colored(item, kind: str, socket: str, color):
    item.use_nodes = True
    node = next(node for node in item.node_tree.nodes if node.type == kind)
    node.inputs[socket].default_value = (*color, 1.0)
    return item


def red_material():
    material = bpy.data.materials.new("Red")
    return colored(material, "BSDF_PRINCIPLED", "Base Color", (0.8, 0.05, 0.05))


def sky():
    return colored(bpy.data.worlds.new("Sky"), "BACKGROUND", "Color", (0.1, 0.2, 0.9))


@pytest.fixture
def asked(monkeypatch):
    """How often Janus was asked for a preview."""
    preview, calls = part("render.preview"), []

    def render(engine, depsgraph, original=preview.render_preview):
        calls.append(depsgraph.scene.name)
        original(engine, depsgraph)

    monkeypatch.setattr(preview, "render_preview", render)
    return calls


@pytest.mark.parametrize("make", [red_material, sky])
def test_shows_what_cycles_shows(scene, core, asked, make):
    scene.render.engine = "CYCLES"
    expected = picture(make())
    assert not asked
    scene.render.engine = "JANUS"
    found = picture(make())
    assert asked
    means = [(p[..., :3] * p[..., 3:]).mean((0, 1)) for p in (found, expected)]
    assert np.allclose(*means, rtol=0.1, atol=0.01)
    assert np.abs(found[..., 3] - expected[..., 3]).mean() < 0.05


def test_says_nothing_of_the_preview_scene(scene, core, asked):
    part("render.final").last_render.clear()
    picture(red_material())
    assert asked and part("render.final").last_render == {}
    assert part("report").kept(asked[0]) == []


def test_a_preview_that_fails_is_a_picture_all_the_same(scene, core, asked, monkeypatch):
    def fails(*_):
        raise RuntimeError("no preview")

    monkeypatch.setattr(part("render.preview"), "_render", fails)
    found = picture(red_material())
    assert asked and found.shape[2] == 4
