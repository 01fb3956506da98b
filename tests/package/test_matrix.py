# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip in each Blender that it is made for, as a user meets it: matrix_steps.py has the steps.

An older version is installed and renders, the new one is installed over it, and then it is used.
bpy 5.0 and one real binary always, all with JANUS_FULL (./dev test --full).
"""

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from blenders import ROOT, Blender, BpyModule, Unavailable
from conftest import cannot
from repack import CORE_SAYS, LABEL, repacked
from test_blender import VERSION

FULL = "JANUS_FULL" in os.environ
# As after the start of Blender, with the preferences that installing has written.
BLENDERS = {
    "bpy-4.2.0": lambda: BpyModule("4.2.0"),
    "bpy-4.5.15": lambda: BpyModule("4.5.15"),
    "bpy-5.0.1": lambda: BpyModule(None),
    "blender-4.3": lambda: Blender("trixie", options=()),
    "blender-5.2": lambda: Blender("sid", options=()),
}
ALWAYS = ("bpy-5.0.1", "blender-5.2")
NAMES = [name for name in BLENDERS if FULL or name in ALWAYS]
# What is the same in all of them (`procedural` is not: before 5.0 Voronoi had other points).
SCENES = ("hero", "glass_box", "textured", "studio")
# bpy 4.2 may crash when it ends, once settings with an update function were unregistered: with no
# more than `class A(PropertyGroup): x: IntProperty(update=f)`, and here after an upgrade.
ENDS_BADLY = ("bpy-4.2.0",)
# Of as many letters as ours (see repack.py): 0.0.1, 0.0.10.
OLDER = {
    "version": f"0.0.1{'0' * (len(VERSION) - 5)}",
    "says": "The former core of Janus.",
    "label": "Older",
}
OTHER = {"version": VERSION, "says": "The core in another build", "label": "Other build"}
ANEW = "Janus was installed anew"  # of what is in use

Place = Blender | BpyModule


@pytest.fixture(scope="session", params=NAMES)
def place(request) -> Place:
    try:
        place = BLENDERS[request.param]()
        place.ends_badly = request.param in ENDS_BADLY
    except Unavailable as error:
        cannot(f"{request.param} cannot be had here: {error}")
    yield place
    place.remove()


@pytest.fixture(scope="session")
def older(extension: Path, tmp_path_factory) -> Path:
    return repacked(extension, tmp_path_factory.mktemp("older"), **OLDER)


@pytest.fixture(scope="session")
def other(extension: Path, tmp_path_factory) -> Path:
    return repacked(extension, tmp_path_factory.mktemp("other"), **OTHER)


def step(
    place: Place,
    name: str,
    *arguments: str,
    trace: bool = False,
    error: str = "",
    disables: bool = False,
) -> dict:
    """What a step found. It must end well, and so must its process.

    But an `error` that was reported may be in the exit code of `blender -b`, though the script has
    caught it; and a step that `disables` Janus ends badly in ENDS_BADLY, after all was written.
    """
    done = place.step(name, *arguments, trace=trace)
    codes = {0}
    if place.is_binary and error and f"Error: {error}" in done.stdout:
        codes.add(1)
    if disables and place.ends_badly:
        codes.add(-signal.SIGSEGV)
    assert done.returncode in codes, f"{name} ended with {done.returncode}:\n{done.stdout}"
    assert "Traceback" not in done.stdout
    found = place.folder / f"{name}.json"
    result = json.loads(found.read_text())
    found.unlink()
    return result


def install(place: Place, archive: Path) -> None:
    done = place.install(place.add(archive))
    assert done.returncode == 0, done.stdout


@pytest.fixture(scope="session")
def first(place: Place, older: Path) -> dict:
    """The older version, installed and used."""
    install(place, older)
    return step(place, "first")


@pytest.fixture(scope="session")
def upgrade(place: Place, first: dict, extension: Path) -> dict:
    """The new one installed over it, in a process in which the older has rendered."""
    return step(place, "upgrade", place.add(extension), error=ANEW, disables=True)


@pytest.fixture(scope="session")
def story(place: Place, upgrade: dict) -> dict:
    """The new one, used."""
    place.add(ROOT / "scenes")
    return step(place, "story", trace=place.is_binary)


def read(path: Path) -> np.ndarray:
    return pytest.importorskip("janus_core.exr").read(path)[0][..., :3]


@pytest.fixture(scope="session")
def ours(tmp_path_factory):
    """ours(scene): its picture by ./dev render, from the development build."""
    folder = tmp_path_factory.mktemp("ours")

    def picture(scene: str) -> np.ndarray:
        path = folder / f"{scene}.exr"
        if not path.exists():
            driver = [sys.executable, str(ROOT / "scenes/render.py"), scene]
            size = ["--resolution", "96x64", "--samples", "16"]
            subprocess.run([*driver, *size, "-o", str(path)], check=True, timeout=300)
        return read(path)

    return picture


# --- Installing -----------------------------------------------------------------------------------


def is_ours(found: dict) -> bool:
    """Python and core of the zip in dist/, and nothing of another."""
    return (
        found["label"] == LABEL
        and found["core_says"].startswith(CORE_SAYS)
        and found["build_info"]["version"] == VERSION
        and "/user/extensions/" in found["core"]
        and [wheel.partition("+")[0] for wheel in found["wheels"]] == [f"janus_core-{VERSION}"]
    )


def test_the_older_version_is_another(first: dict):
    assert first["label"] == OLDER["label"]
    assert first["core_says"].startswith(OLDER["says"])
    assert first["build_info"]["version"] == OLDER["version"]
    assert first["picture"]["deviation"] > 0.0


def test_an_upgrade_asks_for_a_restart(upgrade: dict):
    """Blender loads the new Python at once, but a native module stays until Blender ends."""
    assert upgrade["before"]["label"] == OLDER["label"]
    assert upgrade["after"]["label"] == LABEL
    assert upgrade["after"]["build_info"]["version"] == OLDER["version"]
    assert ANEW in upgrade["error"]
    assert "Restart Blender" in upgrade["error"]


def test_after_the_restart_all_of_it_is_new(story: dict):
    assert is_ours(story["identity"]), story["identity"]


def test_another_build_of_the_same_version_replaces_it(
    place: Place, story: dict, other: Path, extension: Path
):
    """Blender takes wheels of one name and version for the same (see .ci/package.py)."""
    found = step(place, "upgrade", place.add(other), error=ANEW, disables=True)
    assert is_ours(found["before"])
    assert found["after"]["label"] == OTHER["label"]
    assert found["after"]["core_says"].startswith(CORE_SAYS), "Blender cannot replace it yet"
    assert ANEW in found["error"]
    found = step(place, "which")
    assert found["label"] == OTHER["label"]
    assert found["core_says"].startswith(OTHER["says"])
    install(place, extension)
    assert is_ours(step(place, "which"))


# --- Rendering ------------------------------------------------------------------------------------


def test_the_hero_is_a_picture(story: dict):
    hero = story["pictures"]["hero"]
    assert hero["size"] == [96, 64]
    assert hero["finite"]
    assert hero["deviation"] > 0.1 * hero["mean"] > 0.001


@pytest.mark.parametrize("scene", SCENES)
def test_the_pictures_are_those_of_the_development_build(
    story: dict, place: Place, ours, scene: str
):
    """Another Blender, Python and C library may round differently; that may hardly show."""
    expected = ours(scene)
    found = read(place.folder / f"{scene}.exr")
    difference = np.abs(expected - found).max(axis=2)
    close = float((difference <= 1e-3).mean())
    print(
        f"{scene}: means differ by {expected.mean() / found.mean() - 1.0:.2e}, {100 * close:.2f} % "
        f"of the pixels are within 1e-3, the largest difference is {difference.max():.3g}"
    )
    assert abs(expected.mean() / found.mean() - 1.0) < 5e-4
    assert close >= 0.999


def test_cycles_renders_in_the_same_process(story: dict, place: Place):
    hero, cycles = story["pictures"]["hero"], story["pictures"]["cycles"]
    assert cycles["finite"]
    assert cycles["deviation"] > 0.0
    # Loose: Cycles misses most of the caustics.
    assert 0.7 < hero["mean"] / cycles["mean"] < 1.5


def test_janus_renders_the_same_after_cycles(story: dict):
    assert story["pictures"]["again"] == story["pictures"]["hero"]


def test_the_picture_is_stamped(story: dict, place: Place):
    assert b"janus/version" in (place.folder / "hero.exr").read_bytes()[:65536]
    assert b"janus/version" not in (place.folder / "cycles.exr").read_bytes()[:65536]


def test_it_can_be_disabled_and_enabled(story: dict):
    toggle = story["toggle"]
    assert toggle["gone"] == {"enabled": False, "settings": False, "engine": False}
    assert toggle["again"] == story["pictures"]["hero"]


def test_an_animation(story: dict, place: Place):
    """The cube moves from frame to frame."""
    assert story["animation"]["returned"] == ["FINISHED"]
    frames = sorted(place.folder.glob("frame_*"))
    assert [frame.name for frame in frames] == [f"frame_{n:04d}.exr" for n in (1, 2, 3)]
    assert all(b"janus/version" in frame.read_bytes()[:65536] for frame in frames)
    one, two, three = (read(frame) for frame in frames)
    assert np.abs(one - two).mean() > 0.01 < np.abs(two - three).mean()


def test_ctrl_c_ends_a_render(story: dict, place: Place):
    """`blender -b` has a handler for it; in the bpy module it is Python's, and an error."""
    cancel = story["cancel"]
    assert cancel["pressed"], "the render ended before"
    assert cancel["events"] == ["render_cancel"]
    if place.is_binary:
        assert cancel["returned"] == ["CANCELLED"]
        assert cancel["last"]["cancelled"]
        assert 0 < cancel["last"]["samples"] < 1 << 24
    else:
        assert "Stopped by Ctrl-C" in cancel["error"]
        assert (place.folder / "cancelled_partial.exr").exists()
    assert cancel["after"] == ["FINISHED"]
    assert cancel["samples_after"] == 4


def test_what_is_refused_fails(story: dict, place: Place):
    done = place.render(place.inside("broken.blend"), place.inside("broken_"))
    assert done.returncode == 1, done.stdout
    assert "Light path expression 'Broken'" in done.stdout
    assert not list(place.folder.glob("broken_*"))


# --- Libraries ------------------------------------------------------------------------------------


def test_no_symbol_crosses_between_blender_and_us(story: dict, place: Place):
    """Our files bind to themselves, Python and the C and C++ runtimes; nothing binds to us."""
    if not place.is_binary:
        pytest.skip("the bpy module is loaded with RTLD_LOCAL: it cannot show a clash")
    runtime = re.compile(r"/(ld-linux[^/]*|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))\.so\.\d+$")
    # The process's malloc, in Debian's Blenders; its new and delete are everybody's, too.
    allocator = re.compile(r"/lib(tbbmalloc_proxy|jemalloc)\.so\.\d+ \w*(alloc|free|align|_Z[nd])")
    binding = re.compile(r"binding file (\S+) .*? to (\S+) .*?: \w+ symbol `([^']+)'")
    seen, crossing = 0, set()
    for log in place.folder.glob("bindings.*"):
        with open(log, errors="replace") as lines:
            for match in filter(None, map(binding.search, lines)):
                user, owner, symbol = match.groups()
                from_us, to_us = "/janus_core/" in user, "/janus_core/" in owner
                seen += from_us
                known = runtime.search(owner) or allocator.search(f"{owner} {symbol}")
                if from_us and not (to_us or known or re.match("_?Py", symbol)):
                    crossing.add(match.groups())
                if to_us and not from_us:
                    crossing.add(match.groups())
    assert seen > 50, "the dynamic linker's record does not mention janus_core"
    assert not crossing
