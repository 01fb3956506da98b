# SPDX-License-Identifier: GPL-3.0-or-later
"""Three plain bodies on a floor in front of a wall, in the light of two large lamps.

An easy scene: every surface sees the lamps, so path tracing does well and light paths have hardly
anything to add. What bidirectional path tracing costs shows here. `studio` is lit by an
image instead.
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

    paper = kit.diffuse("Paper", (0.6, 0.6, 0.6))
    s, h, d = 6.0, 6.0, 3.0
    kit.quad(scene, "Floor", [(-s, -s, 0), (s, -s, 0), (s, d, 0), (-s, d, 0)], paper)
    kit.quad(scene, "Wall", [(-s, d, 0), (s, d, 0), (s, d, h), (-s, d, h)], paper)

    ball = kit.sphere(scene, "Ball", 0.5, kit.diffuse("Clay", (0.5, 0.24, 0.15)))
    ball.location = (-0.75, 0.1, 0.5)
    kit.box(scene, "Box", (0.7, 0.7, 0.9), kit.diffuse("Blue", (0.12, 0.22, 0.45))).location.x = 0.9
    profile = [(0.0, 0.0), (0.45, 0.0), (0.0, 1.0)]
    kit.lathe(scene, "Cone", profile, kit.diffuse("Green", (0.2, 0.4, 0.15))).location.y = 1.2

    kit.area_light(scene, "Key", (-2.4, -2.2, 3.2), (0, 0, 0.4), (2.0, 2.0), 220.0)
    kit.area_light(scene, "Fill", (3.0, -1.6, 2.4), (0, 0, 0.4), (2.0, 2.0), 60.0, (0.8, 0.9, 1.0))
    kit.camera(scene, (0.0, -5.4, 1.7), (0.0, 0.2, 0.5), lens=60.0)
