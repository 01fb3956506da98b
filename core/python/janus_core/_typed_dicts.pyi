# SPDX-License-Identifier: GPL-3.0-or-later
"""For type checkers alone: the dictionaries that the core returns."""

from typing import Literal, TypedDict

class Counts(TypedDict):
    meshes: int
    instances: int
    triangles: int
    round: int
    lights: int
    materials: int
    meshes_built: int
    shadow_catchers: int

class Progress(TypedDict):
    samples: int
    target_samples: int
    seconds: float
    remaining: float | None
    state: Literal["waiting", "rendering", "done", "cancelled", "failed"]

class Stats(TypedDict):
    samples: int
    seconds: float
    paths: dict[Literal["camera", "light"], int]
    rays: dict[Literal["camera", "specular", "light", "nee", "connection", "splat"], int]
    joins: dict[
        Literal[
            "connections", "connections_facing", "connections_evaluated", "nee", "splats", "merges"
        ],
        int,
    ]
    light_vertices: int
    light_cache_bytes: int
    dropped: int
    effort: dict[Literal["light_paths", "connections"], float]
    weight_error: float
