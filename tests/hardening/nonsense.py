# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments as nobody would give them on purpose, by a seed."""

from __future__ import annotations

import random

import numpy as np

HUGE = 1 << 16
NUMBERS = (
    *(0, 1, -1, 2, 3, 7, 64, 1023, 1 << 16, 1 << 31, (1 << 31) - 1, 1 << 32, 1 << 63, -(1 << 63)),
    *(10**40, -(10**40), 0.0, -0.0, 0.5, -0.5, 1.5, 1e-45, 1e-38, 1e-6, 1e6, -1e6, 1e20, -1e20),
    *(3e38, -3e38, 1e39, 1e300, -1e300, float("inf"), float("-inf"), float("nan")),
    *(True, False, np.float32(2.0), np.float16(1.0), np.int64(-3), np.uint8(255), 1j),
)
WORDS = (
    *("", " ", "m", "mesh", "floor", "lamp", "Lamp", "sky", "POINT", "MESH", "bdpt", "BOX", "x.y"),
    *("Combined", "Depth", "LS+DE", "L(", "0,*", "2,3 1,*", "NONE", "Object", "normal", "color:"),
    *("uv:", "\0", "a\0b", "ä€😀", "\ud800", "x" * 10_000, "%s%n", "../../x", "nan", "(" * 5000),
)
DTYPES = ("f4", "f8", "f2", "i4", "i8", "u1", "u4", "u8", "?", "c8", "O", "U3", "S2", "M8[s]")
SHAPES = (
    *((), (0,), (1,), (2,), (3,), (4,), (5,), (0, 3), (1, 3), (2, 3), (4, 3), (6, 3), (3, 4)),
    *((4, 4), (2, 4, 4), (2, 4, 3), (3, 4, 3), (0, 4, 4), (2, 2, 3), (2, 2, 4), (1, 1, 5), (7, 2)),
    *((2, 0, 3), (0, 0, 3), (1, 1, 1, 1)),
)


class Nonsense:
    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self._numbers = np.random.default_rng(seed)

    def value(self):
        """Anything."""
        return self.random.choice(
            (self.number, self.word, self.array, self.array, self.sequence, self.other)
        )()

    def number(self):
        return self.random.choice(NUMBERS)

    def word(self) -> str:
        return self.random.choice(WORDS)

    def other(self):
        choices = (None, object(), int, b"bytes", {}, {"link": ["a", "b"]}, {1: 2}, {"nodes": 3})
        return self.random.choice((*choices, range(3), {1, 2}, Odd(), lambda: 1))

    def sequence(self, depth: int = 0):
        items = [
            self.sequence(depth + 1)
            if depth < 2 and self.random.random() < 0.2
            else self.random.choice((self.number, self.number, self.word, self.other))()
            for _ in range(self.random.randint(0, 6))
        ]
        return self.random.choice((list, tuple))(items)

    def array(self):
        shape = self.random.choice(SHAPES)
        if self.random.random() < 0.05:  # takes no memory until someone copies it
            shape = self.random.choice(((HUGE, HUGE, 4), (1 << 40, 3), (1 << 40,), (1 << 20, 4, 4)))
            return np.broadcast_to(np.zeros((), dtype=self.random.choice(("f4", "i4"))), shape)
        scale = self.random.choice((1.0, 4.0, 1e6, 1e30))
        made = np.asarray(self._numbers.normal(size=shape) * scale)
        kind = self.random.choice(DTYPES)
        with np.errstate(all="ignore"):
            made = made.astype("i8").astype(kind) if kind[0] == "M" else made.astype(kind)
        if made.size and made.dtype.kind == "f" and self.random.random() < 0.3:
            made.flat[self.random.randrange(made.size)] = self.random.choice(
                (np.nan, np.inf, -np.inf)
            )
        return self.random.choice((made, made, made[::-1] if made.ndim else made, made.T))

    def disturbed(self, good: dict) -> dict:
        """Good arguments, of which some are wrong, missing or too many."""
        result = dict(good)
        for _ in range(self.random.choice((0, 0, 0, 1, 1, 1, 2, 4))):
            name = self.random.choice(list(good))
            result[name] = self.like(good[name]) if self.random.random() < 0.5 else self.value()
        if self.random.random() < 0.03 and result:
            del result[self.random.choice(list(result))]
        if self.random.random() < 0.02:
            result["no_such_argument"] = 1
        return result

    def like(self, good):
        """What is wrong in its value, not in its kind."""
        if isinstance(good, bool):
            return not good
        if isinstance(good, int | float):
            return self.number()
        if isinstance(good, str):
            return self.word()
        if isinstance(good, np.ndarray) and good.size:
            made = good.copy()
            with np.errstate(all="ignore"):
                wild = np.float64(self.random.choice([x for x in NUMBERS if isinstance(x, float)]))
                made.flat[self.random.randrange(made.size)] = wild.astype(made.dtype)
            return made
        if isinstance(good, list | tuple) and good:
            made = list(good)
            made[self.random.randrange(len(made))] = self.random.choice((self.number, self.word))()
            return made
        if isinstance(good, dict) and good:
            made = dict(good)
            made[self.random.choice(list(made))] = self.value()
            return made
        return self.value()


class Odd:
    """Answers every question with an error."""

    def __float__(self):
        raise ValueError("no float")

    def __len__(self):
        raise ValueError("no length")

    def __getitem__(self, item):
        raise ValueError("no items")

    def __str__(self):
        raise ValueError("no text")
