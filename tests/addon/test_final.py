# SPDX-License-Identifier: GPL-3.0-or-later
"""The F12 loop: settings, border, view layers, animation, cancelling, stamps."""

import bpy
import numpy as np
import pytest
from conftest import add_square, messages, new_material, part


def result_pixels():
    """float32[H, W, 4] of the last render, by way of a file: headless Blender has no other."""
    scene = bpy.context.scene
    path = bpy.path.abspath(scene.render.filepath) + ".result.exr"
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    bpy.data.images["Render Result"].save_render(path, scene=scene)
    return load_pixels(path)


def load_pixels(path):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(image.size[0] * image.size[1] * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(image.size[1], image.size[0], 4)


class Impatient:
    """The engine, with a user who presses ESC when `condition` holds."""

    def __init__(self, engine, condition):
        self._engine, self._condition = engine, condition

    def __getattr__(self, name):
        return getattr(self._engine, name)

    def test_break(self):
        return bool(self._condition())


def stop_when(monkeypatch, condition):
    final = part("render.final")
    render_layer = final.render_layer
    monkeypatch.setattr(
        final,
        "render_layer",
        lambda engine, *rest: render_layer(Impatient(engine, condition), *rest),
    )


def gradient(session, name="Combined"):
    """A picture in which every pixel of the full frame differs."""
    s = session.settings
    x0, y0, x1, y1 = s.crop or (0, 0, s.width, s.height)
    y, x = np.mgrid[y0:y1, x0:x1].astype(np.float32)
    return np.stack([x, y, x * 0 + 3.0, x * 0 + 1.0], axis=-1)


def test_settings_reach_the_core(scene, fake_core):
    janus, render = scene.janus, scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 33, 21, 50
    render.threads_mode, render.threads = "FIXED", 3
    render.film_transparent = True
    janus.samples, janus.time_limit, janus.seed, janus.max_bounces = 5, 60.0, 7, 4
    janus.diffuse_bounces, janus.glossy_bounces, janus.transmission_bounces = 1, 2, 3
    janus.transparent_max_bounces = 9
    janus.sample_clamp_direct, janus.sample_clamp_indirect = 0.5, 10.0
    janus.integrator, janus.heuristic = "PT", "POWER"
    janus.light_paths, janus.connections = 0.5, 2.0
    janus.use_merging, janus.merge_radius = True, 0.25
    janus.next_event = False
    janus.pixel_filter_type, janus.filter_width = "GAUSSIAN", 2.0
    janus.film_exposure, janus.film_transparent_glass = 1.5, True
    janus.film_transparent_roughness = 0.25
    bpy.ops.render.render()
    assert vars(fake_core.settings) == {
        "data_passes": [],
        "occlusion_distance": 0.0,
        "noise_threshold": 0.0,
        "min_samples": 0,
        "aovs": [],
        "cryptomatte": [],
        "cryptomatte_levels": 3,
        "pass_alpha_threshold": 0.5,
        "width": 16,
        "height": 10,
        "crop": None,
        "samples": 5,
        "seconds": 60.0,
        "seed": 7,
        "threads": 3,
        "max_bounces": 4,
        "max_diffuse_bounces": 1,
        "max_glossy_bounces": 2,
        "max_transmission_bounces": 3,
        "transparent_max_bounces": 9,
        "clamp_direct": 0.5,
        "clamp_indirect": 10.0,
        "integrator": "pt",
        "filter": "GAUSSIAN",
        "filter_width": 2.0,
        "light_paths": 0.5,
        "connections": 2.0,
        "heuristic": "POWER",
        "merge_radius": 0.25,
        "adaptive_counts": True,
        "motion_blur": False,
        "film_exposure": 1.5,
        "film_transparent": True,
        "film_transparent_glass": True,
        "film_transparent_roughness": 0.25,
        "next_event": False,
        "connection_mode": "CACHE",
        "strategies": "",
        "expressions": [],
        "light_passes": [],
        "strategy_images": 0,
        "shadow_catcher": False,
    }


def test_nothing_is_merged_by_default(scene, fake_core):
    scene.janus.merge_radius = 0.25
    bpy.ops.render.render()
    assert fake_core.settings.merge_radius == 0.0


def test_the_width_of_a_box_filter_is_one_pixel_as_in_cycles(scene, fake_core):
    scene.janus.pixel_filter_type, scene.janus.filter_width = "BOX", 2.0
    bpy.ops.render.render()
    assert fake_core.settings.filter_width == 1.0


def test_defaults(scene, fake_core):
    bpy.ops.render.render()
    settings = vars(fake_core.settings)
    expected = {
        "samples": 64,
        "seconds": 0.0,
        "max_bounces": 12,
        "max_diffuse_bounces": 4,
        "max_glossy_bounces": 4,
        "max_transmission_bounces": 12,
        "transparent_max_bounces": 8,
        "clamp_direct": 0.0,
        "clamp_indirect": 0.0,
        "film_exposure": 1.0,
        "film_transparent_glass": False,
        "integrator": "bdpt",
        "threads": 0,
    }
    expected |= {"filter": "BLACKMAN_HARRIS", "filter_width": 1.5, "heuristic": "BALANCE"}
    assert {name: settings[name] for name in expected} == expected


def test_pixels_arrive(scene, fake_core, monkeypatch):
    monkeypatch.setattr("fake_core.FakeSession.snapshot", gradient)
    bpy.ops.render.render()
    pixels = result_pixels()
    assert pixels.shape == (12, 16, 4)
    assert list(pixels[0, 15]) == [15.0, 0.0, 3.0, 1.0]
    assert list(pixels[11, 0]) == [0.0, 11.0, 3.0, 1.0]


@pytest.mark.parametrize("crop_to_border", [False, True])
@pytest.mark.parametrize("border", [(0.25, 0.8, 0.1, 0.9), (0.03, 0.97, 0.33, 0.36), (0, 1, 0, 1)])
def test_border(scene, fake_core, monkeypatch, crop_to_border, border):
    """A border is a window into the full frame, wherever Blender's rounding puts it."""
    monkeypatch.setattr("fake_core.FakeSession.snapshot", gradient)
    render = scene.render
    render.resolution_x, render.resolution_y = 61, 47
    render.use_border, render.use_crop_to_border = True, crop_to_border
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = border
    bpy.ops.render.render()
    x0, y0, x1, y1 = fake_core.settings.crop
    full = np.zeros((47, 61, 4), dtype=np.float32)
    full[y0:y1, x0:x1] = gradient(fake_core.sessions[-1])
    expected = full[y0:y1, x0:x1] if crop_to_border else full
    assert np.array_equal(result_pixels(), expected)


def test_borders_of_all_sizes_fit(scene, fake_core):
    """Sizes are computed here and in Blender; a mismatch would raise."""
    generator = np.random.default_rng(3)
    scene.janus.samples = 1
    render = scene.render
    render.use_border = True
    for _ in range(60):
        render.resolution_x, render.resolution_y = map(int, generator.integers(8, 300, 2))
        render.resolution_percentage = int(generator.integers(20, 120))
        x, y = generator.random(2) * 0.6
        render.border_min_x, render.border_max_x = x, x + 0.3  # Blender refuses empty ones
        render.border_min_y, render.border_max_y = y, y + 0.3
        bpy.ops.render.render()


def test_one_render_per_view_layer(scene, fake_core):
    second = scene.view_layers.new("Second")
    second.samples = 3
    scene.view_layers.new("Off").use = False
    shown = add_square("Only in first")
    collection = bpy.data.collections.new("Extra")
    scene.collection.children.link(collection)
    scene.collection.objects.unlink(shown)
    collection.objects.link(shown)
    second.layer_collection.children["Extra"].exclude = True
    seen = []
    fake_core.script = lambda s: seen.append((s.settings.samples, len(fake_core.builder.instances)))
    scene.janus.samples = 2
    bpy.ops.render.render()
    assert set(seen) == {(2, 1), (3, 0)}
    assert len(fake_core.sessions) == 2


def test_animation(scene, fake_core, tmp_path):
    square = add_square()
    square.keyframe_insert("location", frame=1)
    square.location.x = 2.0
    square.keyframe_insert("location", frame=3)
    scene.frame_start, scene.frame_end = 1, 3
    scene.render.filepath = str(tmp_path / "frame_")
    scene.janus.samples = 1
    places = []
    fake_core.script = lambda session: places.append(
        fake_core.builder.by_name()["Square"]["transform"][0, 3]
    )
    bpy.ops.render.render(animation=True)
    assert places[0] == 0.0 and places[2] == 2.0 and 0.0 < places[1] < 2.0
    assert sorted(p.name for p in tmp_path.glob("*.png")) == [
        f"frame_{n:04d}.png" for n in (1, 2, 3)
    ]


def test_cancelling_keeps_whole_passes(scene, fake_core, monkeypatch):
    stop_when(monkeypatch, lambda: fake_core.sessions and fake_core.sessions[0].samples > 4)
    scene.janus.samples = 1000
    bpy.ops.render.render()
    assert fake_core.sessions[0].samples == 5
    assert result_pixels()[0, 0] == pytest.approx(fake_core.color)
    assert part("render.final").last_render["cancelled"] is True


def test_cancelling_during_export(scene, fake_core, monkeypatch):
    stop_when(monkeypatch, lambda: True)
    bpy.ops.render.render()
    assert fake_core.sessions == []
    assert not result_pixels().any()
    assert messages("ERROR") == []


def test_cancelling_during_build(scene, fake_core, monkeypatch):
    def commit(self, poll):
        raise fake_core.Cancelled

    monkeypatch.setattr("fake_core.Recorder.commit", commit)
    bpy.ops.render.render()
    assert fake_core.sessions == [] and messages("ERROR") == []
    assert not result_pixels().any()


def test_statistics_for_scripts(scene, fake_core, monkeypatch):
    scene.janus.samples = 4
    bpy.ops.render.render()
    stats = part("render.final").last_render
    assert stats["samples"] == 4 and stats["cancelled"] is False
    assert {"seconds", "sync_seconds", "commit_seconds", "counts"} <= set(stats)
    assert any("4 samples in" in line for line in messages("INFO"))
    scene.camera.data.type = "PANO"
    monkeypatch.setattr(part("sync.camera"), "PANORAMAS", ())
    with pytest.raises(RuntimeError):
        bpy.ops.render.render()
    assert stats == {}


@pytest.mark.parametrize("file_format, suffix", [("PNG", "png"), ("OPEN_EXR", "exr")])
def test_stamp_is_in_the_file(scene, fake_core, tmp_path, file_format, suffix):
    scene.render.image_settings.file_format = file_format
    scene.render.filepath = str(tmp_path / f"out.{suffix}")
    scene.janus.samples, scene.janus.seed = 3, 11
    bpy.ops.render.render(write_still=True)
    content = (tmp_path / f"out.{suffix}").read_bytes()
    for name, value in (("version", "0.1.9"), ("samples", "3"), ("seed", "11")):
        position = content.index(f"janus/{name}".encode())
        assert value.encode() in content[position : position + 40]


@pytest.mark.parametrize("settings", ["janus", "cycles"])
def test_each_frame_may_have_noise_of_its_own(scene, fake_core, settings):
    getattr(scene, settings).use_animated_seed = True
    found = []
    for seed, frame in ((7, 1), (7, 2), (7, 1), (8, 1)):
        scene.janus.seed = seed
        scene.frame_set(frame)
        bpy.ops.render.render()
        found.append(fake_core.settings.seed)
    assert found[0] == found[2] and len(set(found)) == 3 and min(found) >= 0


def test_capture_takes_the_same_way(scene, fake_core, monkeypatch, tmp_path):
    """With a capture path every call passes through the capturing builder, which saves them."""
    saved = []

    class Capturing:
        def __init__(self, builder):
            self.builder, self.calls = builder, []

        def __getattr__(self, name):
            def call(*args, **kwargs):
                self.calls.append(name)
                return getattr(self.builder, name)(*args, **kwargs)

            return call

        def save(self, path, settings):
            saved.append((path, settings, self.calls))

    monkeypatch.setattr(part("bridge"), "capturing_builder", Capturing)
    add_square().data.materials.append(new_material())
    scene.janus.capture_path = str(tmp_path / "scene.npz")
    bpy.ops.render.render()
    [(path, settings, calls)] = saved
    assert path == str(tmp_path / "scene.npz") and settings is fake_core.settings
    assert sorted(calls) == ["set_camera", "set_instance", "set_material", "set_mesh", "set_world"]
    assert len(fake_core.builder.instances) == 1


def test_core_findings_become_warnings(scene, fake_core):
    from types import SimpleNamespace

    found = SimpleNamespace(
        severity="ERROR", object="", material="Wood", node="Noise", message="not supported"
    )
    fake_core.diagnostics = [found, found]
    bpy.ops.render.render()  # not fatal
    assert messages() == ["Material 'Wood', node 'Noise': not supported"]


def test_progress_words():
    progress = part("render.progress")
    state = {"samples": 12, "target_samples": 64, "seconds": 1.0, "remaining": 12.2}
    assert progress.status(state) == "Sample 12/64 | Remaining 00:12"
    assert progress.status(state | {"remaining": None}) == "Sample 12/64"
    assert progress.clock(3725) == "1:02:05"
    assert progress.fraction(state, 0.0) == 12 / 64
    assert progress.fraction(state, 2.0) == 0.5


def test_updates_become_rarer():
    clock = [0.0]
    rhythm = part("render.progress").Rhythm(now=lambda: clock[0])
    shown = []
    while clock[0] < 60.0:
        if rhythm.due():
            shown.append(clock[0])
            rhythm.shown(0.01)
        clock[0] += 0.05
    gaps = np.diff(shown)
    assert shown[0] == pytest.approx(0.5, abs=0.06)
    assert gaps[0] < 1.0 and gaps[-1] == pytest.approx(5.0, abs=0.1)
    rhythm.shown(1.0)  # an expensive picture must not take more than a twentieth of the time
    clock[0] += 19.0
    assert not rhythm.due()
