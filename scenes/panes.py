# SPDX-License-Identifier: GPL-3.0-or-later
"""A wall of panes that light passes without a bend: Transparent closures and alpha.

Each pane has a cell of the picture to itself. Through its left half one sees a backdrop with the
pane's own shadow on it, through its right half the world.
"""

from __future__ import annotations

import bpy

from scenes import kit
from scenes.closures import BLUE, GREY, RED, WHITE, diffuse, glass, glossy, mixed, principled

COLUMNS, ROWS, CELL = 6, 3, 12  # CELL: pixels
WIDTH, HEIGHT, SAMPLES = COLUMNS * CELL, ROWS * CELL, 128
GREEN = (0.3, 0.9, 0.5)


def transparent(color=WHITE):
    return lambda name: kit.shader(name, "BsdfTransparent", Color=(*color, 1.0))


def translucent(color=WHITE):
    return lambda name: kit.shader(name, "BsdfTranslucent", Color=(*color, 1.0))


def emission(color, strength: float):
    return lambda name: kit.emission(name, color, strength)


# From left to right and from the bottom row up: a closure, and how many panes stand in a row.
PANES = [
    (transparent(), 1),
    (transparent(RED), 1),
    (transparent(GREEN), 3),
    (mixed("MixShader", transparent(), diffuse(0.0)), 1),
    (mixed("MixShader", transparent(BLUE), diffuse(0.5, WHITE)), 3),
    (mixed("AddShader", transparent(GREY), diffuse(0.0, (0.3, 0.35, 0.2))), 1),
    #
    (mixed("MixShader", transparent(), glossy("GGX", 0.4)), 1),
    (mixed("MixShader", transparent(RED), glossy("GGX", 0.0, WHITE)), 1),
    (mixed("MixShader", transparent(GREEN), translucent()), 1),
    (mixed("MixShader", transparent(BLUE), glass("GGX", 0.0, 1.3, WHITE)), 1),
    (mixed("MixShader", transparent(RED), emission(GREEN, 0.8)), 1),
    (mixed("AddShader", transparent(GREEN), emission(RED, 0.5)), 3),
    #
    (principled(Alpha=0.3), 1),
    (principled(Alpha=0.3), 3),
    (principled(Alpha=0.3, Emission_Strength=0.8), 1),
    (principled(Alpha=0.7, Metallic=0.6, Roughness=0.3), 1),
    (principled(Alpha=0.5, Transmission_Weight=1.0, Roughness=0.0, IOR=1.3), 1),
    (principled(Alpha=0.0), 1),
]


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    for settings in (scene.cycles, getattr(scene, "janus", None)):
        if settings:
            settings.transparent_max_bounces = 64  # no path ends for it
    kit.view(scene, "Standard")
    kit.world(scene, (0.3, 0.35, 0.4))
    wall = kit.diffuse("Wall", (0.7, 0.7, 0.7))
    for index, (closure, number) in enumerate(PANES):
        row, column = divmod(index, COLUMNS)
        x, z = column - (COLUMNS - 1) / 2, row - (ROWS - 1) / 2
        material = closure(f"Pane {index}")
        for i in range(number):
            y = -0.2 - 0.15 * i
            corners = [(-0.45, y, -0.45), (0.45, y, -0.45), (0.45, y, 0.45), (-0.45, y, 0.45)]
            pane = kit.quad(scene, f"Pane {index}.{i}", corners, material)
            pane.location = (x, 0.0, z)
        corners = [(-0.5, 0.2, -0.5), (0.0, 0.2, -0.5), (0.0, 0.2, 0.5), (-0.5, 0.2, 0.5)]
        kit.quad(scene, f"Backdrop {index}", corners, wall).location = (x, 0.0, z)
    # One lamp on either side. None is a point: path tracing could not see it in the smooth panes.
    kit.area_light(scene, "Front", (-3.0, -9.0, 4.0), (0.0, 0.0, 0.0), (4.0, 3.0), 1200.0)
    lamp = bpy.data.lights.new("Back", "POINT")
    lamp.energy, lamp.shadow_soft_size, lamp.color = 600.0, 1.0, (1.0, 0.8, 0.6)
    back = bpy.data.objects.new("Back", lamp)
    back.location = (4.0, 6.0, 3.0)
    scene.collection.objects.link(back)
    distance = 60.0  # nearly parallel, so that a pane fills its square
    kit.camera(scene, (0.0, -distance, 0.0), (0.0, 0.0, 0.0), lens=36.0 * distance / COLUMNS)
