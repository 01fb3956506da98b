# SPDX-License-Identifier: GPL-3.0-or-later
"""What depends on the path so far, through Cycles, path tracing and BDPT: the same picture."""

import pytest

from . import path_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.006


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(path_scenes, tmp_path_factory.mktemp("paths"))


@pytest.mark.parametrize(("integrator", "samples"), [("pt", 256), ("bdpt", 128)])
@pytest.mark.parametrize("case", path_scenes.CASES)
def test_parity(pictures, case, integrator, samples):
    captured, cycles = pictures(case)
    found = compare(captured.series(integrator, samples, 6), cycles, block=8)
    print(f"{case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE, 0.5 * TOLERANCE)
