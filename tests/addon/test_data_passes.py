# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of data in Blender: which there are, what they are called, and what is in the file."""

import json

import bpy
import numpy as np
import pytest
from conftest import add_square, part

TOGGLES = [
    f"use_pass_{name}"
    for name in (
        "z mist position normal uv object_index material_index cryptomatte_object "
        "cryptomatte_material cryptomatte_asset diffuse_direct emit environment"
    ).split()
]


@pytest.fixture
def layer(scene):
    layer = scene.view_layers[0]
    for toggle in TOGGLES:
        setattr(layer, toggle, True)
    for settings in (layer.janus, layer.cycles):
        settings.denoising_store_passes = settings.pass_debug_sample_count = True
        settings.use_denoising = False
    for name, kind in (("Tint", "COLOR"), ("Mask", "VALUE")):
        aov = layer.aovs.add()
        aov.name, aov.type = name, kind
    return layer


class Engine:
    """Records what is registered."""

    def __init__(self):
        self.found = {}

    def register_pass(self, _scene, _layer, name, count, channels, kind):
        assert count == len(channels)
        self.found[name] = (channels, kind)


@pytest.mark.parametrize("levels", [2, 5, 6, 16])
def test_are_called_as_cycles_calls_them(scene, layer, levels):
    import cycles.engine

    layer.pass_cryptomatte_depth = levels
    theirs = {
        name: (ids, kind) for name, ids, kind in cycles.engine.list_render_passes(scene, layer)
    }
    engine = Engine()
    part("render.passes").register_passes(engine, scene, layer)
    assert engine.found == theirs


def saved(scene, path) -> tuple[dict, dict]:
    """Pictures and metadata of a render of the scene with all its passes."""
    from janus_core import exr

    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy.ops.render.render()
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
    pictures, metadata = exr.read_layers(path)
    return {name.split(".")[-1]: pixels for name, pixels in pictures.items()}, metadata


def mattes(metadata: dict) -> dict:
    """The Cryptomatte entries of a file, without their prefix."""
    return {key[12:]: text for key, text in metadata.items() if key.startswith("cryptomatte/")}


def test_cryptomatte_says_what_its_numbers_mean(scene, layer, core, tmp_path):
    square = add_square("Square")
    square.data.materials.append(bpy.data.materials.new("Métal"))
    child = add_square("Child")
    child.parent, child.location = square, (0.6, 0.0, 0.5)
    scene.janus.samples = 8
    pictures, metadata = saved(scene, tmp_path / "janus.exr")
    scene.render.engine, scene.cycles.samples = "CYCLES", 8
    theirs, their_metadata = saved(scene, tmp_path / "cycles.exr")
    ours, cycles = mattes(metadata), mattes(their_metadata)
    assert len(ours) == 12 and ours.keys() == cycles.keys()
    for key, text in ours.items():
        if key.endswith("/manifest"):  # Cycles names all objects of the scene
            assert json.loads(text).items() <= json.loads(cycles[key]).items()
            assert json.loads(text)
        else:
            assert text == cycles[key]
    names = json.loads(next(t for k, t in ours.items() if k.endswith("manifest") and "Child" in t))
    number = np.uint32(int(names["Square"], 16)).view(np.float32)
    assert number in pictures["CryptoObject00"][..., 0]
    assert pictures.keys() == theirs.keys()
    for name in ("Depth", "Position"):
        assert np.allclose(np.median(pictures[name]), np.median(theirs[name]), rtol=0.1)


def test_sample_counts_are_parts_of_all(scene, layer, core, tmp_path):
    """Or else an editor of images shows white."""
    add_square()
    scene.janus.samples = scene.cycles.samples = 8
    scene.cycles.use_adaptive_sampling = False
    for engine in ("JANUS", "CYCLES"):
        scene.render.engine = engine
        pictures, _ = saved(scene, tmp_path / "counts.exr")
        assert np.all(pictures["Debug Sample Count"] == 1.0)
    scene.render.engine, scene.janus.samples = "JANUS", 256
    scene.janus.use_adaptive_sampling, scene.janus.adaptive_threshold = True, 0.05
    pictures, _ = saved(scene, tmp_path / "counts.exr")
    assert (
        0.0 < pictures["Debug Sample Count"].min() and pictures["Debug Sample Count"].max() == 1.0
    )


def test_uv_needs_no_material_that_reads_it(scene, layer, core, tmp_path):
    square = add_square()
    square.data.uv_layers.new(name="UVMap").data.foreach_set("uv", [0, 0, 1, 0, 1, 1, 0, 1])
    pictures, _ = saved(scene, tmp_path / "uv.exr")
    uv = pictures["UV"][pictures["UV"][..., 2] > 0.99]
    assert uv[:, :2].max() > 0.7 and uv[:, :2].min() < 0.3


def test_mist_is_the_worlds(scene, layer):
    world = scene.world = bpy.data.worlds.new("Hazy")
    world.mist_settings.start, world.mist_settings.depth = 1.5, 4.0
    world.mist_settings.falloff = "INVERSE_QUADRATIC"
    assert part("sync.passes").data_arguments(scene, layer)["mist"] == (1.5, 4.0, 0.5)


def test_what_occludes_is_as_near_as_the_world_says(scene, layer):
    def distance():
        return part("sync.passes").data_arguments(scene, layer)["occlusion_distance"]

    assert distance() == 0.0  # however far
    scene.world = bpy.data.worlds.new("Near")
    scene.world.light_settings.distance = 2.5
    assert distance() == 2.5


def test_no_expression_may_have_the_name(scene, layer):
    item = layer.janus.expressions.add()
    for name in ("Depth", "Denoising Albedo", "CryptoObject00"):
        item.name = name
        assert "another pass" in part("sync.passes").name_problem(layer, item)
