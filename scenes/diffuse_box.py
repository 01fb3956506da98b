# SPDX-License-Identifier: GPL-3.0-or-later
"""A Cornell-like box: five diffuse walls, two diffuse blocks and a lamp in the ceiling.

Nothing in it is specular, so every integrator sees every path: the first scene on which path
tracing, light tracing and BDPT must agree, with each other and with Cycles.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 400, 400, 128


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene)

    white = kit.diffuse("White", (0.73, 0.72, 0.68))
    red = kit.diffuse("Red", (0.62, 0.06, 0.05))
    green = kit.diffuse("Green", (0.12, 0.44, 0.10))
    lamp = kit.emission("Lamp", (1.0, 0.82, 0.56), 14.0)

    # The room: x from -1 to 1, z from 0 to 2, open at y = -1, where the camera looks in.
    a, b, c, d = (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)
    e, f, g, h = (-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)
    kit.quad(scene, "Floor", [a, b, c, d], white)
    kit.quad(scene, "Ceiling", [e, h, g, f], white)
    kit.quad(scene, "Back", [d, c, g, h], white)
    kit.quad(scene, "Left", [a, d, h, e], red)
    kit.quad(scene, "Right", [b, f, g, c], green)

    tall = kit.box(scene, "Tall block", (0.58, 0.58, 1.2), white)
    tall.location, tall.rotation_euler = (-0.34, 0.30, 0.0), (0.0, 0.0, math.radians(18))
    short = kit.box(scene, "Short block", (0.58, 0.58, 0.6), white)
    short.location, short.rotation_euler = (0.36, -0.28, 0.0), (0.0, 0.0, math.radians(-17))

    # An emissive quad just under the ceiling; both of its sides shine.
    s, z = 0.28, 1.98
    kit.quad(scene, "Lamp", [(-s, -s, z), (-s, s, z), (s, s, z), (s, -s, z)], lamp)

    kit.camera(scene, (0.0, -4.9, 1.0), (0.0, 0.0, 1.0), lens=56.0)
