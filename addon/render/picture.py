# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures as files, by Blender's own writers."""

import contextlib
import os

import bpy
import numpy as np

from .whole_file import whole_file

SETTINGS = ("media_type", "file_format", "color_mode", "color_depth", "color_management")


@contextlib.contextmanager
def output_settings(scene, **values):
    """Inside, the scene writes files like this; then as before. media_type is for Blender 5."""
    settings = scene.render.image_settings
    names = [name for name in SETTINGS if hasattr(settings, name)]
    before = {name: getattr(settings, name) for name in names}
    try:
        for name in names:
            if name in values:
                setattr(settings, name, values[name])
        yield
    finally:
        for name, value in before.items():
            setattr(settings, name, value)


def save_result(scene, path: str) -> None:
    """The whole render result, all layers and passes: an OpenEXR file of linear 32-bit floats."""
    with (
        output_settings(
            scene,
            media_type="MULTI_LAYER_IMAGE",
            file_format="OPEN_EXR_MULTILAYER",
            color_depth="32",
        ),
        whole_file(path) as file,
    ):
        bpy.data.images["Render Result"].save_render(file, scene=scene)


def save_display(scene, path: str, pixels: np.ndarray) -> None:
    """A PNG through the scene's view transform. float32[H, W, 3], linear, bottom row first."""
    with (
        _image(pixels, float_buffer=True) as image,
        output_settings(
            scene,
            media_type="IMAGE",
            file_format="PNG",
            color_mode="RGB",
            color_depth="8",
            color_management="FOLLOW_SCENE",
        ),
        whole_file(path) as file,
    ):
        image.save_render(file, scene=scene)


def save_bytes(path: str, pixels: np.ndarray) -> None:
    """float32[H, W, 3], display values from 0 to 1, bottom row first: a PNG as they are."""
    with _image(pixels, float_buffer=False) as image, whole_file(path) as file:
        image.filepath_raw = file
        image.file_format = "PNG"
        image.save()


def displayed(scene, pixels: np.ndarray) -> np.ndarray:
    """What save_display() saves, float32[H, W, 3] from 0 to 1."""
    path = os.path.join(bpy.app.tempdir, "janus_display.png")
    save_display(scene, path, pixels)
    image = bpy.data.images.load(path)
    try:
        flat = np.empty(image.size[0] * image.size[1] * 4, dtype=np.float32)
        image.pixels.foreach_get(flat)
    finally:
        bpy.data.images.remove(image)
        os.unlink(path)
    return flat.reshape(*pixels.shape[:2], 4)[:, :, :3]


@contextlib.contextmanager
def _image(pixels: np.ndarray, float_buffer: bool):
    height, width = pixels.shape[:2]
    image = bpy.data.images.new(
        "Janus picture", width, height, alpha=False, float_buffer=float_buffer
    )
    try:
        opaque = np.ones((height, width, 4), dtype=np.float32)
        opaque[:, :, :3] = pixels
        image.pixels.foreach_set(opaque.reshape(-1))
        yield image
    finally:
        bpy.data.images.remove(image)
