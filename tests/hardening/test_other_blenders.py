# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of other versions of Blender, and of people without Janus.

JANUS_BLENDS names a folder of .blend files, all of which must render; without it there are those
that this Blender makes.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from .conftest import FOLDER, apart

BLENDS = sorted(Path(os.environ.get("JANUS_BLENDS", os.devnull)).rglob("*.blend"))


def rendered(path) -> str:
    """What is said; fails if there is a traceback."""
    command = [sys.executable, str(FOLDER / "open_blend.py"), "render", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=600)
    said = done.stdout + done.stderr
    assert done.returncode == 0, said
    assert "Traceback" not in said, said
    return said


@pytest.mark.skipif(not BLENDS, reason="JANUS_BLENDS names no folder of .blend files")
@pytest.mark.parametrize("path", BLENDS, ids=lambda path: path.stem)
def test_files_of_other_versions(path):
    assert "rendered" in rendered(path)


def test_the_first_file(tmp_path):
    path = tmp_path / "first.blend"
    apart("save_blend.py", path, timeout=300)
    assert "rendered Scene" in rendered(path)


def test_settings_survive_people_without_janus(tmp_path):
    path = tmp_path / "kept.blend"
    apart("save_blend.py", path, timeout=300)
    apart("open_blend.py", "keep", path, timeout=300)
    assert "Scene: 7 samples of the file" in rendered(path)
