# SPDX-License-Identifier: GPL-3.0-or-later
"""The strategy pyramid on one sheet: a row for each path length, a column for each s.

Plain arrays, top row first. The pictures are scene linear and go through the scene's view transform
before the labels are drawn, which must be readable whatever that is.
"""

from dataclasses import dataclass, field

import numpy as np

from ..sync.passes import LONGER, strategies, strategy_name
from .glyphs import ADVANCE, HEIGHT, text_mask

TILE = 160  # pixels: about the width of a tile
GAP = 12
SCALE = 2  # of the glyphs
LINE = (HEIGHT + 4) * SCALE
MARGIN = GAP + ADVANCE * len("12 edges") * SCALE + GAP
PAPER, INK = 0.13, 0.85  # display values
HEADINGS = (("weighted", "weighted"), ("alone", "unweighted"))


@dataclass
class Sheet:
    """Where everything is. `picture` is float32[H, W, 3], and black between the tiles."""

    picture: np.ndarray
    tiles: list[tuple[int, int, int, int]] = field(default_factory=list)  # x, y, width, height
    texts: list[tuple[int, int, str]] = field(default_factory=list)  # x, y of the top left

    def place(self, x: int, y: int, label: str, pixels: np.ndarray) -> None:
        height, width = pixels.shape[:2]
        self.texts.append((x, y, label))
        self.picture[y + LINE : y + LINE + height, x : x + width] = pixels
        self.tiles.append((x, y + LINE, width, height))


def lay_out(passes: dict[str, np.ndarray], exposure: float = 0.0) -> Sheet:
    """`passes` are float32[H, W, 3], bottom row first, by name. `exposure`, in stops, brightens all
    tiles alike, and the sheet says so: their sum is the picture only as they are."""
    small = {
        name: fit(pixels[::-1]) * np.float32(2.0**exposure)
        for name, pixels in passes.items()
        if name == LONGER or name.endswith(tuple(kind for kind, _ in HEADINGS))
    }
    height, width = next(iter(small.values())).shape[:2]
    length = longest(small)
    column = max(width, ADVANCE * len("s=0 t=0") * SCALE) + GAP
    pyramid = column * (length + 1) + GAP
    row = LINE + height + GAP
    top = GAP + LINE
    size = (top + row * (length + (LONGER in small)), MARGIN + 2 * pyramid - GAP)
    sheet = Sheet(np.zeros((*size, 3), dtype=np.float32))
    for number, (kind, heading) in enumerate(HEADINGS):
        left = MARGIN + number * pyramid
        note = f"  exposure {exposure:+.1f}" if exposure else ""
        sheet.texts.append((left, GAP, heading + note))
        for s, t in strategies(length):
            name = strategy_name(s, t, kind)
            if name in small:
                y = top + row * (s + t - 2)
                sheet.place(left + column * s, y, f"s={s} t={t}", small[name])
    for edges in range(1, length + 1):
        label = f"{edges} edge" + "s" * (edges > 1)
        sheet.texts.append((GAP, top + row * (edges - 1) + LINE, label))
    if LONGER in small:
        sheet.place(MARGIN, top + row * length, "longer", small[LONGER])
    return sheet


def label(sheet: Sheet, display: np.ndarray) -> np.ndarray:
    """The finished sheet from `display`, its picture after the view transform, float32[H, W, 3]."""
    result = np.full_like(display, PAPER)
    for x, y, width, height in sheet.tiles:
        place = (slice(y, y + height), slice(x, x + width))
        result[place] = display[place]
    for x, y, text in sheet.texts:
        mask = text_mask(text, SCALE)[:, : result.shape[1] - x]
        result[y : y + mask.shape[0], x : x + mask.shape[1]][mask] = INK
    return result


def longest(names) -> int:
    """Number of edges of the longest paths that have a picture among these passes."""
    length = 0
    while any(
        strategy_name(s, length + 2 - s, kind) in names
        for s in range(length + 2)
        for kind, _ in HEADINGS
    ):
        length += 1
    return length


def fit(pixels: np.ndarray) -> np.ndarray:
    """The picture at about the width of a tile, by whole numbers: means, or repeated pixels."""
    height, width = pixels.shape[:2]
    if width <= TILE:
        factor = max(TILE // width, 1)
        return pixels.repeat(factor, axis=0).repeat(factor, axis=1)
    factor = -(-width // TILE)
    rows, columns = (np.arange(0, size, factor) for size in (height, width))
    sums = np.add.reduceat(np.add.reduceat(pixels, rows, axis=0), columns, axis=1)
    counts = np.add.reduceat(np.ones(height), rows)[:, None] * np.add.reduceat(
        np.ones(width), columns
    )
    return (sums / counts[:, :, None]).astype(np.float32)
