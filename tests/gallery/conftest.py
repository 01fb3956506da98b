# SPDX-License-Identifier: GPL-3.0-or-later
"""A small gallery, made as `./dev gallery` makes it, and a real browser to look at it."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))  # the scenes, with the gallery in them

SMALL = ("--resolution", "48x48", "--seconds", "0.1", "--seeds", "2", "--reference-seconds", "0.4")


def run_gallery(*words: object, timeout: float = 300.0) -> subprocess.CompletedProcess:
    command = [sys.executable, str(ROOT / "scenes" / "gallery"), *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout)


class Gallery:
    def __init__(self, folder: Path, *words: object) -> None:
        self.folder = folder
        done = run_gallery("--output", folder, *SMALL, *words)
        assert done.returncode == 0, done.stdout + done.stderr
        self.said = done.stdout + done.stderr
        self.numbers = json.loads((folder / "figures.json").read_text(encoding="utf-8"))

    def figure(self, name: str) -> dict:
        return next(f for f in self.numbers["figures"] if f["name"] == name)

    def picture(self, figure: str, key: str) -> dict:
        return next(p for p in self.figure(figure)["pictures"] if p["key"] == key)


@pytest.fixture(scope="session")
def gallery(tmp_path_factory) -> Gallery:
    folder = tmp_path_factory.mktemp("gallery") / "new"
    return Gallery(folder, "--only", "glass", "classes", "mirror")


@pytest.fixture(scope="session")
def browser():
    """Chromium without a window and without a network."""
    binary, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not binary or not driver:
        reason = "no browser here: the Debian packages chromium and chromium-driver"
        if os.environ.get("JANUS_REQUIRE_BLENDER") == "1":  # CI skips nothing
            pytest.fail(reason)
        pytest.skip(reason)
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = binary
    for switch in (
        "--headless=new",
        "--no-sandbox",  # Chromium has none for root
        "--disable-dev-shm-usage",
        "--window-size=1280,1000",
        "--host-resolver-rules=MAP * ~NOTFOUND",
    ):
        options.add_argument(switch)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    chromium = webdriver.Chrome(options=options, service=Service(driver))
    yield chromium
    chromium.quit()
