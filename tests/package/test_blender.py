# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension in a real Blender binary: installed from disk, rendering headless."""

import json
import re
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import MODULE, ROOT, Blender

VERSION = re.search(r'(?m)^version = "(.+)"', (ROOT / "addon/blender_manifest.toml").read_text())[1]


def png_texts(path: Path) -> dict[str, str]:
    """The tEXt chunks of a PNG file."""
    data, texts, at = path.read_bytes(), {}, 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        if data[at + 4 : at + 8] == b"tEXt":
            key, _, text = data[at + 8 : at + 8 + length].partition(b"\0")
            texts[key.decode()] = text.decode()
        at += 12 + length
    return texts


@pytest.fixture(scope="session")
def hero(installed: Blender) -> dict:
    """What in_blender.py found when it rendered the hero with Janus, Cycles and Janus."""
    installed.add(ROOT / "scenes")
    script = installed.add(ROOT / "tests/package/in_blender.py")
    # LD_DEBUG: the dynamic linker's own record of which library each symbol came from.
    trace = (f"LD_DEBUG_OUTPUT={installed.inside('bindings')}", "LD_DEBUG=bindings")
    done = installed.run(
        "--addons", MODULE, "-P", script, "--", installed.inside(""), environment=trace
    )
    assert done.returncode == 0, done.stdout
    return json.loads((installed.folder / "result.json").read_text())


def test_blender_finds_the_extension_valid(blender: Blender, extension: Path):
    done = blender.run("--command", "extension", "validate", blender.add(extension))
    assert done.returncode == 0, done.stdout


def test_factory_scene_from_the_command_line(installed: Blender):
    small = installed.folder / "small.py"
    small.write_text(
        "import bpy\n"
        "scene = bpy.context.scene\n"
        "scene.render.resolution_percentage = 5\n"
        "scene.janus.samples = 8\n"
    )
    done = installed.run(
        *("--addons", MODULE, "-P", installed.inside("small.py"), "-E", "JANUS"),
        *("-o", installed.inside("cube_"), "-F", "PNG", "-f", "1"),
    )
    assert done.returncode == 0, done.stdout
    picture = installed.folder / "cube_0001.png"
    assert picture.exists(), "no picture was written"
    texts = png_texts(picture)
    assert VERSION in [v for k, v in texts.items() if "janus/version" in k.lower()], texts
    assert any("janus/samples" in k.lower() for k in texts), texts


def test_hero_is_a_picture(hero: dict):
    janus = hero["janus"]
    assert janus["size"] == [96, 64]
    assert janus["finite"]
    assert janus["deviation"] > 0.1 * janus["mean"] > 0.001


def test_hero_resembles_cycles_in_the_same_process(hero: dict):
    cycles = hero["cycles"]
    assert cycles["finite"]
    assert cycles["deviation"] > 0.0
    # Loose: Cycles misses most of the caustics.
    assert 0.7 < hero["janus"]["mean"] / cycles["mean"] < 1.5


def test_janus_renders_the_same_after_cycles(hero: dict):
    assert hero["janus_again"] == hero["janus"]


@pytest.mark.parametrize(
    ("scene", "picture"),
    [
        ("diffuse_box", "diffuse_box.exr"),
        ("glass_box", "glass_box.exr"),
        ("hero", "janus.exr"),
    ],
)
def test_the_bpy_module_renders_the_same(
    hero: dict, installed: Blender, tmp_path: Path, scene: str, picture: str
):
    """Another Blender, Python and C library may round differently; that may hardly show."""
    exr = pytest.importorskip("janus_core.exr")
    path = tmp_path / "ours.exr"
    driver = [sys.executable, str(ROOT / "scenes" / "render.py"), scene]
    size = ["--resolution", "96x64", "--samples", "16"]
    subprocess.run([*driver, *size, "-o", str(path)], check=True, timeout=300)
    ours, theirs = exr.read(path)[0][..., :3], exr.read(installed.folder / picture)[0][..., :3]
    difference = np.abs(ours - theirs).max(axis=2)
    close = float((difference <= 1e-3).mean())
    print(
        f"{scene}: means differ by {ours.mean() / theirs.mean() - 1.0:.2e}, {100 * close:.2f} % of "
        f"the pixels are within 1e-3, the largest difference is {difference.max():.3g}"
    )
    assert abs(ours.mean() / theirs.mean() - 1.0) < 5e-4
    assert close >= 0.999


def test_the_picture_is_stamped(hero: dict, installed: Blender):
    header = (installed.folder / "janus.exr").read_bytes()[:65536]
    assert b"janus/version" in header
    assert b"janus/version" not in (installed.folder / "cycles.exr").read_bytes()[:65536]


def test_the_core_is_the_extensions_own(hero: dict):
    assert "/user/extensions/" in hero["core"]
    assert hero["build_info"]["version"] == VERSION


def test_no_symbol_crosses_between_blender_and_us(hero: dict, installed: Blender):
    """Our files bind to themselves, Python and the C and C++ runtimes; nothing binds to us."""
    runtime = re.compile(
        r"/(ld-linux[^/]*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))\.so\.\d+$"
        r"|/libtbbmalloc_proxy\.so"  # the process's malloc, in Debian's Blender
    )
    binding = re.compile(r"binding file (\S+) .*? to (\S+) .*?: \w+ symbol `([^']+)'")
    seen, crossing = 0, set()
    for log in installed.folder.glob("bindings.*"):
        with open(log, errors="replace") as lines:
            for match in filter(None, map(binding.search, lines)):
                user, owner, symbol = match.groups()
                from_us, to_us = "/janus_core/" in user, "/janus_core/" in owner
                seen += from_us
                if from_us and not (to_us or runtime.search(owner) or re.match("_?Py", symbol)):
                    crossing.add(match.groups())
                if to_us and not from_us:
                    crossing.add(match.groups())
    assert seen > 50, "the dynamic linker's record does not mention janus_core"
    assert not crossing
