# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of scenes/, exported through Blender once, rendered by the core alone, shown by Blender.

Pictures are float32[H, W, 3], linear, the bottom row first.
"""

from __future__ import annotations

import importlib
import os
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from scenes.driver import addon

FOREVER = 1 << 24  # samples, where time is the limit
MAX_STRETCH = 8.0


@dataclass
class Shot:
    """A picture and what it took, nothing counted but the render itself.

    `passes`: by name, of the light path expressions that were asked for. `samples`: whole passes
    over the picture. `seconds`: of the wall. `cpu`: seconds of all processors together. `time`: by
    the clock that was chosen.
    """

    picture: np.ndarray
    passes: dict[str, np.ndarray]
    samples: int
    seconds: float
    cpu: float
    time: float


class Stage:
    """The scene that is set: Blender has it, to show pictures, and the core, to render them.

    `clock`: "wall", or "cpu" for the time of all processors over the number of threads. The core's
    limit is one of the wall: with "cpu" it is stretched as the render before needed it.
    """

    def __init__(self, janus: addon.Addon, threads: int, clock: str = "wall") -> None:
        self._janus, self._threads, self._clock = janus, threads or os.cpu_count() or 1, clock
        self._stretch = 1.0  # wall time of a second of the clock, lately

    def set(
        self,
        name: str,
        box: tuple[int, int],
        change: Callable[[bpy.types.Scene], None] | None = None,
        **variant: object,
    ) -> None:
        """Builds scenes/`name`.py, whose picture is to fit into `box`, pixels.

        `variant`: what its build() is told. `change` alters the scene that was built.
        """
        from janus_core import capture

        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        module = importlib.import_module(f"scenes.{name}")
        module.build(scene, **variant)
        if change:
            change(scene)
        render, janus = scene.render, scene.janus
        render.engine = addon.ENGINE
        render.resolution_x, render.resolution_y = fit((module.WIDTH, module.HEIGHT), box)
        janus.samples, janus.time_limit = 1, 0.0
        with tempfile.TemporaryDirectory() as folder:
            janus.capture_path = str(Path(folder) / "scene.npz")
            bpy.ops.render.render(write_still=False, scene=scene.name)
            builder, self._settings = capture.load(janus.capture_path)
        self._scene = builder.commit()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self._settings.width, self._settings.height

    def shoot(self, **changes: object) -> Shot:
        """A render with the scene's settings but for the changes (see RenderSettings).

        `seconds` are those of the clock.
        """
        import janus_core

        if changes.get("seconds"):
            wall = changes["seconds"] * self._stretch
            changes = {"samples": FOREVER, **changes, "seconds": wall}
        changes = {"threads": self._threads, **changes}
        settings = janus_core.RenderSettings(**{**self._settings.to_dict(), **changes})
        session = janus_core.RenderSession(self._scene, settings)
        cpu = time.process_time()
        session.start()
        session.finish()
        cpu = time.process_time() - cpu
        stats = session.stats()
        names = [name for name, _ in settings.expressions]
        passes = {name: session.snapshot(name)[:, :, :3] for name in ["Combined", *names]}
        picture = passes.pop("Combined")
        taken = cpu / self._threads if self._clock == "cpu" else stats["seconds"]
        self._stretch = min(max(stats["seconds"] / max(taken, 1e-6), 1.0), MAX_STRETCH)
        return Shot(picture, passes, stats["samples"], stats["seconds"], cpu, taken)

    def save(self, path: Path, picture: np.ndarray) -> None:
        """A PNG through the scene's view transform."""
        part = self._janus.part("render.picture")
        part.save_display(bpy.context.scene, str(path), picture)

    def save_grey(self, path: Path, values: np.ndarray) -> None:
        """A PNG of float[H, W]: 0 is black, 1 and more is white."""
        grey = np.repeat(np.clip(values, 0.0, 1.0)[:, :, None], 3, axis=2)
        self._janus.part("render.picture").save_bytes(str(path), grey.astype(np.float32))


def fit(size: tuple[int, int], box: tuple[int, int]) -> tuple[int, int]:
    """The largest (width, height) of these proportions that fits into the box, at least 1 x 1."""
    scale = min(box[0] / size[0], box[1] / size[1])
    return max(round(scale * size[0]), 1), max(round(scale * size[1]), 1)
