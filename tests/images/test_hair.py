# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair and points beside Cycles', and one picture by all ways to find it."""

import pytest

from . import hair_scenes
from .conftest import made_by_both
from .statistics import compare


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(hair_scenes, tmp_path_factory.mktemp("hair"))


@pytest.mark.parametrize("case", hair_scenes.CASES)
def test_hair(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", hair_scenes.SAMPLES, 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(0.005)


@pytest.mark.parametrize("case", hair_scenes.CASES)
def test_agreement(pictures, case):
    captured, _ = pictures(case)
    other = captured.series("bdpt", hair_scenes.SAMPLES, 6)
    found = compare(other, captured.series("pt", 2 * hair_scenes.SAMPLES, 6), block=8)
    print(f"{case}, bdpt against pt: {found}")
    found.check(0.005)
