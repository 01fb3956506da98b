# SPDX-License-Identifier: GPL-3.0-or-later
"""Error over time as an SVG drawing, both axes logarithmic."""

from __future__ import annotations

import math
from html import escape

WIDTH, HEIGHT = 560, 300
LEFT, RIGHT, TOP, BOTTOM = 52, 180, 24, 40  # margins; names of curves are on the right
NAME_HEIGHT = 15


def draw(curves: dict[str, list[tuple[float, float]]]) -> str:
    """`curves`: by name, points of seconds and trimmed relMSE; what is 0 is left out."""
    points = [point for curve in curves.values() for point in curve if point[0] > 0 < point[1]]
    if not points:
        return ""
    x0, x1 = _decades([point[0] for point in points])
    y0, y1 = _decades([point[1] for point in points])

    def place(seconds: float, error: float) -> tuple[float, float]:
        x = LEFT + (math.log10(seconds) - x0) / (x1 - x0) * (WIDTH - LEFT - RIGHT)
        y = TOP + (y1 - math.log10(error)) / (y1 - y0) * (HEIGHT - TOP - BOTTOM)
        return round(x, 1), round(y, 1)

    parts = []
    for power in range(math.ceil(x0), math.floor(x1) + 1):
        x, _ = place(10.0**power, 10.0**y0)
        parts.append(f'<line class="grid" x1="{x}" x2="{x}" y1="{TOP}" y2="{HEIGHT - BOTTOM}"/>')
        parts.append(_text(x, HEIGHT - BOTTOM + 16, f"{10.0**power:g} s", "middle"))
    for power in range(math.ceil(y0), math.floor(y1) + 1):
        _, y = place(10.0**x0, 10.0**power)
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y}" y2="{y}"/>')
        parts.append(_text(LEFT - 6, y + 4, f"{10.0**power:g}", "end"))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 6, "time of the render", "middle"))
    parts.append(_text(LEFT, TOP - 10, "relMSE, trimmed", "start"))

    names = []  # [y, number, name]
    for number, (name, curve) in enumerate(curves.items()):
        line = [place(*point) for point in curve if point[0] > 0 < point[1]]
        if not line:
            continue
        path = " ".join(f"{'L' if i else 'M'}{x} {y}" for i, (x, y) in enumerate(line))
        dots = "".join(f'<circle cx="{x}" cy="{y}" r="3"/>' for x, y in line)
        parts.append(f'<g class="k{number}"><path d="{path}"/>{dots}</g>')
        names.append([line[-1][1], number, name])
    names.sort()
    for before, after in zip(names, names[1:], strict=False):
        after[0] = max(after[0], before[0] + NAME_HEIGHT)  # one above the other
    for y, number, name in names:
        named = _text(WIDTH - RIGHT + 8, y + 4, name, "start", ' class="name"')
        parts.append(f'<g class="k{number}">{named}</g>')
    title = "Error over time: " + ", ".join(curves)
    return (
        f'<svg class="curve" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="{escape(title, quote=True)}">' + "".join(parts) + "</svg>"
    )


def _decades(values: list[float]) -> tuple[float, float]:
    """Logarithms of a range around the values that has a power of ten, at least, in it."""
    low, high = math.log10(min(values)), math.log10(max(values))
    return low - 0.08 if low - math.floor(low) > 0.3 else math.floor(low) - 0.02, high + 0.08


def _text(x: float, y: float, text: str, anchor: str, more: str = "") -> str:
    return f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}"{more}>{escape(text)}</text>'
