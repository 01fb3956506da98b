# SPDX-License-Identifier: GPL-3.0-or-later
"""The frames and tiles of an image: Python sees the pixels of one at a time."""

import contextlib
import os

import bpy

LAST_FRAME = 300_000  # Blender's


@contextlib.contextmanager
def at_frame(image, frame: int):
    """The pixels of a sequence or movie are those of this frame meanwhile.

    `Image.pixels` shows the frame that was used last; the evaluation of a texture uses one.
    """
    texture = bpy.data.textures.new("Janus: frame", "IMAGE")
    try:
        texture.image = image
        user = texture.image_user
        user.use_auto_refresh = False
        user.frame_start, user.frame_offset, user.frame_duration = 1, 0, LAST_FRAME
        user.frame_current = frame
        texture.evaluate((0.0, 0.0, 0.0))
        yield
    finally:
        bpy.data.textures.remove(texture)


@contextlib.contextmanager
def loaded_tile(image, tile):
    """The image of one UDIM tile, from its file; None if there is none."""
    name = tile_name(image, tile)
    packed = {file.filepath: file.packed_file for file in image.packed_files}
    found = None
    try:
        if name in packed:
            file = packed[name]
            found = bpy.data.images.new("Janus: tile", 1, 1)
            found.pack(data=file.data, data_len=file.size)
            found.source = "FILE"
        else:
            path = tile_path(image, tile)
            if os.path.isfile(path):
                found = bpy.data.images.load(path)
        if found is not None:
            found.colorspace_settings.name = image.colorspace_settings.name
            found.alpha_mode = image.alpha_mode
        yield found
    finally:
        if found is not None:
            bpy.data.images.remove(found)


def tile_path(image, tile) -> str:
    return bpy.path.abspath(tile_name(image, tile), library=image.library)


def tile_name(image, tile) -> str:
    number = tile.number
    u, v = (number - 1001) % 10, (number - 1001) // 10
    pattern = image.filepath_raw
    return pattern.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u + 1}_v{v + 1}")
