# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: scenes of scenes/, small, each with as many samples as it needs.

Two have larger lamps here, as Cycles would need hours for its own noise to go under: the hero
(hero_soft) and the pool, where the caustics are those of a hazy sun.
"""

from __future__ import annotations

import importlib
import math
import os
from dataclasses import dataclass

SEEDS = 8


@dataclass(frozen=True)
class Case:
    width: int
    height: int
    cycles: int  # samples per pixel
    bdpt: int
    long: bool = False  # only in `./dev test --full`


ALL = {
    "diffuse_box": Case(48, 48, 1024, 256),
    "glass_box": Case(48, 48, 2048, 256),
    "cornell_box": Case(32, 32, 512, 256),
    "hero_soft": Case(40, 24, 1024, 256),
    "pool": Case(40, 24, 1024, 1024),
    "studio": Case(40, 24, 512, 256),
    "sunlit_exterior": Case(40, 24, 512, 256),
    "many_lights": Case(40, 24, 4096, 2048, long=True),
    "hdri_interior": Case(40, 24, 2048, 512, long=True),
    "ajar_door": Case(40, 24, 4096, 1024, long=True),
    "hidden_light": Case(40, 24, 16384, 2048, long=True),
    "metal_ring": Case(40, 24, 8192, 6144, long=True),
}
CASES = {name: case for name, case in ALL.items() if not case.long or "JANUS_FULL" in os.environ}


def build(name: str):
    import bpy

    scene = bpy.context.scene
    importlib.import_module(f"scenes.{name}").build(scene)
    case = CASES[name]
    scene.render.resolution_x, scene.render.resolution_y = case.width, case.height
    scene.cycles.samples = case.cycles
    if name == "pool":
        for light in bpy.data.lights:
            light.angle = math.radians(25.0)
    return scene
