# SPDX-License-Identifier: GPL-3.0-or-later
"""Denoising in the F12 loop: settings, passes, what is shown, stopping, failing."""

import bpy
import numpy as np
import pytest
from conftest import add_light, add_mesh, add_square, messages, part
from test_final import Impatient, result_pixels, stop_when
from test_passes import add_expression, saved_layers


@pytest.fixture
def layer(scene):
    return scene.view_layers[0]


@pytest.fixture
def calls(addon, monkeypatch):
    """Keywords of each call of the denoiser, which only doubles the light."""
    calls = []

    def denoise(color, cancel, **keywords):
        calls.append(keywords)
        return color * (2.0, 2.0, 2.0, 1.0)

    monkeypatch.setattr(part("render.denoise"), "denoise", denoise)
    return calls


@pytest.fixture
def no_library(addon, monkeypatch):
    reason = "Blender comes without it"
    monkeypatch.setattr(part("render.denoise"), "_find", lambda: (None, reason))


def test_off_by_default(scene, fake_core, calls):
    """Cycles' default is on, but a default is nobody's choice, and denoising is a bias."""
    assert scene.cycles.use_denoising
    bpy.ops.render.render()
    assert calls == [] and part("render.final").last_render["denoise_seconds"] == 0.0
    assert "Denoising is off" in part("sync.cycles_settings").notice(scene)


def test_what_was_chosen_in_cycles_holds(scene, layer, fake_core, calls):
    scene.cycles.use_denoising = True
    scene.cycles.denoising_quality = "BALANCED"
    bpy.ops.render.render()
    assert [call["quality"] for call in calls] == ["BALANCED"]
    assert "and denoising are copied" in part("sync.cycles_settings").notice(scene)
    layer.cycles.use_denoising = False
    bpy.ops.render.render()
    assert len(calls) == 1
    layer.janus.use_denoising = True
    bpy.ops.render.render()
    assert len(calls) == 2
    scene.janus.use_denoising = False
    bpy.ops.render.render()
    assert len(calls) == 2


def test_view_layers_adopt(scene, layer):
    second = scene.view_layers.new("Second")
    layer.cycles.use_denoising = second.cycles.use_denoising = False
    second.janus.use_denoising = True
    adopt = part("sync.cycles_settings").adopt
    adopt(scene)
    assert not layer.janus.use_denoising and second.janus.use_denoising
    adopt(scene, again=True)
    assert not layer.janus.use_denoising and not second.janus.use_denoising


def test_words_are_cycles(scene, layer):
    for janus, cycles in ((scene.janus, scene.cycles), (layer.janus, layer.cycles)):
        for name in ("use_denoising", "denoising_quality"):
            if name not in janus.bl_rna.properties:
                continue
            ours, theirs = (owner.bl_rna.properties[name] for owner in (janus, cycles))
            assert (ours.name, ours.description) == (theirs.name, theirs.description)
    ours, theirs = (
        [(item.identifier, item.name, item.description, item.value) for item in items]
        for items in (
            scene.janus.bl_rna.properties["denoising_quality"].enum_items,
            scene.cycles.bl_rna.properties["denoising_quality"].enum_items,
        )
    )
    assert ours == theirs and set(part("render.denoise").QUALITIES) == {item[0] for item in ours}


def test_the_picture_before_is_a_pass_as_in_cycles(scene, layer, fake_core, calls, tmp_path):
    engine = pytest.importorskip("cycles.engine")
    scene.cycles.use_denoising = True
    found = part("sync.passes").NOISY_IMAGE
    theirs = [(name, letters) for name, letters, _ in engine.list_render_passes(scene, layer)]
    assert (found.name, found.channels) in theirs
    layer.use_pass_environment = True
    bpy.ops.render.render()
    layers = saved_layers(tmp_path / "passes.exr")
    environment = "Environment" if bpy.app.version >= (5, 0, 0) else "Env"
    assert set(layers) == {"Combined", "Noisy Image", environment}
    red, green, blue, alpha = fake_core.color
    assert np.all(layers["Noisy Image"] == fake_core.color)
    assert np.all(layers["Combined"] == (2 * red, 2 * green, 2 * blue, alpha))
    assert np.all(layers[environment] == 1.0)
    layer.janus.use_denoising = False
    bpy.ops.render.render()
    assert set(saved_layers(tmp_path / "passes.exr")) == {"Combined", environment}


def test_no_expression_can_have_its_name(scene, layer, fake_core):
    add_expression(layer, "Noisy Image", "LE")
    with pytest.raises(RuntimeError, match="another pass"):
        bpy.ops.render.render()


def test_the_compositor_has_its_socket_at_once(scene, layer):
    if bpy.app.version >= (5, 0, 0):
        scene.compositing_node_group = tree = bpy.data.node_groups.new("C", "CompositorNodeTree")
    else:
        scene.use_nodes = True
        tree = scene.node_tree
    node = tree.nodes.new("CompositorNodeRLayers")
    assert "Noisy Image" not in [s.name for s in node.outputs if s.enabled]
    scene.janus.use_denoising = True
    assert "Noisy Image" in [s.name for s in node.outputs if s.enabled]
    layer.janus.use_denoising = False
    assert "Noisy Image" not in [s.name for s in node.outputs if s.enabled]


def test_the_noisy_picture_is_shown_first(scene, fake_core, calls, monkeypatch):
    events = []
    passes, final = part("render.passes"), part("render.final")
    show, denoise = passes.LayerResult.show, part("render.denoise").denoise

    def recorded(word, function):
        def run(*arguments, **keywords):
            events.append(word)
            return function(*arguments, **keywords)

        return run

    monkeypatch.setattr(passes.LayerResult, "show", recorded("show", show))
    monkeypatch.setattr(part("render.denoise"), "denoise", recorded("work", denoise))

    class Listening(Impatient):
        def update_stats(self, *words):
            events.extend(word for word in words if word == "Denoising")

    render_layer = final.render_layer
    monkeypatch.setattr(
        final,
        "render_layer",
        lambda engine, *rest: render_layer(Listening(engine, lambda: False), *rest),
    )
    scene.janus.use_denoising = True
    bpy.ops.render.render()
    assert events == ["show", "Denoising", "work", "show"]


def test_guides_are_those_that_were_chosen(scene, fake_core, calls):
    scene.janus.use_denoising = True
    scene.render.threads_mode, scene.render.threads = "FIXED", 3
    scene.janus.denoising_prefilter = "FAST"
    bpy.ops.render.render()
    assert np.all(calls[0]["albedo"] == 1.0) and np.all(calls[0]["normal"] == 2.0)
    assert (calls[0]["quality"], calls[0]["prefilter"]) == ("HIGH", "FAST")
    assert calls[0]["threads"] == 3 and messages() == []
    scene.janus.denoising_input_passes = "RGB_ALBEDO"
    bpy.ops.render.render()
    assert "albedo" in calls[1] and "normal" not in calls[1]
    scene.janus.denoising_input_passes = "RGB"
    bpy.ops.render.render()
    assert "albedo" not in calls[2] and fake_core.settings.data_passes == []


def test_a_render_that_was_stopped_is_left_as_it_is(scene, fake_core, calls, monkeypatch):
    stop_when(monkeypatch, lambda: fake_core.sessions and fake_core.sessions[0].samples > 4)
    scene.janus.samples, scene.janus.use_denoising = 1000, True
    bpy.ops.render.render()
    assert calls == [] and part("render.final").last_render["denoise_seconds"] == 0.0
    assert result_pixels()[0, 0] == pytest.approx(fake_core.color)


def test_stopping_the_denoiser_keeps_the_render(scene, fake_core, monkeypatch):
    denoise = part("render.denoise")
    work, working = denoise._work, []
    monkeypatch.setattr(denoise, "_work", lambda *a: (working.append(1), work(*a))[1])
    stop_when(monkeypatch, lambda: working)
    scene.render.resolution_x = scene.render.resolution_y = 512
    scene.janus.samples, scene.janus.use_denoising = 3, True
    bpy.ops.render.render()
    stats = part("render.final").last_render
    assert working and stats["cancelled"] is True and stats["samples"] == 3
    assert result_pixels()[0, 0] == pytest.approx(fake_core.color)
    assert messages() == [] and any("Denoising was stopped" in line for line in messages("INFO"))


def test_strategies_are_not_denoised(scene, fake_core, calls, tmp_path):
    strategies = part("render.strategies")
    scene.janus.use_denoising = True
    strategies.ask(scene, 2)
    try:
        bpy.ops.render.render()
        assert calls == [] and "Noisy Image" not in saved_layers(tmp_path / "strategies.exr")
    finally:
        strategies.withdraw(scene)


def test_scripts_get_what_blender_gets(scene, layer, fake_core, calls):
    final = part("render.final")
    scene.janus.use_denoising = True
    final.keep_passes_of.add(scene.name_full)
    try:
        bpy.ops.render.render()
        kept = final.kept_passes[layer.name]
        assert np.all(kept["Noisy Image"] == fake_core.color)
        assert np.all(kept["Combined"][..., 0] == 2.0 * fake_core.color[0])
    finally:
        final.keep_passes_of.clear()
        final.kept_passes.clear()


def test_without_the_library_there_is_a_picture_and_a_warning(scene, fake_core, no_library):
    scene.janus.use_denoising = True
    scene.view_layers.new("Second")
    bpy.ops.render.render()
    [line] = messages()
    assert line == "The picture is not denoised: Blender comes without it"
    assert result_pixels()[0, 0] == pytest.approx(fake_core.color)
    scene.janus.use_denoising = False
    bpy.ops.render.render()
    assert messages() == []


def test_a_failure_is_a_warning(scene, fake_core, monkeypatch):
    scene.janus.use_denoising = True
    monkeypatch.setattr(part("render.denoise"), "DEVICE_CPU", 99)
    bpy.ops.render.render()
    [line] = messages()
    assert "OpenImageDenoise says" in line
    assert result_pixels()[0, 0] == pytest.approx(fake_core.color)


# From here on with the native core.


@pytest.fixture
def room(scene, core):
    """A box on a floor under a large lamp, before nothing: soft shadows, few samples."""
    scene.render.resolution_x, scene.render.resolution_y = 97, 61
    scene.render.film_transparent = True
    add_square("Floor").scale = (1.5, 1.0, 1.0)
    corners = [(x, y, z) for x in (-0.3, 0.3) for y in (-0.3, 0.3) for z in (0.1, 0.5)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    add_mesh("Box", corners, sides)
    lamp = add_light("AREA", "Lamp")
    lamp.location, lamp.data.energy, lamp.data.size = (1.0, 0.5, 2.5), 200.0, 3.0
    scene.janus.samples, scene.janus.seed = 2, 1
    return scene


def rendered(scene, denoise, path, **settings):
    scene.janus.use_denoising = denoise
    for name, value in settings.items():
        setattr(scene.janus, name, value)
    bpy.ops.render.render()
    assert messages() == []
    return saved_layers(path / "picture.exr")


def error(pixels, reference):
    return float(np.sqrt(np.mean((pixels[..., :3] - reference[..., :3]) ** 2)))


def test_noise_falls_in_a_render(room, tmp_path):
    noisy = rendered(room, False, tmp_path)["Combined"]
    layers = rendered(room, True, tmp_path)
    result = layers["Combined"]
    assert part("render.final").last_render["denoise_seconds"] > 0.0
    assert np.array_equal(layers["Noisy Image"], noisy)
    assert np.array_equal(result[..., 3], noisy[..., 3])
    assert 0.0 < noisy[..., 3].mean() < 1.0
    reference = rendered(room, False, tmp_path, samples=512, seed=2)["Combined"]
    assert error(result, reference) < 0.5 * error(noisy, reference)
    assert result[..., :3].mean() == pytest.approx(noisy[..., :3].mean(), rel=0.02)


@pytest.mark.parametrize("crop_to_border", [False, True])
def test_borders(room, tmp_path, crop_to_border):
    render = room.render
    render.use_border, render.use_crop_to_border = True, crop_to_border
    render.border_min_x, render.border_max_x = 0.2, 0.73
    render.border_min_y, render.border_max_y = 0.11, 0.9
    noisy = rendered(room, False, tmp_path)["Combined"]
    layers = rendered(room, True, tmp_path)
    assert layers["Combined"].shape == noisy.shape
    assert noisy.shape == ((48, 51, 4) if crop_to_border else (61, 97, 4))
    assert np.array_equal(layers["Noisy Image"], noisy)
    assert not np.array_equal(layers["Combined"], noisy)
    assert np.array_equal(layers["Combined"][..., 3], noisy[..., 3])


def test_the_smallest_picture(room, tmp_path):
    render = room.render
    render.resolution_x = render.resolution_y = 4
    render.resolution_percentage = 25
    room.camera.location.z = 2.0
    layers = rendered(room, True, tmp_path)
    assert layers["Combined"].shape == (1, 1, 4) and layers["Combined"][0, 0, 0] > 0.1
    assert layers["Combined"] == pytest.approx(layers["Noisy Image"], rel=0.1)
