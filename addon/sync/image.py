# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of texture nodes, as Cycles reads them."""

import bpy
import numpy as np

from ..nodes import image_key
from .color_space import CYCLES_SCALE, DATA, decode_half, encode_srgb, kind_of_space
from .loading import at_frame, loaded_tile

TEXTURES = {"TEX_IMAGE", "TEX_ENVIRONMENT"}
ANIMATED = {"SEQUENCE", "MOVIE"}


class ImageSync:
    """Sends pictures on first use."""

    def __init__(self, builder, depsgraph, cache, log):
        self._builder = builder
        self._frame = depsgraph.scene_eval.frame_current
        self._cache = cache
        self._log = log

    def send(self, graph, owner) -> None:
        """Sends the images of the textures of a flat graph of `owner`, and notes in the graph which
        tiles there are and which frame is meant.
        """
        textures = [node for node in graph["nodes"] if node["type"] in TEXTURES]
        if not textures:
            return
        images = {image_key(image): image for image in bpy.data.images}
        for node in textures:
            properties = node["properties"]
            image = images.get(properties.get("image"))
            if image is None:
                continue
            key = properties["image"]
            if image.source in ANIMATED:
                frame = user_frame(self._frame, *properties["image_user"])
                properties["image"] = key = f"{key}@{frame}"
                self._once(key, image, owner, node, self._send_frame, frame)
            elif image.source == "TILED":
                properties["tiles"] = [tile.number for tile in image.tiles]
                for tile in image.tiles:
                    part = f"{key}:{tile.number}"
                    self._once(part, image, owner, node, self._send_tile, tile)
            else:
                self._once(key, image, owner, node, self._send)

    def _once(self, key: str, image, owner, node, send, *which) -> None:
        self._cache.image(
            key,
            lambda log: send(key, image, _Warner(log, owner, node, image), *which),
            self._log,
        )

    def _send_frame(self, key: str, image, warn, frame: int) -> None:
        with at_frame(image, frame):
            self._send(key, image, warn)

    def _send_tile(self, key: str, image, warn, tile) -> None:
        with loaded_tile(image, tile) as found:
            if found is not None:  # else the core names the tile
                self._send(key, found, warn, image.name)

    def _send(self, key: str, image, warn, name: str = "") -> None:
        found = pixels(image, warn)
        if found is None:  # the core names the node, as it does for nodes without an image
            return
        found, srgb = found
        associated = found.shape[2] == 4 and covers(image)
        name = name or image.name
        self._builder.set_image(key, name=name, pixels=found, srgb=srgb, associated=associated)


class _Warner:
    """Says what is wrong with an image, with all that it belongs to."""

    def __init__(self, log, owner, node, image):
        self._log, self._owner, self._node, self._image = log, owner, node, image

    def __call__(self, message: str) -> None:
        self._log.warning(
            f"the image '{self._image.name}': {message}",
            material=self._owner.name,
            node=self._node["name"],
        )


def user_frame(frame: int, duration: int, start: int, offset: int, cyclic: bool) -> int:
    """Which frame of a sequence or movie a node shows at the scene's frame."""
    if duration == 0:
        return 0
    at = frame - start + 1
    at = (at - 1) % duration + 1 if cyclic else min(max(at, 0), duration)
    return at + offset


# Cycles takes bytes for multiplied where the picture says so.
KNOWS_MULTIPLIED_BYTES = bpy.app.version >= (5, 1, 0)


def covers(image) -> bool:
    """Does alpha cover the colours? Not those of packed channels or of data."""
    packed = image.alpha_mode == "CHANNEL_PACKED"
    return not packed and image.colorspace_settings.name not in DATA


def pixels(image, warn) -> tuple[np.ndarray, bool] | None:
    """float32[H, W, 3 or 4], the bottom row first, and whether it is encoded as sRGB; None if there
    is no picture.

    Blender gives bytes as they are in the file and float pictures in scene-linear colours. Alpha
    that counts is the fourth channel; where it covers, colours are multiplied by it.
    """
    buffer = _raw_pixels(image)
    if buffer is None:
        return None
    space = image.colorspace_settings.name
    kind = kind_of_space(space)
    channels = buffer.shape[2]
    if channels < 3:
        buffer = np.repeat(buffer[..., :1], 3, axis=2)
    elif channels == 3 or image.alpha_mode == "NONE":
        buffer = np.ascontiguousarray(buffer[..., :3])
    alpha = buffer.shape[2] == 4
    if image.is_float:
        # Cycles reads files itself, and decodes what is encoded after it has interpolated.
        from_file = image.source != "GENERATED" and image.packed_file is None
        if kind == "SRGB" and from_file:
            return encode_srgb(buffer, alpha and covers(image)), True
        if from_file and space in CYCLES_SCALE:
            buffer[..., :3] *= CYCLES_SCALE[space]
        return buffer, False
    if kind == "UNKNOWN":
        warn(f"its colour space '{space}' cannot be converted, its numbers are used as they are")
    multiplied = KNOWS_MULTIPLIED_BYTES and image.alpha_mode == "PREMUL"
    if kind == "OTHER":
        return decode_half(buffer, space, alpha and covers(image), multiplied), False
    if alpha and covers(image) and not multiplied:
        # Cycles multiplies bytes before it decodes them, and rounds down.
        integers = np.rint(255.0 * buffer).astype(np.int32)
        buffer[..., :3] = (integers[..., :3] * integers[..., 3:] // 255).astype(np.float32) / 255.0
    return buffer, kind == "SRGB"


def _raw_pixels(image) -> np.ndarray | None:
    width, height = image.size
    channels = image.channels
    if width == 0 or height == 0 or channels == 0:
        return None
    buffer = np.empty(width * height * channels, dtype=np.float32)
    try:
        image.pixels.foreach_get(buffer)
    except (RuntimeError, TypeError):  # the file went away
        return None
    return buffer.reshape(height, width, channels)
