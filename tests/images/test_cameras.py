# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of camera shows what it shows in Cycles."""

import pytest

from . import camera_scenes
from .conftest import made_by_both
from .statistics import compare


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(camera_scenes, tmp_path_factory.mktemp("cameras"))


@pytest.mark.parametrize("case", camera_scenes.CASES)
def test_camera(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", camera_scenes.SAMPLES, 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(0.005)
