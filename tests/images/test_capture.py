# SPDX-License-Identifier: GPL-3.0-or-later
"""A capture rendered without Blender has the bits of the picture that Blender got."""

import subprocess
import sys

import numpy as np
from janus_core import exr

from .conftest import driven


def test_bits(tmp_path):
    direct, capture, again = (tmp_path / name for name in ("a.exr", "a.npz", "b.exr"))
    size = ("--resolution", "64x40", "--samples", 3)
    driven("hero", *size, "--capture", capture, "-o", direct)
    command = [sys.executable, "-m", "janus_core", str(capture), "-o", str(again)]
    subprocess.run(command, check=True, timeout=120)
    assert np.array_equal(exr.read(direct)[0], exr.read(again)[0])
