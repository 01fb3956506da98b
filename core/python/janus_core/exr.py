# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as OpenEXR files.

The build of janus_core that Blender loads is without OpenEXR (Blender has its own, and two in one
process clash). There, all functions raise ImportError.
"""

from __future__ import annotations

import os
from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

__all__ = ["read", "read_layers", "require", "write", "write_layers"]

COMBINED = "Combined"  # the picture itself, among its passes

try:
    from . import _exr
except ImportError as error:
    _exr = None
    _reason = error


def require() -> None:
    """Raises ImportError, which says what to do, if this build is without OpenEXR."""
    if _exr is None:
        raise ImportError(
            "this build of janus_core has no OpenEXR part (the one inside Blender never has); "
            "install the package with `pip install .` in the source tree"
        ) from _reason


def write(
    path: str | os.PathLike[str],
    pixels: npt.ArrayLike,
    metadata: Mapping[str, str] | None = None,
) -> None:
    """Writes scene-linear pixels as 32-bit float channels, compressed without loss (ZIP).

    `pixels` is float32[height, width, 4] (R, G, B, A) or [height, width, 3] (R, G, B), bottom row
    first, as RenderSession.snapshot() gives it; `metadata` becomes string attributes. The file
    appears when it is complete: a write that fails leaves what was there before.

    Raises IoError, which names the file; ValueError for pixels of another shape.
    """
    require()
    _exr.write(os.fsencode(path), np.asarray(pixels, dtype=np.float32), _strings(metadata))


def write_layers(
    path: str | os.PathLike[str],
    layers: Mapping[str, npt.ArrayLike],
    metadata: Mapping[str, str] | None = None,
) -> None:
    """The same for several pictures of one size, by name: a multilayer file, as Blender reads it.

    The channels of a picture are called NAME.R and so on, or NAME.X where there is but one; those
    of "Combined" R and so on, so that programs that know no layers show that one.
    """
    require()
    pictures = [
        ("" if name == COMBINED else name, np.asarray(pixels, dtype=np.float32))
        for name, pixels in layers.items()
    ]
    _exr.write_layers(os.fsencode(path), pictures, _strings(metadata))


def read(path: str | os.PathLike[str]) -> tuple[npt.NDArray[np.float32], dict[str, str]]:
    """(pixels, metadata) of a file: float32[height, width, 4] bottom row first, string attributes.

    Half and integer channels are converted, alpha is 1 where the file has none, a lone luminance
    channel is grey. Raises IoError, which names the file.
    """
    require()
    return _exr.read(os.fsencode(path))


def read_layers(
    path: str | os.PathLike[str],
) -> tuple[dict[str, npt.NDArray[np.float32]], dict[str, str]]:
    """(pictures by name, metadata) of a file, whoever wrote it: all that has channels RGB, RGBA,
    rgba (Cryptomatte), XYZ, XYZW, UVA, Z or X.

    Each is float32[height, width, channels], bottom row first, the channels in that order. Plain
    R, G, B is "Combined"; what Blender writes is called LAYER.PASS. Raises IoError, which names the
    file.
    """
    require()
    layers, metadata = _exr.read_layers(os.fsencode(path))
    return {name or COMBINED: pixels for name, pixels in layers}, metadata


def _strings(metadata: Mapping[str, str] | None) -> dict[str, str]:
    entries = dict(metadata or {})
    if not all(isinstance(text, str) for entry in entries.items() for text in entry):
        raise TypeError("metadata must map strings to strings")
    return entries
