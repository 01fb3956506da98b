# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of ways to render, against a reference, at equal samples and at equal time.

Everything that is compared alternates, in one process with the same threads, and has a seed of its
own: a machine is never quiet, and no two pictures share a sample.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import janus_core
import numpy as np
from janus_core.errors import relative_error, root_mean_square, trimmed_error

from scenes.driver.arguments import SCENES
from scenes.gallery.stage import Shot, Stage

FIRST_SEED, REFERENCE_SEED, CURVE_SEED = 1000, 9000, 5000
CURVE = ("samples", "time", "seconds", "cpu", "relmse", "trimmed")
PARTS = 4  # that a reference is the mean of
SEEDS_OF_ONE = 100  # kept apart for each way to render

Say = Callable[[str], None]
Settings = Mapping[str, object]


@dataclass
class Reference:
    """`own`: the relMSE that it has itself, estimated from its parts.

    `other`: relMSE of a path tracer's picture of the same time against it, and `other_own`, that
    picture's own error: if both are unbiased, the former is about the sum of the two own errors.
    """

    picture: np.ndarray
    own: float
    other: float | None
    other_own: float | None


def reference(
    stage: Stage, how: Settings, second: Settings | None, seconds: float, path: Path, say: Say
) -> Reference:
    """The mean of renders `how` with seeds of their own, `seconds` together; kept in the file.

    `second`: another way to render the same, as a second opinion, of the same time again.
    """
    if path.exists():
        with np.load(path) as file:
            parts, others = file["parts"], file["others"]
    else:
        say("reference")
        parts, others = (
            np.array(
                [
                    stage.shoot(**way, seconds=seconds / PARTS, seed=first + part).picture
                    for part in range(PARTS)
                ]
            )
            if way is not None
            else np.zeros(0)
            for first, way in ((REFERENCE_SEED, how), (REFERENCE_SEED + PARTS, second))
        )
        path.parent.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(path, parts=parts, others=others)
    picture = parts.mean(axis=0)
    own = own_error(parts)
    if not len(others):
        return Reference(picture, own, None, None)
    other = relative_error(others.mean(axis=0), picture)
    return Reference(picture, own, other, own_error(others))


def own_error(parts: np.ndarray) -> float:
    """relMSE of the mean of independent pictures, [N, H, W, 3], from what lies between them.

    Relative to their median: a single path that one of them found by chance would otherwise hide
    its error behind its own brightness.
    """
    count = len(parts)
    scale = np.median(parts, axis=0)
    spread = [relative_error(part - parts.mean(axis=0), np.zeros_like(part), scale)
              for part in parts]  # fmt: skip
    return float(np.sum(spread)) / (count * (count - 1))


def reference_path(folder: Path, scene: str, *settings: object) -> Path:
    """A name that changes with all that a reference depends on."""
    code = b"".join((SCENES / f"{name}.py").read_bytes() for name in (scene, "kit", "props"))
    text = repr((janus_core.__version__, settings)).encode() + code
    return folder / f"{scene}-{hashlib.sha256(text).hexdigest()[:12]}.npz"


def alternate(
    stage: Stage, ways: Mapping[str, Settings], seeds: int, group: int, say: Say, **common: object
) -> dict[str, list[Shot]]:
    """By name, renders of each way with `seeds` seeds, in turns. `group` keeps seeds apart."""
    shots: dict[str, list[Shot]] = {name: [] for name in ways}
    for turn in range(seeds):
        say(f"{_what(common)}, round {turn + 1} of {seeds}")
        for number, (name, way) in enumerate(ways.items()):
            seed = FIRST_SEED * (group + 1) + SEEDS_OF_ONE * number + turn
            shots[name].append(stage.shoot(**{**way, **common}, seed=seed))
    return shots


def _what(common: Settings) -> str:
    if common.get("seconds"):
        return f"{common['seconds']:g} s each"
    return f"{common['samples']} paths per pixel"


def errors(shots: list[Shot], reference: np.ndarray) -> dict:
    """What the pictures are from the reference, as means over them, and what they took.

    RMSE is the root of the mean square over all of them. `relmse_error`: the standard error of
    relmse; None of one picture alone. `brightness`: mean of all pixels beside the reference's.
    """
    relative = [relative_error(shot.picture, reference) for shot in shots]
    squares = [root_mean_square(shot.picture, reference) ** 2 for shot in shots]
    count = len(shots)
    spread = float(np.std(relative, ddof=1)) / math.sqrt(count) if count > 1 else None
    return {
        "rmse": math.sqrt(np.mean(squares)),
        "relmse": float(np.mean(relative)),
        "relmse_error": spread,
        "trimmed": float(np.mean([trimmed_error(shot.picture, reference) for shot in shots])),
        "brightness": float(np.mean([s.picture.mean() for s in shots]) / reference.mean()),
        **cost(shots),
    }


def cost(shots: list[Shot]) -> dict:
    """Means over the renders; `time` by the clock that was chosen, `seconds` of the wall, `cpu` of
    all processors together."""
    return {
        "samples": float(np.mean([shot.samples for shot in shots])),
        "time": float(np.mean([shot.time for shot in shots])),
        "seconds": float(np.mean([shot.seconds for shot in shots])),
        "cpu": float(np.mean([shot.cpu for shot in shots])),
    }


def curve(
    stage: Stage, ways: Mapping[str, Settings], most: float, reference: np.ndarray, say: Say
) -> dict[str, list[dict]]:
    """By name, errors and costs of 1, 2, 4, ... samples, up to about `most` seconds."""
    say("error over time")
    points: dict[str, list[dict]] = {name: [] for name in ways}
    for step in range(20):
        for number, (name, way) in enumerate(ways.items()):
            # The next one takes twice as long.
            if points[name] and 2.0 * points[name][-1]["time"] > 1.2 * most:
                continue
            seed = CURVE_SEED + SEEDS_OF_ONE * number + step
            shot = stage.shoot(**way, samples=1 << step, seconds=0.0, seed=seed)
            found = errors([shot], reference)
            points[name].append({key: found[key] for key in CURVE})
    return points
