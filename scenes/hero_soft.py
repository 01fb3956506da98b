# SPDX-License-Identifier: GPL-3.0-or-later
"""The hero in the light of a lamp so large that a path tracer finds its caustics too.

Less beautiful, but every integrator reaches a small error in a short time: for agreement tests.
"""

from __future__ import annotations

import math

import bpy

from scenes import hero, kit

LAMP = 0.45  # metres


def build(scene: bpy.types.Scene) -> None:
    hero.build(scene)
    kit.view(scene, "Standard")
    key = scene.objects["Key"].data
    key.size = key.size_y = LAMP
    key.spread, key.energy = math.pi, 15.0
