# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of scenes/: each renders without a warning, and is the same picture through Cycles."""

import json
import sys

import numpy as np
import pytest
from janus_core import exr

from . import whole_scenes
from .conftest import ROOT, driven, made_by_both
from .statistics import compare

sys.path.insert(0, str(ROOT))
from scenes.driver import arguments  # noqa: E402

BLOCK = 8
NOISY, MANY = 0.03, 0.1  # the standard error of a block that says nothing; how many may be such


@pytest.mark.parametrize("scene", arguments.scene_names())
def test_renders_without_warnings(scene, tmp_path):
    picture, stats = tmp_path / "a.exr", tmp_path / "a.json"
    size = ("--resolution", "32x20", "--samples", 8)
    driven(scene, *size, "--output", picture, "--stats", stats)
    found = json.loads(stats.read_text())
    assert [line for line in found["diagnostics"] if not line.startswith("info")] == []
    assert found["dropped"] == 0
    pixels = exr.read(str(picture))[0][..., :3]
    assert np.isfinite(pixels).all()
    # Even at this size light must reach most of the picture: no scene is a spot in the dark.
    assert (pixels.max(axis=2) > 1e-4).mean() > 0.5


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(whole_scenes, tmp_path_factory.mktemp("scenes"), timeout=7200.0)


@pytest.mark.parametrize("scene", whole_scenes.CASES)
def test_parity(pictures, scene):
    captured, cycles = pictures(scene)
    case = whole_scenes.CASES[scene]
    found = compare(captured.series("bdpt", case.bdpt, 8), cycles, block=BLOCK, noisy=NOISY)
    print(f"{scene}, bdpt against Cycles: {found}")
    blocks = -(-case.width // BLOCK) * -(-case.height // BLOCK)
    assert len(found.left_out) <= MANY * blocks
    found.check(0.005, 0.0025)
