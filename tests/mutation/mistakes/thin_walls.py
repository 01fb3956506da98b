# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin walls."""

from __future__ import annotations

from mistake import one

from mistakes.sources import BSDFS, FACET_LOBES

CLOSURES = "core/janus/shading/closures.cpp"
GLASS = "core/janus/shading/thin_wall.cpp"
THIN = "ThinGlass.*:ThinWall.*"

THIN_WALLS = (
    one(
        "panes-alike-from-everywhere",
        0,
        "what a pane lets through does not depend on the angle",
        THIN,
        CLOSURES,
        "return std::max(0.0f, dot(n, point_->view));",
        "return 1.0f + 0.0f * dot(n, point_->view);",
    ),
    one(
        "tint-of-one-crossing",
        0,
        "light that is reflected within a pane keeps its colour",
        THIN,
        GLASS,
        "const Rgb between = back.reflected * kept;",
        "const Rgb between = back.reflected;",
    ),
    one(
        "mirrored-for-the-camera-alone",
        0,
        "light walks through a rough pane have the density of the normal that the camera sees",
        BSDFS,
        FACET_LOBES,
        "if (n_light != -n) {",
        "if (false && n_light != -n) {",
    ),
)
