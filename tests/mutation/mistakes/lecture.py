# SPDX-License-Identifier: GPL-3.0-or-later
"""Strategies, light path expressions, passes."""

from __future__ import annotations

from mistake import one

from mistakes.sources import LECTURE

MATCH = "core/janus/path/match.h"
STRATEGIES = "core/janus/integrator/strategies.h"

LECTURE_MADE_VISIBLE = (
    one(
        "lens-without-its-cosine",
        0,
        "the importance of a lens that light paths hit lacks 1 / cos",
        LECTURE,
        "core/janus/camera/perspective.cpp",
        "(aperture_.area() * d.z)",
        "aperture_.area()",
    ),
    one(
        "lens-as-a-full-disk",
        0,
        "light paths hit the lens beside its blades",
        LECTURE,
        "core/janus/camera/aperture.h",
        "if (edge.x * to.y - edge.y * to.x < 0.0f) {",
        "if (dot(unit, unit) > 1.0f) {",
    ),
    one(
        "average-counts-what-is-no-strategy",
        0,
        "light straight into the camera has two strategies in an average",
        LECTURE,
        STRATEGIES,
        "return t == 1 ? s > 1 && splats_",
        "return t == 1 ? splats_",
    ),
    one(
        "classic-splats-per-pixel",
        0,
        "classic bdpt takes each light path for the only one that may splat",
        LECTURE,
        "core/janus/integrator/classic_bdpt.cpp",
        "splat(v, counts_.splat,",
        "splat(v, 1.0f,",
    ),
    one(
        "classic-weights-without-splats",
        0,
        "the weights of classic bdpt know of no splats",
        LECTURE,
        "core/janus/integrator/classic_bdpt.cpp",
        "counts_.splat = static_cast<float>(light_paths_);",
        "counts_.splat = 1.0f;",
    ),
    one(
        "images-without-weight-have-weights",
        0,
        "the unweighted image of a strategy is the weighted one",
        LECTURE,
        "core/janus/integrator/layers.h",
        "value / weight);",
        "value);",
    ),
    one(
        "connections-read-the-wrong-way",
        0,
        "the two vertices of a connection are read in the order of the camera",
        LECTURE,
        "core/janus/path/connect.cpp",
        "unread->set(first, second)",
        "unread->set(second, first)",
    ),
    one(
        "glossy-share-of-walks-lost",
        0,
        "walks read a vertex of two kinds as diffuse alone",
        LECTURE,
        MATCH,
        "add(next(s.state, event, vertex.instance), s.share * share, sampler);",
        "add(next(s.state, event, vertex.instance), share, sampler);",
    ),
    one(
        "dropped-states-not-made-up-for",
        0,
        "a state that is kept by chance does not count for the one that is dropped",
        LECTURE,
        MATCH,
        "rival = {state, share / pmf};",
        "rival = {state, share};",
    ),
    one(
        "layers-miss-whole-splats",
        0,
        "a splat that belongs to an expression as a whole is in the picture alone",
        LECTURE,
        "core/janus/integrator/splats.h",
        "with_picture.bits |= mask.bits;",
        "with_picture.bits |= mask.bits & 0;",
    ),
    one(
        "states-behind-the-vertex",
        0,
        "light that a camera walk hits is sorted by what lies behind z_1 twice",
        LECTURE,
        "core/janus/integrator/pass.h",
        "found.trace->before(), UnreadVertices(z_1)",
        "found.trace->states(), UnreadVertices(z_1)",
    ),
)
