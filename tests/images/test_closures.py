# SPDX-License-Identifier: GPL-3.0-or-later
"""Every closure against Cycles': a wall of spheres, each in a block of its own."""

import numpy as np
import pytest
from janus_core import exr

from .conftest import CAPTURES, driven
from .statistics import block_means, compare

CELL = 12  # pixels of a sphere's block, as in scenes/closures.py


def inside_the_spheres() -> np.ndarray:
    """Leaves out the edges, which the background fills a part of."""
    width, height = CAPTURES["closures"]
    y, x = np.mgrid[:height, :width] % CELL - (CELL - 1) / 2
    return x**2 + y**2 < (0.41 * CELL) ** 2


@pytest.fixture(scope="module")
def cycles(tmp_path_factory):
    width, height = CAPTURES["closures"]
    pictures = []
    for seed in range(1, 7):
        path = tmp_path_factory.mktemp("cycles") / f"{seed}.exr"
        size = ("--resolution", f"{width}x{height}", "--seed", seed)
        driven("closures", "--engine", "cycles", *size, "--samples", 256, "-o", path)
        pictures.append(exr.read(path)[0])
    return pictures


@pytest.mark.parametrize(("integrator", "samples"), [("pt", 128), ("bdpt", 64)])
def test_parity(captured, cycles, integrator, samples):
    mask = inside_the_spheres()
    pictures = captured("closures").series(integrator, samples, 8)
    ratios = [
        np.mean([block_means(p, CELL, mask).mean(axis=1) for p in group], axis=0)
        for group in (pictures, cycles)
    ]
    percent = 100 * (ratios[0] / ratios[1] - 1)
    print("closures in per cent of Cycles:", np.array2string(percent, precision=2))
    found = compare(pictures, cycles, block=CELL, mask=mask)
    print(f"closures, {integrator} against Cycles: {found}")
    found.check(0.005)
    assert np.abs(percent).max() < 5  # none hides in the mean (the noisiest has 1.5 %)
