# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of scenes/, exported through Blender once, rendered by the core alone, shown by Blender.

Pictures are float32[H, W, 3], linear, the bottom row first.
"""

from __future__ import annotations

import importlib
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from scenes.driver import addon

FOREVER = 1 << 24  # samples, where time is the limit


@dataclass
class Shot:
    """A picture and what it took, nothing counted but the render itself.

    `passes`: by name, of the light path expressions that were asked for. `samples`: whole passes
    over the picture. `seconds`: by the clock. `cpu`: seconds of all processors together.
    """

    picture: np.ndarray
    passes: dict[str, np.ndarray]
    samples: int
    seconds: float
    cpu: float


class Stage:
    """The scene that is set: Blender has it, to show pictures, and the core, to render them."""

    def __init__(self, janus: addon.Addon, threads: int) -> None:
        self._janus, self._threads = janus, threads

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
        """A render with the scene's settings but for the changes (see RenderSettings)."""
        import janus_core

        if changes.get("seconds"):
            changes = {"samples": FOREVER, **changes}
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
        return Shot(picture, passes, stats["samples"], stats["seconds"], cpu)

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
