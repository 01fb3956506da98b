# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion blur, and lights that shine on some objects only."""

from __future__ import annotations

from mistake import one

from mistakes.sources import LINKING, MOTION

SLICE = "core/janus/render/time_slice.cpp"
EXPOSURE = "core/janus/render/exposure.cpp"

MOTION_AND_LINKING = (
    one(
        "lights-that-stay-behind",
        0,
        "a surface that shines moves, and what chooses points on it does not",
        MOTION,
        SLICE,
        "!(moves(scene, instance) ||",
        "!((false && moves(scene, instance)) ||",
    ),
    one(
        "moving-lights-in-the-dark",
        0,
        "what varies on a surface that moves and shines is never looked for",
        MOTION,
        "core/janus/light/mesh_light.h",
        "return slot_[primitive] == kDark ? Rgb(0.0f) : triangle(primitive).radiance;",
        "return Rgb(0.0f);",
    ),
    one(
        "waves-of-one-time",
        0,
        "all waves of a pass see the same time",
        MOTION,
        EXPOSURE,
        "0.6180339887498949 * static_cast<double>(wave)",
        "0.0 * static_cast<double>(wave)",
    ),
    one(
        "shutter-without-its-curve",
        0,
        "times are as likely when the shutter is nearly closed",
        MOTION,
        EXPOSURE,
        "if (let_through_.size() < 2) {",
        "if (true || let_through_.size() < 2) {",
    ),
    one(
        "normals-of-another-time",
        0,
        "a mesh that bends keeps its normals",
        MOTION,
        "core/janus/geometry/mesh.cpp",
        "const vec3 n = (1.0f - t) * a.normals[i] + t * b.normals[i];",
        "const vec3 n = a.normals[i];",
    ),
    one(
        "rotations-the-long-way",
        0,
        "what turns goes by the longer way round",
        MOTION,
        "core/janus/geometry/motion.cpp",
        "glm::dot(poses_.back().rotation, q) < 0.0f",
        "glm::dot(poses_.back().rotation, q) > 0.0f",
    ),
    one(
        "sky-around-a-scene-at-rest",
        0,
        "light from far away misses what moves out of the scene's box",
        MOTION,
        "core/janus/render/surroundings.cpp",
        "bounds.extend(swept(instance, shape));",
        "bounds.extend(bounds);",
    ),
    one(
        "dark-lights-found-by-chance",
        0,
        "a walk that hits a light sees it though it does not shine there",
        LINKING,
        "core/janus/path/subpath.h",
        "|| !previous.lit_by(light)) {",
        "|| (false && !previous.lit_by(light))) {",
    ),
    one(
        "light-walks-from-dark-lights",
        0,
        "a light path goes on from what its light does not shine on",
        LINKING,
        "core/janus/path/subpath.h",
        "if (!receiver.lit_by(light) || ",
        "if (",
    ),
    one(
        "dark-lights-in-the-tree",
        0,
        "the light tree chooses lights that do not shine on the receiver",
        LINKING,
        "core/janus/light/light_tree.cpp",
        "if (!shines_on(node.links, receiver.unlit_by)) {",
        "if (false && !shines_on(node.links, receiver.unlit_by)) {",
    ),
    one(
        "shadows-of-the-first-set",
        0,
        "where walks find lights, all are blocked by the same objects",
        LINKING,
        "core/janus/render/shadows_ahead.h",
        "std::popcount(types_ & (ray_bit(type) - 1))",
        "std::popcount(types_ & (ray_bit(type) - 1)) * 0",
    ),
)
