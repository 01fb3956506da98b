# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: scenes of scenes/, small, with as many samples as Cycles' noise needs."""

from __future__ import annotations

import importlib

SEEDS = 8
# Name: (width, height, Cycles' samples per pixel).
CASES = {
    "diffuse_box": (48, 48, 1024),
    "glass_box": (48, 48, 1024),
    "cornell_box": (32, 32, 512),
    "hero": (40, 24, 2048),
    "hidden_light": (40, 24, 2048),
    "metal_ring": (40, 24, 2048),
    "ajar_door": (40, 24, 2048),
    "pool": (40, 24, 2048),
    "many_lights": (40, 24, 1024),
    "hdri_interior": (40, 24, 2048),
    "studio": (40, 24, 512),
    "sunlit_exterior": (40, 24, 512),
}


def build(name: str):
    import bpy

    scene = bpy.context.scene
    importlib.import_module(f"scenes.{name}").build(scene)
    width, height, samples = CASES[name]
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.cycles.samples = samples
    return scene
