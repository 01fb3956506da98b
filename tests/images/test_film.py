# SPDX-License-Identifier: GPL-3.0-or-later
"""What the film leaves out, through Cycles, path tracing and BDPT: the same colours and alpha."""

import numpy as np
import pytest

from . import film_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.006


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(film_scenes, tmp_path_factory.mktemp("film"))


def alpha(group: list) -> list:
    return [np.repeat(picture[..., 3:], 3, axis=2) for picture in group]


@pytest.mark.parametrize(("integrator", "samples"), [("pt", 384), ("bdpt", 192)])
@pytest.mark.parametrize("case", film_scenes.CASES)
def test_parity(pictures, case, integrator, samples):
    captured, cycles = pictures(case)
    ours = captured.series(integrator, samples, 6)
    found = compare(ours, cycles, block=8)
    print(f"{case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE, 0.5 * TOLERANCE)
    found = compare(alpha(ours), alpha(cycles), block=8)
    print(f"alpha of {case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE)
