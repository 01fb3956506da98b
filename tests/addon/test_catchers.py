# SPDX-License-Identifier: GPL-3.0-or-later
"""Shadow catchers: which objects are, which lights shine on them, and their pass."""

import bpy
import numpy as np
import pytest
from conftest import add_light, add_mesh, add_square, messages, part


@pytest.fixture
def layer(scene):
    return scene.view_layers[0]


def catchers(recorder, kind="instances", name="shadow_catcher"):
    return {item["name"]: item[name] for item in getattr(recorder, kind).values()}


def test_objects_are_what_they_say(scene, export):
    add_square("Floor").is_shadow_catcher = True
    add_square("Thing")
    assert catchers(export()) == {"Floor": True, "Thing": False}
    assert messages() == []


@pytest.mark.parametrize("which", ["instance", "instancer"])
def test_instances_are_by_themselves_or_by_who_shows_them(scene, export, which):
    collection = bpy.data.collections.new("Parts")
    part_of_it = add_square("Part")
    scene.collection.objects.unlink(part_of_it)
    collection.objects.link(part_of_it)
    empty = bpy.data.objects.new("Empty", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    scene.collection.objects.link(empty)
    (part_of_it if which == "instance" else empty).is_shadow_catcher = True
    assert catchers(export()) == {"Part": True}


def test_lights_are_part_of_the_footage_unless_they_say_otherwise(scene, export):
    add_light("AREA", "Real")
    add_light("POINT", "Added").is_shadow_catcher = False
    assert catchers(export(), "lights", "lights_catchers") == {"Real": True, "Added": False}


def test_the_pass_is_cycles_until_the_file_says_otherwise(scene, layer, fake_core):
    cycles_settings = part("sync.cycles_settings")
    assert not cycles_settings.layer_value(layer, "use_pass_shadow_catcher")
    bpy.ops.render.render()
    assert not fake_core.settings.shadow_catcher
    layer.cycles.use_pass_shadow_catcher = True
    bpy.ops.render.render()
    assert fake_core.settings.shadow_catcher
    layer.janus.use_pass_shadow_catcher = False
    bpy.ops.render.render()
    assert not fake_core.settings.shadow_catcher
    cycles_settings.adopt(scene, again=True)
    assert layer.janus.use_pass_shadow_catcher


def test_the_pass_has_cycles_name(scene, layer):
    engine = pytest.importorskip("cycles.engine")
    layer.janus.use_pass_shadow_catcher = layer.cycles.use_pass_shadow_catcher = True
    (ours,) = part("sync.passes").requested(scene, layer)
    assert (ours.name, ours.channels, ours.kind) in engine.list_render_passes(scene, layer)
    item = layer.janus.expressions.add()
    item.name = ours.name
    assert "another pass" in part("sync.passes").name_problem(layer, item)


@pytest.fixture
def shadow(scene, core):
    """A floor that catches the shadow of a roof over its middle."""
    floor = add_square("Floor")
    floor.is_shadow_catcher = True
    floor.scale = (4.0, 4.0, 1.0)
    corners = [(-0.4, -0.4, 0.3), (0.4, -0.4, 0.3), (0.4, 0.4, 0.3), (-0.4, 0.4, 0.3)]
    roof = add_mesh("Roof", corners, [(0, 1, 2, 3)])
    roof.visible_camera = False
    add_light("SUN", "Sun").rotation_euler = (0.0, 0.0, 0.0)
    scene.camera.location, scene.camera.rotation_euler = (0.0, 0.0, 4.0), (0.0, 0.0, 0.0)
    scene.render.film_transparent = True
    scene.janus.samples = scene.janus.preview_samples = 16
    return scene


def test_f12_shows_the_shadow(shadow, layer):
    final = part("render.final")
    final.keep_passes_of.add(shadow.name_full)
    try:
        bpy.ops.render.render()
        picture = final.kept_passes[layer.name]["Combined"]
        layer.janus.use_pass_shadow_catcher = True
        bpy.ops.render.render()
        passes = dict(final.kept_passes[layer.name])
    finally:
        final.keep_passes_of.clear()
        final.kept_passes.clear()
    height, width = picture.shape[:2]
    middle, corner = picture[height // 2, width // 2], picture[0, 0]
    assert not picture[..., :3].any() and middle[3] > 0.6 and corner[3] < 0.02
    assert not passes["Combined"].any()
    factor = passes["Shadow Catcher"].mean(axis=2)
    assert np.allclose(np.clip(1.0 - factor, 0.0, 1.0), picture[..., 3], atol=1e-5)
    assert messages() == []


def test_denoising_is_for_the_shadow_in_alpha_too(shadow, layer, monkeypatch):
    seen = []

    def denoise(color, alpha, **_):
        seen.append(alpha)
        return 0.5 * color

    monkeypatch.setattr(part("render.denoise"), "denoise", denoise)
    shadow.janus.use_denoising = True
    final = part("render.final")
    final.keep_passes_of.add(shadow.name_full)
    try:
        bpy.ops.render.render()
        passes = final.kept_passes[layer.name]
    finally:
        final.keep_passes_of.clear()
        final.kept_passes.clear()
    assert np.allclose(passes["Combined"], 0.5 * passes["Noisy Image"])
    shadow.objects["Floor"].is_shadow_catcher = False
    bpy.ops.render.render()
    shadow.objects["Floor"].is_shadow_catcher = True
    shadow.render.film_transparent = False
    bpy.ops.render.render()
    assert seen == [True, False, False]


def test_viewports_show_the_shadow_and_follow(shadow, core):
    from viewport_kit import Eye, followed_by

    eye = Eye(core)
    picture = eye.wait()
    height, width = picture.shape[:2]
    assert picture[height // 2, width // 2, 3] > 0.6 and picture[0, 0, 3] < 0.02
    with followed_by(eye):
        shadow.objects["Floor"].is_shadow_catcher = False
    picture = eye.wait()
    assert picture[0, 0, 0] > 0.0 and picture[0, 0, 3] == 1.0


def test_viewports_denoise_the_shadow_in_alpha(shadow, core, monkeypatch):
    from viewport_kit import Eye

    tasks = []

    class Task:
        """Darkens alpha, if it is asked to denoise that."""

        def __init__(self, pixels, alpha, **_):
            tasks.append(alpha)
            self._pixels = pixels * (1.0, 1.0, 1.0, 0.5 if alpha else 1.0)

        def wait(self, seconds):
            return True

        def result(self):
            return self._pixels

        def cancel(self):
            pass

    denoise = part("render.denoise")
    monkeypatch.setattr(denoise, "DenoiseTask", Task)
    monkeypatch.setattr(denoise, "unavailable", lambda: None)
    eye = Eye(core)
    noisy = eye.wait()
    shadow.janus.use_preview_denoising = True
    assert np.allclose(eye.wait()[..., 3], 0.5 * noisy[..., 3], atol=0.02)
    assert set(tasks) == {True}
    tasks.clear()
    shadow.render.film_transparent = False
    eye.wait()
    assert set(tasks) == {False}
