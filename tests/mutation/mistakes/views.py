# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that look different from everywhere: whose view counts."""

from __future__ import annotations

from mistake import one

from mistakes.sources import BSDF, CONNECT, FLIGHT

MESH_LIGHT = "core/janus/light/mesh_light.cpp"
TESTS = "*ShaderAgreement*:*Reshadings*"

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
)
