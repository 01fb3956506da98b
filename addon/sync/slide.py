# SPDX-License-Identifier: GPL-3.0-or-later
"""Images of Blender as slides of a projector, and lamps that can be one."""

import math

import bpy
import numpy as np

from ..report import RenderRefused
from .color_space import srgb_to_linear
from .image import pixels

MOST_SPREAD = math.radians(0.1)  # narrower lamps are rendered with this one, too
WIDEST = math.radians(160.0)


def read_slide(name: str, warn) -> np.ndarray:
    """The image of that name: float32[H, W, 3], scene linear, bottom row first.

    warn(message) is told what cannot be read as it is meant. Raises RenderRefused for an image that
    is not there or has no pixels.
    """
    image = bpy.data.images.get(name)
    if image is None:
        raise RenderRefused(f"There is no image '{name}'")
    found = pixels(image, warn)
    if found is None:
        raise RenderRefused(f"The image '{name}' has no pixels: is its file there?")
    buffer, srgb = found
    color = buffer[..., :3]
    return np.ascontiguousarray(srgb_to_linear(color) if srgb else color, dtype=np.float32)


def unfit(light) -> tuple[str, str]:
    """The setting for which this light data cannot be a projector, and why; ("", "") if it can."""
    if light.type not in ("SPOT", "AREA"):
        return "type", "Only spot and area lights can be projectors"
    if light.type == "SPOT" and light.shadow_soft_size > 0.0:
        return "shadow_soft_size", "A spot light projects a sharp picture with a Radius of 0 alone"
    if light.type == "SPOT" and light.spot_size > WIDEST + 1e-6:
        return "spot_size", "A projector's Spot Size is at most 160 degrees"
    if light.type == "AREA" and light.spread > MOST_SPREAD + 1e-6:
        return "spread", "An area light projects a picture with a Spread of 0 alone"
    return "", ""
