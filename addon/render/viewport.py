# SPDX-License-Identifier: GPL-3.0-or-later
"""The rendered viewport without its drawing: a scene that follows the depsgraph, and a session.

Blender asks for a picture whenever it draws, on its main thread. So nothing here waits long: scenes
are built and rendered on threads of the core, and a change shows first in large pixels (a draft),
which come at once, before they are rendered as they should be.
"""

import time
from dataclasses import dataclass

import numpy as np

from .. import report
from ..sync.cache import SceneCache, generation, read_changes
from ..sync.difference import DifferenceBuilder
from ..sync.scene_sync import sync_objects
from .denoise import alpha_is_noisy
from .viewport_denoise import PictureDenoiser

DIVIDERS = (1, 2, 4, 8)  # pixels of a draft are so many times as large
FIRST_DIVIDER = 4  # before it is known how fast this scene renders
DRAFT_SECONDS = 0.1  # that a draft may take
STEP_SECONDS = 0.5  # and a sample in smaller pixels after it; else there is a step between
SHORT_WAIT = 0.04  # seconds for which drawing may wait for what comes soon
MIN_INTERVAL = 0.1  # seconds between two pictures
MAX_SHARE = 0.1  # of the time may go into fetching and drawing them


@dataclass(frozen=True)
class Picture:
    """float32[h, w, 4], scene linear, premultiplied, bottom row first, and where it belongs in the
    region: x, y, width, height."""

    pixels: np.ndarray
    rectangle: tuple[int, int, int, int]


class Viewport:
    """Of one 3D viewport. Methods are for Blender's main thread.

    sync() takes in what has changed in the scene, look() where the viewport looks; advance() sees
    to it that this gets rendered, and says whether there is another picture. Raises RenderRefused
    and the core's SceneError; what is shown stays as it was then.
    """

    def __init__(self, core, now=time.perf_counter):
        self._core = core
        self._now = now
        self._start_over()
        self._view = self._settings = self._denoising = None
        self._denoiser = PictureDenoiser(None)
        self._session = None
        self._finished = False  # has it got all its samples?
        self._divider = 1  # of its pixels
        self._is_draft = False  # is it the first after a change?
        self._target = 0  # samples of the session when it ends
        self._noisy_alpha = False  # of the session's picture
        self._shown = 0  # samples of the session in the picture
        self._next_picture = 0.0
        self._seconds = None  # that the last session took for a sample of a pixel
        self.picture: Picture | None = None
        self.log = report.DiagnosticsLog()

    def _start_over(self) -> None:
        self._builder = DifferenceBuilder(self._core.SceneBuilder())
        self._cache = SceneCache(self._builder)
        self._known = False  # has the builder got the scene?
        self._generation = generation()
        self._task = self._scene = None
        self._outdated = False  # does the builder hold more than the scene and the task?
        self._restart = False  # is the session another one's?

    def sync(self, depsgraph, shown=None) -> None:
        """Sends to the core what has changed. `shown`: see InstanceSync.run()."""
        if self._generation != generation():
            self._start_over()
        changes = read_changes(depsgraph) if self._known else None
        if changes and changes.only_cameras:
            return
        self.log = report.DiagnosticsLog()
        self._known = False
        sync_objects(self._builder, depsgraph, self._cache, self.log, changes, shown)
        self._known = True
        if self._scene is not None and not self._builder.changed:
            self._add_findings()  # of the scene as it stays

    def look(self, view, settings: dict, denoising: dict | None = None) -> None:
        """`settings`: those of RenderSettings but for its size; `denoising`: view_denoising()."""
        if denoising != self._denoising:
            self._denoiser, self._denoising = PictureDenoiser(denoising), denoising
            self._restart = True
        self._builder.set_camera(**view.camera)
        if self._builder.changed:
            self._builder.changed = False
            self._outdated = True
        pixels = view.scaled(view.pixel)
        if (pixels, settings) != (
            self._view and self._view.scaled(self._view.pixel),
            self._settings,
        ):
            self._restart = True
        self._view, self._settings = view, settings
        if self._session and self._obsolete and not self._unseen_draft:
            self._session.cancel()

    def pause(self) -> None:
        """Leaves the machine to others; the picture stays. advance() goes on, or starts again."""
        if self._session is not None and not self._finished:
            self._session.cancel()
            self._restart = True

    def advance(self) -> bool:
        """Takes the next steps; True if `picture` is another one."""
        if self._view is None or not self._known:
            return False
        self._commit()
        fresh = self._take_clean()
        fresh = self._fetch() or fresh  # a draft that has ended is seen before the next step starts
        if self._task is None and self._scene is not None and self._may_start():
            self._start()
            fresh = self._fetch() or fresh
        return fresh

    @property
    def busy(self) -> bool:
        """Is there more to come?"""
        running = self._session is not None and not self._finished
        return self._obsolete or running or self._denoiser.busy

    @property
    def status(self) -> str:
        if self._task is not None and self._scene is None:
            return "Building scene"
        if self._session is None:
            return ""
        samples = self._shown if self._finest else 0
        # As in Cycles: with a noise threshold, fewer samples than asked for may be all there are.
        done = "Rendering Done | " if self._finished and not self._obsolete else ""
        return f"{done}Sample {samples}/{self._settings['samples']}"

    @property
    def _obsolete(self) -> bool:
        """Does the session render what is no longer so?"""
        return bool(self._outdated or self._restart or self._task)

    @property
    def _unseen_draft(self) -> bool:
        """Drafts are quick, and without them a steady change would never show."""
        return self._is_draft and self._shown == 0

    def _commit(self) -> None:
        patience = 0.0
        if self._task is None and self._outdated:
            self._task = self._builder.start_commit()
            self._outdated = False
            patience = SHORT_WAIT
        if self._task is not None and self._task.wait(patience):
            task, self._task = self._task, None
            self._scene = task.scene()
            self._add_findings()
            self._restart = True

    def _add_findings(self) -> None:
        """What the core says of the scene, once: each turn of the view makes another scene."""
        found = report.DiagnosticsLog()
        found.extend(self._scene.diagnostics)
        for entry, count in found.entries():
            if entry not in self.log.counts:
                self.log.add(entry, count)

    def _may_start(self) -> bool:
        if self._session is None:
            return True
        if self._restart:
            return not self._unseen_draft or self._ended()
        return not self._finest and self._ended()

    @property
    def _finest(self) -> bool:
        """Are the session's pixels those of the finished picture?"""
        return self._divider == self._view.pixel

    def _start(self) -> None:
        self._is_draft = self._restart or self._session is None
        dividers = [divider for divider in DIVIDERS if divider >= self._view.pixel]
        if self._is_draft:
            divider = self._divider_within(DRAFT_SECONDS, dividers)
        else:
            finer = [divider for divider in dividers if divider < self._divider]
            divider = self._divider_within(STEP_SECONDS, finer)
        self._restart = False
        self._session = None  # waits for its threads
        self._denoiser.begin(self._is_draft)
        settings = self._settings | self._view.scaled(divider)
        if divider > self._view.pixel:
            settings["samples"] = 1
        session = self._core.RenderSession(self._scene, self._core.RenderSettings(**settings))
        session.start()
        self._session, self._divider, self._target = session, divider, settings["samples"]
        self._noisy_alpha = alpha_is_noisy(settings["film_transparent"], self._scene.counts)
        self._rectangle = self._view.rectangle
        self._finished, self._shown, self._next_picture = False, 0, 0.0
        end = self._now() + SHORT_WAIT
        while self._samples() == 0 and self._now() < end and not session.wait(0.002):
            pass

    def _divider_within(self, seconds: float, dividers) -> int:
        """The least of them whose sample takes no longer, or else the largest."""
        if self._seconds is None:
            return max(FIRST_DIVIDER, dividers[0])
        pixels = self._view.rectangle[2] * self._view.rectangle[3]
        quick = (d for d in dividers if pixels * self._seconds < seconds * d**2)
        return next(quick, dividers[-1])

    def _fetch(self) -> bool:
        if self._session is None or (self._obsolete and not self._unseen_draft):
            return False
        ended, samples, now = self._ended(), self._samples(), self._now()
        fresh = samples > self._shown
        if fresh and (ended or now >= self._next_picture):
            pixels = self._session.snapshot()
            last = ended or samples == self._target
            fresh = self._denoiser.add(self._session, pixels, samples, last, self._noisy_alpha)
            if fresh:
                self.picture = Picture(pixels, self._rectangle)
            self._shown = samples
            pause = max(MIN_INTERVAL, (self._now() - now) / MAX_SHARE)
            self._next_picture = self._now() + pause
            self._seconds = self._session.stats()["seconds"] / (samples * pixels[..., 0].size)
        else:
            fresh = False
        if ended and not self._finished:
            self._finished = self._finest
            self._session.finish()  # raises what went wrong
        return fresh

    def _take_clean(self) -> bool:
        """The picture that has been denoised meanwhile, unless it is out of date."""
        pixels = self._denoiser.take()
        if pixels is None or self._obsolete:
            return False
        self.picture = Picture(pixels, self._rectangle)
        return True

    def _samples(self) -> int:
        return self._session.progress()["samples"]

    def _ended(self) -> bool:
        return self._session.wait(0.0)
