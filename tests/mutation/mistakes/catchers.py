# SPDX-License-Identifier: GPL-3.0-or-later
"""Shadow catchers: whose a path is, and what stands before them."""

from __future__ import annotations

from mistake import one

from mistakes.sources import SUBPATH

CATCHING = "core/janus/path/catching.cpp"
FOOTAGE = "core/janus/session/footage.cpp"
TESTS = "Catchers.*"

CATCHERS = (
    one(
        "catchers-not-for-splats",
        0,
        "light walks do not know that the camera sees a catcher",
        TESTS,
        SUBPATH,
        "v.caught = settings.catchers && catches(scene, v.hit);",
        "",
    ),
    one(
        "catchers-end-where-they-are-clear",
        0,
        "light walks do not look for a catcher before what the camera sees",
        TESTS,
        CATCHING,
        "if (!caught && !passed) {",
        "if (!caught) {",
    ),
    one(
        "catchers-hidden-by-nothing",
        0,
        "light paths to catchers alone pass what stands before them",
        TESTS,
        CATCHING,
        "value *= scene.whole->transmittance(passed.value_or(from), to, RayType::Camera,",
        "(void)scene.whole->transmittance(passed.value_or(from), to, RayType::Camera,",
    ),
    one(
        "catchers-with-added-lamps",
        0,
        "lamps that are no part of the footage shine on it beforehand",
        TESTS,
        "core/janus/render/builder.cpp",
        "const bool shines = !scene_.whole || desc.lights_catchers;",
        "const bool shines = true;",
    ),
    one(
        "catchers-in-empty-pixels",
        0,
        "the factor does not know how much there is of a catcher",
        "Catchers.AreTheSame*:Catchers.ArePutTogetherFromTheirParts",
        FOOTAGE,
        "image.pixels[4 * i + 3] = background && !apart ? 1.0f : alpha + (1.0f - alpha)",
        "image.pixels[4 * i + 3] = background && !apart ? 1.0f : alpha + 1.0f",
    ),
    one(
        "catchers-at-other-times",
        0,
        "the scene of catchers alone has other times of the shutter",
        TESTS,
        "core/janus/render/exposure.cpp",
        "whole_ ? &whole_->scene() : nullptr",
        "timeless_->whole",
    ),
)
