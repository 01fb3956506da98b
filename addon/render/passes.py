# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's render result: which passes it has, and how pixels get into it."""

import json

import numpy as np

from ..sync.passes import COMBINED, requested


def register_passes(engine, scene, view_layer) -> None:
    """Blender makes these passes and no others, and the compositor has sockets for them."""
    for found in (COMBINED, *requested(scene, view_layer)):
        channels = found.channels
        engine.register_pass(scene, view_layer, found.name, len(channels), channels, found.kind)


class LayerResult:
    """The result of one view layer.

    Blender may crash if render() returns without a full-size result, so `end` belongs in a
    `finally`: it hands over what was pushed last, or black.
    """

    def __init__(self, engine, frame):
        self._engine = engine
        self._frame = frame
        self._result = None
        self._fields = {}  # of the metadata

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
        if self._fields:
            result = self._engine.get_result()
            for name, value in self._fields.items():
                result.stamp_data_add_field(name, value)

    def stamp(self, **fields) -> None:
        """What `end` writes into the metadata of the picture, as janus/<field>."""
        self._fields |= {f"janus/{name}": str(value) for name, value in fields.items()}

    def stamp_matte(self, kind: str, names: dict[str, str], hash_of) -> None:
        """The metadata of a Cryptomatte: what readers need to know names by their hashes."""
        name = f"{self._frame.view_layer}.Crypto{kind}"
        manifest = json.dumps(names, ensure_ascii=False, separators=(",", ":"))
        values = {
            "name": name,
            "hash": "MurmurHash3_32",
            "conversion": "uint32_to_float32",
            "manifest": manifest,
        }
        prefix = f"cryptomatte/{hash_of(name)[:7]}"
        self._fields |= {f"{prefix}/{field}": value for field, value in values.items()}

    def _begin(self) -> None:
        if self._result is None:  # with a border, Blender clips this to the border
            frame = self._frame
            self._result = self._engine.begin_result(
                0, 0, frame.width, frame.height, layer=frame.view_layer
            )
