# SPDX-License-Identifier: GPL-3.0-or-later
"""Whenever and however a render is stopped, it ends, and the next one is as if nothing had been."""

from .conftest import FULL, apart

COUNT = 1000 if FULL else 50
MOST_SECONDS = 10.0  # 0.2 on a quiet machine: this finds what hangs


def test_random_cancels():
    longest = float(apart("random_cancels.py", COUNT, timeout=120 + 2 * COUNT))
    print(f"{COUNT} cancels, the slowest took {longest:.3f} s")
    assert longest < MOST_SECONDS
