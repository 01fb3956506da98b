# SPDX-License-Identifier: GPL-3.0-or-later
"""Principled's thin walls beside Cycles', which only Blender 5.2 has."""

import os
import shutil
import sys

import pytest
from blenders import MODULE, ROOT, Blender

sys.path.insert(0, str(ROOT / "tests"))
from images import closure_grid, test_closures  # noqa: E402
from images.conftest import pictures_in  # noqa: E402

CHOICES = ("JANUS_FULL", "JANUS_CELLS")  # of cells


@pytest.fixture(scope="module")
def pictures(installed: Blender):
    """Cycles' pictures by the real Blender, and its capture for the core that is tested here."""
    for name in ("scenes", "addon"):  # the driver reads files of both
        installed.add(ROOT / name)
    images = installed.folder / "tests/images"
    images.mkdir(parents=True)
    for path in (ROOT / "tests/images").glob("*.py"):
        shutil.copy(path, images)
    done = installed.run(
        *("--addons", MODULE, "-P", installed.inside("tests/images/both.py"), "--"),
        *("closure_grid", installed.inside(""), closure_grid.THIN_WALLS),
        environment=tuple(f"{name}={os.environ[name]}" for name in CHOICES if name in os.environ),
        timeout=900,
    )
    assert done.returncode == 0, done.stdout
    return pictures_in(closure_grid, installed.folder)


@pytest.mark.parametrize("integrator", test_closures.SAMPLES)
def test_parity(pictures, integrator: str):
    test_closures.check_parity(pictures, closure_grid.THIN_WALLS, integrator)
