# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: pages of balls, one setting of closure_cells.py each.

Page N has every PAGES-th cell from the N-th on, so that one page is a cross-section of all. Balls
show a closure under all angles at once. They stand far apart in depth before an orthographic
camera: each has a square of the picture to itself, and little to do with its neighbours.
"""

from __future__ import annotations

import os

from . import closure_cells, closure_cells_thin_wall

PAGES, COLUMNS = 8, 8
CELL = 12  # pixels of a ball's square
RADIUS = 0.49
FULL = "JANUS_FULL" in os.environ
ONLY = os.environ.get("JANUS_CELLS", "")  # to look at those whose names hold this alone
SEEDS, SAMPLES, BOUNCES = 8, 128, 4

CASES = [f"page_{number}" for number in range(PAGES if FULL else 1)]
# What only Blender 5.2 has. See tests/package/test_thin_wall.py.
THIN_WALLS = "thin_walls"


def names(page: str) -> list[str]:
    """From left to right and from the bottom row up: the order of the blocks of a picture."""
    closure_cells.add_cells()
    cells = [name for name in closure_cells.CELLS if ONLY in name]
    thin = [name for name in cells if name.startswith(closure_cells_thin_wall.NAME)]
    if page == THIN_WALLS:
        return thin[:: 1 if FULL else 3]
    return [name for name in cells if name not in thin][int(page.rpartition("_")[2]) :: PAGES]


def times(page: str) -> int:
    """How many times the samples of the quick run; bubbles are noisy."""
    return 2 if FULL or page == THIN_WALLS else 1


def rows(page: str) -> int:
    return -(-len(names(page)) // COLUMNS)


def world(t):
    """Brighter above, with stripes and a turn of hue; smooth, as light is found by chance."""
    x, y, z = t.node("SeparateXYZ", {0: t.coordinate("Generated")}).outputs[:3]

    def wave(value, times: float, level: float):
        swing = t.out("Math", {0: value, 1: times}, operation="MULTIPLY")
        sine = t.out("Math", {0: swing}, operation="SINE")
        return t.out("Math", {0: sine, 1: 0.25, 2: level}, operation="MULTIPLY_ADD")

    color = t.out("CombineXYZ", {0: wave(x, 5.0, 0.5), 1: wave(z, 2.0, 0.5), 2: wave(y, 7.0, 0.45)})
    return t.out("Background", {"Color": color})


def build(page: str):
    import bpy

    from scenes import kit
    from tests.images.node_cases import material
    from tests.images.world_scenes import set_tree

    scene = bpy.context.scene
    kit.neutral_settings(scene, CELL * COLUMNS, CELL * rows(page), SAMPLES * times(page))
    # Cycles counts a bounce where the camera's ray meets a smooth wall: that may not matter.
    kit.limit_bounces(scene.cycles, BOUNCES if page != THIN_WALLS else 4 * BOUNCES)
    set_tree(scene, world)
    # Cycles must find light by chance: where it joins light to rough glass, it adds some for pairs
    # of directions that no facet refracts into each other (5.0; 5 % at roughness 0.8).
    scene.world.cycles.sampling_method = "NONE"
    glow = kit.emission("Lamp", (1.0, 0.95, 0.9), 1.4)
    glow.cycles.emission_sampling = "NONE"
    s = 150.0
    lamp = kit.quad(scene, "Lamp", [(-s, -s, 0), (s, -s, 0), (s, s, 0), (-s, s, 0)], glow)
    lamp.matrix_world = kit.aim((-140.0, -150.0, 220.0), (0.0, 45.0, 0.0))
    mesh = kit.sphere(scene, "Ball", RADIUS, None, 64).data
    bpy.data.objects.remove(bpy.data.objects["Ball"])
    mesh.materials.append(None)
    for index, name in enumerate(names(page)):
        row, column = divmod(index, COLUMNS)
        ball = bpy.data.objects.new(f"Ball {index}", mesh)
        ball.location = (
            column - (COLUMNS - 1) / 2,
            6.0 * ((column + 4 * row) % 16),  # 4 columns or rows apart where it is the same
            row - (rows(page) - 1) / 2,
        )
        ball.material_slots[0].link = "OBJECT"
        ball.material_slots[0].material = material(name, closure_cells.CELLS[name])
        scene.collection.objects.link(ball)
    kit.camera(scene, (0.0, -20.0, 0.0), (0.0, 0.0, 0.0), clip=(0.1, 1000.0))
    scene.camera.data.type = "ORTHO"
    scene.camera.data.ortho_scale = max(COLUMNS, rows(page))
    return scene


def for_janus(scene) -> None:
    """Janus looks for the light."""
    import bpy

    bpy.data.materials["Lamp"].cycles.emission_sampling = "AUTO"
    scene.world.cycles.sampling_method = "AUTOMATIC"
