# SPDX-License-Identifier: GPL-3.0-or-later
"""Shadow catchers through Cycles, path tracing and BDPT: the same picture without them, and the
same factor for the footage."""

import numpy as np
import pytest

from . import catcher_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.006
INTEGRATORS = {"pt": 512, "bdpt": 256}  # samples
SEEDS = 6
# Of the factor, where most of a pixel is a shadow catcher: elsewhere its noise is large.
COVERED = 0.5


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    made = made_by_both(catcher_scenes, tmp_path_factory.mktemp("catchers"))

    def get(case: str):
        captured, cycles = made(case)
        # The passes of the one view layer, without its name.
        return captured, [
            {name.rpartition(".")[2]: pixels for name, pixels in picture.items()}
            for picture in cycles
        ]

    return get


def series(captured, integrator: str, **changes) -> list[dict]:
    first = 1 + 1000 * list(INTEGRATORS).index(integrator)
    return [
        captured.render_passes(
            integrator=integrator,
            samples=INTEGRATORS[integrator],
            seed=first + i,
            adaptive_counts=False,
            **changes,
        )
        for i in range(SEEDS)
    ]


def combined(group: list[dict]) -> list:
    return [passes["Combined"] for passes in group]


def alpha(group: list[dict]) -> list:
    return [np.repeat(passes["Combined"][..., 3:], 3, axis=2) for passes in group]


def factor(group: list[dict]) -> list:
    return [passes["Shadow Catcher"] for passes in group]


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("case", [*catcher_scenes.FACTORS, *catcher_scenes.OTHERWISE])
def test_parity(pictures, case, integrator):
    captured, cycles = pictures(case)
    ours = series(captured, integrator)
    found = compare(combined(ours), combined(cycles), block=8)
    print(f"matte of {case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE, 0.5 * TOLERANCE)
    found = compare(alpha(ours), alpha(cycles), block=8)
    print(f"alpha of {case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE)
    others = cycles
    if case in catcher_scenes.OTHERWISE:
        others = series(captured, "bdpt" if integrator == "pt" else "pt")
    covered = np.mean(alpha(cycles), axis=(0, 3)) < COVERED
    found = compare(factor(ours), factor(others), 8, covered)
    print(f"factor of {case}, {integrator} against Cycles: {found}")
    found.check(0.5 * TOLERANCE)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("case", catcher_scenes.COMPOSITES)
def test_composites(pictures, case, integrator):
    captured, cycles = pictures(case)
    ours = series(captured, integrator)
    # In pixels that an object covers in part, Cycles darkens the background for that twice.
    matte = captured.render_passes(integrator="pt", samples=64, shadow_catcher=True)["Combined"]
    whole = np.abs(matte[..., 3] - 0.5) > 0.499
    found = compare(combined(ours), combined(cycles), 8, whole)
    print(f"{case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE, 0.5 * TOLERANCE)
    found = compare(alpha(ours), alpha(cycles), 8)
    print(f"alpha of {case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE)
