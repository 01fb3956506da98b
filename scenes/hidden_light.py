# SPDX-License-Identifier: GPL-3.0-or-later
"""A living room in the evening, lit by the ceiling: the only bulbs are in opaque shades.

After Veach (1997, fig. 10.3). An uplight throws its light on the ceiling above it, and nothing
else is lit directly but the table with its glass egg, by a small spotlight on the wall. All but the
egg is diffuse, so that renderers with other materials can be given the same scene.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 256

# (radius, height) in metres. The cup is closed below, and so deep that its bulb sees only ceiling.
STAND = [(0.0, 0.0), (0.15, 0.0), (0.15, 0.015), (0.03, 0.03), (0.014, 0.06), (0.014, 1.5)]
CUP = [(0.0, 1.5), (0.05, 1.5), (0.16, 1.78), (0.165, 1.78), (0.155, 1.775), (0.048, 1.51)]
EGG = [
    (math.sin(a) * (1 - 0.16 * -math.cos(a)), -1.32 * math.cos(a))
    for a in (math.pi * i / 64 for i in range(65))
]


def uplight(scene: bpy.types.Scene, location: kit.Point3) -> None:
    metal = kit.diffuse("Bronze", (0.30, 0.20, 0.12))
    kit.lathe(scene, "Stand", STAND, metal, 48).location = location
    kit.lathe(scene, "Cup", [*CUP, (0.0, 1.51)], metal, 96).location = location
    bulb = kit.sphere(scene, "Bulb", 0.045, kit.emission("Bulb", (1.0, 0.80, 0.56), 3000.0), 32)
    bulb.location = (location[0], location[1], 1.57)


def spotlight(scene: bpy.types.Scene, eye: kit.Point3, target: kit.Point3) -> None:
    """A bulb of two centimetres in a black tube that keeps its light from the rest of the room."""
    wall, closed, length = 0.040, 0.05, 0.12
    tube = [(wall, -length), (0.044, -length), (0.044, closed), (0.0, closed)]
    tube = [(0.0, closed - 0.004), (wall, closed - 0.004), *tube]
    housing = kit.lathe(scene, "Housing", tube, kit.diffuse("Black", (0.04, 0.04, 0.04)), 48)
    bulb = kit.sphere(
        scene, "Halogen", 0.01, kit.emission("Halogen", (1.0, 0.86, 0.66), 60000.0), 16
    )
    turn = [round(angle, 4) for angle in kit.aim(eye, target).to_euler()]
    for item in (housing, bulb):
        item.location, item.rotation_euler = eye, turn


def sofa(scene: bpy.types.Scene) -> None:
    cloth = kit.diffuse("Linen", (0.16, 0.26, 0.32))
    pillow = kit.diffuse("Pillow", (0.62, 0.36, 0.12))
    for name, size, location, bevel in (
        ("Seat", (1.9, 0.85, 0.28), (-0.35, 1.50, 0.12), 0.05),
        ("Cushion left", (0.93, 0.72, 0.16), (-0.82, 1.42, 0.39), 0.06),
        ("Cushion right", (0.93, 0.72, 0.16), (0.12, 1.42, 0.39), 0.06),
        ("Back rest", (1.9, 0.22, 0.72), (-0.35, 1.86, 0.14), 0.07),
        ("Arm left", (0.22, 0.86, 0.56), (-1.40, 1.50, 0.08), 0.06),
        ("Arm right", (0.22, 0.86, 0.56), (0.70, 1.50, 0.08), 0.06),
    ):
        props.block(scene, name, size, cloth, location, 0.0, bevel)
    item = props.block(scene, "Pillow", (0.44, 0.14, 0.40), pillow, (0.33, 1.66, 0.56), -14, 0.065)
    item.rotation_euler.x = -0.3


def table(scene: bpy.types.Scene) -> None:
    wood = kit.diffuse("Walnut", (0.20, 0.10, 0.055))
    props.block(scene, "Table", (1.1, 0.62, 0.04), wood, (-0.1, 0.35, 0.38))
    for i, (x, y) in enumerate(((-0.58, 0.10), (0.38, 0.10), (-0.58, 0.60), (0.38, 0.60))):
        props.block(scene, f"Leg {i}", (0.05, 0.05, 0.38), wood, (x, y, 0.0))
    egg = kit.lathe(scene, "Egg", [(0.1 * r, 0.1 * z) for r, z in EGG], kit.glass("Glass"))
    egg.location = (0.12, 0.33, 0.4201 + 0.1 * 1.32)
    for i, (color, turn) in enumerate((((0.45, 0.08, 0.06), 12), ((0.72, 0.66, 0.52), 31))):
        cover = kit.diffuse(f"Book {i}", color)
        height = 0.4203 + 0.0352 * i
        props.block(
            scene, f"Book {i}", (0.26, 0.19, 0.035), cover, (-0.40, 0.36, height), turn, 4e-3
        )


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX")
    kit.world(scene)

    plaster = kit.diffuse("Plaster", (0.70, 0.64, 0.54))
    white = kit.diffuse("Ceiling", (0.80, 0.79, 0.76))
    parquet = kit.diffuse("Parquet", (0.34, 0.19, 0.10))
    a, b, c, d = (-2.3, -2.6, 0), (2.3, -2.6, 0), (2.3, 2.1, 0), (-2.3, 2.1, 0)
    e, f, g, h = ((x, y, 2.5) for x, y, _ in (a, b, c, d))
    kit.quad(scene, "Floor", [a, b, c, d], parquet)
    kit.quad(scene, "Ceiling", [e, h, g, f], white)
    for name, corners in (
        ("Back", [d, c, g, h]),
        ("Front", [b, a, e, f]),
        ("Left", [a, d, h, e]),
        ("Right", [c, b, f, g]),
    ):
        kit.quad(scene, name, corners, plaster)
    rug = kit.diffuse("Rug", (0.50, 0.42, 0.33))
    props.block(scene, "Rug", (2.6, 1.7, 0.012), rug, (-0.15, 0.45, 0.0), 0.0, 0.004)
    frame, print_ = kit.diffuse("Frame", (0.03, 0.03, 0.03)), (0.55, 0.22, 0.10)
    props.block(scene, "Frame", (0.9, 0.03, 0.62), frame, (-0.35, 2.08, 1.35))
    props.block(scene, "Passe-partout", (0.82, 0.02, 0.54), white, (-0.35, 2.07, 1.39), 0.0, 1e-3)
    props.block(
        *(scene, "Picture", (0.5, 0.02, 0.3), kit.diffuse("Print", print_), (-0.35, 2.065, 1.51)),
        *(0.0, 1e-3),
    )
    sofa(scene)
    table(scene)
    uplight(scene, (1.35, 1.55, 0.0))

    spotlight(scene, (2.05, 0.95, 1.75), (0.12, 0.33, 0.50))
    kit.camera(scene, (0.32, -2.3, 1.2), (0.12, 1.0, 0.98), lens=26.0)
