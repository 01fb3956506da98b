# SPDX-License-Identifier: GPL-3.0-or-later
"""Photometric files of every type and symmetry, small and uneven, and broken ones."""

from __future__ import annotations

import itertools

HEAD = "IESNA:LM-63-2002\n[TEST] uneven\n[MANUFAC] none, really\n"


def ies(kind: int, vertical, horizontal, tilt="TILT=NONE", factor=1.0) -> str:
    """`kind`: 1 is C, 2 is B, 3 is A."""
    numbers = itertools.cycle((900, 700, 950, 300, 520, 80, 610, 40, 330, 150, 720))
    rows = [" ".join(str(next(numbers)) for _ in vertical) for _ in horizontal]
    counts = f"{len(vertical)} {len(horizontal)}"
    size = f"1 1000 {factor} {counts} {kind} 2 0.1,0.2,0.3\n1.0 0.9 60\n"
    angles = [" ".join(f"{x:g}" for x in v) for v in (vertical, horizontal)]
    return "\n".join([HEAD + tilt, size, *angles, *rows, ""])


DOWN, FULL = (0, 10, 25, 45, 70, 90), (0, 20, 50, 90, 130, 180)
TEXTS = {
    "C around": ies(1, DOWN, (0,)),
    "C quarter": ies(1, FULL, (0, 20, 55, 90)),
    "C half": ies(1, FULL, (0, 40, 95, 140, 180)),
    "C whole": ies(1, FULL, (0, 70, 160, 240, 310, 360)),
    "C turned half": ies(1, DOWN, (90, 130, 180, 230, 270)),
    "C up": ies(1, (90, 120, 150, 180), (0, 90, 180, 270, 360)),
    "C without 360": ies(1, FULL, (0, 60, 120, 180, 240, 300)),
    "C with a gap": ies(1, FULL, (0, 60, 120, 200, 240)),
    "C part": ies(1, (20, 40, 60), (10, 100, 200)),
    "B half": ies(2, (0, 15, 40, 90), (0, 30, 60, 90)),
    "B whole": ies(2, (-90, -30, 0, 50, 90), (-90, -40, 10, 90)),
    "B mixed": ies(2, (-90, -30, 0, 50, 90), (0, 40, 90)),
    "A half": ies(3, (-90, -40, 0, 30, 90), (0, 30, 60, 90)),
    "A whole": ies(3, (-90, -40, 0, 30, 90), (-90, -20, 0, 50, 90)),
    "A up": ies(3, (0, 30, 90), (0, 45, 90)),
    "tilted": ies(1, FULL, (0, 40, 90), tilt="TILT=INCLUDE\n1\n3\n0 45 90\n1.0 0.9 0.8"),
    "brighter": ies(1, FULL, (0, 40, 90), factor=2.5),
}
BROKEN = {
    "empty": "",
    "no tilt": HEAD + "1 1000 1\n",
    "ends early": ies(1, FULL, (0, 40, 90))[:-30],
    "type 4": ies(4, FULL, (0, 40, 90)),
    "no angles": ies(1, (), ()),
    "words": ies(1, FULL, (0, 40, 90)).replace("1000", "many"),
    "ends at tilt": HEAD + "TILT=NONE",
}
