# SPDX-License-Identifier: GPL-3.0-or-later
"""The box again, with a glass and a mirror sphere and one of Blender's own area lamps.

Reflections, refractions and their caustics, of a lamp large enough that a path tracer finds
them too: the scene for comparing the integrators where specular surfaces take part.
"""

from __future__ import annotations

import bpy

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 400, 400, 128


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene)

    white = kit.diffuse("White", (0.66, 0.64, 0.60))
    blue = kit.diffuse("Blue", (0.08, 0.22, 0.46))
    ochre = kit.diffuse("Ochre", (0.62, 0.36, 0.08))

    a, b, c, d = (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)
    e, f, g, h = (-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)
    kit.quad(scene, "Floor", [a, b, c, d], white)
    kit.quad(scene, "Ceiling", [e, h, g, f], white)
    kit.quad(scene, "Back", [d, c, g, h], white)
    kit.quad(scene, "Left", [a, d, h, e], blue)
    kit.quad(scene, "Right", [b, f, g, c], ochre)

    ball = kit.sphere(scene, "Glass", 0.42, kit.glass("Glass", (0.98, 1.0, 0.99), 1.5))
    ball.location = (0.42, -0.35, 0.46)
    mirror = kit.sphere(scene, "Mirror", 0.40, kit.metal("Mirror", (0.92, 0.90, 0.86)))
    mirror.location = (-0.44, 0.30, 0.40)

    kit.area_light(
        scene, "Lamp", (0.0, 0.0, 1.95), (0.0, 0.0, 0.0), (0.5, 0.5), 30.0, (1.0, 0.9, 0.75), True
    )
    kit.camera(scene, (0.0, -4.9, 1.0), (0.0, 0.0, 1.0), lens=56.0)
