# SPDX-License-Identifier: GPL-3.0-or-later
"""The card trick of Sen et al. (2005): a card with its back to the camera, read nevertheless.

A projector lights the card's face, and nothing else. The camera sees the back, and the page of a
book in the light that the face reflects onto it. The dual picture, `./dev render dual_card --dual
DIR`, is what the projector sees.
"""

from __future__ import annotations

import math

import bpy
from mathutils import Matrix

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 160, 120, 256

# The face as the projector sees it.
FACE = (
    ".......",
    ".#####.",
    ".....#.",
    "....#..",
    "...#...",
    "..#....",
    "..#....",
    "..#....",
    ".......",
)
FIELD = 0.09  # metres
LOWEST = 0.1


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene)

    card(scene)
    page = kit.diffuse("Page", (0.85, 0.83, 0.78))
    table = kit.diffuse("Table", (0.42, 0.28, 0.17))
    wall = kit.diffuse("Wall", (0.75, 0.75, 0.72))
    kit.quad(scene, "Table", [(-2, -2, 0), (2, -2, 0), (2, 3, 0), (-2, 3, 0)], table)
    kit.quad(scene, "Wall", [(-2, 3, 0), (2, 3, 0), (2, 3, 3), (-2, 3, 3)], wall)
    book = [(-0.8, 0.12, 0.002), (0.8, 0.12, 0.002), (0.8, 1.3, 0.002), (-0.8, 1.3, 0.002)]
    kit.quad(scene, "Book", book, page)
    kit.camera(scene, (0.0, -1.5, 3.0), (0.0, 0.42, 0.15), lens=44.0)

    light = bpy.data.lights.new("Projector", "SPOT")
    light.energy = 8000.0
    light.shadow_soft_size = 0.0
    light.spot_size, light.spot_blend = 2.0 * math.atan(0.127), 0.0
    projector = bpy.data.objects.new("Projector", light)
    # Taller than wide, as the card is.
    projector.matrix_world = kit.aim((0.0, 2.3, 0.9), (0.0, 0.0, LOWEST + 4.5 * FIELD)) @ (
        Matrix.Diagonal((1.0, 1.25, 1.0, 1.0))
    )
    scene.collection.objects.link(projector)


def card(scene: bpy.types.Scene) -> None:
    """Its face looks along +y, where left is +x."""
    materials = {
        ".": kit.diffuse("Paper", (0.85, 0.85, 0.85)),
        "#": kit.diffuse("Ink", (0.03,) * 3),
    }
    columns, rows = len(FACE[0]), len(FACE)
    half = 0.5 * columns * FIELD
    for kind, material in materials.items():
        vertices, faces = [], []
        for row, line in enumerate(FACE):
            for column in (i for i, field in enumerate(line) if field == kind):
                x, z = half - column * FIELD, LOWEST + (rows - row) * FIELD
                corners = [(x, z - FIELD), (x - FIELD, z - FIELD), (x - FIELD, z), (x, z)]
                faces.append(tuple(range(len(vertices), len(vertices) + 4)))
                vertices += [(px, 0.0, pz) for px, pz in corners]
        kit.mesh_object(scene, material.name, vertices, faces, material)
    top = LOWEST + rows * FIELD
    back = [
        (-half, -0.004, LOWEST),
        (half, -0.004, LOWEST),
        (half, -0.004, top),
        (-half, -0.004, top),
    ]
    kit.quad(scene, "Back", back, kit.diffuse("Back", (0.45, 0.06, 0.05)))
