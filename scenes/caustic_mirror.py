# SPDX-License-Identifier: GPL-3.0-or-later
"""A glass ball under a point light, seen twice: directly, and in a mirror that fills half a wall.

Directly its caustic is LSSDE, which light paths find. In the mirror it is LSSDSE: both ends of
the path are specular, and as the light has no size, nothing can be hit by chance. No strategy of
bidirectional path tracing makes such a path; merging vertices does.

`build(scene, twin=True)` takes the mirror out of its frame and puts a mirrored copy of the room,
lamp included, behind the hole. What the camera sees is the same, but the caustic is now seen
directly: an unbiased reference for what is in the mirror.
"""

from __future__ import annotations

import bpy
from mathutils import Matrix

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 480, 320, 256

RIGHT, FRONT, DEPTH, TOP = 2.6, -0.7, 2.6, 1.9  # the room: x from 0, y from FRONT, z from 0; metres
MIRROR = (0.25, 2.35, 0.12, 1.6)  # in the wall x = 0: from y to y, from z to z
WATTS = 26.0


def wall_with_hole(scene: bpy.types.Scene, material: bpy.types.Material) -> None:
    """The wall x = 0 around the mirror."""
    y0, y1, z0, z1 = MIRROR
    outer = [(0, FRONT, 0), (0, DEPTH, 0), (0, DEPTH, TOP), (0, FRONT, TOP)]
    inner = [(0, y0, z0), (0, y1, z0), (0, y1, z1), (0, y0, z1)]
    faces = [(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4)]
    kit.mesh_object(scene, "Mirror wall", [*outer, *inner], faces, material)


def build(scene: bpy.types.Scene, twin: bool = False) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene)

    white = kit.diffuse("White", (0.66, 0.64, 0.60))
    blue = kit.diffuse("Blue", (0.10, 0.24, 0.44))
    ochre = kit.diffuse("Ochre", (0.60, 0.38, 0.12))
    x, f, y, z = RIGHT, FRONT, DEPTH, TOP
    kit.quad(scene, "Floor", [(0, f, 0), (x, f, 0), (x, y, 0), (0, y, 0)], white)
    kit.quad(scene, "Ceiling", [(0, f, z), (0, y, z), (x, y, z), (x, f, z)], white)
    kit.quad(scene, "Back", [(0, y, 0), (x, y, 0), (x, y, z), (0, y, z)], blue)
    kit.quad(scene, "Right", [(x, f, 0), (x, f, z), (x, y, z), (x, y, 0)], ochre)
    wall_with_hole(scene, white)
    ball = kit.sphere(scene, "Ball", 0.27, kit.glass("Glass", (1.0, 1.0, 1.0), 1.5))
    ball.location = (1.0, 1.4, 0.34)
    block = kit.box(scene, "Block", (0.34, 0.34, 0.62), ochre)
    block.location, block.rotation_euler = (1.9, 1.2, 0.0), (0.0, 0.0, 0.5)
    lamp = (2.0, 1.95, 1.45)
    props.lamp(scene, "Lamp", "POINT", lamp, WATTS, (1.0, 0.92, 0.8), shadow_soft_size=0.0)

    y0, y1, z0, z1 = MIRROR
    if twin:
        reflection = Matrix.Scale(-1.0, 4, (1.0, 0.0, 0.0))
        for item in [o for o in scene.objects if o.name != "Mirror wall"]:
            copy = item.copy()
            scene.collection.objects.link(copy)
            copy.matrix_world = reflection @ item.matrix_basis
    else:
        mirror = kit.metal("Mirror", (1.0, 1.0, 1.0))
        kit.quad(scene, "Mirror", [(0, y0, z0), (0, y1, z0), (0, y1, z1), (0, y0, z1)], mirror)
    kit.camera(scene, (1.75, -0.65, 1.15), (0.2, 1.42, 0.2), lens=40.0)
