# SPDX-License-Identifier: GPL-3.0-or-later
"""Every closure against Cycles', over a grid of its settings: each in a block of its own."""

import numpy as np
import pytest

from . import closure_grid
from .conftest import made_by_both
from .statistics import block_means, compare

CELL = closure_grid.CELL
TOLERANCE = 0.01  # of each block's mean
# Its standard error: of the noisiest (what has been below a surface), and of most.
ERROR, MEDIAN = 0.0075, 0.002
FIRM = 0.0025  # with such an error, two per cent do not pass
ROUNDING = 2e-4  # what passes straight through is nearly without noise
DARK = 0.1  # the surroundings have 0.5: what is darker is compared in hundredths of this
SAMPLES = {"pt": 96, "bdpt": 112}  # of the quick run


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(closure_grid, tmp_path_factory.mktemp("closures"), timeout=3600.0)


def inside_the_balls(page: str) -> np.ndarray:
    """Leaves out the edges, which the background fills a part of, and squares without a ball."""
    rows, columns = closure_grid.rows(page), closure_grid.COLUMNS
    y, x = np.mgrid[: rows * CELL, : columns * CELL]
    balls = y // CELL * columns + x // CELL < len(closure_grid.names(page))
    y, x = (along % CELL - (CELL - 1) / 2 for along in (y, x))
    return balls & (x**2 + y**2 < (0.41 * CELL) ** 2)


def compared(pictures, page: str, integrator: str, factor=1.0):
    """Janus' pictures, times the factor, against Cycles'."""
    captured, cycles = pictures(page)
    ours = captured.series(integrator, SAMPLES[integrator] * closure_grid.times(page), 8)
    wrong = [factor * picture[..., :3] for picture in ours]
    mask = inside_the_balls(page)
    return compare(wrong, cycles, block=CELL, mask=mask, dark=DARK, rounding=ROUNDING)


def check_parity(pictures, page: str, integrator: str) -> None:
    names = closure_grid.names(page)
    found = compared(pictures, page, integrator)
    print(f"{page}, {len(names)} cells, {integrator} against Cycles: {found}")
    for i in np.argsort(-np.abs(found.blocks))[:5]:
        print(f"  {100 * found.blocks[i]:+.2f} % +- {100 * found.errors[i]:.2f} %: {names[i]}")
    print(f"  standard errors: {100 * np.median(found.errors):.2f} % in the middle of all")
    assert np.median(found.errors) <= MEDIAN
    assert (found.errors <= FIRM).mean() > 0.7
    found.check_blocks(TOLERANCE, ERROR, names)


@pytest.mark.parametrize("integrator", SAMPLES)
@pytest.mark.parametrize("page", closure_grid.CASES)
def test_parity(pictures, page, integrator):
    check_parity(pictures, page, integrator)


@pytest.mark.parametrize("integrator", SAMPLES)
def test_a_wrong_block_is_found(pictures, integrator):
    """Two per cent in any one block that is neither dark nor noisy."""
    page = closure_grid.CASES[0]
    mask = inside_the_balls(page)
    right = compared(pictures, page, integrator)
    level = np.mean([block_means(p, CELL, mask).mean(axis=1) for p in pictures(page)[1]], axis=0)
    y, x = np.mgrid[: mask.shape[0], : mask.shape[1]] // CELL
    for block in np.flatnonzero((level > DARK) & (right.errors <= FIRM)):
        planted = np.where(closure_grid.COLUMNS * y + x == block, 1.02, 1.0)[..., None]
        with pytest.raises(AssertionError, match="the means differ"):
            compared(pictures, page, integrator, planted).check_blocks(TOLERANCE, ERROR)
