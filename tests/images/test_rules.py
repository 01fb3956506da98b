# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules for whole paths through Cycles, path tracing and BDPT: the same picture."""

import subprocess
import sys

import pytest
from janus_core import exr

from . import rules_scenes
from .conftest import Captured
from .statistics import compare

TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rules")
    command = [sys.executable, rules_scenes.__file__, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


@pytest.mark.parametrize(("integrator", "samples"), [("pt", 256), ("bdpt", 128)])
@pytest.mark.parametrize("case", rules_scenes.CASES)
def test_parity(pictures, case, integrator, samples):
    seeds = range(1, rules_scenes.SEEDS + 1)
    cycles = [exr.read(pictures / f"{case}_{seed}.exr")[0] for seed in seeds]
    captured = Captured(pictures / f"{case}.npz")
    ours = captured.series(integrator, samples, 6, **rules_scenes.limits(case))
    found = compare(ours, cycles, block=8)
    print(f"{case}, {integrator} against Cycles: {found}")
    # Lamps that are not to be hit make more noise.
    found.check(TOLERANCE, 0.5 * TOLERANCE if case not in rules_scenes.CAPS else None)
