# SPDX-License-Identifier: GPL-3.0-or-later
"""Denoises the pictures of a viewport in the background, while it goes on to render."""

import time

import numpy as np

from . import denoise

MAX_SHARE = 0.25  # of the time may go into denoising, but for the last picture
ARGUMENTS = {"Denoising Albedo": "albedo", "Denoising Normal": "normal"}


class PictureDenoiser:
    """Takes pictures with noise and gives them back without. What cannot be denoised is shown as it
    is: the panel says why.
    """

    def __init__(self, denoising: dict | None, now=time.perf_counter):
        self._denoising = denoising if denoise.unavailable() is None else None
        self._now = now
        self._task = None
        self._clean = False  # has there been a clean picture of what is rendered?
        self._started = self._next = 0.0

    @property
    def busy(self) -> bool:
        return self._task is not None

    def begin(self, change: bool) -> None:
        """Another session starts; `change`: it shows something else than the one before."""
        self._clean = self._clean and not change
        self._next = 0.0
        if change and self._task is not None:
            self._task.cancel()
            self._task = None

    def add(self, session, pixels: np.ndarray, samples: int, last: bool, alpha=False) -> bool:
        """There is another picture; true if it is to be shown, noisy as it is.

        `last`: of the session; `alpha`: it is noisy, too.
        """
        if self._denoising is None or samples < self._denoising["start_sample"]:
            return True
        if last and self._task is not None:
            self._task.cancel()
            self._task = None
        if self._task is None and (last or self._now() >= self._next):
            guides = {ARGUMENTS[name]: session.snapshot(name) for name in self._denoising["guides"]}
            self._task = denoise.DenoiseTask(
                pixels,
                **guides,
                prefilter=self._denoising["prefilter"],
                quality=self._denoising["quality"],
                alpha=alpha,
            )
            self._started = self._now()
        return not self._clean

    def take(self) -> np.ndarray | None:
        """A picture that is ready, once."""
        if self._task is None or not self._task.wait(0.0):
            return None
        task, self._task = self._task, None
        taken = self._now() - self._started
        self._next = self._now() + taken * (1.0 / MAX_SHARE - 1.0)
        try:
            pixels = task.result()
        except (denoise.DenoiseCancelled, denoise.DenoiseFailed):
            return None
        self._clean = True
        return pixels
