# SPDX-License-Identifier: GPL-3.0-or-later
"""Do two ways of rendering have the same expectation?

Monte Carlo pictures of one scene differ by noise; what must agree is the mean. So each way renders
the scene with several independent seeds, the pictures are averaged over blocks of pixels, and each
block is compared by Welch's t-test: the standard error comes from the scatter between seeds. That
holds for any correlation between the samples *inside* a picture (stratified points, splats that a
light path leaves in many pixels, a filter that joins neighbours), which an error bar made from the
samples of one picture does not.

Many blocks are many chances for a false alarm. Sidak's correction keeps the chance that *any* of
the tests of a comparison fails by accident below `alpha` (family-wise), whatever the number of
blocks; tests with fixed seeds then either always pass or always fail.

A test that finds nothing proves nothing unless it could have found something, so a comparison
also carries the standard error of the relative difference of the means: callers demand that it is
small (see `Comparison.check`).

Two things to know when choosing blocks and samples. Fireflies: the t-test wants block means that
are roughly normal; a technique that finds a part of the light once in a million samples shows a
mean that is too low *and* an error bar that is too small. Large blocks, more samples per seed and
lamps that are not tiny are the cure, not a laxer alpha. Seeds: variance from n seeds has n - 1
degrees of freedom; below about 8 the tails of t are so wide that only gross errors are found.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

ALPHA = 1e-3  # family-wise chance of a false alarm in one comparison


def block_means(image: np.ndarray, size: int, mask: np.ndarray | None = None) -> np.ndarray:
    """Means over blocks of size x size pixels: [H, W, 3] -> [blocks, 3].

    Blocks at the border may be smaller. With a mask [H, W] only its pixels count, and blocks less
    than half full of them are left out; the same mask always leaves the same blocks.
    """
    height, width = image.shape[:2]
    weight = np.ones((height, width)) if mask is None else mask.astype(float)
    means = []
    for y in range(0, height, size):
        for x in range(0, width, size):
            part = weight[y : y + size, x : x + size]
            if part.sum() < 0.5 * part.size or part.sum() == 0:
                continue
            values = image[y : y + size, x : x + size, :3].astype(float)
            means.append((values * part[..., None]).sum(axis=(0, 1)) / part.sum())
    return np.array(means).reshape(-1, 3)


def welch(a: np.ndarray, b: np.ndarray, rounding: float = 1e-6) -> tuple[np.ndarray, np.ndarray]:
    """(t, two-sided p) of Welch's test for equal means; axis 0 runs over the seeds.

    Where neither side scatters at all (both black, say) p is 1 if they are equal, else 0.
    """
    n, m = len(a), len(b)
    difference = a.mean(axis=0) - b.mean(axis=0)
    va, vb = a.var(axis=0, ddof=1) / n, b.var(axis=0, ddof=1) / m
    scatter = va + vb
    scale = np.maximum(np.abs(a).mean(axis=0), np.abs(b).mean(axis=0))
    # Rounding in the mean of constants is no scatter.
    still = scatter <= (rounding * scale) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(still, 0.0, difference / np.sqrt(scatter))
        freedom = scatter**2 / (va**2 / (n - 1) + vb**2 / (m - 1))
    p = np.ones(np.shape(t))
    for index in np.ndindex(p.shape):
        if still[index]:
            p[index] = float(abs(difference[index]) <= 10.0 * rounding * scale[index])
        else:
            p[index] = student_p(float(t[index]), float(freedom[index]))
    return t, p


def student_p(t: float, freedom: float) -> float:
    """The two-sided p-value of Student's t: P(|T| >= |t|)."""
    return incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t))


def incomplete_beta(a: float, b: float, x: float) -> float:
    """The regularized incomplete beta function I_x(a, b), by Lentz's continued fraction."""
    if x <= 0.0:
        return 0.0
    if x >= 1.0:
        return 1.0
    if x > (a + 1.0) / (a + b + 2.0):  # where the fraction converges slowly
        return 1.0 - incomplete_beta(b, a, 1.0 - x)
    log_front = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
    log_front += a * math.log(x) + b * math.log1p(-x)
    tiny = 1e-300
    c, d = 1.0, 1.0 / _away_from_zero(1.0 - (a + b) * x / (a + 1.0), tiny)
    fraction = d
    for m in range(1, 500):
        even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        d = 1.0 / _away_from_zero(1.0 + even * d, tiny)
        c = _away_from_zero(1.0 + even / c, tiny)
        fraction *= d * c
        odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        d = 1.0 / _away_from_zero(1.0 + odd * d, tiny)
        c = _away_from_zero(1.0 + odd / c, tiny)
        fraction *= d * c
        if abs(d * c - 1.0) < 1e-14:
            break
    return math.exp(log_front) * fraction / a


def _away_from_zero(value: float, tiny: float) -> float:
    return value if abs(value) > tiny else tiny


def sidak(alpha: float, tests: int) -> float:
    """The level of each of `tests` tests such that one false alarm in all has chance alpha."""
    return -math.expm1(math.log1p(-alpha) / tests)


@dataclass(frozen=True)
class Comparison:
    """What `compare` found out; `str` is a report of a few lines."""

    difference: float  # of the means of everything, relative to the second: a / b - 1
    error: float  # the standard error of `difference`
    p: float  # the smallest p-value of all blocks and channels
    where: str  # what it belongs to
    t: float  # and its t
    level: float  # a p-value below it is a significant difference
    tests: int
    left_out: tuple[int, ...] = ()  # blocks that were too noisy to be tested
    blocks: np.ndarray = field(default_factory=lambda: np.zeros(0))  # of each block: a / b - 1
    errors: np.ndarray = field(default_factory=lambda: np.zeros(0))  # and its standard error

    @property
    def significant(self) -> bool:
        return self.p < self.level

    def check(self, tolerance: float, error: float | None = None) -> None:
        """Asserts that the two agree, and that a difference of `tolerance` would have shown.

        `error`: the largest standard error allowed, by default a third of the tolerance.
        """
        limit = tolerance / 3.0 if error is None else error
        assert self.error <= limit, f"too noisy to tell anything: {self}"
        assert not self.significant, f"the means differ: {self}"
        assert abs(self.difference) <= tolerance, f"the means differ: {self}"

    def check_blocks(self, tolerance: float, error: float, names: list[str] | None = None) -> None:
        """Asserts the same of every block, each of which may be `error` at most uncertain."""
        names = names or [f"block {i}" for i in range(len(self.blocks))]
        said = [
            f"{name}: {100 * a:+.2f} % +- {100 * b:.2f} %"
            for name, a, b in zip(names, self.blocks, self.errors, strict=True)
        ]
        noisy = [said[i] for i in np.flatnonzero(~(self.errors <= error))]
        assert not noisy, f"too noisy to tell anything: {noisy}"
        off = [said[i] for i in np.flatnonzero(~(np.abs(self.blocks) <= tolerance))]
        assert not off, f"the means differ: {off}"
        assert not self.significant, f"the means differ: {self}"

    def __str__(self) -> str:
        return (
            f"mean differs by {100 * self.difference:+.3f} % (standard error "
            f"{100 * self.error:.3f} %); the worst of {self.tests} tests is {self.where}: "
            f"t = {self.t:+.2f}, p = {self.p:.2g}, significant below {self.level:.2g}"
            + (f"; too noisy: blocks {self.left_out}" if self.left_out else "")
        )


def compare(
    a: list[np.ndarray],
    b: list[np.ndarray],
    block: int,
    mask: np.ndarray | None = None,
    alpha: float = ALPHA,
    noisy: float | None = None,
    dark: float = 1e-30,
    rounding: float = 1e-6,
) -> Comparison:
    """Compares the expectations of two sets of pictures, one picture per seed, [H, W, 3 or 4].

    Tests the mean over each block (all channels together) and of each channel over the whole
    picture. The seeds of all pictures must be different and the pictures of one set alike. Blocks
    whose relative standard error in `b` is above `noisy` are not tested: their means are far from
    normal. The differences of blocks darker than `dark` are relative to that. Scatter of up to
    `rounding`, relative, is none.
    """
    means_a = np.array([block_means(image, block, mask) for image in a])
    means_b = np.array([block_means(image, block, mask) for image in b])
    if not np.isfinite(means_a).all() or not np.isfinite(means_b).all():
        raise ValueError("a picture holds a value that is not finite")
    whole_a, whole_b = means_a.mean(axis=1), means_b.mean(axis=1)
    blocks_a, blocks_b = means_a.mean(axis=2), means_b.mean(axis=2)
    spread = blocks_b.std(axis=0, ddof=1) / math.sqrt(len(b))
    tested = np.full(len(spread), True)
    if noisy is not None:
        tested = spread <= noisy * blocks_b.mean(axis=0)
    series_a = np.concatenate([blocks_a[:, tested], whole_a], axis=1)
    series_b = np.concatenate([blocks_b[:, tested], whole_b], axis=1)
    t, p = welch(series_a, series_b, rounding)
    worst = int(p.argmin())
    names = [f"block {i}" for i in np.flatnonzero(tested)] + ["all red", "all green", "all blue"]
    level = np.maximum(blocks_b.mean(axis=0), dark)
    scatters = blocks_a.var(axis=0, ddof=1) / len(a) + blocks_b.var(axis=0, ddof=1) / len(b)
    total_a, total_b = whole_a.mean(axis=1), whole_b.mean(axis=1)
    scatter = total_a.var(ddof=1) / len(a) + total_b.var(ddof=1) / len(b)
    reference = total_b.mean()
    ratio = series_a.mean(axis=0)[worst] / max(series_b.mean(axis=0)[worst], 1e-30) - 1.0
    return Comparison(
        difference=float(total_a.mean() / reference - 1.0),
        error=float(math.sqrt(scatter) / reference),
        p=float(p[worst]),
        where=f"{names[worst]} ({100 * ratio:+.2f} %)",
        t=float(t[worst]),
        level=sidak(alpha, len(p)),
        tests=len(p),
        left_out=tuple(int(i) for i in np.flatnonzero(~tested)),
        blocks=(blocks_a.mean(axis=0) - blocks_b.mean(axis=0)) / level,
        errors=np.sqrt(scatters) / level,
    )
