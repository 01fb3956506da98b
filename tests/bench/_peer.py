# SPDX-License-Identifier: GPL-3.0-or-later
"""What the services of other renderers share: their protocol.

A service says "ready", or "cannot: reason". Each line of stdin is a render, as JSON:
{"seconds": T, "seed": N, "output": an .npy}. The answers are JSON as well: {"samples": ...,
"seconds": ..., "cpu": ...}. It ends with stdin.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable

import _plain
import numpy as np

# Renderers print to stdout whatever they like; the answers have a pipe of their own.
_answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def load(path: str) -> _plain.PlainScene:
    """The captured scene; ends the process with "cannot: reason" if it is not plain."""
    try:
        return _plain.load(path)
    except _plain.NotPlain as reason:
        print(f"cannot: {reason}", file=_answers, flush=True)
        raise SystemExit(1) from reason


def serve(render: Callable[[float, int], tuple[np.ndarray, float, float, float]]) -> None:
    """`render(seconds, seed)` -> (picture from the bottom row up, samples, seconds, cpu)."""
    print("ready", file=_answers, flush=True)
    for line in sys.stdin:
        wanted = json.loads(line)
        picture, samples, seconds, cpu = render(wanted["seconds"], wanted["seed"])
        np.save(wanted["output"], picture)
        answer = {"samples": samples, "seconds": seconds, "cpu": cpu}
        print(json.dumps(answer), file=_answers, flush=True)
