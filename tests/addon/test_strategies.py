# SPDX-License-Identifier: GPL-3.0-or-later
"""The strategy pyramid: passes of the result, files, contact sheet, operator."""

import bpy
import numpy as np
import pytest
from conftest import part
from test_final import load_pixels
from test_passes import saved_layers


@pytest.fixture
def sheet(addon):
    return part("render.contact_sheet")


@pytest.fixture
def strategies(addon):
    module = part("render.strategies")
    yield module
    module.kept_passes.clear()


def names(length):
    return part("sync.passes").strategy_names(length)


def flat_passes(length, shape=(3, 4, 3), value=0.25):
    return {name: np.full(shape, value, dtype=np.float32) for name in names(length)}


def test_names():
    assert names(0) == []
    weighted = ["s0 t2 weighted"]
    weighted += [f"s{s} t{3 - s} weighted" for s in range(3)]
    alone = [name.replace("weighted", "alone") for name in weighted]
    assert names(2) == [*weighted, *alone, "longer weighted"]


def test_strategies_are_passes_of_the_result(scene, fake_core, tmp_path, strategies):
    strategies.ask(scene, 2)
    bpy.ops.render.render()
    assert fake_core.settings.strategy_images == 2
    layers = saved_layers(tmp_path / "all.exr")
    assert set(layers) == {"Combined", *names(2)}
    for name in names(2):
        assert np.all(layers[name] == fake_core.sessions[-1].passes().index(name))
    strategies.withdraw(scene)
    bpy.ops.render.render()
    assert fake_core.settings.strategy_images == 0
    assert set(saved_layers(tmp_path / "all.exr")) == {"Combined"}
    assert strategies.kept_passes == {}


def test_files(scene, fake_core, tmp_path, strategies):
    strategies.ask(scene, 1)
    bpy.ops.render.render()
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "TIFF", "RGBA", "16"
    files = strategies.save(scene, str(tmp_path / "new"))
    assert files == [str(tmp_path / "new" / f"strategies.{end}") for end in ("png", "exr")]
    after = settings.file_format, settings.color_mode, settings.color_depth
    assert after == ("TIFF", "RGBA", "16")
    exr = pytest.importorskip("janus_core.exr")
    layers, _ = exr.read_layers(files[1])
    assert {name.partition(".")[2] for name in layers} == {"Combined", *names(1)}


def test_one_sheet_for_each_view_layer(scene, fake_core, tmp_path, strategies):
    scene.view_layers.new("Second")
    strategies.ask(scene, 1)
    bpy.ops.render.render()
    strategies.save(scene, str(tmp_path))
    found = {path.name for path in tmp_path.glob("strategies*")}
    assert found == {"strategies_ViewLayer.png", "strategies_Second.png", "strategies.exr"}


@pytest.mark.parametrize("transform", ["Standard", "AgX"])
def test_tiles_have_the_view_transform_and_labels_have_not(
    scene, fake_core, tmp_path, strategies, sheet, transform
):
    scene.view_settings.view_transform = transform
    scene.render.dither_intensity = 0.0
    strategies.kept_passes["ViewLayer"] = flat_passes(1, value=2.0)
    bpy.ops.render.render()  # there must be a result
    strategies.kept_passes["ViewLayer"] = flat_passes(1, value=2.0)
    files = strategies.save(scene, str(tmp_path))
    pixels = load_pixels(files[0])[::-1, :, :3]
    placed = sheet.lay_out(flat_passes(1))
    x, y, _, _ = placed.tiles[0]
    if transform == "Standard":
        assert pixels[y, x] == pytest.approx(1.0)
    else:
        assert 0.6 < pixels[y, x, 0] < 0.98
    assert pixels.min() == pytest.approx(sheet.PAPER, abs=0.01)
    assert np.count_nonzero(np.isclose(pixels[:, : sheet.MARGIN], sheet.INK, atol=0.01)) > 100


def test_rows_are_lengths_and_columns_are_s(sheet):
    passes = flat_passes(3)
    for name, pixels in passes.items():
        if name.endswith("alone"):
            pixels[:] = 0.5
    placed = sheet.lay_out(passes)
    where = {text: (x, y) for x, y, text in placed.texts[::-1]}  # the weighted ones, first
    assert where["s=0 t=2"][1] < where["s=0 t=3"][1] == where["s=2 t=1"][1] < where["s=0 t=4"][1]
    assert where["s=0 t=2"][0] < where["s=1 t=2"][0] < where["s=2 t=1"][0] < where["s=3 t=1"][0]
    values = [placed.picture[y, x, 0] for x, y, _, _ in placed.tiles]
    assert values == [0.25] * 8 + [0.5] * 8 + [0.25]  # 1 + 3 + 4 of each, and the longer ones
    assert {"weighted", "unweighted", "1 edge", "2 edges", "3 edges", "longer"} <= set(where)
    boxes = np.zeros(placed.picture.shape[:2], dtype=int)
    for x, y, width, height in placed.tiles:
        boxes[y : y + height, x : x + width] += 1
    assert boxes.max() == 1 and boxes.sum() == len(placed.tiles) * width * height


def test_no_tile_is_brightened_in_silence(sheet):
    plain, bright = sheet.lay_out(flat_passes(1)), sheet.lay_out(flat_passes(1), exposure=2.0)
    assert bright.picture.max() == 1.0 and plain.picture.max() == 0.25
    assert "weighted  exposure +2.0" in {text for _, _, text in bright.texts}
    assert not any("exposure" in text for _, _, text in plain.texts)


def test_what_the_core_has_no_picture_of_leaves_a_gap(sheet):
    passes = flat_passes(2)
    del passes["s1 t2 weighted"], passes["s1 t2 alone"]
    labels = [text for _, _, text in sheet.lay_out(passes).texts]
    assert "s=1 t=2" not in labels and labels.count("s=2 t=1") == 2


@pytest.mark.parametrize("shape", [(1, 1), (7, 5), (100, 160), (333, 641), (1080, 1920)])
def test_tiles_keep_the_mean_of_small_and_large_pictures(sheet, shape):
    pixels = np.zeros((*shape, 3), dtype=np.float32)
    pixels[:, : shape[1] // 2] = 1.0
    tile = sheet.fit(pixels)
    assert sheet.TILE / 2 <= tile.shape[1] <= sheet.TILE
    assert tile.mean() == pytest.approx(pixels.mean(), abs=0.02)
    assert tile.min() >= 0.0 and tile.max() <= 1.0


def test_every_label_can_be_drawn(sheet):
    """With the widest numbers that the properties allow."""
    placed = sheet.lay_out(flat_passes(16), exposure=-9.5)
    finished = sheet.label(placed, placed.picture)
    x, y, text = placed.texts[0]
    ink = np.all(finished == np.float32(sheet.INK), axis=2)
    assert text.startswith("weighted") and ink[y : y + 14, x : x + 12].any()
    for x, y, width, height in placed.tiles:
        assert not ink[y : y + height, x : x + width].any()


def test_glyphs_differ():
    glyphs = part("render.glyphs")
    shapes = {tuple(rows) for rows in glyphs.GLYPHS.values()}
    assert len(shapes) == len(glyphs.GLYPHS)
    one = glyphs.text_mask("1", 1).astype(int)
    assert [list(row) for row in one[:2]] == [[0, 0, 1, 0, 0, 0], [0, 1, 1, 0, 0, 0]]


def test_operator(scene, fake_core, tmp_path, strategies):
    assert bpy.ops.janus.render_strategies(length=2, directory=str(tmp_path)) == {"FINISHED"}
    assert fake_core.settings.strategy_images == 2
    assert {image.name for image in bpy.data.images} >= {"strategies.png", "strategies.exr"}
    multilayer = bpy.data.images["strategies.exr"]
    multilayer.size[:]  # makes Blender read it
    assert multilayer.type == "MULTILAYER"
    bpy.ops.render.render()
    assert fake_core.settings.strategy_images == 0 and strategies.kept_passes == {}


def test_operator_says_why_it_failed(scene, fake_core, tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(RuntimeError, match="file"):
        bpy.ops.janus.render_strategies(directory=str(tmp_path / "file" / "folder"))
    bpy.ops.render.render()
    assert fake_core.settings.strategy_images == 0


@pytest.mark.parametrize("integrator", ["PT", "LT"])
def test_only_bidirectional_has_strategies(scene, fake_core, integrator):
    scene.janus.integrator = integrator
    with pytest.raises(RuntimeError, match="Only Janus' integrator Bidirectional"):
        bpy.ops.janus.render_strategies()
    assert fake_core.sessions == []


def test_in_a_window_the_sheet_is_shown_after_the_render(scene, fake_core, tmp_path, strategies):
    """There, Blender renders in the background of the window and a timer waits for it."""
    operators = part("operators.strategies")
    strategies.ask(scene, 1)
    bpy.ops.render.render()
    assert operators._Waiting(scene.name, str(tmp_path), 0.0)() is None  # is not called again
    assert (tmp_path / "strategies.png").is_file() and "strategies.png" in bpy.data.images
    bpy.ops.render.render()
    assert fake_core.settings.strategy_images == 0
    operators._Waiting("gone", str(tmp_path / "gone"), 0.0)()
    assert not (tmp_path / "gone").exists()
