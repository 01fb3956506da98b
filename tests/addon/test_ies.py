# SPDX-License-Identifier: GPL-3.0-or-later
"""Photometric files as tables; tests/images/node_cases_ies.py compares what they mean."""

import random
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import part

sys.path.append(str(Path(__file__).resolve().parents[2]))

from tests.images.ies_texts import BROKEN, TEXTS  # noqa: E402


def parse(text):
    return part("nodes.ies").parse_ies(text)


def parts(table):
    h, v = int(table[0]), int(table[1])
    angles = np.degrees(table[2 : 2 + h + v])
    return angles[:h], angles[h:], np.reshape(table[2 + h + v :], (h, v))


@pytest.mark.parametrize("name", TEXTS)
def test_tables(addon, name):
    horizontal, vertical, rows = parts(parse(TEXTS[name]))
    assert rows.shape == (len(horizontal), len(vertical))
    for angles in (horizontal, vertical):
        assert (np.diff(angles) > 0.0).all()
        assert angles[0] >= 0.0 and angles[-1] <= 360.001
    assert rows.min() > 0.0


def test_quarters_are_mirrored(addon):
    horizontal, _, rows = parts(parse(TEXTS["C quarter"]))
    assert horizontal == pytest.approx([0, 20, 55, 90, 125, 160, 180, 200, 235, 270, 305, 340, 360])
    assert (rows == rows[::-1]).all()


def test_candela_become_watts(addon):
    plain, brighter = (parts(parse(TEXTS[name]))[2] for name in ("tilted", "brighter"))
    assert brighter == pytest.approx(2.5 * plain)
    assert plain[0, 0] == pytest.approx(900 * 0.9 * 4 * np.pi / 177.83, rel=1e-3)


@pytest.mark.parametrize("name", BROKEN)
def test_broken(addon, name):
    with pytest.raises(part("nodes.ies").IesError, match="."):
        parse(BROKEN[name])


def test_whatever_is_in_a_file(addon):
    """Either a table that fits together, or an error that says why."""
    chance = random.Random(4)
    good = 0
    for _ in range(2000):
        text = list(chance.choice(list(TEXTS.values())))
        for _ in range(chance.choice((1, 1, 2, 20))):
            at = chance.randrange(len(text))
            text[at : at + chance.randrange(3)] = chance.choice(
                ["-", "9", "x", " ", "\n", "1e99", ""]
            )
        try:
            table = parse("".join(text))
        except part("nodes.ies").IesError as error:
            assert str(error)
            continue
        good += 1
        assert len(table) == 2 + table[0] + table[1] + table[0] * table[1]
        assert np.isfinite(table).all()
    assert 200 < good < 1900
