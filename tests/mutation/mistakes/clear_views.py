# SPDX-License-Identifier: GPL-3.0-or-later
"""What the camera sees clearly: holdouts, and the glass of a transparent film."""

from __future__ import annotations

from mistake import one

from mistakes.sources import CLEAR_VIEWS, CONNECT, SUBPATH

CLEAR = (
    one(
        "holdouts-not-for-splats",
        0,
        "light walks show the camera what holds out",
        CLEAR_VIEWS,
        CONNECT,
        "|| v.held)",
        ")",
    ),
    one(
        "holdouts-for-every-view",
        0,
        "mirrors and diffuse surfaces see holes, too",
        CLEAR_VIEWS,
        SUBPATH,
        "if (v.clear && (surface ?",
        "if ((surface ?",
    ),
    one(
        "holdouts-behind-glass-not-for-connections",
        0,
        "connections at clear glass show what holds out behind it",
        CLEAR_VIEWS,
        CONNECT,
        "if (rules.clear_views() && c.clear && (l.held || l.hidden)) {",
        "if (rules.clear_views() && c.clear && l.hidden) {",
    ),
    one(
        "background-behind-glass-by-light-walks",
        0,
        "light walks do not know that they come from the background",
        CLEAR_VIEWS,
        SUBPATH,
        "v.hidden = hidden_in_clear_view(light, settings);",
        "",
    ),
    one(
        "background-behind-glass-by-shadow-rays",
        0,
        "next event estimation adds the background behind clear glass, as Cycles' does",
        CLEAR_VIEWS,
        CONNECT,
        "v.clear && hidden_in_clear_view(light, rules)",
        "false",
    ),
    one(
        "clear-by-any-lobe",
        0,
        "walks take a refraction for clear where one of the lobes that share it is",
        CLEAR_VIEWS,
        "core/janus/path/clear_view.cpp",
        "(share >= 1.0f || sampler.next_1d() < share)",
        "true",
    ),
)
