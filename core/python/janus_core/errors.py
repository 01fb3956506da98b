# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a picture is from a better one. Pictures are [H, W, 3], linear.

Whoever compares renderers by these numbers should say which one it is: relMSE weighs dark and
bright pixels alike, RMSE is what the brightest pixels say.
"""

from __future__ import annotations

import numpy as np

__all__ = ["relative_error", "root_mean_square", "squared_errors", "trimmed_error"]

EPSILON, DROPPED = 0.01, 0.001


def root_mean_square(picture: np.ndarray, reference: np.ndarray) -> float:
    """RMSE: the root of the mean over pixels and channels of (x - r)^2, in the pictures' unit."""
    difference = np.asarray(picture, dtype=np.float64) - reference
    return float(np.sqrt(np.mean(difference**2)))


def squared_errors(
    picture: np.ndarray, reference: np.ndarray, scale: np.ndarray | None = None
) -> np.ndarray:
    """Per pixel (x - r)^2 / (r^2 + 0.01 m^2), the mean over channels; m: mean of the reference.

    That is the usual relMSE with an epsilon of 0.01, for a picture exposed to a mean of 1.
    `scale` stands for r in the denominator.
    """
    scale = reference if scale is None else scale
    epsilon = EPSILON * scale.mean() ** 2
    return np.mean((picture - reference) ** 2 / (scale**2 + epsilon), axis=2)


def relative_error(*pictures: np.ndarray) -> float:
    """relMSE: the mean of squared_errors()."""
    return float(squared_errors(*pictures).mean())


def trimmed_error(*pictures: np.ndarray) -> float:
    """The same without the thousandth of the pixels where it is largest.

    A single path that is found by chance alone (a caustic seen in a mirror) can be larger than
    all other errors together, and tells who was lucky. But neither does this see all the light
    that an engine is missing, if it has it in few pixels.
    """
    errors = np.sort(squared_errors(*pictures), axis=None)
    return float(errors[: len(errors) - round(DROPPED * len(errors))].mean())
