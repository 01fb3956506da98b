# SPDX-License-Identifier: GPL-3.0-or-later
"""A wall of spheres, one closure each, lit from everywhere and by one lamp.

Spheres show a closure under all angles at once. Each has a square of the picture to itself, so that
a comparison by blocks is one of closures. They stand apart: what they do to each other is little.
"""

from __future__ import annotations

import bpy

from scenes import kit

COLUMNS, ROWS, CELL = 9, 4, 12  # CELL: pixels
WIDTH, HEIGHT, SAMPLES = COLUMNS * CELL, ROWS * CELL, 128

RED, BLUE, GREY, WHITE = (0.9, 0.35, 0.2), (0.25, 0.45, 0.9), (0.6, 0.6, 0.6), (1.0, 1.0, 1.0)


def _shader(kind: str, distribution: str | None = None, **inputs: object):
    """A maker of materials of one node; names of inputs with _ for blanks."""
    return lambda name: kit.shader(
        name, kind, distribution, **{key.replace("_", " "): value for key, value in inputs.items()}
    )


def diffuse(roughness: float, color=RED):
    return _shader("BsdfDiffuse", Color=(*color, 1.0), Roughness=roughness)


def glossy(distribution: str, roughness: float, color=RED):
    return _shader("BsdfAnisotropic", distribution, Color=(*color, 1.0), Roughness=roughness)


def glass(distribution: str, roughness: float, ior: float = 1.5, color=BLUE):
    return _shader("BsdfGlass", distribution, Color=(*color, 1.0), Roughness=roughness, IOR=ior)


def refraction(roughness: float, ior: float = 1.45):
    return _shader("BsdfRefraction", "GGX", Color=(*BLUE, 1.0), Roughness=roughness, IOR=ior)


def principled(distribution: str = "MULTI_GGX", color=RED, **inputs: object):
    return _shader("BsdfPrincipled", distribution, Base_Color=(*color, 1.0), **inputs)


def mixed(kind: str, first, second):
    return lambda name: kit.combined(name, kind, first(name + " A"), second(name + " B"))


# From left to right and from the bottom row up: the order of the blocks of a picture.
CLOSURES = [
    diffuse(0.0),
    diffuse(0.5),
    diffuse(1.0, WHITE),
    _shader("BsdfTranslucent", Color=(*RED, 1.0)),
    glossy("GGX", 0.0),
    glossy("GGX", 0.25),
    glossy("GGX", 0.9),
    glossy("MULTI_GGX", 0.5),
    glossy("MULTI_GGX", 1.0),
    #
    glass("GGX", 0.0),
    glass("GGX", 0.2),
    glass("GGX", 0.6),
    glass("MULTI_GGX", 0.4, 1.33),
    glass("MULTI_GGX", 0.8, 1.8, WHITE),
    glass("GGX", 0.3, 0.8),
    refraction(0.0),
    refraction(0.3),
    refraction(0.7, 1.2),
    #
    principled(),
    principled("GGX", Roughness=0.3),
    principled(Roughness=0.0),
    principled(color=WHITE, Roughness=1.0),
    principled(Roughness=0.3, Specular_IOR_Level=1.0, IOR=1.8),
    principled(Roughness=0.5, Diffuse_Roughness=0.8, Specular_IOR_Level=0.2),
    principled(Metallic=1.0, Roughness=0.4),
    principled("GGX", Metallic=1.0, Roughness=0.8),
    principled(Metallic=0.5, Roughness=0.2),
    #
    principled(Transmission_Weight=1.0, Roughness=0.0),
    principled(Transmission_Weight=1.0, Roughness=0.4),
    principled("GGX", Transmission_Weight=0.5, Roughness=0.3, IOR=1.3),
    principled(Transmission_Weight=0.4, Metallic=0.3, Roughness=0.5, IOR=0.9),
    principled(Emission_Strength=0.3, Roughness=0.6),
    mixed("MixShader", diffuse(0.0), glossy("GGX", 0.0)),
    mixed("MixShader", diffuse(0.3), glass("GGX", 0.3)),
    mixed("AddShader", diffuse(0.0, GREY), glossy("GGX", 0.3, BLUE)),
    _shader("Emission", Color=(*BLUE, 1.0), Strength=0.7),
]


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene, (0.5, 0.55, 0.6))
    for index, closure in enumerate(CLOSURES):
        row, column = divmod(index, COLUMNS)
        ball = kit.sphere(scene, f"Ball {index}", 0.48, closure(f"Closure {index}"), 64)
        ball.location = (column - (COLUMNS - 1) / 2, 0.0, row - (ROWS - 1) / 2)
    # Cycles must find this lamp by chance: where it joins a lamp to rough glass, it adds light
    # for pairs of directions that no facet refracts into each other (5.0; 5 % at roughness 0.8).
    glow = kit.emission("Lamp", (1.0, 0.95, 0.9), 6.0)
    glow.cycles.emission_sampling = "NONE"
    lamp = kit.quad(scene, "Lamp", [(-7, -7, 0), (7, -7, 0), (7, 7, 0), (-7, 7, 0)], glow)
    lamp.matrix_world = kit.aim((-6.0, -8.0, 9.0), (0.0, 0.0, 0.0))
    distance = 60.0  # nearly parallel, so that a ball fills its square
    kit.camera(scene, (0.0, -distance, 0.0), (0.0, 0.0, 0.0), lens=36.0 * distance / COLUMNS)
