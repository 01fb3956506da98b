# SPDX-License-Identifier: GPL-3.0-or-later
"""The same scene through Cycles: the same picture."""

import pytest
from janus_core import exr

from .conftest import CAPTURES, driven
from .statistics import compare


@pytest.mark.parametrize("scene", ["diffuse_box", "glass_box"])
def test_parity(captured, tmp_path, scene):
    width, height = CAPTURES[scene]
    cycles = []
    for seed in range(1, 7):
        path = tmp_path / f"{seed}.exr"
        size = ("--resolution", f"{width}x{height}", "--seed", seed)
        driven(scene, "--engine", "cycles", *size, "--samples", 2048, "-o", path)
        cycles.append(exr.read(path)[0])
    found = compare(captured(scene).series("bdpt", 256, 8), cycles, block=8)
    print(f"{scene}, bdpt against Cycles: {found}")
    found.check(0.003)
