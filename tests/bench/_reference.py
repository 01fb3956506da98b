# SPDX-License-Identifier: GPL-3.0-or-later
"""Long renders that errors are measured against, with estimates of their own errors, on disk.

Each of three renderers makes two pictures with seeds of their own. Half their difference is as
large as the error of their mean, so that its relMSE is known without a better picture.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from _measure import ROOT
from janus_core.errors import relative_error, trimmed_error

FOLDER = ROOT / "build" / "bench-references"
KINDS = ("pt", "cycles", "bdpt")
# Squared differences have long tails: two pictures that differ by twice what their errors say
# still agree.
AGREE = 2.0


@dataclass
class Reference:
    picture: np.ndarray
    kind: str  # who made it
    error: float  # its own relMSE
    good: bool  # whether that is at most a tenth of what is measured


class References:
    """The pictures of one scene. `missing` says whether they have to be made (`add`) and saved."""

    def __init__(self, scene: str, settings: dict) -> None:
        code = [ROOT / "scenes" / f"{name}.py" for name in (scene, "kit", "props")]
        text = repr(sorted(settings.items())).encode() + b"".join(p.read_bytes() for p in code)
        self._path = FOLDER / f"{scene}-{hashlib.sha256(text).hexdigest()[:12]}.npz"
        self._halves: dict[str, np.ndarray] = {}
        self.missing = not self._path.exists()
        if not self.missing:
            with np.load(self._path) as file:
                self._halves = {kind: file[kind] for kind in KINDS}

    def add(self, kind: str, halves: list[np.ndarray]) -> None:
        self._halves[kind] = np.array(halves, dtype=np.float64)

    def save(self) -> None:
        FOLDER.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(self._path, **self._halves)
        self.missing = False

    def picture(self, kind: str) -> np.ndarray:
        return self._halves[kind].mean(axis=0)

    def error(self, kind: str, of: Callable[..., float] = relative_error) -> float:
        first, second = self._halves[kind]
        return of((first - second) / 2, np.zeros_like(first), self._scale())

    def differ(self, one: str, other: str) -> tuple[float, float]:
        """(trimmed error between two renderers' pictures, what their own explain of it)."""
        seen = trimmed_error(self.picture(one), self.picture(other), self._scale())
        return seen, sum(self.error(kind, trimmed_error) for kind in (one, other))

    def _scale(self) -> np.ndarray:
        """The brightness of pixels, without what only one of the renderers found by chance."""
        return np.median([self.picture(kind) for kind in KINDS], axis=0)

    def agree(self, one: str, other: str) -> bool:
        seen, expected = self.differ(one, other)
        return seen <= AGREE * expected

    def choose(self, measured: Callable[[np.ndarray, Callable[..., float]], float]) -> Reference:
        """pt and Cycles together if all three agree and they are good enough, otherwise bdpt.

        `measured(picture, of)` is the smallest error `of` that is to be measured against a picture.
        Good are those whose own error is a tenth of that, with and without the largest errors:
        where these are fireflies of the reference itself, they are in both sides of the first.
        """
        metrics = (relative_error, trimmed_error)

        def reference(picture: np.ndarray, kind: str, errors: list[float]) -> Reference:
            limits = [0.1 * measured(picture, of) for of in metrics]
            good = all(error <= limit for error, limit in zip(errors, limits, strict=True))
            return Reference(picture, kind, errors[0], good)

        weights = {kind: 1.0 / max(self.error(kind), 1e-12) for kind in ("pt", "cycles")}
        total = sum(weights.values())
        shares = {kind: weight / total for kind, weight in weights.items()}
        both = sum(self.picture(kind) * share for kind, share in shares.items())
        errors = [sum(self.error(k, of) * w**2 for k, w in shares.items()) for of in metrics]
        found = reference(both, "pt + Cycles", errors)
        # Both can miss the same light in both halves, and know nothing of it; bdpt makes all paths
        # that they make.
        pairs = (("pt", "cycles"), ("bdpt", "pt"), ("bdpt", "cycles"))
        if found.good and all(self.agree(*pair) for pair in pairs):
            return found
        own = [self.error("bdpt", of) for of in metrics]
        return reference(self.picture("bdpt"), "bdpt", own)
