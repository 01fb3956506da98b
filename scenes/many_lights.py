# SPDX-License-Identifier: GPL-3.0-or-later
"""Three baubles on a table under 480 small lamps on strings, out of the camera's focus.

Which lamp matters differs from point to point: a task for the light tree. Most of the lamps one
sees are discs the size of the lens; their mirror images in the baubles are sharp.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 256

STRINGS, LAMPS, BEHIND = 16, 30, 12
COLORS = [
    (1.0, 0.50, 0.12),
    (1.0, 0.70, 0.32),
    (1.0, 0.16, 0.06),
    (0.14, 0.42, 1.0),
    (0.2, 0.9, 0.3),
]
CAP = [(0.0, 0.0), (0.011, 0.0), (0.012, 0.002), (0.011, 0.004), (0.011, 0.010), (0.0, 0.012)]


def strings(scene: bpy.types.Scene) -> None:
    """Catenaries across the picture, the farther ones higher; the last ones behind the camera."""
    cable = kit.diffuse("Cable", (0.03, 0.04, 0.03))
    glow = [kit.emission(f"Glow {i}", color, 30.0) for i, color in enumerate(COLORS)]
    bulbs = [kit.sphere(scene, f"Bulb {i}", 0.009, material, 12) for i, material in enumerate(glow)]
    for index in range(STRINGS):
        behind = index - BEHIND
        y = 0.7 + 0.24 * index if behind < 0 else -0.8 - 0.3 * behind
        half = 0.9 + 0.42 * abs(y)
        low = 0.07 + 0.030 * index + 0.07 * math.sin(2.3 * index)
        if behind >= 0:
            low = 0.45 + 0.13 * behind
        sag = 0.07 + 0.04 * math.cos(1.7 * index)
        slope = 0.10 * math.sin(4.1 * index)
        points = []
        for i in range(LAMPS):
            u = 2.0 * (i + 0.5) / LAMPS - 1.0
            swing = 0.02 * math.sin(5.1 * i + index)
            points.append(
                (half * u + 0.03 * math.sin(3.7 * index), y + swing, low + slope * u + sag * u * u)
            )
        for i, (x, y, z) in enumerate(points):
            kind = (3 * index + 2 * i + i * i) % len(COLORS)
            if i % 3 == 2:  # every third one is a little sphere that glows
                bulb = bulbs[kind].copy()
                bulb.name = f"Bulb {index}.{i}"
                scene.collection.objects.link(bulb)
                bulb.location = (x, y, z - 0.016)
                continue
            item = props.lamp(
                *(scene, f"Lamp {index}.{i}", "POINT", (x, y, z - 0.016), 0.07, COLORS[kind]),
                shadow_soft_size=0.008,
            )
            item.visible_camera = True
        wire(scene, f"Cable {index}", points, 0.0025, cable)
    for bulb in bulbs:
        bpy.data.objects.remove(bulb)


def wire(scene, name: str, points, radius: float, material: bpy.types.Material) -> None:
    """A thin square tube through the points."""
    offsets = [(radius, 0.0), (0.0, radius), (-radius, 0.0), (0.0, -radius)]
    vertices = [(x, y + a, z + b) for x, y, z in points for a, b in offsets]
    faces = []
    for i in range(len(points) - 1):
        for k in range(4):
            a, b = 4 * i + k, 4 * i + (k + 1) % 4
            faces.append((a, b, b + 4, a + 4))
    kit.mesh_object(scene, name, vertices, faces, material)


def bauble(scene, name: str, radius: float, material, x: float, y: float, cap, lean: float) -> None:
    body = kit.sphere(scene, name, radius, material, 128)
    body.location = (x, y, radius + 0.0002)
    top = kit.lathe(scene, f"{name} cap", CAP, cap, 48)
    top.location = (
        x + (radius - 0.001) * math.sin(lean),
        y,
        radius + (radius - 0.001) * math.cos(lean),
    )
    top.rotation_euler = (0.0, lean, 0.0)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", "AgX - Medium High Contrast")
    kit.world(scene, (0.010, 0.018, 0.045))

    wood = props.principled("Table", (0.20, 0.105, 0.06), 0.32)
    for i in range(7):
        props.block(
            *(scene, f"Board {i}", (2.4, 0.148, 0.03), wood, (0.0, -0.42 + 0.15 * i, -0.03)),
            *(0.0, 0.003),
        )
    ground = kit.diffuse("Ground", (0.05, 0.06, 0.05))
    kit.quad(
        scene, "Ground", [(-9, -2, -0.75), (9, -2, -0.75), (9, 9, -0.75), (-9, 9, -0.75)], ground
    )

    brass = props.principled("Brass", (0.90, 0.68, 0.34), 0.25, 1.0)
    red = props.principled("Red", (0.56, 0.018, 0.022), 0.06)
    bauble(scene, "Red bauble", 0.055, red, -0.005, 0.0, brass, 0.35)
    silver = props.principled("Silver", (0.86, 0.86, 0.90), 0.03, 1.0)
    bauble(scene, "Silver bauble", 0.043, silver, 0.112, 0.035, brass, -0.5)
    frosted = props.principled("Frosted", (0.62, 0.42, 0.16), 0.38, 1.0)
    bauble(scene, "Gold bauble", 0.034, frosted, -0.092, -0.035, brass, -0.9)
    strings(scene)
    # From behind the camera, so that the near sides are not black.
    kit.area_light(
        scene, "Fill", (-0.9, -1.4, 1.1), (0.0, 0.0, 0.05), (0.5, 0.5), 8.0, (0.75, 0.85, 1.0)
    )
    camera = kit.camera(scene, (0.0, -0.62, 0.13), (0.012, 0.0, 0.074), lens=55.0).data
    camera.dof.use_dof = True
    camera.dof.focus_distance, camera.dof.aperture_fstop = 0.60, 2.0
