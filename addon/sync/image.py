# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of texture nodes, as Cycles reads them."""

import bpy
import numpy as np

from ..nodes import image_key

# Colour spaces in which the bytes of a picture are numbers as they are.
DATA = {"Non-Color", "Raw"}  # what they hold are no colours
TEXTURES = {"TEX_IMAGE", "TEX_ENVIRONMENT"}
PLAIN = {"Non-Color", "Linear Rec.709", "Linear", "Raw"}


def send_images(builder, graph, owner, log, sent: set) -> None:
    """Sends the images of the textures of a flat graph of `owner`; `sent`: the keys of those that
    the builder has.
    """
    textures = [node for node in graph["nodes"] if node["type"] in TEXTURES]
    if not textures:
        return
    images = {image_key(image): image for image in bpy.data.images}
    for node in textures:
        key = node["properties"].get("image")
        image = images.get(key)
        if image is None or key in sent:
            continue
        sent.add(key)
        if image.source in ("TILED", "SEQUENCE", "MOVIE"):
            kind = {"TILED": "tiled images", "SEQUENCE": "image sequences", "MOVIE": "movies"}
            log.warning(
                f"{kind[image.source]} are not supported yet ('{image.name}'), the texture is "
                "rendered as if its image were missing",
                material=owner.name,
                node=node["name"],
            )
            continue
        plain = image.colorspace_settings.name in PLAIN
        found = pixels(image)
        if found is None:  # the core names the node, as it does for nodes without an image
            continue
        srgb = not image.is_float and not plain
        if srgb and image.colorspace_settings.name != "sRGB":
            log.warning(
                f"the colour space '{image.colorspace_settings.name}' of '{image.name}' is not "
                "supported yet, sRGB is used",
                material=owner.name,
                node=node["name"],
            )
        associated = found.shape[2] == 4 and covers(image)
        builder.set_image(key, name=image.name, pixels=found, srgb=srgb, associated=associated)


def covers(image) -> bool:
    """Does alpha cover the colours? Not those of packed channels or of data."""
    packed = image.alpha_mode == "CHANNEL_PACKED"
    return not packed and image.colorspace_settings.name not in DATA


def pixels(image) -> np.ndarray | None:
    """float32[H, W, 3 or 4], the bottom row first; None if there is no picture.

    Blender gives bytes as they are in the file and float pictures in scene-linear colours. Alpha
    that counts is the fourth channel; where it covers, colours are multiplied by it.
    """
    width, height = image.size
    channels = image.channels
    if width == 0 or height == 0 or channels == 0:
        return None
    buffer = np.empty(width * height * channels, dtype=np.float32)
    try:
        image.pixels.foreach_get(buffer)
    except (RuntimeError, TypeError):  # the file went away
        return None
    buffer = buffer.reshape(height, width, channels)
    if channels < 3:
        return np.repeat(buffer[..., :1], 3, axis=2)
    if channels == 3 or image.alpha_mode == "NONE":
        return np.ascontiguousarray(buffer[..., :3])
    # Cycles multiplies bytes before it decodes them, and rounds down.
    if not image.is_float and covers(image):
        integers = np.rint(255.0 * buffer).astype(np.int32)
        buffer[..., :3] = (integers[..., :3] * integers[..., 3:] // 255).astype(np.float32) / 255.0
    return buffer
