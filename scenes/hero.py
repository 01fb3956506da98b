# SPDX-License-Identifier: GPL-3.0-or-later
"""A swirled glass goblet, a marble and a brass ring in the light of one small lamp.

The picture of the README. Nearly everything worth seeing in it is a caustic: light that reaches
the table through glass or off brass. A path tracer finds those only when a path that leaves the
table happens to hit the lamp of a few centimetres; light paths find them at once.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 640, 400, 280

# (radius, height) in metres: the outer side from the foot to the rim.
OUTER = [
    (0.0410, 0.0000),
    (0.0425, 0.0020),
    (0.0400, 0.0042),
    (0.0220, 0.0085),
    (0.0090, 0.0160),
    (0.0068, 0.0280),
    (0.0085, 0.0400),
    (0.0200, 0.0495),
    (0.0400, 0.0640),
    (0.0510, 0.0850),
    (0.0525, 0.1080),
    (0.0470, 0.1330),
    (0.0425, 0.1500),
]
# The inner side from the rim to the bottom of the bowl.
INNER = [
    (0.0398, 0.1508),
    (0.0428, 0.1330),
    (0.0475, 0.1080),
    (0.0450, 0.0870),
    (0.0330, 0.0730),
    (0.0170, 0.0660),
]


FLUTES, DEPTH, TWIST = 16, 0.0005, 7.0
SEGMENTS = 240


def swirl(radius: float, height: float, angle: float) -> float:
    """Twisted flutes on the outside of the bowl, fading out at its foot and at the rim.

    They are shallow, so that each is a lens that focuses about where the table is; deep ones
    would look the same and only scatter the light.
    """
    rise = (height - 0.048) / (0.150 - 0.048)
    if not 0.0 < rise < 1.0:
        return radius
    return radius + DEPTH * math.sin(math.pi * rise) ** 1.5 * math.cos(
        FLUTES * angle + TWIST * rise
    )


def goblet(scene: bpy.types.Scene, material: bpy.types.Material) -> bpy.types.Object:
    outer = [(0.0, 0.0), *kit.spline(OUTER, 8)]
    inner = [*kit.spline(INNER, 8), (0.0, 0.0640)]
    rim = max(range(len(outer)), key=lambda i: outer[i][1])
    return kit.lathe(
        scene,
        "Goblet",
        outer + inner,
        material,
        segments=SEGMENTS,
        shape=lambda row, radius, height, angle: (
            swirl(radius, height, angle) if row <= rim else radius
        ),
    )


def brass_ring(scene: bpy.types.Scene, material: bpy.types.Material) -> bpy.types.Object:
    """A flat band of metal with rounded edges."""
    radius, height, thickness, fillet = 0.034, 0.014, 0.0024, 0.0008
    corners = [
        (radius + thickness - fillet, fillet, -90.0),
        (radius + thickness - fillet, height - fillet, 0.0),
        (radius + fillet, height - fillet, 90.0),
        (radius + fillet, fillet, 180.0),
    ]
    profile = []
    for x, z, start in corners:
        for i in range(7):
            angle = math.radians(start + 15.0 * i)
            profile.append((x + fillet * math.cos(angle), z + fillet * math.sin(angle)))
    profile.append(profile[0])
    return kit.lathe(scene, "Ring", profile, material, segments=256)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", "AgX - Medium High Contrast")
    kit.world(scene)

    table = kit.diffuse("Table", (0.30, 0.165, 0.095))
    wall = kit.diffuse("Wall", (0.14, 0.30, 0.36))
    clear_glass = kit.glass("Glass", (0.985, 1.0, 0.995), 1.5)
    amber = kit.glass("Amber", (1.0, 0.60, 0.22), 1.5)
    brass = kit.metal("Brass", (0.95, 0.72, 0.36))

    kit.quad(scene, "Table", [(-2, -2, 0), (2, -2, 0), (2, 0.32, 0), (-2, 0.32, 0)], table)
    kit.quad(scene, "Wall", [(-2, 0.32, 0), (2, 0.32, 0), (2, 0.32, 1.6), (-2, 0.32, 1.6)], wall)

    goblet(scene, clear_glass).location = (0.055, 0.03, 0.0004)
    marble = kit.sphere(scene, "Marble", 0.017, amber)
    marble.location = (0.005, -0.115, 0.0172)
    brass_ring(scene, brass).location = (0.150, -0.060, 0.0002)

    # The key is the lamp that makes the caustics: two centimetres wide, behind and to the right.
    kit.area_light(
        *(scene, "Key", (0.47, 0.23, 0.42), (0.02, -0.01, 0.05), (0.02, 0.02)),
        *(1.5, (1.0, 0.85, 0.64), False, 54.0),
    )
    # A large, weak and cool one keeps the shadows open and draws a reflection into the glass.
    kit.area_light(
        scene, "Fill", (-0.75, -0.15, 0.75), (0.0, 0.1, 0.05), (0.5, 0.5), 0.5, (0.5, 0.72, 1.0)
    )
    kit.camera(scene, (0.0, -0.72, 0.38), (-0.004, -0.005, 0.052), lens=64.0)
