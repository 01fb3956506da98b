# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: scenes of scenes/, small, with as many samples as their noise needs.

Two have larger lamps here, as Cycles would need hours for its own noise to go under: the hero
(hero_soft) and the pool, where the caustics are those of a hazy sun.
"""

from __future__ import annotations

import importlib
import math
from dataclasses import dataclass

SEEDS = 8


@dataclass(frozen=True)
class Case:
    width: int
    height: int
    cycles: int  # samples per pixel
    bdpt: int


CASES = {
    "diffuse_box": Case(48, 48, 1024, 256),
    "glass_box": Case(48, 48, 2048, 256),
    "cornell_box": Case(32, 32, 512, 256),
    "hero_soft": Case(40, 24, 2048, 512),
    "hidden_light": Case(40, 24, 8192, 512),
    "metal_ring": Case(40, 24, 4096, 1024),
    "ajar_door": Case(40, 24, 2048, 512),
    "pool": Case(40, 24, 2048, 512),
    "many_lights": Case(40, 24, 1024, 512),
    "hdri_interior": Case(40, 24, 2048, 256),
    "studio": Case(40, 24, 512, 256),
    "sunlit_exterior": Case(40, 24, 512, 256),
}


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
