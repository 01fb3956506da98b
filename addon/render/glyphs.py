# SPDX-License-Identifier: GPL-3.0-or-later
"""The few characters that contact sheets need: Blender's Python has no way to draw text."""

import numpy as np

WIDTH, HEIGHT = 5, 7  # pixels of a glyph; one more is between two
ADVANCE = WIDTH + 1

# One row of a glyph for each number, from the top; the highest of five bits is the left pixel.
GLYPHS = {
    " ": (0, 0, 0, 0, 0, 0, 0),
    "+": (0, 4, 4, 31, 4, 4, 0),
    "-": (0, 0, 0, 31, 0, 0, 0),
    ".": (0, 0, 0, 0, 0, 12, 12),
    "=": (0, 0, 31, 0, 31, 0, 0),
    "0": (14, 17, 19, 21, 25, 17, 14),
    "1": (4, 12, 4, 4, 4, 4, 14),
    "2": (14, 17, 1, 2, 4, 8, 31),
    "3": (31, 2, 4, 2, 1, 17, 14),
    "4": (2, 6, 10, 18, 31, 2, 2),
    "5": (31, 16, 30, 1, 1, 17, 14),
    "6": (6, 8, 16, 30, 17, 17, 14),
    "7": (31, 1, 2, 4, 8, 8, 8),
    "8": (14, 17, 17, 14, 17, 17, 14),
    "9": (14, 17, 17, 15, 1, 2, 12),
    "d": (1, 1, 13, 19, 17, 17, 15),
    "e": (0, 0, 14, 17, 31, 16, 14),
    "g": (0, 15, 17, 17, 15, 1, 14),
    "h": (16, 16, 22, 25, 17, 17, 17),
    "i": (4, 0, 12, 4, 4, 4, 14),
    "l": (12, 4, 4, 4, 4, 4, 14),
    "n": (0, 0, 22, 25, 17, 17, 17),
    "o": (0, 0, 14, 17, 17, 17, 14),
    "p": (0, 0, 30, 17, 30, 16, 16),
    "r": (0, 0, 22, 25, 16, 16, 16),
    "s": (0, 0, 14, 16, 14, 1, 30),
    "t": (8, 8, 28, 8, 8, 9, 6),
    "u": (0, 0, 17, 17, 17, 19, 13),
    "w": (0, 0, 17, 17, 21, 21, 10),
    "x": (0, 0, 17, 10, 4, 10, 17),
}


def text_mask(text: str, scale: int) -> np.ndarray:
    """bool[H, W], top row first: where there is ink. Raises KeyError for other characters."""
    rows = np.array([GLYPHS[character] for character in text], dtype=np.uint8)  # [N, HEIGHT]
    bits = rows[:, :, None] >> np.arange(WIDTH - 1, -2, -1).clip(0) & 1
    bits[:, :, WIDTH] = 0  # the space between
    mask = bits.transpose(1, 0, 2).reshape(HEIGHT, -1).astype(bool)
    return mask.repeat(scale, axis=0).repeat(scale, axis=1)
