# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension in a real Blender with windows, as an artist uses it: gui_steps.py tells the story.

The pictures of the screen are kept in build/gui/, to be looked at.
"""

import json
import os
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from blenders import ROOT, Blender
from conftest import cannot

SHOTS = ROOT / "build/gui"
WIDTH, HEIGHT = 1600, 900
SQUARE = 24  # pixels
LIMIT = 420.0  # seconds for the whole story, on a machine that is busy
TOOLS = ("Xvfb", "xdotool", "xwd", "xwdtopnm", "pnmtopng", "pngtopnm")


@pytest.fixture(scope="session")
def display():
    """A screen that nobody sees; its number."""
    missing = [tool for tool in TOOLS if not shutil.which(tool)]
    if missing:
        cannot(f"no screen for Blender's windows: {', '.join(missing)} missing")
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{WIDTH}x{HEIGHT}x24"],
        pass_fds=[write],
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    with os.fdopen(read) as numbers:
        number = numbers.readline().strip()
    assert number, "Xvfb does not start"
    yield f":{number}"
    server.terminate()
    server.wait()


def run(*command, given: bytes | None = None, display: str = "") -> bytes:
    environment = {**os.environ, "DISPLAY": display}
    done = subprocess.run(command, input=given, check=True, capture_output=True, env=environment)
    return done.stdout


def grant(display: str, wish: str) -> None:
    """A key to be pressed where the picture is, or a picture of the screen."""
    if wish.startswith("key "):
        run(
            "xdotool",
            "mousemove",
            str(WIDTH // 3),
            str(HEIGHT // 2),
            *wish.split(),
            display=display,
        )
        return
    screen = run("xwd", "-silent", "-root", display=display)
    (SHOTS / f"{wish}.png").write_bytes(run("pnmtopng", given=run("xwdtopnm", given=screen)))


def pixels(path: Path) -> np.ndarray:
    """[height, width, 3], 0 to 1, the top row first."""
    kind, width, height, most, raw = run("pngtopnm", path).split(maxsplit=4)
    assert (kind, most) == (b"P6", b"255")
    return np.frombuffer(raw, np.uint8).reshape(int(height), int(width), 3) / 255.0


@pytest.fixture(scope="session")
def story(blender: Blender, extension: Path, display: str) -> dict:
    """What gui_steps.py found, and how Blender ended."""
    shutil.rmtree(SHOTS, ignore_errors=True)
    SHOTS.mkdir(parents=True)
    blender.add(ROOT / "scenes")
    script, archive = blender.add(ROOT / "tests/package/gui_steps.py"), blender.add(extension)
    request = blender.folder / "request.txt"
    with (SHOTS / "blender.log").open("w") as log:
        process = blender.start(
            *("--window-geometry", "0", "0", str(WIDTH), str(HEIGHT)),
            *("-P", script, "--", blender.inside("."), archive),
            environment=(f"DISPLAY={display}", "LIBGL_ALWAYS_SOFTWARE=1"),
            stdout=log,
        )
        end = time.monotonic() + LIMIT
        while process.poll() is None and time.monotonic() < end:
            if request.exists() and (wish := request.read_text()):
                grant(display, wish)
                request.unlink()
            time.sleep(0.05)
        hung = process.poll() is None
        process.kill()
        process.wait()
    told = blender.folder / "gui.json"
    log = (SHOTS / "blender.log").read_text()
    assert told.exists(), f"the story was not told to its end:\n{log}"
    result = json.loads(told.read_text())
    result["exit"] = "hung" if hung else process.returncode
    result["log"] = log
    print(json.dumps({k: v for k, v in result.items() if k != "log"}, indent=1), log)
    return result


def seen(story: dict, name: str) -> np.ndarray:
    """The middle of the viewport in a picture of the screen: means of squares, less noisy."""
    x, y, width, height = story["areas"][name]
    picture = pixels(SHOTS / f"{name}.png")
    middle = picture[y + height // 4 : y + 3 * height // 4, x + width // 4 : x + 3 * width // 4]
    rows, columns = middle.shape[0] // SQUARE, middle.shape[1] // SQUARE
    squares = middle[: rows * SQUARE, : columns * SQUARE].reshape(rows, SQUARE, columns, SQUARE, 3)
    return squares.mean(axis=(1, 3))


def test_the_story_ends_well(story: dict):
    assert "error" not in story, story["error"]
    assert story["step"] == "done"
    assert story["exit"] == 0
    assert "Traceback" not in story["log"]
    assert story["operators"]


def test_the_viewport_renders(story: dict):
    solid, rendered = seen(story, "solid"), seen(story, "rendered")
    assert rendered.std() > 0.05
    assert np.abs(solid - rendered).mean() > 0.05
    blue, ochre = rendered[:, : rendered.shape[1] // 4], rendered[:, -rendered.shape[1] // 4 :]
    assert (blue[..., 2] - blue[..., 0]).mean() > (ochre[..., 2] - ochre[..., 0]).mean() + 0.1


def test_the_viewport_follows_the_view(story: dict):
    assert np.abs(seen(story, "orbit") - seen(story, "rendered")).mean() > 0.03
    assert np.abs(seen(story, "back") - seen(story, "rendered")).mean() < 0.03


def test_the_viewport_follows_edits_and_undo(story: dict):
    back, moved = seen(story, "back"), seen(story, "moved")
    red, undone = seen(story, "red"), seen(story, "undone")
    assert np.abs(moved - back).mean() > 0.01
    assert (red[..., 0] - red[..., 1]).mean() > (moved[..., 0] - moved[..., 1]).mean() + 0.1
    assert np.abs(undone - back).mean() < 0.5 * np.abs(moved - back).mean()


def test_escape_ends_a_render(story: dict):
    assert story["events"][0] == "render_cancel"
    assert story["escaped_after"] < 10.0


def test_a_render_is_saved(story: dict, blender: Blender):
    picture = pixels(blender.folder / "f12.png")
    assert picture.shape == (160, 160, 3)
    assert picture.std() > 0.05


def test_the_report_names_what_is_left_out(story: dict):
    assert any(material == "Blue" and "olume" in text for material, text in story["report"])


def test_there_may_be_two_viewports(story: dict):
    before, after = story["viewports"]
    assert after == before + 1


def test_another_file_may_be_loaded_while_rendering(story: dict):
    assert story["engine_after_load"] == "JANUS"
    assert "load_post" in story["events"]
    assert seen(story, "loaded").std() > 0.03
