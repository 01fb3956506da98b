# SPDX-License-Identifier: GPL-3.0-or-later
"""Words and numbers for Blender's progress display, and the rhythm of its updates."""

import time

FIRST_UPDATE = 0.5  # seconds
SLOWEST_UPDATE = 5.0
POLL_SECONDS = 0.05
MAX_SHARE = 0.05  # of the time may go into showing the picture


def fraction(progress: dict, time_limit: float) -> float:
    """How much is done, 0 to 1, by samples or by time, whichever ends first."""
    done = progress["samples"] / max(progress["target_samples"], 1)
    if time_limit > 0.0:
        done = max(done, progress["seconds"] / time_limit)
    return min(done, 1.0)


def status(progress: dict) -> str:
    text = f"Sample {progress['samples']}/{progress['target_samples']}"
    if progress["remaining"] is not None:
        text += f" | Remaining {clock(progress['remaining'])}"
    return text


def clock(seconds: float) -> str:
    """00:12, or 1:02:03 from an hour on."""
    minutes, second = divmod(round(seconds), 60)
    hours, minute = divmod(minutes, 60)
    return f"{hours}:{minute:02d}:{second:02d}" if hours else f"{minute:02d}:{second:02d}"


class Rhythm:
    """When to show the picture again: soon at first, then ever more rarely."""

    def __init__(self, now=time.perf_counter):
        self._now = now
        self._interval = FIRST_UPDATE
        self._next = now() + self._interval

    def due(self) -> bool:
        return self._now() >= self._next

    def shown(self, cost: float) -> None:
        """Plans the next update after one that took `cost` seconds."""
        self._interval = min(self._interval * 1.5, SLOWEST_UPDATE)
        self._next = self._now() + max(self._interval, cost / MAX_SHARE)


def run_to_end(engine, session, time_limit: float, said: str = "", show=None) -> bool:
    """Runs a core session under Blender's progress display until it ends or the user stops it.

    `said` stands before the words; show() is called now and then to show the picture. Returns
    whether the user stopped it.
    """
    rhythm = Rhythm()
    cancelled = False
    session.start()
    while not session.wait(POLL_SECONDS):
        if engine.test_break() and not cancelled:
            cancelled = True
            session.cancel()
        progress = session.progress()
        engine.update_progress(fraction(progress, time_limit))
        engine.update_stats("", said + status(progress))
        if show is not None and not cancelled and rhythm.due():
            started = time.perf_counter()
            show()
            rhythm.shown(time.perf_counter() - started)
    session.finish()
    engine.update_progress(1.0)
    return cancelled
