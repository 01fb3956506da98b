# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules for whole paths through Cycles, path tracing and BDPT: the same picture."""

import pytest

from . import rules_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(rules_scenes, tmp_path_factory.mktemp("rules"))


@pytest.mark.parametrize(("integrator", "samples"), [("pt", 256), ("bdpt", 128)])
@pytest.mark.parametrize("case", rules_scenes.CASES)
def test_parity(pictures, case, integrator, samples):
    captured, cycles = pictures(case)
    found = compare(captured.series(integrator, samples, 6), cycles, block=8)
    print(f"{case}, {integrator} against Cycles: {found}")
    # Lamps that are not to be hit make more noise.
    found.check(TOLERANCE, 0.5 * TOLERANCE if case not in rules_scenes.CAPS else None)
