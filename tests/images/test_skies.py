# SPDX-License-Identifier: GPL-3.0-or-later
"""The Sky Texture through Cycles and through Janus: the same sky, and the same light of its sun."""

import numpy as np
import pytest

from . import sky_scenes, sky_views
from .conftest import made_by_both
from .statistics import compare

# Of the brightest pixel. What is left is where in their pixels the two throw their samples.
OFF = 5e-4
TOLERANCE = 0.003


@pytest.fixture(scope="module")
def views(tmp_path_factory):
    return made_by_both(sky_views, tmp_path_factory.mktemp("views"))


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    return made_by_both(sky_scenes, tmp_path_factory.mktemp("skies"))


@pytest.mark.parametrize("case", sky_views.CASES)
def test_view(views, case):
    """Pixel by pixel, but for those at the horizon and at the edge of the sun."""
    captured, cycles = views(case)
    ours, theirs = captured.render(samples=sky_views.SAMPLES)[..., :3], cycles[0][..., :3]
    off = np.abs(ours - theirs).max(axis=-1) / max(float(theirs.max()), 1e-9)
    edge = float(np.sort(off, axis=None)[-1 - off.size // 100])
    print(f"{case}: {edge:.1e} of the range, {off.max():.1e} on edges")
    assert edge <= OFF
    assert off.max() <= 40.0 * OFF


@pytest.mark.parametrize(
    "case, integrator",
    [(case, integrator) for case in sky_scenes.CASES for integrator in ("pt", "bdpt")]
    + [(case, "lt") for case in ("default", "wide", "two_suns")],
)
def test_light(pictures, case, integrator):
    captured, cycles = pictures(case)
    ours = captured.series(integrator, sky_scenes.SAMPLES, 6)
    found = compare(ours, cycles, block=8, rounding=1e-4)
    print(f"{case}, {integrator} against Cycles: {found}")
    found.check(TOLERANCE, error=0.0015)
