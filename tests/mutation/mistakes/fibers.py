# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair, points, and where light walks end."""

from __future__ import annotations

from mistake import one

from mistakes.sources import BSDF, ORACLE, SUBPATH

HAIR = "*Fibers*:ChiangHair.*:RoundShape.*"
TECHNIQUES = ORACLE + ":*Agreement*hair*:*SingleTechniques*round*"

FIBERS = (
    one(
        "fibres-that-light-walks-could-reach",
        0,
        "weights count techniques whose light walk ends on a fibre",
        TECHNIQUES,
        SUBPATH,
        "if (v.shading.bsdf.one_way()) {\n      v.mis.a = {};",
        "if (false && v.shading.bsdf.one_way()) {\n      v.mis.a = {};",
    ),
    one(
        "fibres-that-light-walks-leave",
        0,
        "a fibre has a density for light walks",
        HAIR + ":" + TECHNIQUES,
        BSDF,
        "if (kind_ == VertexKind::OneWay) {\n    sum.pdf_importance",
        "if (false) {\n    sum.pdf_importance",
    ),
    one(
        "tubes-with-open-ends",
        0,
        "what an open end lets in is seen from one side alone",
        HAIR + ":" + TECHNIQUES,
        "core/janus/geometry/accel.cpp",
        "if (!shape_->round()->disks().empty()) {",
        "if (false && !shape_->round()->disks().empty()) {",
    ),
    one(
        "tubes-seen-from-within",
        0,
        "rays meet what is round from within, too",
        HAIR,
        "core/janus/geometry/accel.cpp",
        "facing > 0.0f) {",
        "facing > 2.0f) {",
    ),
    one(
        "dark-hair",
        0,
        "hair that shines is no light for the walks that find it",
        HAIR,
        "core/janus/render/builder.cpp",
        "shape.round() ||",
        "(false && shape.round()) ||",
    ),
    one(
        "scales-that-tilt-all-alike",
        0,
        "reflections turn by the tilt of the scales once",
        HAIR,
        "core/janus/shading/hair.cpp",
        "{-2.0f, 1.0f, 4.0f, 0.0f}",
        "{-1.0f, 1.0f, 4.0f, 0.0f}",
    ),
)
