# SPDX-License-Identifier: GPL-3.0-or-later
"""The driver behind ./dev render: usage, errors, output, statistics, Ctrl-C."""

import io
import json
import signal
import subprocess
import sys
import time

import pytest

from .conftest import DRIVER, ROOT, drive, driven

sys.path.insert(0, str(ROOT))
from scenes.driver import arguments  # noqa: E402
from scenes.driver.progress import Progress, clock  # noqa: E402

TINY = ("--resolution", "32x20", "--samples", 2)


def test_every_scene_is_listed():
    assert {"hero", "diffuse_box", "glass_box"} <= set(arguments.scene_names())
    assert not {"kit", "render"} & set(arguments.scene_names())


@pytest.mark.parametrize(
    "words",
    [
        ["nowhere"],
        ["nowhere.blend"],
        ["hero", "--samples", "0"],
        ["hero", "--resolution", "640"],
        ["hero", "--integrator", "magic"],
        ["hero", "--output", "picture.jpg"],
        ["hero", "--engine", "cycles", "--capture", "x.npz"],
    ],
)
def test_wrong_usage_is_2(words, capsys):
    with pytest.raises(SystemExit) as stopped:
        arguments.parse(words)
    assert stopped.value.code == 2
    assert "error:" in capsys.readouterr().err


def test_defaults():
    options = arguments.parse([])
    assert options.scene == "hero"
    assert options.output == ROOT / "renders" / "hero.png"
    assert options.engine == "janus"
    assert arguments.parse(["--resolution", "64x40"]).resolution == (64, 40)


def test_blender_is_taken_out_of_the_words():
    words = ["hero", "--blender", "/b", "--samples", "3", "--blender=/c"]
    assert arguments.without_blender(words) == ["hero", "--samples", "3"]


def test_clock():
    assert [clock(s) for s in (0.2, 59.6, 3671)] == ["0:00", "1:00", "1:01:11"]


def test_progress_bar():
    stream = io.StringIO()
    stream.isatty = lambda: True
    progress = Progress("janus", samples=40, stream=stream)
    progress.feed("Synchronizing objects")
    progress.feed("Sample 0/40 | Remaining 00:10")
    progress.feed("Mem: 0M | Sample 40/40")
    assert progress.samples == 40
    shown = stream.getvalue().split("\r")
    assert "Synchronizing objects" in shown[1]
    assert "100 %" in shown[-1]
    assert "40/40 samples" in shown[-1]


@pytest.mark.parametrize("engine", ["janus", "cycles"])
def test_picture_and_statistics(engine, tmp_path):
    exr, stats = tmp_path / "new" / "a.exr", tmp_path / "a.json"
    out = driven("glass_box", *TINY, "--engine", engine, "-o", exr, "--stats", stats)
    assert str(exr) in out
    from janus_core import exr as files

    pixels, _ = files.read(str(exr))
    assert pixels.shape[:2] == (20, 32)
    assert pixels[..., :3].max() > 1.0  # linear and not clipped: the lamp is in view
    found = json.loads(stats.read_text())
    assert found["engine"] == engine
    assert found["samples"] == 2
    assert found["seconds"] >= 0.0
    assert found["setup_seconds"] >= 0.0
    assert found["diagnostics"] == [] or engine == "janus"
    if engine == "janus":
        assert found["paths"]["camera"] == 2 * 32 * 20
        assert found["paths"]["light"] > 0
        assert sum(found["rays"].values()) > 0
        assert found["dropped"] == 0
        assert not [d for d in found["diagnostics"] if not d.startswith("info")]


def test_time_limit(tmp_path):
    stats = tmp_path / "a.json"
    begin = time.monotonic()
    driven("glass_box", "--resolution", "32x20", "--seconds", 1, *out(tmp_path), "--stats", stats)
    found = json.loads(stats.read_text())
    assert 0.9 <= found["seconds"] < 3.0
    assert found["samples"] > 1
    assert time.monotonic() - begin < 30.0


def test_errors_are_one_line_and_exit_1(tmp_path):
    for words in (
        ("glass_box", *TINY, "-o", "/proc/no/such/place.png"),
        (_not_a_blend(tmp_path), *TINY, *out(tmp_path)),
        ("hero", "--blender", "/no/such/blender"),
    ):
        result = drive(*words)
        assert result.returncode == 1, result.stderr
        assert "Traceback" not in result.stderr
        assert result.stderr.splitlines()[-1].startswith("./dev render: ")


def test_ctrl_c_keeps_the_picture(tmp_path):
    picture, stats = tmp_path / "a.png", tmp_path / "a.json"
    words = ["glass_box", "--resolution", "64x40", "--samples", "1000000"]
    command = [sys.executable, str(DRIVER), *words, "-o", str(picture), "--stats", str(stats)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
    time.sleep(8.0)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30.0)
    assert process.returncode == 130, errors.decode()
    assert b"Traceback" not in errors
    assert picture.stat().st_size > 0
    assert json.loads(stats.read_text())["samples"] > 0


def out(folder) -> tuple:
    return ("-o", folder / "a.png")


def _not_a_blend(folder):
    path = folder / "broken.blend"
    path.write_bytes(b"this is no blend file" * 10)
    return path
