# SPDX-License-Identifier: GPL-3.0-or-later
"""Every scene of scenes/ builds and renders, and uses nothing that Janus does not support."""

import json
import sys

import numpy as np
import pytest
from janus_core import exr

from .conftest import ROOT, driven

sys.path.insert(0, str(ROOT))
from scenes.driver import arguments  # noqa: E402


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
