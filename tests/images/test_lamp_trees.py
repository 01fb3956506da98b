# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees of lamps through Cycles and through Janus: the same light."""

import pytest

from . import lamp_tree_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(lamp_tree_scenes, tmp_path_factory.mktemp("lamp_trees"))


@pytest.mark.parametrize("case", lamp_tree_scenes.CASES)
def test_parity(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", lamp_tree_scenes.samples(case), 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(TOLERANCE)


@pytest.mark.parametrize("case", lamp_tree_scenes.BOTH_WAYS)
def test_light_paths(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("bdpt", lamp_tree_scenes.samples(case) // 2, 6), cycles, 8)
    print(f"{case}, bdpt against Cycles: {found}")
    found.check(TOLERANCE)
