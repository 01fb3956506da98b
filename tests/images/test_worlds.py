# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees of worlds through Cycles and through Janus: the same sky, and the same light."""

import numpy as np
import pytest

from . import world_scenes, world_views
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.005


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(world_scenes, tmp_path_factory.mktemp("worlds"))


@pytest.fixture(scope="module")
def views(tmp_path_factory):
    return made_by_both(world_views, tmp_path_factory.mktemp("views"))


@pytest.mark.parametrize("case", world_views.CASES)
def test_view(views, case):
    """Pixel by pixel, but for those on which rounding decides at seams and in a picture's sun."""
    captured, cycles = views(case)
    ours, theirs = captured.render(samples=1)[..., :3], cycles[0][..., :3]
    off = np.abs(ours - theirs).max(axis=-1) > 2e-3 + 2e-3 * theirs.max(axis=-1)
    assert off.mean() < 0.01, f"{off.sum()} pixels differ, by up to {np.abs(ours - theirs).max()}"


@pytest.mark.parametrize("case", world_scenes.CASES)
def test_light(pictures, case):
    captured, cycles = pictures(case)
    found = compare(captured.series("pt", world_scenes.samples(case), 6), cycles, block=8)
    print(f"{case}, pt against Cycles: {found}")
    found.check(TOLERANCE)
