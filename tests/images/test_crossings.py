# SPDX-License-Identifier: GPL-3.0-or-later
"""Transparent closures and alpha against Cycles': a wall of panes, each in a block of its own."""

import numpy as np
import pytest

from . import pane_scenes
from .conftest import made_by_both
from .statistics import block_means, compare

CELL = 12  # pixels of a pane's block, as in scenes/panes.py
TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(pane_scenes, tmp_path_factory.mktemp("panes"))


def in_per_cent(ours: list, cycles: list) -> np.ndarray:
    """By how much the mean of each pane differs."""
    means = [
        np.mean([block_means(picture, CELL).mean(axis=1) for picture in group], axis=0)
        for group in (ours, cycles)
    ]
    return 100 * (means[0] / means[1] - 1)


@pytest.mark.parametrize(("integrator", "samples"), [("pt", 128), ("bdpt", 64)])
@pytest.mark.parametrize("case", pane_scenes.CASES)
def test_parity(pictures, case, integrator, samples):
    captured, cycles = pictures(case)
    ours = captured.series(integrator, samples, 8)
    percent = in_per_cent(ours, cycles)
    print("panes in per cent of Cycles:", np.array2string(percent, precision=2))
    found = compare(ours, cycles, block=CELL)
    print(f"{case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE)
    assert np.abs(percent).max() < 2  # none hides in the mean


def test_alpha(pictures):
    """How much of the world each pane hides; half of each block is the backdrop, alpha 1."""
    captured, cycles = pictures("film_transparent")

    def alpha(group):
        return [np.repeat(picture[..., 3:], 3, axis=2) for picture in group]

    for integrator, samples in (("pt", 128), ("bdpt", 64)):
        ours = alpha(captured.series(integrator, samples, 8))
        found = compare(ours, alpha(cycles), block=CELL)
        print(f"alpha, {integrator} against Cycles: {found}")
        found.check(TOLERANCE)
        assert np.abs(in_per_cent(ours, alpha(cycles))).max() < 1
