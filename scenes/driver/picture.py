# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes Blender's render result to a file."""

from __future__ import annotations

import contextlib
from pathlib import Path

import bpy

from scenes.driver.addon import alone


def save(scene: bpy.types.Scene, path: Path) -> None:
    """PNG: 8 bits, through the scene's view transform. EXR: 32-bit float, scene linear."""
    path.parent.mkdir(parents=True, exist_ok=True)
    settings = scene.render.image_settings
    with contextlib.suppress(AttributeError, TypeError):
        settings.media_type = "IMAGE"  # Blender 5
    if path.suffix.lower() == ".exr":
        settings.file_format = "OPEN_EXR"
        settings.color_mode = "RGBA"
        settings.color_depth = "32"
        settings.exr_codec = "ZIP"
    else:
        settings.file_format = "PNG"
        settings.color_mode = "RGBA" if scene.render.film_transparent else "RGB"
        settings.color_depth = "8"
    result = bpy.data.images["Render Result"]
    with alone("render/whole_file.py").whole_file(str(path)) as file:
        result.save_render(file, scene=scene)
