# SPDX-License-Identifier: GPL-3.0-or-later
"""Path tracing, light tracing and BDPT render the same picture: within 0.3 %, and by blocks."""

import itertools

import numpy as np
import pytest

from . import material_scenes
from .conftest import made_by_both
from .statistics import compare

TOLERANCE = 0.003
SEEDS = 8


@pytest.mark.parametrize(
    ("scene", "samples"),
    [
        ("diffuse_box", {"bdpt": 160, "pt": 1024, "lt": 256}),
        ("glass_box", {"bdpt": 256, "pt": 1536}),
        ("hero_soft", {"bdpt": 1600, "pt": 1024}),
    ],
)
def test_integrators_agree(captured, scene, samples):
    pictures = {name: captured(scene).series(name, n, SEEDS) for name, n in samples.items()}
    for other in samples.keys() - {"bdpt"}:
        found = compare(pictures["bdpt"], pictures[other], block=8)
        print(f"{scene}, bdpt against {other}: {found}")
        found.check(TOLERANCE)


@pytest.fixture(scope="module")
def materials(tmp_path_factory):
    return made_by_both(material_scenes, tmp_path_factory.mktemp("materials"))


@pytest.mark.parametrize("case", material_scenes.CASES)
def test_integrators_agree_on_materials(materials, case):
    captured, _ = materials(case)
    samples = {"pt": 256, "lt": 320, "bdpt": 80}
    times, left = (3, material_scenes.SEEN) if case in material_scenes.MIRRORS else (1, 0)
    if case in material_scenes.NOISY:
        times = 5
    pictures = {name: captured.series(name, times * n, SEEDS) for name, n in samples.items()}
    seen = np.ones(pictures["pt"][0].shape[:2], dtype=bool)
    seen[:, :left] = False  # of what remains, there is less to average
    for a, b in itertools.combinations(samples, 2):
        mask = seen if "lt" in (a, b) else None
        found = compare(pictures[a], pictures[b], block=8, mask=mask)
        print(f"{case}, {a} against {b}: {found}")
        found.check(TOLERANCE, error=0.5 * TOLERANCE)


def test_automatic_counts_show_the_same_picture(captured):
    """They look at a pass before they choose; what they saw is part of the picture."""
    series = captured("glass_box").series
    pt = series("pt", 1536, SEEDS)
    found = compare(series("bdpt", 256, SEEDS, adaptive_counts=True), pt, block=8)
    print(f"glass_box, bdpt with automatic counts against pt: {found}")
    found.check(TOLERANCE)


def test_light_tracing_agrees_on_the_caustic_of_the_hero(captured):
    """Left of the glass, where nothing is seen by way of a specular surface."""
    bdpt = captured("hero_soft").series("bdpt", 1600, SEEDS)
    lt = captured("hero_soft").series("lt", 4096, SEEDS)
    height, width = bdpt[0].shape[:2]
    mask = np.zeros((height, width), dtype=bool)
    mask[:, : int(0.42 * width)] = True
    found = compare(bdpt, lt, block=8, mask=mask)
    print(f"hero_soft, bdpt against lt: {found}")
    found.check(TOLERANCE, error=0.5 * TOLERANCE)


def test_a_wrong_picture_is_found(captured):
    """The comparison has the power that the tests above rely on."""
    bdpt = captured("diffuse_box").series("bdpt", 160, SEEDS)
    dimmer = [1.006 * picture for picture in captured("diffuse_box").series("pt", 1024, SEEDS)]
    with pytest.raises(AssertionError, match="the means differ"):
        compare(bdpt, dimmer, block=8).check(TOLERANCE)
