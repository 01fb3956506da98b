# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders leave nothing behind: resident memory does not grow from one to the next."""

import sys

import pytest

from .conftest import FULL, apart

COUNT = 100 if FULL else 12
WARM_UP = 30 if FULL else 5  # caches of Python, Blender and the C library fill
# One scene or picture that is kept is some MB, at each render.
MOST_MEGABYTES = 8.0


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize("through", ["core", "blender", "persistent"])
def test_resident_memory(through):
    printed = apart("many_renders.py", through, COUNT, timeout=300 + 10 * COUNT)
    found = [float(word) for word in printed.splitlines()[-1].split()]
    assert len(found) == COUNT
    settled, last = found[WARM_UP:], found[-5:]
    print(f"{through}: {min(settled)} to {max(settled)} MB, at the end {min(last)} MB")
    assert min(last) - min(settled) < MOST_MEGABYTES, found
