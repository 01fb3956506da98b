# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of data beside Cycles': depth, normals, indices, Cryptomatte and the like.

Where a surface has less alpha than the threshold of the view layer, both look through it. But the
first sample of Cycles may end there, and its means count the samples that end there as nought; here
what lies behind is seen whole. Those pixels are left out.
"""

import numpy as np
import pytest

from . import data_scenes
from .conftest import made_by_both

NAMES = {"Object Index": "IndexOB", "Material Index": "IndexMA"}
OWN_NAMES = NAMES | {"Ambient Occlusion": "AO"}
FIRST = ("Depth", "Position", *NAMES)  # of the first sample, which is another one in each render
# Largest differences of a pixel's mean. Features of mirrors: Cycles counts their colour twice.
MEANS = {
    "Normal": 0.08,
    "UV": 0.08,
    "Mist": 0.03,
    "Ambient Occlusion": 0.1,
    "Denoising Normal": 0.08,
    "Denoising Depth": 0.2,
    "Denoising Albedo": 0.08,
}
KINDS = ("Object", "Material", "Asset")
SEEDS = range(1, data_scenes.SEEDS + 1)


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """get(case) -> (ours, theirs): dictionaries of pictures, of several seeds."""
    get = made_by_both(data_scenes, tmp_path_factory.mktemp("data"))

    def both(case):
        captured, cycles = get(case)
        ours = [captured.render_passes(integrator="pt", samples=256, seed=s) for s in SEEDS]
        return ours, [{key.split(".")[-1]: p for key, p in one.items()} for one in cycles]

    made = {case: both(case) for case in data_scenes.CASES}
    return made.__getitem__


def coverage(passes: dict, kind: str) -> dict[float, np.ndarray]:
    """By id, the share of each pixel."""
    found: dict[float, np.ndarray] = {}
    for level in range(3):
        picture = passes[f"Crypto{kind}{level:02d}"]
        for ids, shares in ((picture[..., 0], picture[..., 1]), (picture[..., 2], picture[..., 3])):
            for number in np.unique(ids[shares > 0]):
                here = np.where(ids == number, shares, 0.0)
                found[number] = found.get(number, 0.0) + here
    return found


def thin(passes: dict) -> np.ndarray:
    """Where the camera looks through a surface with little alpha."""
    from janus_core import cryptomatte_hash

    number = np.uint32(int(cryptomatte_hash("Thin"), 16)).view(np.float32)
    return coverage(passes, "Object")[number] > 0


@pytest.mark.parametrize("case", data_scenes.CASES)
@pytest.mark.parametrize("name", MEANS)
def test_means(pictures, case, name):
    ours, theirs = pictures(case)
    a = np.mean([one[OWN_NAMES.get(name, name)] for one in ours], axis=0)
    b = np.mean([one[name] for one in theirs], axis=0)
    off = np.abs(a - b)[~thin(ours[0])]
    print(f"{case}, {name}: mean {off.mean():.5f}, largest {off.max():.4f}")
    assert off.max() < MEANS[name] and off.mean() < 0.03 * MEANS[name] + 0.002


@pytest.mark.parametrize("case", ["perspective", "panorama"])
def test_vector(pictures, case):
    """Pixels, up to ten. (Of orthographic cameras that turn, Cycles says what Blender's own
    projection does not.)
    """
    ours, theirs = ([one["Vector"] for one in seeds] for seeds in pictures(case))
    seen = np.all([np.abs(one).max(axis=2) > 0 for one in (*ours, *theirs)], axis=0)
    a, b = np.mean(ours, axis=0), np.mean(theirs, axis=0)
    off = np.abs(a - b).max(axis=2)[seen & ~thin(pictures(case)[0][0])]
    print(f"{case}: mean {off.mean():.4f}, largest {off.max():.3f} of {np.abs(a).max():.1f}")
    assert seen.mean() > 0.25 and np.abs(a).max() > 3
    assert off.mean() < 0.01 and off.max() < 0.2


@pytest.mark.parametrize("case", data_scenes.CASES)
@pytest.mark.parametrize("name", FIRST)
def test_first_samples(pictures, case, name):
    """Where the same thing is seen in all of the pixel, the middle one of several samples."""
    ours, theirs = pictures(case)
    mine = NAMES.get(name, name)
    inside = ~thin(ours[0])
    for index in (one[NAMES["Object Index"]] for one in ours):
        inside &= (index == ours[0][NAMES["Object Index"]])[..., 0]
    for index in (one["Object Index"] for one in theirs):
        inside &= (index == ours[0][NAMES["Object Index"]])[..., 0]
    assert inside.mean() > 0.6
    a, b = (
        np.median([one[key] for one in seeds], axis=0)
        for seeds, key in ((ours, mine), (theirs, name))
    )
    off = np.abs(a - b)[inside]
    if name in NAMES:
        assert off.max() == 0.0 and len(np.unique(a[inside])) > 4
    else:  # a pixel is up to some centimetres wide
        assert np.percentile(off, 95) < 0.1 and off.mean() < 0.02


@pytest.mark.parametrize("case", data_scenes.CASES)
@pytest.mark.parametrize("kind", KINDS)
def test_cryptomatte(pictures, case, kind):
    ours, theirs = pictures(case)
    a, b = coverage(ours[0], kind), coverage(theirs[0], kind)
    assert set(a) == set(b) and len(a) >= 6
    for number in a:
        off = np.abs(a[number] - b[number])
        assert off.max() < 0.15 and off.mean() < 0.005


def test_the_ball_hangs_on_the_block(pictures):
    ours, _ = pictures("perspective")
    assert len(coverage(ours[0], "Asset")) == len(coverage(ours[0], "Object")) - 1
