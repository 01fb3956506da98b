# SPDX-License-Identifier: GPL-3.0-or-later
"""Asking Blender now and then whether the user wants to stop."""

import time

from ..report import RenderCancelled

INTERVAL = 0.05  # seconds


class Poll:
    """Cheap enough to be called for every instance: asks Blender every INTERVAL at most."""

    def __init__(self, test_break):
        self._test_break = test_break
        self._next = 0.0

    def __call__(self) -> None:
        """Raises RenderCancelled if the user wants to stop."""
        now = time.perf_counter()
        if now >= self._next:
            self._next = now + INTERVAL
            if self._test_break():
                raise RenderCancelled
