# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of light through Cycles and through path tracing: the same picture."""

import pytest

from . import light_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(light_scenes, tmp_path_factory.mktemp("lights"))


@pytest.mark.parametrize("case", light_scenes.CASES)
def test_parity(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", light_scenes.samples(case), 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(TOLERANCE)
