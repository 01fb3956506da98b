# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion blur beside Cycles', and one picture by all ways to find it."""

import pytest

from . import motion_scenes
from .conftest import made_by_both
from .statistics import compare


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(motion_scenes, tmp_path_factory.mktemp("motion"))


@pytest.mark.parametrize("case", motion_scenes.CASES)
def test_motion(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", motion_scenes.SAMPLES, 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(0.005)


@pytest.mark.parametrize(
    "case, integrator",
    [("shining", "lt"), ("spins", "lt")]
    + [(case, "bdpt") for case in ("spins", "bends", "camera", "shining", "round_shutter")],
)
def test_agreement(pictures, case, integrator):
    captured, _ = pictures(case)
    other = captured.series(integrator, 2 * motion_scenes.SAMPLES, 6)
    found = compare(other, captured.series("pt", motion_scenes.SAMPLES, 6), block=8)
    print(f"{case}, {integrator} against pt: {found}")
    found.check(0.005)
