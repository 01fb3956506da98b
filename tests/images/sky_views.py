# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: worlds of the Sky Texture, looked at all around. Suns are so wide that pixels
lie in them.

Both engines throw their samples within a hundredth of a pixel, which is much next to the horizon:
there the models have most of their rows.
"""

from __future__ import annotations

from math import radians

from . import world_views
from .world_scenes import background, set_tree

SEEDS, SAMPLES = 1, 64
MODELS = ("SINGLE_SCATTERING", "MULTIPLE_SCATTERING")
WIDE = {"sun_size": radians(24.0)}
# By name: properties of the node.
ATMOSPHERES = {
    "default": {"sun_disc": False},
    "zenith": {"sun_elevation": radians(88.0), "sun_disc": False},
    "horizon": {"sun_elevation": 0.0, "sun_rotation": 1.0, "sun_disc": False},
    "dusk": {"sun_elevation": radians(-4.0), "sun_rotation": -2.5, "sun_disc": False},
    "night": {"sun_elevation": radians(-30.0), "sun_disc": False},
    "over": {"sun_elevation": radians(150.0), "sun_rotation": 7.0, "sun_disc": False},
    "high": {"altitude": 30000.0, "sun_elevation": 0.6, "sun_disc": False},
    "space": {"altitude": 100000.0, "sun_elevation": 0.4, "sun_disc": False},
    "sea": {"altitude": 0.0, "sun_elevation": 0.1, "sun_disc": False},
    "thick": {"air_density": 5.0, "aerosol_density": 8.0, "ozone_density": 6.0, "sun_disc": False},
    "thin": {"air_density": 0.2, "aerosol_density": 0.0, "ozone_density": 0.0, "sun_disc": False},
    "disc": {**WIDE, "sun_elevation": 0.5, "sun_intensity": 0.3, "sun_rotation": 1.2},
    "disc_low": {**WIDE, "sun_elevation": 0.1, "altitude": 3000.0},
    "disc_below": {**WIDE, "sun_elevation": -0.1},
}
FORMULAS = {
    "default": {},
    "clear": {"turbidity": 1.7, "sun_direction": (0.6, -0.3, 0.4), "ground_albedo": 0.9},
    "hazy": {"turbidity": 7.3, "sun_direction": (-0.8, 0.1, 0.1), "ground_albedo": 0.0},
    "foggy": {"turbidity": 10.0, "sun_direction": (0.2, 0.9, 0.5)},
    "dusk": {"turbidity": 3.0, "sun_direction": (0.6, 0.7, -0.2)},
}
SKIES = {
    **{f"{m}_{n}".lower(): {"sky_type": m, **p} for m in MODELS for n, p in ATMOSPHERES.items()},
    **{
        f"{m}_{n}".lower(): {"sky_type": m, **p}
        for m in ("PREETHAM", "HOSEK_WILKIE")
        for n, p in FORMULAS.items()
    },
}


def turned(t, model: str):
    """Looked up elsewhere, and with vectors that are no directions."""
    inputs = {"Vector": t.coordinate("Generated"), "Rotation": (0.4, 0.2, 1.0)}
    moved = {**inputs, "Scale": (0.8, 1.2, 0.9), "Location": (0.1, 0.0, 0.1)}
    vector = t.out("Mapping", moved)
    sky = t.out("TexSky", {}, **SKIES[f"{model}_hazy"])
    t.tree.links.new(vector, sky.node.inputs["Vector"])
    return background(t, sky, 0.1)


def sky(**properties):
    return lambda t: background(t, t.out("TexSky", {}, **properties), 0.1)


CASES = {
    **{name: sky(**properties) for name, properties in SKIES.items()},
    **{f"turned_{m}": lambda t, m=m: turned(t, m) for m in ("preetham", "hosek_wilkie")},
}


def build(name: str):
    scene = world_views.build("gradient")
    set_tree(scene, CASES[name])
    scene.cycles.samples = SAMPLES
    return scene
