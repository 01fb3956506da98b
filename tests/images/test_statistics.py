# SPDX-License-Identifier: GPL-3.0-or-later
"""The statistics can tell: they stay quiet without a bias and find a small one."""

import math

import numpy as np
import pytest

from .statistics import block_means, compare, sidak, student_p, welch

SHAPE = (40, 64, 3)
SEEDS = 12


def pictures(rng, bias=1.0, where=slice(None), noise=0.3, seeds=SEEDS):
    """Pictures with skewed, positive noise, like that of a path tracer."""
    y, x, _ = np.indices(SHAPE)
    expectation = 0.2 + 0.01 * x + 0.005 * y
    expectation[:, where] *= bias
    shape = 1.0 / noise**2
    return [expectation * rng.gamma(shape, 1.0 / shape, SHAPE) for _ in range(seeds)]


@pytest.mark.parametrize(
    ("t", "freedom", "p"),
    # From tables of Student's t and closed forms (1 and 2 degrees of freedom).
    [
        (0.0, 5.0, 1.0),
        (1.0, 1.0, 0.5),
        (math.sqrt(2.0), 2.0, 1.0 - math.sqrt(0.5)),
        (2.228, 10.0, 0.05),
        (4.587, 10.0, 0.001),
        (-3.883, 200000.0, 1.032e-4),
    ],
)
def test_student(t, freedom, p):
    assert student_p(t, freedom) == pytest.approx(p, rel=2e-3)


def test_sidak():
    assert sidak(0.01, 1) == pytest.approx(0.01)
    assert 1.0 - (1.0 - sidak(0.01, 40)) ** 40 == pytest.approx(0.01)


def test_block_means_respect_border_and_mask():
    image = np.zeros((5, 6, 4))
    image[:, 4:, 0] = 2.0
    means = block_means(image, 4)
    assert means.shape == (4, 3)
    assert means[:, 0].tolist() == [0.0, 2.0, 0.0, 2.0]
    mask = np.zeros((5, 6), bool)
    mask[:4, :4] = True
    mask[0, 4:] = True  # a quarter of its block only
    assert block_means(image, 4, mask).shape == (1, 3)


def test_p_values_are_uniform_without_a_difference():
    rng = np.random.default_rng(1)
    _, p = welch(rng.normal(size=(6, 4000)), 3.0 * rng.normal(size=(9, 4000)))
    for level in (0.5, 0.1, 0.01):
        share = (p < level).mean()
        assert abs(share - level) < 4.0 * math.sqrt(level / 4000)


def test_false_alarms_are_rare():
    rng = np.random.default_rng(2)
    runs = 400
    alarms = sum(
        compare(pictures(rng), pictures(rng), block=16, alpha=0.02).significant for _ in range(runs)
    )
    assert alarms <= 0.02 * runs + 3.0 * math.sqrt(0.02 * runs)


def test_one_percent_everywhere_is_found():
    rng = np.random.default_rng(3)
    for _ in range(20):
        result = compare(pictures(rng, 1.01, noise=0.1), pictures(rng, noise=0.1), 16)
        assert result.significant
        assert result.difference == pytest.approx(0.01, abs=0.003)
        with pytest.raises(AssertionError, match="the means differ"):
            result.check(0.003)


def test_a_bias_in_one_place_is_found():
    rng = np.random.default_rng(4)
    column = slice(0, 16)
    for _ in range(20):
        result = compare(pictures(rng, 1.05, column), pictures(rng), block=16)
        assert result.significant
        assert result.where.startswith(("block 0", "block 4", "block 8"))


def test_blocks_are_checked_one_by_one():
    rng = np.random.default_rng(6)
    right = compare(pictures(rng), pictures(rng), block=16)
    right.check_blocks(0.05, 0.02)
    with pytest.raises(AssertionError, match="too noisy"):
        right.check_blocks(0.05, 1e-6)
    wrong = compare(pictures(rng, 1.08, slice(0, 16)), pictures(rng), block=16)
    with pytest.raises(AssertionError, match=r"the means differ: \['block 0: [+]8") as found:
        wrong.check_blocks(0.05, 0.02)
    assert "block 1:" not in str(found.value)
    dim = [0.01 * p for p in pictures(rng)]
    assert abs(compare([1.5 * p for p in dim], dim, block=16, dark=1.0).blocks).max() < 0.02


def test_noise_is_no_proof():
    rng = np.random.default_rng(5)
    noisy = pictures(rng, noise=5.0)
    with pytest.raises(AssertionError, match="too noisy"):
        compare(noisy, pictures(rng), block=16).check(0.003)


def test_black_and_constant_pictures():
    black = [np.zeros(SHAPE)] * 3
    grey = [np.full(SHAPE, 0.25, np.float32)] * 3
    assert compare(grey, grey, block=8).p == 1.0
    assert compare(grey, [g * 1.001 for g in grey], block=8).significant
    _, p = welch(np.zeros((3, 1)), np.zeros((3, 1)))
    assert p[0] == 1.0
    with pytest.raises(ValueError, match="finite"):
        compare(grey, [g * np.nan for g in black], block=8)


def test_noisy_blocks_are_named_and_not_tested():
    rng = np.random.default_rng(5)
    a, b = pictures(rng), pictures(rng)
    for picture in b:
        picture[:8, :8] *= rng.exponential()
    found = compare(a, b, block=8, noisy=0.1)
    assert found.left_out == (0,)
    assert not found.significant
    assert compare(a, b, block=8).left_out == ()
