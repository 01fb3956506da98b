# SPDX-License-Identifier: GPL-3.0-or-later
"""What points and instances of particles know of themselves, through Cycles and through Janus."""

import numpy as np
import pytest

from . import maker_scenes
from .conftest import made_by_both

ALIKE = 1e-5  # of the brightest, where one colour alone is seen
TOLERANCE = 0.003  # of the mean: there is noise at the edges


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(maker_scenes, tmp_path_factory.mktemp("makers"))


def without_edges(picture: np.ndarray) -> np.ndarray:
    """The pixels that are as all around them, as what stands there is of one colour."""
    alike = np.ones(picture.shape[:2], dtype=bool)
    for y in (-1, 0, 1):
        for x in (-1, 0, 1):
            other = np.roll(picture, (y, x), axis=(0, 1))
            alike &= np.abs(other - picture).max(axis=-1) <= 1e-5 * picture.max()
    return alike


@pytest.mark.parametrize("case", maker_scenes.CASES)
def test_parity(pictures, case):
    captured, cycles = pictures(case)
    ours = np.mean([picture[..., :3] for picture in captured.series("pt", 64, 1)], axis=0)
    theirs = np.mean([picture[..., :3] for picture in cycles], axis=0)
    seen = theirs.max(axis=-1) > 0.0
    inside = without_edges(theirs) & seen
    print(f"{case}: {inside.sum()} pixels of {seen.sum()}")
    if not case.startswith("moving"):  # there all is edges
        assert inside.sum() > 500
        levels = np.unique(theirs[inside].round(4), axis=0)
        assert len(levels) == 1 if case.startswith("not") else len(levels) >= 8
        off = np.abs(ours - theirs).max(axis=-1) / theirs.max()
        print(f"  {len(levels)} levels, off by {off[inside].max():.2e}")
        assert off[inside].max() <= ALIKE
    difference = ours[seen].mean(axis=0) / theirs[seen].mean(axis=0) - 1.0
    print(f"  of all: {difference}")
    assert np.abs(difference).max() <= TOLERANCE
