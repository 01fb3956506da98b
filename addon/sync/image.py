# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of texture nodes, as Cycles reads them."""

import bpy
import numpy as np

from ..nodes import image_key

# Colour spaces in which the bytes of a picture are numbers as they are.
PLAIN = {"Non-Color", "Linear Rec.709", "Linear", "Raw"}


def send_images(builder, graph, owner, log) -> None:
    """Sends the images of the environment textures of a flat graph of `owner`, each once."""
    sent = set()
    images = {image_key(image): image for image in bpy.data.images}
    for node in graph["nodes"]:
        key = node["properties"].get("image") if node["type"] == "TEX_ENVIRONMENT" else None
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
        found = pixels(image)
        if found is None:  # the core names the node, as it does for nodes without an image
            continue
        srgb = not image.is_float and image.colorspace_settings.name not in PLAIN
        if srgb and image.colorspace_settings.name != "sRGB":
            log.warning(
                f"the colour space '{image.colorspace_settings.name}' of '{image.name}' is not "
                "supported yet, sRGB is used",
                material=owner.name,
                node=node["name"],
            )
        builder.set_image(key, name=image.name, pixels=found, srgb=srgb)


def pixels(image) -> np.ndarray | None:
    """float32[H, W, 3], the bottom row first; None if there is no picture.

    Blender gives bytes as they are in the file and float pictures in scene-linear colours.
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
    colors = buffer[..., :3]
    # Cycles multiplies bytes by a straight alpha before it decodes them, and rounds down.
    if channels == 4 and not image.is_float and image.alpha_mode == "STRAIGHT":
        integers = np.rint(255.0 * buffer).astype(np.int32)
        colors = (integers[..., :3] * integers[..., 3:] // 255).astype(np.float32) / 255.0
    return np.ascontiguousarray(colors)
