# SPDX-License-Identifier: GPL-3.0-or-later
"""Light that goes below surfaces: the densities of both ends."""

from __future__ import annotations

from mistake import one

from mistakes.sources import ORACLE

ENDS = "core/janus/shading/subsurface_ends.cpp"
WALK = "core/janus/render/subsurface_walk.cpp"
WALKS = "Subsurface*"
TECHNIQUES = f"{ORACLE}:*SubsurfaceAgreement*:*SingleTechniques*subsurface*"

BELOW = (
    one(
        "walks-below-that-are-alike",
        0,
        "camera walks think that light walks go below a surface with the same density",
        TECHNIQUES,
        "core/janus/path/subsurface.cpp",
        "ratio = walk.reverse(*other, upper_normal(v.hit, arrival)).pdf_ratio *",
        "ratio =",
    ),
    one(
        "albedo-of-one-end",
        0,
        "light walks take the medium's scale for 1",
        TECHNIQUES,
        WALK,
        "Reverse out{medium.scale() / survival_, 1.0};",
        "Reverse out{Rgb(1.0f) / survival_, 1.0};",
    ),
    one(
        "entries-without-adjoint",
        0,
        "light walks leave an entry without the ratio of its cosines",
        TECHNIQUES,
        ENDS,
        "mode == TransportMode::Importance ? std::abs(d.wo_ng / below_ng) : 1.0f;",
        "1.0f;",
    ),
    one(
        "exits-drawn-for-free",
        0,
        "the chance that light goes below at an exit is in no density",
        TECHNIQUES,
        ENDS,
        "e.pdf_importance = lobe ? pmf(*lobe, grazing(d.wi_ng)) : 0.0f;",
        "e.pdf_importance = lobe ? 1.0f : 0.0f;",
    ),
    one(
        "guided-as-if-not",
        0,
        "directions are drawn towards the surface, and not counted so",
        WALKS,
        "core/janus/shading/subsurface.cpp",
        "step.pdf = (1.0f - level.guided) * scattered * step.pdf +",
        "step.pdf = scattered * step.pdf + 0.0f *",
    ),
)
