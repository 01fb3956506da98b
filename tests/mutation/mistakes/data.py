# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of data, and scenes that share their parts."""

from __future__ import annotations

from mistake import one

from mistakes.sources import COMMITS, DATA

WALK = "core/janus/integrator/data_passes.cpp"
AOVS = "core/janus/integrator/aovs.h"
DATA_FILM = "core/janus/film/data_film.cpp"

DATA_AND_COMMITS = (
    one(
        "matte-ids-not-normal",
        0,
        "hashes of Cryptomatte become numbers that readers lose",
        DATA,
        "core/janus/film/cryptomatte.cpp",
        "hash ^ 1U << 23 : hash",
        "hash : hash",
    ),
    one(
        "depth-as-a-mean",
        0,
        "samples after the first change what only the first may say",
        DATA,
        DATA_FILM,
        "(is_first || !kDataPasses[i].first)",
        "(is_first || true)",
    ),
    one(
        "mattes-cover-what-is-behind",
        0,
        "what lies behind something transparent covers all of the pixel",
        DATA,
        WALK,
        "see_mattes(*hit, average(through) * alpha, sample);",
        "see_mattes(*hit, alpha, sample);",
    ),
    one(
        "normals-of-the-world",
        0,
        "a denoiser gets normals that do not turn with the camera",
        DATA,
        WALK,
        "vec3(view_.from_world * vec4(found.normal, 0.0f))",
        "found.normal",
    ),
    one(
        "features-of-the-mirror",
        0,
        "what denoisers see in a mirror lacks its colour",
        DATA,
        WALK,
        "share *= found.smooth;",
        "share *= 1.0f;",
    ),
    one(
        "aovs-of-all-that-is-behind",
        0,
        "AOVs of what lies behind something thin count in full",
        DATA,
        AOVS,
        "value_ *= chance;",
        "value_ *= 1.0f;",
    ),
    one(
        "aovs-behind-what-holds",
        0,
        "AOVs are written behind surfaces with enough alpha",
        DATA,
        WALK,
        "if (!done && !choice_.aovs.empty()) {",
        "if (!choice_.aovs.empty()) {",
    ),
    one(
        "meshes-never-change",
        0,
        "a mesh that is set again stays the old one",
        COMMITS,
        "core/janus/render/builder.h",
        "MeshDesc desc) {\n    shapes_[key] = std::make_shared<ShapeItem>(std::move(desc));",
        "MeshDesc desc) {\n    shapes_.try_emplace(key, std::make_shared<ShapeItem>(desc));",
    ),
    one(
        "hierarchies-built-again",
        0,
        "a scene shares no hierarchies with the one before",
        COMMITS,
        "core/janus/render/builder.cpp",
        "commit.build_accel(last);",
        "commit.build_accel(nullptr);",
    ),
)
