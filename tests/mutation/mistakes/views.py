# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that look different from everywhere: whose view counts."""

from __future__ import annotations

from mistake import one

from mistakes.sources import BSDF, CONNECT, FLIGHT, FLIGHT_APART, PROGRAM, SUBPATH

MESH_LIGHT = "core/janus/light/mesh_light.cpp"
TESTS = "*ShaderAgreement*:*Reshadings*"
ONLOOKERS = "*LightPathNode*:*Lights*odes:*LightTransport*odes"

VIEWS = (
    one(
        "value-of-the-walk",
        0,
        "the value is that of the lobes seen from where the walk comes",
        TESTS,
        BSDF,
        "if (reshading_ && !alike(*reshading_, wo, wi)) {\n    reshade(",
        "if (false) {\n    reshade(",
    ),
    one(
        "delta-value-of-the-walk",
        0,
        "the same for smooth reflection and refraction",
        TESTS,
        BSDF,
        "if (reshading_ && !alike(*reshading_, from, to)) {",
        "if (false) {",
    ),
    one(
        "density-of-the-camera",
        0,
        "the density of light walks is that of the lobes seen from the camera",
        TESTS,
        BSDF,
        "seen.pdf_importance = sum.pdf_importance;",
        "",
    ),
    one(
        "emission-along-the-normal",
        0,
        "light paths start with the emission that is seen from straight above",
        TESTS,
        MESH_LIGHT,
        "radiance(triangle, b, direction)",
        "radiance(triangle, b, n)",
    ),
    one(
        "transparency-seen-by-the-light",
        0,
        "light walks pass what is transparent from their own side",
        TESTS,
        FLIGHT,
        "v.shading.transparency = scene.shade(v.hit, direction).transparency;",
        "",
    ),
    one(
        "splat-ray-seen-from-the-light",
        0,
        "the rays of splats see surfaces from the light's end",
        TESTS,
        CONNECT,
        "joined.camera = Scene::End::B;",
        "",
    ),
    one(
        "one-copy-is-met",
        0,
        "light walks end at one copy of a surface alone, whatever others there are in its place",
        ONLOOKERS,
        FLIGHT_APART,
        "may_end(copy) && !by_path ? v.shading",
        "i == 0 && may_end(copy) && !by_path ? v.shading",
    ),
    one(
        "copies-share-a-material",
        0,
        "a copy of a surface is shaded as the one that was met",
        ONLOOKERS,
        "core/janus/render/scene.h",
        "hit.material = instance.material(",
        "(void)instance.material(",
    ),
    one(
        "one-copy-is-lit",
        0,
        "a light that is looked for is seen on one copy of a surface alone",
        ONLOOKERS,
        FLIGHT_APART,
        "      scene.shade(hit, -ray.direction, shading, here);",
        "      if (i > 0) break;\n      scene.shade(hit, -ray.direction, shading, here);",
    ),
    one(
        "untinted-light-paths",
        0,
        "light paths do not know the node tree of a lamp",
        ONLOOKERS,
        SUBPATH,
        "v.beta *= light.tint(*endpoint, emission->direction, glm::length(v.hit.p - *endpoint));",
        "",
    ),
    one(
        "tinted-where-rays-start",
        0,
        "the tree of a lamp is asked at the ray's origin, not where the path starts",
        ONLOOKERS,
        SUBPATH,
        "light.tint(*endpoint, ",
        "light.tint(emission->origin, ",
    ),
    one(
        "kept-for-the-other-side",
        0,
        "what a surface keeps for other views is used for those of its other side, too",
        "RunAgain.*",
        PROGRAM,
        "reshading.program->kept_count > 0 && dot(view, point.ng) * dot(seen, point.ng) > 0.0f",
        "reshading.program->kept_count > 0",
    ),
    one(
        "all-lies-at-one-metre",
        0,
        "to the node tree of a lamp, light paths end a metre away",
        ONLOOKERS,
        SUBPATH,
        "glm::length(v.hit.p - *endpoint));",
        "1.0f);",
    ),
)
