# SPDX-License-Identifier: GPL-3.0-or-later
"""Saves what was rendered before an error."""

import bpy
import numpy as np

from .whole_file import whole_file


def save_partial(path: str, pixels: np.ndarray) -> None:
    """Writes float32 [H, W, 4], bottom row first, as an OpenEXR file of linear 32-bit floats."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("Janus partial", width, height, alpha=True, float_buffer=True)
    try:
        image.colorspace_settings.name = "Non-Color"  # linear values, written as they are
        image.alpha_mode = "PREMUL"
        image.pixels.foreach_set(np.ascontiguousarray(pixels, dtype=np.float32).reshape(-1))
        image.file_format = "OPEN_EXR"
        with whole_file(path) as file:
            image.filepath_raw = file
            image.save()
    finally:
        bpy.data.images.remove(image)
