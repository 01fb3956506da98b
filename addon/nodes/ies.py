# SPDX-License-Identifier: GPL-3.0-or-later
"""Photometric files (IES LM-63): how bright a luminaire is in each direction.

Read as forgivingly as Cycles does, and brought to its one form: horizontal angles around the beam
and vertical ones from it, in radians.
"""

import re

import numpy as np

# Watts for a candela of white light (D65 has 177.83 lumens for a watt), all around.
WATTS_PER_CANDELA = 0.0706650768394
TYPE_C, TYPE_B, TYPE_A = 1, 2, 3
INTEGER = re.compile(r"\s*([+-]?\d+)")
NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)")


class IesError(Exception):
    """Why a text is no photometric file."""


def parse_ies(text: str) -> list[float]:
    """The numbers of horizontal and of vertical angles, these angles, and for each horizontal one a
    row of intensities.
    """
    photometry, vertical, horizontal, rows = _read(text)
    if not vertical or not horizontal:
        raise IesError("it has no angles")
    with np.errstate(over="ignore"):
        vertical, horizontal, rows = (
            np.array(x, dtype=np.float32) for x in (vertical, horizontal, rows)
        )
    if not all(np.isfinite(x).all() for x in (vertical, horizontal, rows)):
        raise IesError("a number is out of range")
    if photometry == TYPE_A:
        vertical, horizontal, rows = _type_a(vertical, horizontal, rows)
    elif photometry == TYPE_B:
        vertical, horizontal, rows = _type_b(vertical, horizontal, rows)
    else:
        horizontal, rows = _type_c(horizontal, rows)
    degree = np.float32(np.pi) / np.float32(180.0)
    numbers = [np.float32([len(horizontal), len(vertical)]), horizontal * degree]
    return np.concatenate([*numbers, vertical * degree, rows.ravel()]).tolist()


class _Scanner:
    """Numbers one after the other, wherever lines end."""

    def __init__(self, text: str, at: int):
        self._text, self._at = text, at

    def integer(self, what: str) -> int:
        return int(self._next(INTEGER, what))

    def number(self, what: str = "a number") -> float:
        return float(self._next(NUMBER, what))

    def count(self, what: str) -> int:
        found = self.integer(what)
        if not 0 <= found <= len(self._text):
            raise IesError(f"{what} is {found}")
        return found

    def numbers(self, count: int, what: str) -> list[float]:
        return [self.number(what) for _ in range(count)]

    def next_line(self) -> None:
        end = self._text.find("\n", self._at)
        if end < 0:
            raise IesError("it ends after TILT")
        self._at = end + 1

    def _next(self, pattern, what: str) -> str:
        found = pattern.match(self._text, self._at)
        if found is None:
            raise IesError(f"{what} is missing")
        self._at = found.end()
        return found[1]


def _read(text: str):
    """The type of photometry, the angles in degrees, and the intensities, by rows."""
    text = text.replace(",", " ")
    tilt = text.find("\nTILT=")
    if tilt < 0:
        raise IesError("there is no line of TILT")
    if text.startswith("INCLUDE", tilt + 6):
        scanner = _Scanner(text, tilt + 13)
        scanner.number("the geometry of its tilt")
        scanner.numbers(2 * scanner.count("the number of its tilts"), "a tilt")
    else:
        scanner = _Scanner(text, tilt + 1)
        scanner.next_line()
    scanner.integer("the number of lamps")
    scanner.number("the lumens per lamp")
    factor = scanner.number("its multiplier")
    v_count = scanner.count("the number of vertical angles")
    h_count = scanner.count("the number of horizontal angles")
    photometry = scanner.integer("the photometric type")
    if photometry not in (TYPE_A, TYPE_B, TYPE_C):
        raise IesError(f"the photometric type is {photometry}")
    scanner.integer("the unit of its size")
    scanner.numbers(3, "its size")
    factor *= scanner.number("its ballast factor") * scanner.number("its photometric factor")
    scanner.number("its input watts")
    vertical = scanner.numbers(v_count, "a vertical angle")
    horizontal = scanner.numbers(h_count, "a horizontal angle")
    factor *= WATTS_PER_CANDELA
    rows = [[factor * x for x in scanner.numbers(v_count, "an intensity")] for _ in range(h_count)]
    return photometry, vertical, horizontal, rows


def _close(a, b) -> bool:
    return abs(a - b) < 1e-4


def _joined(first, second):
    return np.concatenate([first, second]).astype(np.float32)


def _type_a(vertical, horizontal, rows):
    """From -90 to 90 degrees across, which are 270 to 90 around; where half is there, mirrored."""
    around, turned = 180.0 - horizontal[::-1], rows[::-1]
    if _close(horizontal[0], 0.0):
        around, turned = _joined(around, 180.0 + horizontal[1:]), _joined(turned, rows[1:])
    return vertical + 90.0, around, turned


def _type_b(vertical, horizontal, rows):
    """The axis lies across: what is vertical becomes horizontal, as the lamp can be turned."""
    vertical, horizontal, rows = horizontal, vertical, rows.T
    if _close(horizontal[0], 0.0):
        horizontal = _joined(-horizontal[:0:-1], horizontal)
        rows = _joined(rows[:0:-1], rows)
    if _close(vertical[0], 0.0):
        vertical = _joined(-vertical[:0:-1], vertical)
        rows = np.concatenate([rows[:, :0:-1], rows], axis=1)
    return vertical + 90.0, horizontal + 90.0, rows


def _type_c(horizontal, rows):
    """A quarter and a half are mirrored; what is the same all around is there twice."""
    if _close(horizontal[0], 90.0):
        horizontal = horizontal - 90.0
    if len(horizontal) == 1:
        horizontal, rows = np.float32([0.0, 360.0]), np.concatenate([rows, rows])
    for end in (90.0, 180.0):
        if _close(horizontal[-1], end):
            horizontal = _joined(horizontal, 2.0 * end - horizontal[-2::-1])
            rows = _joined(rows, rows[-2::-1])
    last = horizontal[-1]
    if _close(horizontal[0], 0.0) and not _close(last, 360.0):
        steps = (last - horizontal[-2], horizontal[1] - horizontal[0])
        if any(_close(step, 360.0 - last) for step in steps):  # the last one was left out
            horizontal, rows = _joined(horizontal, [360.0]), _joined(rows, rows[:1])
    return horizontal, rows
