# SPDX-License-Identifier: GPL-3.0-or-later
"""Additional walks over deltas."""

from __future__ import annotations

from mistake import Edit, Mistake, one

from mistakes.sources import BDPT

TESTS = "SpecularWalks.*"

SPECULAR_WALKS = (
    one(
        "specular-walks-on-top",
        0,
        "the camera walk's own light over deltas is not divided among the walks",
        TESTS,
        BDPT,
        "gather_light(found, found.specular ? share : 1.0f, sample",
        "gather_light(found, 1.0f, sample",
    ),
    one(
        "all-hits-shared",
        0,
        "hits that other techniques find, too, are divided among the walks",
        TESTS,
        BDPT,
        "gather_light(found, found.specular ? share : 1.0f, sample",
        "gather_light(found, share, sample",
    ),
    Mistake(
        "specular-walks-go-anywhere",
        0,
        "additional walks take light behind vertices of other kinds, of which others know nothing",
        TESTS,
        (
            Edit(BDPT, "specular_.specular = true;", "specular_.specular = false;"),
            Edit(
                BDPT,
                "if (found.specular) { gather_light",
                "if (found.edges > 1) { gather_light",
            ),
        ),
    ),
)
