# SPDX-License-Identifier: GPL-3.0-or-later
"""Light and shadow linking beside Cycles', and one picture by all ways to find it."""

import pytest

from . import linking_scenes
from .conftest import made_by_both
from .statistics import compare


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(linking_scenes, tmp_path_factory.mktemp("linking"))


@pytest.mark.parametrize("case", linking_scenes.CASES)
def test_linking(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", linking_scenes.SAMPLES, 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(0.005)


@pytest.mark.parametrize("case", linking_scenes.CASES)
def test_agreement(pictures, case):
    captured, _ = pictures(case)
    other = captured.series("bdpt", 2 * linking_scenes.SAMPLES, 6)
    found = compare(other, captured.series("pt", linking_scenes.SAMPLES, 6), block=8)
    print(f"{case}, bdpt against pt: {found}")
    found.check(0.005)
