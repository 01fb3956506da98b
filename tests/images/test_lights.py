# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of light through Cycles and through path tracing: the same picture."""

import subprocess
import sys

import pytest
from janus_core import exr

from . import light_scenes
from .conftest import Captured
from .statistics import compare

TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    folder = tmp_path_factory.mktemp("lights")
    command = [sys.executable, light_scenes.__file__, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.mark.parametrize("case", light_scenes.CASES)
def test_parity(pictures, case):
    seeds = range(1, light_scenes.SEEDS + 1)
    cycles = [exr.read(pictures / f"{case}_{seed}.exr")[0] for seed in seeds]
    ours = Captured(pictures / f"{case}.npz").series("pt", light_scenes.samples(case), 6)
    found = compare(ours, cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(TOLERANCE)
