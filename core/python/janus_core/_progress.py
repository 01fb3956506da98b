# SPDX-License-Identifier: GPL-3.0-or-later
"""A progress bar for a render, on one line of a terminal."""

from __future__ import annotations

import shutil
from typing import Any, TextIO

BAR = 24  # characters


class ProgressBar:
    """Shows RenderSession.progress(); does nothing where `stream` is no terminal."""

    def __init__(self, stream: TextIO, seconds: float = 0.0) -> None:
        """`seconds`: the time limit, 0 for none."""
        self._stream = stream if stream.isatty() else None
        self._seconds = seconds
        self._width = 0

    def show(self, progress: dict[str, Any]) -> None:
        """Draws the bar again."""
        line = status(progress, self._seconds)
        if self._stream:
            line = line[: shutil.get_terminal_size().columns - 1]
            self._stream.write("\r" + line.ljust(self._width))
            self._stream.flush()
            self._width = len(line)

    def close(self) -> None:
        """Wipes the line, so that other text can follow."""
        if self._stream and self._width:
            self._stream.write("\r" + " " * self._width + "\r")
            self._stream.flush()
            self._width = 0


def status(progress: dict[str, Any], seconds: float) -> str:
    """`[======      ]  50 % 32/64 samples, 0:12 left`."""
    fraction = progress["samples"] / max(progress["target_samples"], 1)
    if seconds > 0.0:
        fraction = max(fraction, progress["seconds"] / seconds)
    fraction = min(fraction, 1.0)
    full = round(fraction * BAR)
    bar = f"[{'=' * full}{' ' * (BAR - full)}] {100 * fraction:3.0f} %"
    text = f"{bar} {progress['samples']}/{progress['target_samples']} samples"
    if progress["remaining"] is not None:
        text += f", {clock(progress['remaining'])} left"
    return text


def clock(seconds: float) -> str:
    """0:12, or 1:02:03 from an hour on."""
    minutes, second = divmod(round(seconds), 60)
    hours, minute = divmod(minutes, 60)
    return f"{hours}:{minute:02}:{second:02}" if hours else f"{minute}:{second:02}"
