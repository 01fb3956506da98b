# SPDX-License-Identifier: GPL-3.0-or-later
"""What must not go wrong with files, Ctrl-C in the command, and the typed stub."""

import ast
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import janus_core
import numpy as np
import pytest
from janus_core import capture, exr

from .conftest import SETTINGS, fill

PIXELS = np.arange(5 * 7 * 4, dtype=np.float32).reshape(5, 7, 4)


def test_exr_keeps_every_bit(tmp_path):
    pixels = PIXELS.copy()
    pixels[0, :5, 0] = np.nan, np.inf, -np.inf, 1e-40, -0.0
    exr.write(tmp_path / "a.exr", pixels)
    assert exr.read(tmp_path / "a.exr")[0].tobytes() == pixels.tobytes()


def test_exr_without_alpha_reads_as_opaque(tmp_path):
    exr.write(tmp_path / "a.exr", PIXELS[:, :, :3].astype(np.float64)[:, ::-1])
    again, _ = exr.read(tmp_path / "a.exr")
    assert np.array_equal(again[:, :, :3], PIXELS[:, ::-1, :3])
    assert np.all(again[:, :, 3] == 1.0)


def test_exr_layers_keep_names_and_every_bit(tmp_path):
    layers = {"Combined": PIXELS, "Diffuse Inter-Reflections": -PIXELS[:, :, :3], "a b": PIXELS + 1}
    exr.write_layers(tmp_path / "a.exr", layers, {"janus/seed": "7"})
    again, metadata = exr.read_layers(tmp_path / "a.exr")
    assert metadata == {"janus/seed": "7"} and set(again) == set(layers)
    for name, pixels in layers.items():
        assert np.array_equal(again[name], pixels)
    assert np.array_equal(exr.read(tmp_path / "a.exr")[0], PIXELS)  # for who knows no layers


@pytest.mark.parametrize("second", [PIXELS[1:, :, :3], PIXELS[:, :, :2], None])
def test_exr_refuses_layers_that_do_not_fit(tmp_path, second):
    layers = {"Combined": PIXELS, "b": second} if second is not None else {}
    with pytest.raises((ValueError, janus_core.IoError)):
        exr.write_layers(tmp_path / "a.exr", layers)
    assert not list(tmp_path.iterdir())


def test_exr_refuses_two_layers_of_a_name(tmp_path):
    with pytest.raises(janus_core.IoError, match="two layers"):
        exr.write_layers(tmp_path / "a.exr", {"Combined": PIXELS, "": PIXELS})


@pytest.mark.parametrize("shape", [(4,), (3, 3), (3, 3, 2), (0, 3, 4)])
def test_exr_refuses_other_shapes(tmp_path, shape):
    with pytest.raises((ValueError, janus_core.IoError)):
        exr.write(tmp_path / "a.exr", np.zeros(shape))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["", "channels", "dataWindow", "type", "x" * 256])
def test_exr_refuses_names_that_would_spoil_the_file(tmp_path, name):
    with pytest.raises(janus_core.IoError, match=r"a\.exr"):
        exr.write(tmp_path / "a.exr", PIXELS, {name: "value"})
    assert not list(tmp_path.iterdir())


def test_exr_follows_links_and_spares_devices(tmp_path):
    target, link = tmp_path / "target.exr", tmp_path / "link.exr"
    target.write_text("old")
    link.symlink_to(target)
    exr.write(link, PIXELS)
    assert link.is_symlink() and np.array_equal(exr.read(target)[0], PIXELS)
    with pytest.raises(janus_core.IoError, match="/dev/null"):
        exr.write("/dev/null", PIXELS)
    assert Path("/dev/null").is_char_device()


@pytest.mark.parametrize("kept", [0.2, 0.6, 0.95])
def test_exr_cut_short_is_an_error(tmp_path, kept):
    path = tmp_path / "a.exr"
    exr.write(path, np.random.default_rng(1).random((64, 64, 4), dtype=np.float32))
    content = path.read_bytes()
    path.write_bytes(content[: int(kept * len(content))])
    with pytest.raises(janus_core.IoError, match=r"a\.exr"):
        exr.read(path)


def test_full_disk_leaves_the_old_picture(tmp_path):
    """A limit on the size of files fails a write as a full disk does."""
    path = tmp_path / "a.exr"
    exr.write(path, PIXELS)
    code = """if True:
        import sys, numpy, janus_core
        from janus_core import exr
        try:
            exr.write(sys.argv[1], numpy.random.default_rng(1).random((256, 256, 4)))
        except janus_core.IoError as error:
            sys.exit(0 if sys.argv[1] in str(error) else "no name in it")
        sys.exit("no error")
    """
    done = subprocess.run(
        [sys.executable, "-c", code, path],
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 16, 1 << 16)),
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert [p.name for p in tmp_path.iterdir()] == ["a.exr"]
    assert np.array_equal(exr.read(path)[0], PIXELS)


def test_interrupted_command_writes_what_there_is(tmp_path):
    recorded = capture.CapturingBuilder()
    fill(recorded)
    recorded.save(tmp_path / "s.npz", janus_core.RenderSettings(**SETTINGS))
    out = tmp_path / "out.exr"
    command = [sys.executable, "-m", "janus_core", tmp_path / "s.npz", "-o", out]
    process = subprocess.Popen([*command, "--seconds", "120"], stderr=subprocess.PIPE, text=True)
    time.sleep(3.0)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 130, errors
    assert "interrupted" in errors
    pixels, metadata = exr.read(out)
    assert pixels.shape == (16, 32, 4) and pixels[:, :, :3].max() > 0.0
    assert 0 < int(metadata["janus/samples"]) < 1 << 24


def test_stub_has_the_names_of_the_module():
    folder = Path(janus_core.__file__).parent
    stubs = ("_core.pyi", "_settings.pyi", "_transport_session.pyi")
    stub = "".join((folder / name).read_text("utf-8") for name in stubs)
    tree = ast.parse(stub)
    functions = {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}
    classes = {n.name: n for n in tree.body if isinstance(n, ast.ClassDef) if n.name[0] != "_"}
    assert functions | set(classes) | {"__version__"} == set(janus_core.__all__)
    for name, node in classes.items():
        if name.endswith("Error") or name == "Cancelled":
            continue
        stubbed = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
        real = {n for n in vars(getattr(janus_core, name)) if not n.startswith("_")}
        assert {n for n in stubbed if not n.startswith("_")} == real, name
