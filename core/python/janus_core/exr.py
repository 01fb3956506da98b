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

__all__ = ["read", "require", "write"]

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
    entries = dict(metadata or {})
    if not all(isinstance(text, str) for entry in entries.items() for text in entry):
        raise TypeError("metadata must map strings to strings")
    _exr.write(os.fsencode(path), np.asarray(pixels, dtype=np.float32), entries)


def read(path: str | os.PathLike[str]) -> tuple[npt.NDArray[np.float32], dict[str, str]]:
    """(pixels, metadata) of a file: float32[height, width, 4] bottom row first, string attributes.

    Half and integer channels are converted, alpha is 1 where the file has none, a lone luminance
    channel is grey. Raises IoError, which names the file.
    """
    require()
    return _exr.read(os.fsencode(path))
