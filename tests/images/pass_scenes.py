# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: the passes of light that Cycles has, and one for each light group."""

from __future__ import annotations

from . import film_scenes

SEEDS = 8
CASES = {"passes": 1024}  # samples

TOGGLES = [
    f"use_pass_{kind}_{what}"
    for kind in ("diffuse", "glossy", "transmission")
    for what in ("direct", "indirect", "color")
] + ["use_pass_emit", "use_pass_environment"]
GROUPS = {"Lamp": "Key", "Glow": "Practical", "World": "Sky"}


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, 32, 24, CASES[name])
    film_scenes.stage(scene)
    kit.world(scene, (0.3, 0.4, 0.6), 0.5)
    shade = kit.combined(
        "Shade",
        "MixShader",
        kit.shader("Paper", "BsdfTranslucent", Color=(0.9, 0.6, 0.3, 1.0)),
        # Smooth: where Cycles joins a lamp to rough glass, it adds light.
        kit.shader("Glass", "BsdfGlass", Color=(0.8, 0.9, 1.0, 1.0), Roughness=0.0, IOR=1.4),
    )
    corners = [(0.2, -1.1, 0.1), (1.3, -1.1, 0.1), (1.3, -0.9, 0.8), (0.2, -0.9, 0.8)]
    kit.quad(scene, "Shade", corners, shade)
    metal = kit.shader(
        "Brass",
        "BsdfPrincipled",
        **{"Base Color": (0.9, 0.7, 0.3, 1.0), "Metallic": 1.0, "Roughness": 0.4},
    )
    kit.box(scene, "Brass", (0.4, 0.4, 0.5), metal).location = (1.1, 0.4, 0.02)
    resin = kit.shader(
        "Resin",
        "BsdfPrincipled",
        **{"Base Color": (0.5, 0.8, 0.4, 1.0), "Transmission Weight": 0.6, "Roughness": 0.4},
    )
    kit.box(scene, "Resin", (0.3, 0.3, 0.4), resin).location = (-1.1, -0.4, 0.02)
    layer = scene.view_layers[0]
    for toggle in TOGGLES:
        setattr(layer, toggle, True)
    for owner, group in GROUPS.items():
        layer.lightgroups.add(name=group)
        (scene.world if owner == "World" else scene.objects[owner]).lightgroup = group
    kit.limit_bounces(scene.cycles, 4)
    return scene


def save(scene, path) -> None:
    """What Cycles has rendered, with all passes."""
    import bpy

    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)
