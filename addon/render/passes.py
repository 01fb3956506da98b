# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's render result: which passes it has, and how pixels get into it."""

import numpy as np

from ..sync.passes import COMBINED, requested


def register_passes(engine, scene, view_layer) -> None:
    """Blender makes these passes and no others, and the compositor has sockets for them."""
    for found in (COMBINED, *requested(scene, view_layer)):
        channels = found.channels
        engine.register_pass(scene, view_layer, found.name, len(channels), channels, "COLOR")


class LayerResult:
    """The result of one view layer.

    Blender may crash if render() returns without a full-size result, so `end` belongs in a
    `finally`: it hands over what was pushed last, or black.
    """

    def __init__(self, engine, frame):
        self._engine = engine
        self._frame = frame
        self._result = None

    def push(self, pixels: dict[str, np.ndarray]) -> None:
        """Shows float32 arrays [H, W, C] by pass name, bottom row first."""
        for name, values in pixels.items():
            self.fill(name, values)
        self.show()

    def fill(self, name: str, values: np.ndarray) -> None:
        """Sets one pass, without showing it yet."""
        self._begin()
        for rendered in self._result.layers[0].passes:  # with stereo, one of a name per view
            if rendered.name == name:
                flat = np.ascontiguousarray(values, dtype=np.float32).reshape(-1)
                expected = len(rendered.rect) * rendered.channels
                if flat.size != expected:
                    raise RuntimeError(
                        f"pass {rendered.name} has {flat.size} values, Blender wants {expected}"
                    )
                rendered.rect.foreach_set(flat)

    def show(self) -> None:
        self._engine.update_result(self._result)

    def end(self) -> None:
        self._begin()
        self._engine.end_result(self._result)
        self._result = None

    def stamp(self, **fields) -> None:
        """Writes janus/<field> into the metadata of the picture. Only after `end`."""
        result = self._engine.get_result()
        for name, value in fields.items():
            result.stamp_data_add_field(f"janus/{name}", str(value))

    def _begin(self) -> None:
        if self._result is None:  # with a border, Blender clips this to the border
            frame = self._frame
            self._result = self._engine.begin_result(
                0, 0, frame.width, frame.height, layer=frame.view_layer
            )
