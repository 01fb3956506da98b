# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the picture of a viewport, and wakes Blender when there is another one."""

import weakref

import bpy
import numpy as np

POLL_SECONDS = 0.02
PAUSE_SECONDS = 0.25  # while a final render runs
MOST = 65504.0  # of a half float: more would be infinite, and black


class PictureOnScreen:
    """The last picture as a texture. Only while Blender draws: it needs the GPU's context."""

    def __init__(self):
        self._texture = self._picture = None

    def draw(self, picture) -> None:
        import gpu
        from gpu_extras.presets import draw_texture_2d

        if picture is not self._picture:
            height, width = picture.pixels.shape[:2]
            values = np.minimum(picture.pixels, np.float32(MOST)).reshape(-1)
            buffer = gpu.types.Buffer("FLOAT", len(values), values)
            self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer)
            self._picture = picture
        x, y, width, height = picture.rectangle
        gpu.state.blend_set("ALPHA_PREMULT")
        draw_texture_2d(self._texture, (x, y), width, height)
        gpu.state.blend_set("NONE")


class Waker:
    """Asks Blender to draw an engine's viewport again as long as that is busy."""

    def __init__(self, engine):
        self._engine = weakref.ref(engine)
        self._waiting = False

    def wake(self, seconds: float = POLL_SECONDS) -> None:
        """After so long, once. To be called in each draw that is not the last one."""
        if not self._waiting:
            self._waiting = True
            bpy.app.timers.register(self._tick, first_interval=seconds)

    def _tick(self) -> None:
        self._waiting = False
        engine = self._engine()
        if engine is not None:
            try:
                engine.tag_redraw()
            except ReferenceError:  # Blender has freed it
                pass
