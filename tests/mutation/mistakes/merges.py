# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertex merging."""

from __future__ import annotations

from mistake import one

from mistakes.sources import CONNECT, MERGING, MIS

MERGES = (
    one(
        "merges-not-in-weights",
        0,
        "no weight knows of merging, which takes a share all the same",
        MERGING,
        MIS,
        "a.splat * b.splat +\n         a.merge * b.merge;",
        "a.splat * b.splat;",
    ),
    one(
        "direct-light-merged",
        0,
        "merging finds direct light, too, which the weights leave to the others",
        MERGING,
        "core/janus/integrator/vertex_grid.h",
        "v.edges > 1",
        "v.edges > 0",
    ),
    one(
        "merges-at-z_1-in-weights",
        0,
        "next event estimation and hits leave a share to merging at z_1, which there is not",
        MERGING,
        MIS,
        "behind.merge - (delta ? 0.0f : 1.0f)",
        "behind.merge",
    ),
    one(
        "merged-flux-with-a-cosine",
        0,
        "the flux of a light path is taken as radiance times a solid angle",
        MERGING,
        CONNECT,
        "(scale / std::abs(cos_light))",
        "scale",
    ),
    one(
        "merge-radius-of-the-first-pass",
        0,
        "the estimate divides by the area of the first pass",
        MERGING,
        "core/janus/integrator/merging.h",
        "scale_ = 1.0f / (area() *",
        "scale_ = 1.0f / (std::numbers::pi_v<float> * first_radius_ * first_radius_ *",
    ),
    one(
        "longest-merges-skipped",
        0,
        "a merge counts its vertex twice",
        MERGING,
        CONNECT,
        "if (l.entry || edges > l.max_edges ||",
        "if (l.entry || edges + 1 > l.max_edges ||",
    ),
    one(
        "labels-not-for-merges",
        0,
        "what is hidden from a ray is there where vertices are merged",
        MERGING,
        CONNECT,
        "label = label.within(l.labels);\n    }\n    scale",
        "}\n    scale",
    ),
    one(
        "caps-not-for-merges",
        0,
        "merging has no limits of bounces by kind",
        MERGING,
        CONNECT,
        "scale *= rules.caps.share(l.bounces + c.bounces, label);",
        "",
    ),
    one(
        "crossings-not-for-merges",
        0,
        "merging has a limit of crossings for each subpath",
        MERGING,
        CONNECT,
        "l.crossings + c.crossings > rules.max_crossings ||\n      dot(",
        "dot(",
    ),
    one(
        "merged-background-behind-glass",
        0,
        "merging at clear glass shows the background of a transparent film",
        MERGING,
        CONNECT,
        "if (rules.clear_views() && c.clear && l.hidden) {\n    scale",
        "if (false) {\n    scale",
    ),
)
