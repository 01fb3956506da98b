# SPDX-License-Identifier: GPL-3.0-or-later
"""AOVs beside Cycles', pixel by pixel: both are means over samples, and Cycles' are of the chance
with which its paths get through what has little alpha."""

import numpy as np
import pytest

from . import aov_scenes
from .conftest import made_by_both

SEEDS = range(1, aov_scenes.SEEDS + 1)


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """get(case) -> (ours, theirs): dictionaries of pictures, means over several seeds."""
    get = made_by_both(aov_scenes, tmp_path_factory.mktemp("aovs"))

    def both(case):
        captured, cycles = get(case)
        ours = [captured.render_passes(integrator="pt", samples=256, seed=s) for s in SEEDS]
        theirs = [{key.split(".")[-1]: p for key, p in one.items()} for one in cycles]
        return tuple(
            {
                name: np.mean([one[prefix + name] for one in seeds], axis=0)
                for name in aov_scenes.AOVS
            }
            for seeds, prefix in ((ours, "AOV "), (theirs, ""))
        )

    made = {case: both(case) for case in aov_scenes.CASES}
    return made.__getitem__


@pytest.mark.parametrize("case", aov_scenes.CASES)
@pytest.mark.parametrize("name", aov_scenes.AOVS)
def test_aovs(pictures, case, name):
    a, b = (made[name] for made in pictures(case))
    assert a.shape == b.shape and a.shape[2] == (4 if aov_scenes.AOVS[name] == "COLOR" else 1)
    off = np.abs(a - b)
    print(
        f"{case}, {name}: mean {off.mean():.5f}, largest {off.max():.4f} of {np.abs(b).max():.2f}"
    )
    unseen = name == "Sky" and case in ("transparent_film", "hidden_world")
    assert (np.abs(b).max() == 0.0) == unseen
    most = np.abs(b).max()
    assert off.max() < 0.01 * most + 0.02 and off.mean() < 0.001 * most + 0.0005


def test_floor_does_not_write_sides(pictures):
    """Where there is nothing before it."""
    ours, theirs = pictures("perspective")
    for made in (ours, theirs):
        floor = (made["Sides"][..., 3] == 0.0) & (made["Map"][..., 3] == 1.0)
        assert floor.mean() > 0.03
        assert np.all(made["Sides"][floor] == 0.0) and np.allclose(made["Sum"][floor], 2.25)
