# SPDX-License-Identifier: GPL-3.0-or-later
"""On a full disk every file that is written ends in a message that names it; the old one stays."""

import contextlib
import os
import resource
import signal
import subprocess
import sys

import janus_core
import numpy as np
import pytest
from janus_core import capture, cli, dual, exr

from tests.bindings.conftest import SETTINGS, fill, translation

from .conftest import FOLDER  # first: it finds the folder tests

KILOBYTES = 16


@contextlib.contextmanager
def no_room(kilobytes=KILOBYTES):
    """No file of this process grows beyond that: as on a full disk, for whoever is no root."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes << 10, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)


@pytest.fixture(params=["limit", "disk"])
def full(request, tmp_path):
    """A folder, and a context in which what is written there finds no room."""
    if request.param == "limit":
        yield tmp_path, no_room
        return
    size = f"size={KILOBYTES}k"
    command = ["mount", "-t", "tmpfs", "-o", size, "janus-test", str(tmp_path)]
    if os.geteuid() != 0 or subprocess.run(command, capture_output=True).returncode != 0:
        pytest.skip("only root can mount a small disk")
    try:
        yield tmp_path, contextlib.nullcontext
    finally:
        subprocess.run(["umount", "-l", str(tmp_path)], check=True)


def noise(*shape):
    """What no compression makes small."""
    return np.random.default_rng(1).random(shape, dtype=np.float32)


def writers():
    builder = capture.CapturingBuilder()
    fill(builder)
    builder.set_image("sky", name="Sky", pixels=noise(128, 128, 3))
    settings = janus_core.RenderSettings(**SETTINGS)
    spot = {"name": "Spot", "type": "SPOT", "transform": translation(0, 0, 3), "spot_size": 1.0}
    builder.set_light("spot", **spot)
    matrix = dual.capture(builder.commit(), settings, "Spot", resolution=(64, 64))
    return {
        "scene.npz": lambda path: builder.save(path, settings),
        "matrix.npz": matrix.save,
        "picture.exr": lambda path: exr.write(path, noise(256, 256, 4)),
        "layers.exr": lambda path: exr.write_layers(path, {"Combined": noise(256, 256, 4)}),
    }


@pytest.mark.parametrize("name", ["scene.npz", "matrix.npz", "picture.exr", "layers.exr"])
def test_old_files_stay(full, name):
    folder, shut = full
    path = folder / name
    path.write_text("good")
    with shut(), pytest.raises(janus_core.IoError) as caught:
        writers()[name](path)
    assert str(path) in str(caught.value)
    assert any(text in str(caught.value) for text in ("No space left", "File too large"))
    assert path.read_text() == "good"
    assert [p.name for p in folder.iterdir()] == [name]  # nothing half written beside it


@pytest.fixture
def scene_file(tmp_path_factory):
    builder = capture.CapturingBuilder()
    fill(builder)
    path = tmp_path_factory.mktemp("scene") / "scene.npz"
    settings = {**SETTINGS, "width": 128, "height": 128, "samples": 1}
    builder.save(path, janus_core.RenderSettings(**settings))
    return str(path)


@pytest.mark.parametrize("which", ["picture", "stats"])
def test_command(full, scene_file, which, capsys):
    folder, shut = full
    picture, stats = folder / "picture.exr", folder / "stats.json"
    arguments = [scene_file, "-q", "-o", str(picture)]
    if which == "stats":
        stats.write_text("good")
        # The picture, of one colour, fits; what is said of it does not.
        arguments += ["--resolution", "4x4", "--stats", str(stats)]
        shut = (lambda: no_room(2)) if shut is no_room else (lambda: filled(folder))
    with shut():
        assert cli.main(arguments) == cli.FAILED
    said = capsys.readouterr().err
    assert str(stats if which == "stats" else picture) in said
    assert "No space left" in said or "File too large" in said
    if which == "stats":
        assert stats.read_text() == "good"
        assert picture.exists()


@contextlib.contextmanager
def filled(folder):
    """But for a page or two."""
    with open(folder / "rest", "wb", buffering=0) as rest, contextlib.suppress(OSError):
        while True:
            rest.write(b"x" * 4096)
    with open(folder / "rest", "r+b") as rest:
        rest.truncate(os.path.getsize(folder / "rest") - 4096)
    yield


@pytest.mark.parametrize("name", ["picture.png", "picture.exr"])
def test_driver(full, name):
    """Blender's own writers are silent about it."""
    folder, shut = full
    if shut is no_room:
        pytest.skip("Blender has files of its own to write, which the limit is for, too")
    path = folder / name
    path.write_text("good")
    command = [sys.executable, "scenes/render.py", "cornell_box", "--samples", "1"]
    done = subprocess.run(
        [*command, "--resolution", "160x160", "--output", str(path)],
        cwd=FOLDER.parents[1],
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 1, done.stdout + done.stderr
    assert f"cannot write {path}" in done.stderr
    assert "No space left" in done.stderr
    assert path.read_text() == "good"
    assert [p.name for p in folder.iterdir()] == [name]
