# SPDX-License-Identifier: GPL-3.0-or-later
"""A small house with a garden under a clear sky.

An easy scene: nearly all of the light comes straight from the sun and the sky, and light paths
from so far away hardly ever arrive where the camera looks.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 128

LENGTH, DEPTH, EAVES, RIDGE = 7.0, 5.0, 2.7, 4.7  # of the house, metres


def house(scene: bpy.types.Scene) -> None:
    render = kit.diffuse("Render", (0.74, 0.66, 0.52))
    white = props.principled("White", (0.80, 0.79, 0.76), 0.4)
    door = props.principled("Door", (0.10, 0.26, 0.24), 0.35)
    brick = kit.diffuse("Brick", (0.36, 0.14, 0.09))
    windows = [(0.7, 1.9, 0.95, 2.2), (5.1, 6.3, 0.95, 2.2)]
    front = props.wall(
        scene, "Front", (LENGTH, 0.3, EAVES), render, [*windows, (3.0, 4.0, 0.0, 2.15)]
    )
    front.location = (-LENGTH / 2, 0.0, 0.0)
    back = props.wall(scene, "Back", (LENGTH, 0.3, EAVES), render)
    back.location = (-LENGTH / 2, DEPTH - 0.3, 0.0)
    for name, x in (("Left gable", -LENGTH / 2 - 2e-3), ("Right gable", LENGTH / 2 + 2e-3)):
        points = [(x, 0, 0), (x, DEPTH, 0), (x, DEPTH, EAVES), (x, DEPTH / 2, RIDGE), (x, 0, EAVES)]
        kit.mesh_object(scene, name, points, [(0, 1, 2, 3, 4)], render)
    glazing = props.principled("Glazing", (0.03, 0.04, 0.05), 0.05)
    for x0, x1, z0, z1 in windows:
        x, width, tall = (x0 + x1) / 2 - LENGTH / 2, x1 - x0, z1 - z0
        props.block(scene, "Pane", (width, 0.02, tall), glazing, (x, 0.20, z0), 0.0, 0.001)
        # A little above the edge of the opening: what lies in one plane fights for the ray.
        props.block(scene, "Sill", (width + 0.16, 0.2, 0.064), white, (x, 0.0, z0 - 0.06))
        for offset in (0.035 - width / 2, 0.0, width / 2 - 0.035):
            props.block(scene, "Stile", (0.06, 0.06, tall), white, (x + offset, 0.16, z0))
        for level in (0.0, 0.6 * tall, tall - 0.06):
            props.block(scene, "Rail", (width, 0.055, 0.06), white, (x, 0.16, z0 + level))
        for side in (-1, 1):  # shutters
            props.block(
                *(scene, "Shutter", (0.56, 0.04, tall), door),
                (x + side * (width / 2 + 0.32), -0.03, z0),
            )
    props.block(scene, "Door", (0.96, 0.06, 2.13), door, (0.0, 0.18, 0.0))
    for level in (0.25, 1.2):
        props.block(scene, "Panel", (0.66, 0.03, 0.75), door, (0.0, 0.145, level))
    knob = kit.sphere(
        scene, "Knob", 0.04, props.principled("Brass", (0.9, 0.66, 0.3), 0.25, 1.0), 32
    )
    knob.location = (-0.36, 0.11, 1.05)
    stone = kit.diffuse("Stone", (0.52, 0.48, 0.42))
    props.block(scene, "Step", (1.5, 0.7, 0.12), stone, (0.0, -0.3, 0.0), 0.0, 0.02)
    props.block(scene, "Chimney", (0.6, 0.6, 2.3), brick, (1.9, DEPTH / 2 + 0.5, 3.3), 0.0, 0.02)
    props.block(scene, "Chimney cap", (0.74, 0.74, 0.1), stone, (1.9, DEPTH / 2 + 0.5, 5.6))
    roof(scene)


def roof(scene: bpy.types.Scene) -> None:
    """Rows of shingles, each a slat that lies on the one below."""
    shingles = [
        kit.diffuse(f"Shingle {i}", color)
        for i, color in enumerate([(0.34, 0.13, 0.08), (0.40, 0.16, 0.09), (0.29, 0.11, 0.07)])
    ]
    slope = math.atan2(RIDGE - EAVES, DEPTH / 2)
    run = math.hypot(RIDGE - EAVES, DEPTH / 2) + 0.45
    rows, columns = 14, 24
    pitch, width = run / rows, (LENGTH + 0.7) / columns
    for side in (-1, 1):
        for k in range(rows):
            down = pitch * (k + 0.5)
            y = DEPTH / 2 + side * down * math.cos(slope)
            z = RIDGE + 0.05 - down * math.sin(slope)
            for i in range(columns):
                x = -(LENGTH + 0.7) / 2 + width * (i + 0.5)
                size = (width - 0.012, pitch * 1.15, 0.03)
                item = kit.box(scene, "Shingle", size, shingles[(i * 5 + k * 3 + i * k) % 7 % 3])
                item.location = (x, y, z)
                item.rotation_euler.x = -side * (slope - 0.06)


def tree(scene, name: str, x: float, y: float, height: float, leaves, bark) -> None:
    trunk = [
        (0.0, 0.0),
        (0.16, 0.0),
        (0.11, 0.3 * height),
        (0.08, 0.6 * height),
        (0.0, 0.6 * height),
    ]
    kit.lathe(scene, f"{name} trunk", trunk, bark, 24).location = (x, y, 0.0)
    for i in range(9):  # a crown of balls on a spiral
        angle, up = 2.4 * i, 0.48 + 0.055 * i
        out = 0.20 * height * math.sin(math.pi * (0.2 + 0.08 * i))
        radius = height * (0.19 - 0.008 * i)
        ball = kit.sphere(scene, f"{name} leaves {i}", radius, leaves, 40)
        ball.location = (x + out * math.cos(angle), y + out * math.sin(angle), up * height)


def garden(scene: bpy.types.Scene) -> None:
    lawn = kit.diffuse("Lawn", (0.14, 0.25, 0.06))
    path = kit.diffuse("Path", (0.50, 0.44, 0.36))
    kit.quad(scene, "Lawn", [(-60, -40, 0), (60, -40, 0), (60, 80, 0), (-60, 80, 0)], lawn)
    for i in range(7):  # stepping stones
        x = 0.18 * math.sin(1.9 * i)
        props.block(
            scene, f"Slab {i}", (0.95, 0.62, 0.05), path, (x, -1.0 - 0.8 * i, 0.0), 9 * (-1) ** i
        )
    white = kit.diffuse("Fence", (0.78, 0.77, 0.74))
    for side in (-1, 1):
        for i in range(22):
            x = side * (1.0 + 0.28 * i)
            props.block(scene, "Picket", (0.11, 0.025, 0.85), white, (x, -4.2, 0.05))
        for z in (0.25, 0.65):
            props.block(scene, "Bar", (6.1, 0.04, 0.08), white, (side * 3.9, -4.17, z))
    bark = kit.diffuse("Bark", (0.16, 0.10, 0.06))
    tree(scene, "Oak", -5.6, 2.2, 5.6, kit.diffuse("Oak leaves", (0.10, 0.22, 0.04)), bark)
    tree(scene, "Birch", 6.4, 4.5, 6.6, kit.diffuse("Birch leaves", (0.17, 0.29, 0.06)), bark)
    bush = kit.diffuse("Bush", (0.07, 0.17, 0.05))
    for i, x in enumerate((-3.0, -2.2, -1.35, 1.4, 2.25, 3.1)):
        ball = kit.sphere(scene, f"Bush {i}", 0.36 + 0.05 * (i % 3), bush, 40)
        ball.location = (x, -0.55, 0.26)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", "AgX - Medium High Contrast")
    kit.world(scene, (0.28, 0.48, 0.90), 1.0)
    house(scene)
    garden(scene)
    props.lamp(
        *(scene, "Sun", "SUN", (-6.0, -8.0, 9.0), 4.0, (1.0, 0.90, 0.75), (0.0, 0.0, 0.0)),
        angle=props.SUN,
    )
    kit.camera(scene, (-4.6, -11.2, 2.1), (0.1, 0.6, 1.9), lens=34.0)
