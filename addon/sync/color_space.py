# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour spaces of pictures: whatever Blender's OpenColorIO knows, by having Blender convert.

Python cannot ask for a conversion, but a float picture in a file is converted when it is read. So
numbers become a TIFF in memory that says to be of the space in question.
"""

import functools
import struct

import bpy
import numpy as np

# What is in a picture of these spaces is no colour, and alpha does not cover it.
DATA = {"Non-Color", "Raw"}
KNOWN = {"sRGB": "SRGB", "Non-Color": "LINEAR", "Raw": "LINEAR"}
# Where white is 203 nits, Blender makes it 1 when it reads a picture; Cycles makes 1 of 100 nits.
CYCLES_SCALE = {"Rec.2100-PQ": 2.03, "Rec.2100-HLG": 2.03}
STEPS = 256  # at which a space is compared with sRGB and with no space at all
SRGB_TOLERANCE, LINEAR_TOLERANCE = 1e-4, 1e-6  # Cycles'


@functools.cache
def kind_of_space(name: str) -> str:
    """SRGB, LINEAR (scene linear, or data), OTHER; UNKNOWN to Blender. By what it does, as Cycles
    decides.
    """
    if name in KNOWN:
        return KNOWN[name]
    v = np.linspace(0.0, 1.0, STEPS, dtype=np.float32)
    zero = np.zeros_like(v)
    probe = np.stack(
        [np.stack(c, -1) for c in ((v, zero, zero), (zero, v, zero), (zero, zero, v), (v, v, v))]
    )
    found = to_scene_linear(probe, name)
    if found is None:
        return "UNKNOWN"
    white = found[3, :, 0]
    alone = np.stack([found[i, :, i] for i in range(3)])
    crossed = max(np.abs(np.delete(found[i], i, axis=1)).max() for i in range(3))
    even = np.abs(found[3] - white[:, None]).max()
    if crossed > 1e-5 or np.abs(alone - white).max() > 1e-5 or even > 1e-5:
        return "OTHER"
    if np.abs(white - v).max() < LINEAR_TOLERANCE:
        return "LINEAR"
    return "SRGB" if np.abs(white - srgb_to_linear(v)).max() < SRGB_TOLERANCE else "OTHER"


def to_scene_linear(colors: np.ndarray, space: str) -> np.ndarray | None:
    """float32[H, W, 3] of a colour space of Blender's in scene linear; None: it is none."""
    image = bpy.data.images.new("Janus: colour space", 1, 1, float_buffer=True)
    try:
        data = _tiff(colors)
        image.pack(data=data, data_len=len(data))
        image.source = "FILE"
        image.alpha_mode = "NONE"
        image.colorspace_settings.name = space
        if tuple(image.size) != (colors.shape[1], colors.shape[0]) or not image.is_float:
            return None
        result = np.empty(image.channels * colors.shape[0] * colors.shape[1], np.float32)
        image.pixels.foreach_get(result)
        return result.reshape(*colors.shape[:2], -1)[..., :3]
    except (RuntimeError, TypeError):
        return None
    finally:
        bpy.data.images.remove(image)


def decode_half(buffer: np.ndarray, space: str, covered: bool, multiplied: bool) -> np.ndarray:
    """A picture of bytes in scene-linear colours, rounded to half floats as in Cycles. `covered`:
    colours are to be multiplied by alpha; `multiplied`: they are.
    """
    colors, scale = buffer[..., :3], CYCLES_SCALE.get(space, 1.0)
    if covered:
        alpha = _half(buffer[..., 3:])
        colors = _half(colors if multiplied else colors * buffer[..., 3:])
        share = np.where(alpha > 0.0, alpha, 1.0)
        found = scale * to_scene_linear(colors / share, space) * share
        return np.concatenate([_half(found), alpha], axis=2)
    found = _half(scale * to_scene_linear(_half(colors), space))
    return np.concatenate([found, _half(buffer[..., 3:])], axis=2)


def encode_srgb(buffer: np.ndarray, covered: bool) -> np.ndarray:
    """Scene-linear colours encoded as sRGB. `covered`: they are, and stay, multiplied by alpha."""
    colors = buffer[..., :3]
    share = np.where(buffer[..., 3:] > 0.0, buffer[..., 3:], 1.0) if covered else 1.0
    linear = colors / share
    curve = 1.055 * np.power(np.maximum(linear, 0.0031308), 1.0 / 2.4) - 0.055
    encoded = np.where(linear < 0.0031308, 12.92 * linear, curve) * share
    return np.concatenate([encoded, buffer[..., 3:]], axis=2).astype(np.float32)


def srgb_to_linear(x: np.ndarray) -> np.ndarray:
    """The decoding of IEC 61966-2-1."""
    return np.where(x > 0.04045, ((np.maximum(x, 0.0) + 0.055) / 1.055) ** 2.4, x / 12.92)


def _half(x: np.ndarray) -> np.ndarray:
    return np.asarray(x).astype(np.float16).astype(np.float32)


def _tiff(colors: np.ndarray) -> bytes:
    """The file of a float picture, the bottom row first, without compression."""
    height, width, channels = colors.shape
    pixels = np.ascontiguousarray(colors[::-1], dtype="<f4").tobytes()
    count = 10
    lists = 8 + 2 + 12 * count + 4  # behind header and directory
    data = lists + 4 * channels
    short, long = 3, 4
    entries = (
        (256, long, 1, width),
        (257, long, 1, height),
        (258, short, channels, lists),  # 32 bits each
        (259, short, 1, 1),  # not compressed
        (262, short, 1, 2),  # RGB
        (273, long, 1, data),
        (277, short, 1, channels),
        (278, long, 1, height),
        (279, long, 1, len(pixels)),
        (339, short, channels, lists + 2 * channels),  # floats
    )
    directory = struct.pack("<H", count)
    for tag, kind, number, value in entries:
        directory += struct.pack("<HHII", tag, kind, number, value)
    shorts = struct.pack(f"<{2 * channels}H", *[32] * channels, *[3] * channels)
    return b"II*\0" + struct.pack("<I", 8) + directory + struct.pack("<I", 0) + shorts + pixels
