# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: a few diffuse things in the light of the Sky Texture and its sun.

Nothing is smooth, so that light paths alone find it all.
"""

from __future__ import annotations

from math import radians

from .world_scenes import background, set_tree

SEEDS, SIZE, SAMPLES = 6, 24, 256
STRENGTH = 0.05


def sky(t, strength=STRENGTH, **properties):
    return background(t, t.out("TexSky", {}, **properties), strength)


def two_suns(t):
    """One of them half hidden behind the horizon, where Cycles looks for the brightness alone."""
    wide = {"sun_size": radians(20.0), "sun_intensity": 0.01}
    first = sky(t, sun_elevation=0.7, sun_rotation=0.5, **wide)
    second = sky(t, sky_type="SINGLE_SCATTERING", sun_rotation=4.0, sun_elevation=0.05, **wide)
    return t.out("AddShader", {0: first, 1: second})


def colored(t):
    """The tree dims what the node gives, the sun more than the rest."""
    color = t.out("TexSky", {}, sun_elevation=0.9, sun_rotation=2.0)
    dimmed = t.out("Gamma", {0: color, 1: 0.7})
    return background(t, dimmed, 0.1)


CASES = {
    "default": lambda t: sky(t),
    "noon": lambda t: sky(t, sun_elevation=1.3, sun_rotation=0.4, altitude=2000.0),
    "single": lambda t: sky(t, sky_type="SINGLE_SCATTERING", sun_elevation=0.5),
    "low": lambda t: sky(t, 1.0, sun_elevation=0.002, sun_rotation=2.0, aerosol_density=0.3),
    "wide": lambda t: sky(t, sun_size=radians(25.0), sun_elevation=0.4, sun_rotation=-1.0),
    "no_disc": lambda t: sky(t, 0.3, sun_disc=False, sun_elevation=0.8),
    "two_suns": two_suns,
    "colored": colored,
    "preetham": lambda t: sky(t, 5.0, sky_type="PREETHAM", sun_direction=(0.5, 0.3, 0.6)),
    "hosek": lambda t: sky(t, 20.0, sky_type="HOSEK_WILKIE", sun_direction=(0.5, 0.3, 0.6)),
}


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, SAMPLES)
    set_tree(scene, CASES[name])
    white = kit.diffuse("White", (0.8, 0.75, 0.7))
    corners = [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0)]
    kit.quad(scene, "Floor", corners, white)
    kit.box(scene, "Block", (0.5, 0.4, 0.6), white).rotation_euler = (0, 0, 0.4)
    kit.box(scene, "Shelf", (0.9, 0.5, 0.05), white).location = (0.7, 0.3, 0.7)
    kit.camera(scene, (0.0, -4.0, 2.2), (0.0, 0.1, 0.3), lens=50.0)
    for kind in ("max", "diffuse"):
        setattr(scene.cycles, f"{kind}_bounces", 4)
    return scene
