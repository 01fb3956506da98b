# SPDX-License-Identifier: GPL-3.0-or-later
"""A tiled pool in the sun, its floor covered with the caustics of the waves.

Sun, water, floor, water, camera: both ends of every path through the water are specular, so no
connection helps. Only a path from the camera that happens to hit the sun finds this light, and
that is why the sun here is a little larger than the real one.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 512

X, Y, DEPTH = 3.0, 4.2, 1.3  # the water: from -X to X, 0 to Y, metres
LEVEL = -0.14
# Waves: length in metres, direction in degrees, phase, height in metres.
WAVES = [
    (0.95, 12, 0.3, 0.0080),
    (0.71, 61, 1.1, 0.0058),
    (0.55, -38, 2.9, 0.0046),
    (0.43, 97, 4.0, 0.0030),
    (0.33, 150, 5.2, 0.0020),
    (0.27, 25, 0.8, 0.0013),
]


def wave(x: float, y: float) -> float:
    height = LEVEL
    for length, degrees, phase, amplitude in WAVES:
        angle = math.radians(degrees)
        along = x * math.cos(angle) + y * math.sin(angle)
        height += amplitude * math.sin(2 * math.pi * along / length + phase)
    return height


def water(scene: bpy.types.Scene) -> None:
    """The surface alone: under it there is nothing but water."""
    across, along = 180, 126
    points = [
        (-X + 2 * X * i / across, Y * k / along)
        for k in range(along + 1)
        for i in range(across + 1)
    ]
    row = across + 1
    faces = [
        (k * row + i, k * row + i + 1, (k + 1) * row + i + 1, (k + 1) * row + i)
        for k in range(along)
        for i in range(across)
    ]
    surface = kit.glass("Water", (0.95, 1.0, 1.0), 1.33)
    kit.mesh_object(scene, "Water", [(x, y, wave(x, y)) for x, y in points], faces, surface, True)


def basin(scene: bpy.types.Scene) -> None:
    grout = kit.diffuse("Grout", (0.62, 0.66, 0.66))
    blues = [
        props.principled(f"Tile {i}", color, 0.5)
        for i, color in enumerate(
            [(0.16, 0.48, 0.60), (0.22, 0.55, 0.66), (0.12, 0.42, 0.56), (0.30, 0.62, 0.70)]
        )
    ]
    dark = props.principled("Dark tile", (0.03, 0.14, 0.30), 0.5)

    def mixed(i: int, k: int) -> int:  # any fixed pattern without a visible period
        return (i * i * 7 + k * k * 13 + i * k * 5 + 3 * i + k) % 17 % 4

    def lane(i: int, k: int) -> int:
        return 4 if i % 10 in (4, 5) and 3 < k < 38 else mixed(i, k)

    def band(i: int, k: int) -> int:
        return 4 if k == 10 else mixed(i, k)

    colors, out = [*blues, dark], 0.004  # tiles stand out of the grout by that
    kit.quad(
        scene, "Floor", [(-X, 0, -DEPTH), (X, 0, -DEPTH), (X, Y, -DEPTH), (-X, Y, -DEPTH)], grout
    )
    floor = (-X, 0, -DEPTH + out)
    props.tiles(scene, "Floor tiles", floor, (2 * X, 0, 0), (0, Y, 0), (60, 42), colors, lane)
    for name, corner, u, count in (
        ("Back", (-X, Y, -DEPTH), (2 * X, 0, 0), 60),
        ("Front", (X, 0, -DEPTH), (-2 * X, 0, 0), 60),
        ("Left", (-X, 0, -DEPTH), (0, Y, 0), 42),
        ("Right", (X, Y, -DEPTH), (0, -Y, 0), 42),
    ):
        length = math.hypot(u[0], u[1])
        inward = (u[1] / length, -u[0] / length)
        ends = [corner, (corner[0] + u[0], corner[1] + u[1], -DEPTH)]
        kit.quad(scene, name, [*ends, *((x, y, 0.0) for x, y, _ in ends[::-1])], grout)
        start = (corner[0] + out * inward[0], corner[1] + out * inward[1], -DEPTH)
        up = (0, 0, DEPTH - 0.05)
        props.tiles(scene, f"{name} tiles", start, u, up, (count, 12), colors, band)


def surroundings(scene: bpy.types.Scene) -> None:
    stone = kit.diffuse("Stone", (0.50, 0.40, 0.30))
    coping = kit.diffuse("Coping", (0.66, 0.62, 0.54))
    lawn = kit.diffuse("Lawn", (0.13, 0.24, 0.06))
    for name, size, location in (
        ("Edge left", (0.36, Y + 0.72, 0.06), (-X - 0.16, Y / 2, -0.01)),
        ("Edge right", (0.36, Y + 0.72, 0.06), (X + 0.16, Y / 2, -0.01)),
        ("Edge back", (2 * X - 0.04, 0.36, 0.06), (0.0, Y + 0.16, -0.01)),
        ("Edge front", (2 * X - 0.04, 0.36, 0.06), (0.0, -0.16, -0.01)),
    ):
        props.block(scene, name, size, coping, location, 0.0, 0.02)
    for name, x0, x1, y0, y1, material in (
        ("Deck left", -9.0, -X - 0.2, -3.0, Y + 1.6, stone),
        ("Deck right", X + 0.2, 9.0, -3.0, Y + 1.6, stone),
        ("Deck back", -X - 0.2, X + 0.2, Y + 0.2, Y + 1.6, stone),
        ("Deck front", -X - 0.2, X + 0.2, -3.0, -0.2, stone),
        ("Lawn", -30.0, 30.0, Y + 1.6, 40.0, lawn),
    ):
        corners = [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
        kit.quad(scene, name, corners, material)
    hedge = kit.diffuse("Hedge", (0.05, 0.12, 0.03))
    props.block(scene, "Hedge", (24.0, 1.0, 1.7), hedge, (0.0, Y + 5.0, 0.0), 0.0, 0.2)

    # A ball that floats, and the steel rails of a ladder.
    white, red = kit.diffuse("White", (0.8, 0.8, 0.78)), kit.diffuse("Red", (0.72, 0.07, 0.05))
    ball = kit.sphere(scene, "Ball", 0.20, white, 48)
    ball.data.materials.append(red)
    stripes = [int(i % 48 // 8 % 2) for i in range(len(ball.data.polygons))]
    ball.data.polygons.foreach_set("material_index", stripes)
    props.place(ball, (0.95, 2.35, LEVEL + 0.11), 20.0, 35.0)
    steel = props.principled("Steel", (0.75, 0.76, 0.78), 0.2, 1.0)
    bend = [
        (0.022 * math.cos(a), 0.022 * math.sin(a))
        for a in (2 * math.pi * i / 16 for i in range(17))
    ]
    bend[-1] = bend[0]
    for y in (Y - 1.25, Y - 0.75):
        hoop = kit.lathe(scene, f"Rail {y:.2f}", [(0.45 + r, z) for r, z in bend], steel, 96)
        props.place(hoop, (-X, y, -0.02), 0.0, 90.0)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", "AgX - Medium High Contrast", -0.4)
    kit.world(scene, (0.30, 0.50, 0.85), 0.7)
    water(scene)
    basin(scene)
    surroundings(scene)
    props.lamp(
        *(scene, "Sun", "SUN", (-4.0, 2.0, 6.0), 3.2, (1.0, 0.92, 0.80), (0.0, 3.2, 0.0)),
        angle=math.radians(2.0),
    )
    kit.camera(scene, (0.4, -1.3, 1.95), (-0.05, 1.75, -0.45), lens=27.0)
