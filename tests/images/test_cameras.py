# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of camera shows what it shows in Cycles."""

import subprocess
import sys
from pathlib import Path

import pytest
from janus_core import exr

from .camera_scene import CASES
from .conftest import Captured
from .statistics import compare

SEEDS = 4


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Captures and Cycles' pictures of all cases, made by one process with bpy."""
    folder = tmp_path_factory.mktemp("cameras")
    script = Path(__file__).with_name("camera_scene.py")
    command = [sys.executable, str(script), str(folder), str(SEEDS), "64"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, f"{result.stdout}{result.stderr}"
    return folder


@pytest.mark.parametrize("case", CASES)
def test_camera(folder, case):
    cycles = [exr.read(folder / f"{case}-{seed}.exr")[0] for seed in range(SEEDS)]
    janus = Captured(folder / f"{case}.npz").series("pt", 64, 6)
    found = compare(janus, cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(0.005)
