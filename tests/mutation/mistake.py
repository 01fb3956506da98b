# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mistake is: changes to the source, and the tests that are expected to notice.

An edit's `old` text must be found exactly once in its file, with any white space where it has some.
Keep it short, so that it survives what happens around it. `number` is that of the checklist of
classic mistakes in the design notes; `tests` is a filter of GoogleTest. `long` runs them with the
sample counts of `./dev test --full`.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Edit:
    file: str
    old: str
    new: str


@dataclass(frozen=True)
class Mistake:
    name: str
    number: int  # 0: not in the checklist
    what: str
    tests: str
    edits: tuple[Edit, ...]
    long: bool = False


def one(
    name: str, number: int, what: str, tests: str, file: str, old: str, new: str, long: bool = False
) -> Mistake:
    return Mistake(name, number, what, tests, (Edit(file, old, new),), long)
