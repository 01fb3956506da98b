# SPDX-License-Identifier: GPL-3.0-or-later
"""Where things are in the source, and what each kind of test is called."""

BDPT = "core/janus/integrator/bdpt.cpp"
BSDF = "core/janus/shading/bsdf.cpp"
CAMERA = "core/janus/camera/camera.h"
CONNECT = "core/janus/path/connect.cpp"
FILM = "core/janus/film/film.cpp"
FLIGHT = "core/janus/path/flight.h"
FLIGHT_APART = "core/janus/path/flight.cpp"
MIS = "core/janus/path/mis.h"
ROULETTE = "core/janus/path/roulette.h"
SCATTER = "core/janus/shading/scatter.cpp"
SUBPATH = "core/janus/path/subpath.h"

# Wildcards, because files of tests are split and merged.
ORACLE = "*Oracle*:*MisRecursion*"
PICTURES = "*Agreement*:*Techniques*:*KnownAnswer*:Mistakes*"
CROSSINGS = "*Crossings*:*Transparency*:Mistakes.*"
BSDFS = "*Bsdfs*:*Dielectric*:*Delta*:*Furnace*"
CAMERAS = "*CameraAgreement*:Camera.*"
CAPS = "BounceCaps.*"
CLAMP = "Clamp.*"
RAY_TYPES = "*Visibility*:LightRules.*"
