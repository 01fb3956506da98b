# SPDX-License-Identifier: GPL-3.0-or-later
"""Captures, the command line and OpenEXR files."""

import json
import subprocess
import sys
import zipfile

import janus_core
import numpy as np
import pytest
from janus_core import capture, cli, exr

from .conftest import PLANE, SETTINGS, fill, render, sky, translation


@pytest.fixture
def captured(tmp_path):
    """(path of a capture, the picture that it must give)"""
    builder = capture.CapturingBuilder()
    fill(builder)
    builder.set_world(name="World", graph=None)
    path = tmp_path / "scene.npz"
    builder.save(path, janus_core.RenderSettings(**SETTINGS))
    return path, render(builder.commit()).snapshot()


def command(*arguments):
    words = [sys.executable, "-m", "janus_core", *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, timeout=120)


def test_same_bits(captured):
    path, expected = captured
    builder, settings = capture.load(path)
    assert settings == janus_core.RenderSettings(**SETTINGS)
    assert np.array_equal(render(builder.commit()).snapshot(), expected)


def test_cameras(tmp_path):
    """A fisheye of a field, lens, polynomial and shift of its own, and a camera with none."""
    fisheye = {
        "type": "FISHEYE_LENS_POLYNOMIAL",
        "fisheye_fov": 2.0,
        "fisheye_lens": 8.0,
        "fisheye_polynomial": (-0.1, -1.2, 0.3, 0.0, 0.0),
        "shift": (0.1, 0.2),
    }
    pictures = []
    for camera in ({}, {"type": "FISHEYE_EQUISOLID"}, fisheye):
        builder = capture.CapturingBuilder()
        fill(builder)
        builder.set_camera(
            name="Eye", transform=translation(0, 0, 1), window=(-1.0, 1.0, -0.75, 0.75), **camera
        )
        builder.set_world(name="World", graph=None)
        path = tmp_path / "scene.npz"
        builder.save(path, janus_core.RenderSettings(**SETTINGS))
        loaded, _ = capture.load(path)
        expected = render(builder.commit()).snapshot()
        assert np.array_equal(render(loaded.commit()).snapshot(), expected)
        pictures.append(expected)
    assert not np.array_equal(pictures[1], pictures[2])


def test_images(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    pixels = np.random.default_rng(1).random((4, 8, 3), dtype=np.float32)
    sky(builder, pixels)
    builder.save(tmp_path / "sky.npz", janus_core.RenderSettings(**SETTINGS))
    expected = render(builder.commit()).snapshot()
    again, _ = capture.load(tmp_path / "sky.npz")
    assert np.array_equal(render(again.commit()).snapshot(), expected)
    sky(builder, 0.5 * pixels)
    assert not np.array_equal(render(builder.commit()).snapshot(), expected)


def test_holdouts(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    builder.set_world(name="World", graph=None)
    plain = render(builder.commit()).snapshot()
    for key, arguments in builder._items["instance"].items():
        builder.set_instance(key, **arguments | {"holdout": True})
    builder.save(tmp_path / "held.npz", janus_core.RenderSettings(**SETTINGS))
    again, _ = capture.load(tmp_path / "held.npz")
    held = render(again.commit()).snapshot()
    assert plain[..., :3].any()
    assert plain[..., 3].all()
    assert not held[4:-4, 4:-4].any()  # the border sees the edge of the floor


def test_shadow_catchers(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    for key, arguments in builder._items["instance"].items():
        builder.set_instance(key, **arguments | {"shadow_catcher": True})
    settings = janus_core.RenderSettings(**SETTINGS, film_transparent=True)
    builder.save(tmp_path / "caught.npz", settings)
    again, settings = capture.load(tmp_path / "caught.npz")
    session = janus_core.RenderSession(again.commit(), settings)
    session.start()
    session.finish()
    assert not session.snapshot().any()  # nothing is done to their light


def test_motion(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    still = render(builder.commit()).snapshot()
    fill(builder)
    up = PLANE["positions"] + np.float32([0, 0, 0.5])
    builder.set_mesh_motion("mesh", positions=[PLANE["positions"], up])
    builder.set_instance_motion("floor", transforms=[translation(0, 0, 0), translation(1, 0, 0)])
    builder.set_camera_motion(
        transforms=[translation(0, 0, 4), translation(0.5, 0, 4)],
        windows=[(-0.5, 0.5, -0.25, 0.25)] * 2,
    )
    builder.set_shutter([0.2, 1.0, 0.4])
    builder.save(tmp_path / "moving.npz", janus_core.RenderSettings(**SETTINGS))
    blurred = render(builder.commit()).snapshot()
    assert not np.array_equal(blurred, still)
    again, _ = capture.load(tmp_path / "moving.npz")
    assert np.array_equal(render(again.commit()).snapshot(), blurred)
    fill(builder)  # what is set again stands still
    builder.save(tmp_path / "still.npz", janus_core.RenderSettings(**SETTINGS))
    again, _ = capture.load(tmp_path / "still.npz")
    assert np.array_equal(render(again.commit()).snapshot(), still)


def test_motion_that_is_none():
    builder = janus_core.SceneBuilder()
    with pytest.raises(janus_core.SceneError, match="no camera"):
        builder.set_shutter([1.0])
    fill(builder)
    for arguments, message in (
        ({"positions": [[(0, 0)]]}, r"motion positions.*\(N, M, 3\)"),
        ({"positions": [PLANE["positions"]] * 2, "normals": [PLANE["positions"]]}, "1 times"),
    ):
        with pytest.raises(janus_core.SceneError, match=message):
            builder.set_mesh_motion("mesh", **arguments)
    with pytest.raises(janus_core.SceneError, match=r"floor.*\(N, 4, 4\)"):
        builder.set_instance_motion("floor", transforms=np.eye(3))
    with pytest.raises(janus_core.SceneError, match="lengths"):
        builder.set_camera_motion(transforms=[np.eye(4)] * 2, windows=[])


PASSES = (
    "next_event",
    "connection_mode",
    "strategies",
    "expressions",
    "light_passes",
    "strategy_images",
    "shadow_catcher",
)
FILM = ("film_exposure", "film_transparent_glass", "film_transparent_roughness")


# 3: from before holdouts and the film's settings, 5: before passes and strategies.
@pytest.mark.parametrize("version, without", [(3, (*FILM, *PASSES)), (5, PASSES)])
def test_older_captures(captured, tmp_path, version, without):
    path, expected = captured
    old = tmp_path / "old.npz"
    with zipfile.ZipFile(path) as new, zipfile.ZipFile(old, "w") as archive:
        for name in new.namelist():
            content = new.read(name)
            if name == "scene.json":
                description = json.loads(content)
                description["version"] = version
                for setting in without:
                    del description["settings"][setting]
                content = json.dumps(description)
            archive.writestr(name, content)
    builder, settings = capture.load(old)
    assert settings == janus_core.RenderSettings(**SETTINGS)
    assert np.array_equal(render(builder.commit()).snapshot(), expected)


def test_nothing_in_it_is_pickled(captured):
    with zipfile.ZipFile(captured[0]) as archive:
        assert "scene.json" in archive.namelist()
        assert json.loads(archive.read("scene.json"))
    with np.load(captured[0], allow_pickle=False) as arrays:
        for name in arrays.files:
            if name != "scene.json":
                assert arrays[name].dtype.kind in "fiu"


def test_removed_items_are_not_saved(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    builder.remove("lamp")
    builder.save(tmp_path / "a.npz", janus_core.RenderSettings(**SETTINGS))
    again, _ = capture.load(tmp_path / "a.npz")
    assert again.commit().counts["lights"] == 0


@pytest.mark.parametrize("content", [b"", b"this is no archive", b"PK\x03\x04 broken"])
def test_foreign_files(tmp_path, content):
    path = tmp_path / "broken.npz"
    path.write_bytes(content)
    with pytest.raises(janus_core.IoError, match="broken.npz"):
        capture.load(path)


def test_cut_file(captured):
    content = captured[0].read_bytes()
    captured[0].write_bytes(content[: len(content) // 2])
    with pytest.raises(janus_core.IoError):
        capture.load(captured[0])


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(janus_core.IoError, match="none.npz"):
        capture.load(tmp_path / "none.npz")
    with pytest.raises(janus_core.IoError):
        capture.CapturingBuilder().save(tmp_path / "no" / "a.npz", janus_core.RenderSettings())


def test_command_gives_the_same_bits(captured, tmp_path):
    path, expected = captured
    out, stats = tmp_path / "out.exr", tmp_path / "stats.json"
    done = command(path, "-o", out, "--stats", stats)
    assert done.returncode == 0, done.stderr
    pixels, metadata = exr.read(out)
    assert np.array_equal(pixels, expected)
    assert metadata["janus/version"] == janus_core.__version__
    found = json.loads(stats.read_text())
    assert found["samples"] == SETTINGS["samples"]
    assert found["rays"]["camera"] > 0
    assert found["seconds"] > 0.0


def test_command_options(captured, tmp_path):
    out, stats = tmp_path / "out.exr", tmp_path / "stats.json"
    words = ("--samples", 2, "--integrator", "pt", "--max-bounces", 1, "--resolution", "16x8")
    more = ("--threads", 1, "--seed", 9, "--filter", "box", "-q")
    done = command(captured[0], "-o", out, "--stats", stats, *words, *more)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert exr.read(out)[0].shape == (8, 16, 4)
    settings = json.loads(stats.read_text())["settings"]
    assert settings["samples"] == 2 and settings["integrator"] == "pt" and settings["seed"] == 9


def test_passes_and_strategies_are_captured(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    settings = janus_core.RenderSettings(
        **SETTINGS,
        next_event=False,
        heuristic="NONE",
        connection_mode="CLASSIC",
        strategies="0,* 1,2",
        expressions=[("Sharp", "LS+DE"), ("All", "L.*E")],
        light_passes=["DiffDir"],
    )
    builder.save(tmp_path / "scene.npz", settings)
    assert capture.load(tmp_path / "scene.npz")[1] == settings


def test_command_writes_passes(captured, tmp_path):
    path, expected = captured
    out = tmp_path / "out.exr"
    done = command(path, "-o", out, "--pass", "Everything=L.*E", "--pass", "Sharp=LS+DE")
    assert done.returncode == 0, done.stderr
    layers, _ = exr.read_layers(out)
    assert set(layers) == {"Combined", "Everything", "Sharp"}
    assert np.array_equal(layers["Combined"], expected)
    assert np.allclose(layers["Everything"], expected[:, :, :3], rtol=1e-4, atol=1e-5)
    wrong = command(path, "-o", out, "--pass", "Sharp=LS+(E")
    assert wrong.returncode == 2 and "Sharp" in wrong.stderr and "Traceback" not in wrong.stderr
    assert command(path, "-o", out, "--pass", "LS+DE").returncode == 2


def test_aovs_are_captured(tmp_path):
    def written(**inputs):
        end = {"name": "End", "type": "OUTPUT_AOV", "inputs": inputs}
        return {"nodes": [end | {"properties": {"aov_name": "Mask"}}], "surface": None}

    builder = capture.CapturingBuilder()
    fill(builder)
    builder.set_world(name="World", graph=None, aovs=written(Value=-2.0))
    for key, arguments in builder._items["material"].items():
        builder.set_material(key, **arguments, aovs=written(Value=3.0))
    settings = janus_core.RenderSettings(**SETTINGS, aovs=[("Mask", "VALUE"), ("Tint", "COLOR")])
    builder.save(tmp_path / "scene.npz", settings)
    again, found = capture.load(tmp_path / "scene.npz")
    assert found == settings and found.aovs == [("Mask", "VALUE"), ("Tint", "COLOR")]
    pictures = [
        render(scene.commit(), aovs=settings.aovs).snapshot("AOV Mask")
        for scene in (builder, again)
    ]
    assert np.array_equal(*pictures)
    assert pictures[0].max() == 3.0 and pictures[0].min() >= -2.0
    out = tmp_path / "out.exr"
    done = command(tmp_path / "scene.npz", "-o", out)
    assert done.returncode == 0, done.stderr
    layers, _ = exr.read_layers(out)
    assert np.array_equal(layers["AOV Mask"], pictures[0])
    assert layers["AOV Tint"].shape[2] == 4 and not layers["AOV Tint"].any()


def test_exit_codes(captured, tmp_path):
    path, _ = captured
    out = tmp_path / "out.exr"
    assert command(path).returncode == 2
    assert command(path, "-o", out, "--samples", "no").returncode == 2
    assert command(path, "-o", tmp_path / "out.png").returncode == 2
    assert command(tmp_path / "none.npz", "-o", out).returncode == 1
    assert command(path, "-o", tmp_path / "no" / "out.exr").returncode == 1
    builder = capture.CapturingBuilder()  # without a camera
    builder.save(tmp_path / "blind.npz", janus_core.RenderSettings())
    blind = command(tmp_path / "blind.npz", "-o", out)
    assert blind.returncode == 3
    assert "camera" in blind.stderr and "Traceback" not in blind.stderr
    assert not out.exists()


@pytest.mark.parametrize("reason", ["", "not enough memory for a picture"])
@pytest.mark.parametrize("name", ["_run", "_render"])
def test_command_without_memory(captured, tmp_path, monkeypatch, capsys, name, reason):
    """Nowhere a traceback; what has been rendered until then is written."""
    path, _ = captured
    out, stats = tmp_path / "out.exr", tmp_path / "stats.json"

    def fail(*arguments):
        if name == "_run":
            raise MemoryError(reason)
        render(*arguments)
        return MemoryError(reason)

    render = cli._render
    monkeypatch.setattr(cli, name, fail)
    assert cli.main([str(path), "-q", "-o", str(out), "--stats", str(stats)]) == cli.FAILED
    said = capsys.readouterr().err
    assert ("out of memory" if name == "_run" else "rendering failed") in said and reason in said
    assert out.exists() == stats.exists() == (name == "_render")


def test_exr_round_trip(tmp_path):
    pixels = np.random.default_rng(1).normal(size=(5, 7, 4)).astype(np.float32)
    pixels[0, 0] = [np.inf, -0.0, 1e30, 1e-40]
    path = tmp_path / "ünïcode.exr"
    exr.write(path, pixels, {"janus/seed": "3"})
    again, metadata = exr.read(path)
    assert np.array_equal(again, pixels)
    assert metadata["janus/seed"] == "3"


def test_exr_errors(tmp_path):
    with pytest.raises(janus_core.IoError, match="none.exr"):
        exr.read(tmp_path / "none.exr")
    with pytest.raises(janus_core.IoError, match="no/a.exr"):
        exr.write(tmp_path / "no" / "a.exr", np.zeros((2, 2, 4), dtype=np.float32))
    (tmp_path / "text.exr").write_text("no picture")
    with pytest.raises(janus_core.IoError, match="text.exr"):
        exr.read(tmp_path / "text.exr")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["text.exr"]  # nothing half written
