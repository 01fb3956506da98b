# SPDX-License-Identifier: GPL-3.0-or-later
"""A progress bar on stderr, fed by the text that an engine gives to Blender's status line."""

from __future__ import annotations

import re
import shutil
import sys
import time

SAMPLE = re.compile(r"[Ss]ample (\d+)\s*(?:/|of)\s*(\d+)")
BAR_INTERVAL = 0.1  # seconds, on a terminal
LINE_INTERVAL = 10.0  # seconds, into a file


class Progress:
    """Shows samples and time left. On a terminal one line that changes, elsewhere a line a while.

    `samples` and `seconds` are the limits of the render, 0 where there is none.
    """

    def __init__(self, label: str, samples: int = 0, seconds: float = 0.0, stream=None):
        self._label = label
        self._limit_samples = samples
        self._limit_seconds = seconds
        self._stream = stream or sys.stderr
        self._tty = self._stream.isatty()
        self._begin = time.monotonic()
        self._first: tuple[float, int] | None = None  # when sampling began
        self._shown_at = 0.0 if self._tty else self._begin
        self._width = 0
        self.samples = 0

    def feed(self, text: str) -> None:
        """Takes the engine's status text; anything without a sample count is shown as it is."""
        found = SAMPLE.search(text)
        if not found:
            if self._first is None:
                self._show(f"{self._label}: {text.split('|')[-1].strip()}", time.monotonic())
            return
        self.update(int(found[1]), int(found[2]))

    def update(self, done: int, total: int) -> None:
        now = time.monotonic()
        self.samples = done
        if self._first is None:
            self._first = (now, done)
        total = self._limit_samples or total
        fraction, left = self._estimate(now, done, total)
        text = f"{done} samples" if self._only_time() else f"{done}/{total} samples"
        if left is not None:
            text += f", {clock(left)} left"
        self._show(f"{self._label} {_bar(fraction)} {text}", now, force=done == total)

    def close(self) -> None:
        if self._tty and self._width:
            self._stream.write("\r" + " " * self._width + "\r")
            self._stream.flush()
            self._width = 0

    def _only_time(self) -> bool:
        return self._limit_seconds > 0 and not self._limit_samples

    def _estimate(self, now: float, done: int, total: int) -> tuple[float, float | None]:
        """(fraction done, seconds left or None), by whichever limit comes first."""
        begin, at_begin = self._first
        spent = now - begin
        fraction, left = 0.0, None
        if total > 0 and not self._only_time():
            fraction = min(done / total, 1.0)
            if done > at_begin and spent > 0:
                left = spent * (total - done) / (done - at_begin)
        if self._limit_seconds > 0:
            rest = max(self._limit_seconds - spent, 0.0)
            if left is None or rest < left:
                fraction, left = max(fraction, min(spent / self._limit_seconds, 1.0)), rest
        return fraction, left

    def _show(self, line: str, now: float, force: bool = False) -> None:
        interval = BAR_INTERVAL if self._tty else LINE_INTERVAL
        if not force and now - self._shown_at < interval:
            return
        self._shown_at = now
        if self._tty:
            line = line[: shutil.get_terminal_size().columns - 1]
            self._stream.write("\r" + line.ljust(self._width))
            self._width = len(line)
        else:
            self._stream.write(line + "\n")
        self._stream.flush()


def _bar(fraction: float, width: int = 24) -> str:
    full = int(fraction * width + 0.5)
    return f"[{'=' * full}{' ' * (width - full)}] {100 * fraction:3.0f} %"


def clock(seconds: float) -> str:
    seconds = int(seconds + 0.5)
    if seconds >= 3600:
        return f"{seconds // 3600}:{seconds // 60 % 60:02}:{seconds % 60:02}"
    return f"{seconds // 60}:{seconds % 60:02}"
