# SPDX-License-Identifier: GPL-3.0-or-later
"""The Cornell box with its measured proportions and reflectances, in metres, under an area lamp.

The room of Goral et al. (1984), with the data that Cornell publishes: walls and blocks are not
quite square. `diffuse_box` is the plainer one, for tests.
"""

from __future__ import annotations

import bpy

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 400, 400, 128

# Corners on the floor as (x, depth) in centimetres, x from the right; and the height.
TALL = [(423.0, 247.0), (265.0, 296.0), (314.0, 456.0), (472.0, 406.0)], 330.0
SHORT = [(130.0, 65.0), (82.0, 225.0), (240.0, 272.0), (290.0, 114.0)], 165.0


def point(x: float, height: float, depth: float) -> kit.Point3:
    """From Cornell's coordinates to ours: metres, z up, the camera looks along y."""
    return ((278.0 - x) / 100.0, depth / 100.0, height / 100.0)


def block(scene: bpy.types.Scene, name: str, shape, material: bpy.types.Material) -> None:
    base, height = shape
    vertices = [point(x, z, depth) for z in (0.0, height) for x, depth in base]
    faces = [(4, 5, 6, 7), *((i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4) for i in range(4))]
    kit.mesh_object(scene, name, vertices, faces, material)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX")
    kit.world(scene)

    white = kit.diffuse("White", (0.74, 0.74, 0.72))
    red = kit.diffuse("Red", (0.60, 0.06, 0.05))
    green = kit.diffuse("Green", (0.13, 0.42, 0.10))

    a, b = point(552.8, 0, 0), point(0, 0, 0)
    c, d = point(0, 0, 559.2), point(549.6, 0, 559.2)
    e, f = point(556.0, 548.8, 0), point(0, 548.8, 0)
    g, h = point(0, 548.8, 559.2), point(556.0, 548.8, 559.2)
    kit.quad(scene, "Floor", [a, b, c, d], white)
    kit.quad(scene, "Ceiling", [e, h, g, f], white)
    kit.quad(scene, "Back", [d, c, g, h], white)
    kit.quad(scene, "Left", [a, d, h, e], red)
    kit.quad(scene, "Right", [b, f, g, c], green)
    block(scene, "Tall block", TALL, white)
    block(scene, "Short block", SHORT, white)

    centre = point(278.0, 548.7, 279.5)
    kit.area_light(
        *(scene, "Lamp", centre, (centre[0], centre[1], 0.0), (1.30, 1.05), 140.0),
        *((1.0, 0.80, 0.52), True),
    )
    kit.camera(scene, point(278, 273, -800), point(278, 273, 0), lens=50.4)
