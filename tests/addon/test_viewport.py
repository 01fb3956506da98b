# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered viewports: drafts, pauses, undo, and what is said."""

import time
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from conftest import part
from view_kit import HEIGHT, WIDTH
from viewport_kit import SAMPLES, Eye, followed_by, furnish


@pytest.fixture
def world_of_things(scene):
    return furnish(scene)


def rendered(scene, path) -> np.ndarray:
    """What F12 makes of the scene."""
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(4 * WIDTH * HEIGHT, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(HEIGHT, WIDTH, 4)


def test_shows_what_f12_renders(world_of_things, core, tmp_path):
    eye = Eye(core)
    picture = eye.wait()
    assert picture.shape == (HEIGHT, WIDTH, 4) and picture[..., :3].std() > 0.01
    assert np.allclose(
        picture, rendered(world_of_things, tmp_path / "f12.exr"), rtol=1e-5, atol=1e-6
    )


def test_what_does_not_show_starts_nothing(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    eye.sent()
    with followed_by(eye):
        bpy.data.objects["Ball"].select_set(True)
        bpy.data.objects["Ball"].location = bpy.data.objects["Ball"].location
        world_of_things.render.fps = 30
    eye.look()
    assert not eye.viewport.busy and not eye.sent()
    assert eye.viewport.picture.pixels is before


def test_the_camera_moves_alone(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    eye.sent()
    with followed_by(eye):
        world_of_things.camera.location.x += 0.5
    after = eye.wait()
    assert eye.sent() == {"set_camera"} and eye.counts["meshes_built"] == 0
    assert not np.array_equal(after, before)


def test_after_an_undo_nothing_is_taken_for_known(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    part("sync.cache").forget_addresses()
    with followed_by(eye):
        bpy.data.objects["Ball"].location.x += 0.1
        bpy.data.objects["Ball"].location.x -= 0.1
    assert np.array_equal(eye.wait(), before)
    assert len(eye.spies) == 2 and "set_mesh" in eye.sent()


def test_a_steady_change_shows(world_of_things, core):
    """As long as someone turns the view, each draw sees another camera."""
    eye = Eye(core)
    eye.wait()
    shown = set()
    end = time.monotonic() + 10.0
    while len(shown) < 3 and time.monotonic() < end:
        world_of_things.camera.location.x += 0.01
        bpy.context.view_layer.update()
        eye.look()
        if eye.viewport.advance():
            shown.add(eye.viewport.picture.pixels.tobytes())
    assert len(shown) == 3


def test_drafts_come_first_where_samples_are_slow(world_of_things, core):
    eye = Eye(core)
    eye.look()
    eye.viewport._seconds = 1.0  # for a sample of a pixel
    sizes = []
    end = time.monotonic() + 30.0
    while (eye.viewport.busy or not sizes) and time.monotonic() < end:
        if eye.viewport.advance():
            sizes.append(eye.viewport.picture.pixels.shape[:2])
            assert eye.viewport.picture.rectangle == (0, 0, WIDTH, HEIGHT)
            eye.viewport._seconds = 1.0
    assert sizes[:4] == [(HEIGHT // d, WIDTH // d) for d in (8, 4, 2, 1)]


def test_pixels_as_large_as_the_scene_wants(world_of_things, core):
    render = bpy.context.scene.render
    eye = Eye(core)
    for size in ("2", "8", "1"):
        render.preview_pixel_size = size
        assert eye.wait().shape[:2] == (HEIGHT // int(size), WIDTH // int(size))
        assert eye.viewport.picture.rectangle == (0, 0, WIDTH, HEIGHT)
        samples = bpy.context.scene.janus.preview_samples
        assert eye.viewport.status == f"Rendering Done | Sample {samples}/{samples}"


def test_a_draft_that_ends_between_two_draws_is_seen(world_of_things, core):
    eye = Eye(core)
    make, sessions = core.RenderSession, []

    def started_later(scene, settings):
        sessions.append(make(scene, settings))
        names = ("progress", "snapshot", "stats", "cancel", "finish", "wait")
        late = {name: getattr(sessions[-1], name) for name in names}
        return SimpleNamespace(start=lambda: None, **late)

    eye.viewport._core.RenderSession = started_later
    eye.look()
    end = time.monotonic() + 10.0
    while not sessions and time.monotonic() < end:
        assert not eye.viewport.advance()
    sessions[0].start()
    sessions[0].finish()
    assert eye.viewport.advance()
    assert eye.viewport.picture.pixels.shape[:2] == (HEIGHT // 4, WIDTH // 4)


def test_local_view_comes_without_an_update(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    assert len(depsgraph.updates) == 0
    eye.viewport.sync(depsgraph, lambda obj: obj.name != "Ball")
    assert not np.array_equal(eye.wait(), before)
    eye.viewport.sync(depsgraph)
    assert np.allclose(eye.wait(), before, rtol=1e-5, atol=1e-6)


def test_what_is_left_out_is_said_once_and_stays_said(world_of_things, core):
    """By the exporter, and by the core at each commit."""
    material = bpy.data.materials["Tiles"]
    nodes = material.node_tree.nodes
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    occlusion = nodes.new("ShaderNodeAmbientOcclusion")
    material.node_tree.links.new(occlusion.outputs[0], shader.inputs["Roughness"])
    bpy.context.view_layer.update()
    eye = Eye(core)
    eye.wait()
    said = dict(eye.viewport.log.counts)
    assert any(entry.node == occlusion.name for entry in said)
    for x in (0.1, 0.2):  # the view turns
        world_of_things.camera.location.x += x
        bpy.context.view_layer.update()
        eye.wait()
        assert eye.viewport.log.counts == said
    with followed_by(eye):
        bpy.data.objects["Ball"].select_set(True)
        world_of_things.render.fps = 31
    eye.wait()
    assert eye.viewport.log.counts == said
    with followed_by(eye):
        nodes.remove(occlusion)
    eye.wait()
    assert not any(entry.node for entry in eye.viewport.log.counts)


def test_a_sync_that_fails_leaves_nothing_behind(world_of_things, core, monkeypatch):
    """Objects that came with it are gone in the next."""
    eye = Eye(core)
    before = eye.wait()
    for number in range(3):
        extra = bpy.data.objects.new(f"A {number}", bpy.data.objects["Ball"].data)
        extra.location = (number - 1.0, -0.8, 0.5)
        world_of_things.collection.objects.link(extra)
    bpy.context.view_layer.update()
    cache = part("sync.cache").SceneCache
    with monkeypatch.context() as patch:
        patch.setattr(cache, "end", lambda self: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            eye.viewport.sync(bpy.context.evaluated_depsgraph_get())
    for number in range(3):
        bpy.data.objects.remove(bpy.data.objects[f"A {number}"])
    bpy.context.view_layer.update()
    eye.viewport.sync(bpy.context.evaluated_depsgraph_get())
    assert np.allclose(eye.wait(), before, rtol=1e-5, atol=1e-6)


def test_can_be_denoised(world_of_things, core):
    if reason := part("render.denoise").unavailable():
        pytest.skip(reason)
    eye = Eye(core)
    noisy = eye.wait()
    world_of_things.janus.use_preview_denoising = True
    clean = eye.wait()
    assert clean.shape == noisy.shape and np.array_equal(clean[..., 3], noisy[..., 3])
    assert 0.0 < np.abs(clean - noisy).mean() < 0.3 * noisy.mean()
    world_of_things.janus.use_preview_denoising = False
    assert np.array_equal(eye.wait(), noisy)


def test_pauses_and_goes_on(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    world_of_things.janus.preview_samples = 1 << 20
    eye.look()
    eye.viewport.advance()
    eye.viewport.pause()
    assert eye.viewport._session.wait(5.0)
    world_of_things.janus.preview_samples = SAMPLES
    assert np.array_equal(eye.wait(), before)


def test_a_finished_picture_outlives_a_pause(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    session = eye.viewport._session
    eye.viewport.pause()
    assert np.array_equal(eye.wait(), before) and eye.viewport._session is session


def test_renders_say_that_they_run(scene, fake_core):
    final, seen = part("render.final"), []
    fake_core.script = lambda session: seen.append(final.running)
    bpy.ops.render.render()
    fake_core.script = lambda session: 1 / 0
    with pytest.raises(RuntimeError):
        bpy.ops.render.render()
    assert set(seen) == {1} and final.running == 0


def test_settings_start_again(world_of_things, core):
    eye = Eye(core)
    few = eye.wait()
    world_of_things.janus.preview_samples = 5
    many = eye.wait()
    assert eye.viewport.status == "Rendering Done | Sample 5/5"
    assert not np.array_equal(few, many)
    assert "set_mesh" in eye.sent() and len(eye.spies) == 1


def test_says_that_it_is_done(world_of_things, core):
    settings = world_of_things.janus
    settings.preview_samples = 1024
    settings.use_preview_adaptive_sampling = True
    settings.preview_adaptive_threshold = 1.0
    eye = Eye(core)
    eye.wait()
    done, samples = eye.viewport.status.split(" | Sample ")
    assert done == "Rendering Done" and 0 < int(samples.split("/")[0]) < 1024
    settings.preview_samples = 2048
    eye.look()
    assert not eye.viewport.status.startswith("Rendering Done")  # what is done is not that any more
    eye.viewport.advance()
    assert not eye.viewport.status.startswith("Rendering Done")


def test_what_is_refused_leaves_the_picture(world_of_things, core, monkeypatch):
    monkeypatch.setattr(part("sync.camera"), "PANORAMAS", ("EQUIRECTANGULAR",))
    eye = Eye(core)
    before = eye.wait()
    data = world_of_things.camera.data
    data.type = "PANO"
    part("sync.camera").panorama(data).panorama_type = "MIRRORBALL"
    bpy.context.view_layer.update()
    with pytest.raises(part("report").RenderRefused, match="MIRRORBALL"):
        eye.look()
    assert eye.viewport.picture.pixels is before
    data.type = "PERSP"
    bpy.context.view_layer.update()
    assert np.array_equal(eye.wait(), before)
