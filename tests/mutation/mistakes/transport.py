# SPDX-License-Identifier: GPL-3.0-or-later
"""Light transport matrices: what a projector emits, and in which pixel a path starts."""

from __future__ import annotations

from mistake import one

from mistakes.sources import SUBPATH

PROJECTOR = "core/janus/light/projector.cpp"
BIDIRECTIONAL = "core/janus/integrator/bidirectional.h"
SUMS = "core/janus/film/transport_sums.cpp"
TESTS = "Transport.*"

TRANSPORT = (
    one(
        "projector-even-in-solid-angle",
        0,
        "a projector's pixels shrink towards the edge, and get as much light",
        "*Lights.*projector*",
        PROJECTOR,
        "return 1.0f / (size_.x * size_.y * cosine * cosine * cosine);",
        "return 1.0f / (size_.x * size_.y * cosine);",
    ),
    one(
        "projector-knows-no-pixel-of-light-paths",
        0,
        "connections and splats all start in the first pixel",
        TESTS,
        SUBPATH,
        "v.pixel = light.pixel(v.hit.p);",
        "",
    ),
    one(
        "transport-without-splats",
        0,
        "the matrix has no light that light paths bring to the camera",
        TESTS,
        BIDIRECTIONAL,
        "context_.transport->add_splat(block, s->raster, v.pixel, value);",
        "",
    ),
    one(
        "transport-without-next-event-pixels",
        0,
        "next event estimation starts in the first pixel",
        TESTS,
        BIDIRECTIONAL,
        "context_.transport ? context_.scene().lights[nee->light]->pixel(v.hit.p) : 0;",
        "0;",
    ),
    one(
        "transport-variance-of-contributions",
        0,
        "variances count each contribution of a pass as a sample",
        "TransportSums.*",
        SUMS,
        "sample += parts[i].value;\n    }\n    sum.value += sample;\n"
        "    sum.square += sample * sample;",
        "sample += parts[i].value;\n      sum.square += parts[i].value * parts[i].value;\n    }\n"
        "    sum.value += sample;",
    ),
)
