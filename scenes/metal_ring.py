# SPDX-License-Identifier: GPL-3.0-or-later
"""Two gold rings on a table in the light of one small lamp, with the cardioids that they throw.

The simplest of caustics, and one that path tracing hardly finds: the lamp is a centimetre wide.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 256


def ring(scene, name: str, radius: float, width: float, material) -> bpy.types.Object:
    """A band with a rounded outside and a cylindrical inside, which focuses best."""
    thickness, edge, profile = 0.0022, 0.0006, []
    half = width / 2
    for i in range(25):  # the outside, a flat arc from the lower to the upper edge
        z = -1.0 + 2.0 * i / 24
        profile.append(
            (radius + thickness * (0.55 + 0.45 * math.sqrt(1.0 - 0.98 * z * z)), half * z)
        )
    for start, z in ((90.0, half - edge), (180.0, -half + edge)):  # two fillets
        for i in range(1, 8):
            angle = math.radians(start + 90.0 * i / 8)
            profile.append((radius + edge + edge * math.cos(angle), z + edge * math.sin(angle)))
    profile.append(profile[0])
    return kit.lathe(scene, name, profile, material, 360)


def metal(name: str, color: kit.Color) -> bpy.types.Material:
    """Polished, but worn: rough enough that light reflected by one ring is found in the other."""
    return kit.shader(name, "BsdfAnisotropic", "GGX", Color=(*color, 1.0), Roughness=0.12)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", "AgX - Medium High Contrast")
    kit.world(scene, (0.30, 0.42, 0.60), 0.2)

    gold = metal("Gold", (1.0, 0.70, 0.28))
    rose = metal("Rose gold", (0.96, 0.60, 0.44))
    table = kit.diffuse("Table", (0.44, 0.36, 0.30))
    kit.quad(scene, "Table", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], table)

    large = ring(scene, "Ring", 0.030, 0.012, gold)
    large.location = (-0.012, 0.004, 0.0061)
    small = ring(scene, "Leaning ring", 0.022, 0.007, rose)
    # It leans on the large one: its lowest point on the table, its side on the rim.
    props.place(small, (0.040, -0.014, 0.0178), 62.0, 47.0)

    lamp = (0.18, 0.15, 0.19)
    kit.area_light(
        *(scene, "Lamp", lamp, (0.0, 0.0, 0.0), (0.01, 0.01), 0.45, (1.0, 0.90, 0.76)),
        spread=70.0,
    )
    kit.camera(scene, (-0.03, -0.20, 0.17), (0.006, -0.002, 0.002), lens=62.0)
