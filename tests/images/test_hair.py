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
    """Ribbons that look at every ray are not quite tubes, which costs a quarter of a percent."""
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", hair_scenes.samples(case), 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    assert found.error <= 0.0035
    assert abs(found.difference) <= 0.008


@pytest.mark.parametrize("case", hair_scenes.CASES)
def test_agreement(pictures, case):
    captured, _ = pictures(case)
    samples = hair_scenes.samples(case)
    other = captured.series("bdpt", samples, 6)
    found = compare(other, captured.series("pt", 2 * samples, 6), block=8)
    print(f"{case}, bdpt against pt: {found}")
    found.check(0.01)
