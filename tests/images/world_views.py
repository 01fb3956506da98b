# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: worlds of nodes, looked at all around, with one sample in each pixel's middle.

Beside the worlds of world_scenes.py, everything that a node says of a place.
"""

from __future__ import annotations

from .world_scenes import TREES, background, by_ray, set_tree

SEEDS, PANORAMA = 1, (96, 48)


def coordinate(node: str, output: str):
    """An output as a colour, between 0 and 1."""

    def build(t):
        value = t.out(node, {}, output)
        color = t.out(
            "VectorMath", {0: value, 1: (0.2,) * 3, 2: (0.5,) * 3}, operation="MULTIPLY_ADD"
        )
        return background(t, color)

    return build


COORDINATES = [
    *(("TexCoord", name) for name in ("Generated", "Normal", "UV", "Object", "Camera")),
    ("TexCoord", "Reflection"),
    *(("NewGeometry", name) for name in ("Position", "Normal", "True Normal", "Incoming")),
    *(("NewGeometry", name) for name in ("Parametric", "Backfacing")),
    *(("CameraData", name) for name in ("View Vector", "View Z Depth", "View Distance")),
    *(("ObjectInfo", name) for name in ("Location", "Color", "Alpha", "Object Index", "Random")),
    *(("LayerWeight", name) for name in ("Fresnel", "Facing")),
]
CASES = {
    **{tree.__name__: tree for tree in TREES},
    "by_camera": by_ray("Is Camera Ray"),
    **{
        f"{node}_{name}".lower().replace(" ", "_"): coordinate(node, name)
        for node, name in COORDINATES
    },
    "lens_texcoord_camera": coordinate("TexCoord", "Camera"),
    "lens_cameradata_view_vector": coordinate("CameraData", "View Vector"),
}


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, *PANORAMA, 1)
    set_tree(scene, CASES[name])
    kit.camera(scene, (0.7, -4.0, 2.2), (0.0, 0.1, 0.3), lens=20.0)
    if not name.startswith("lens"):
        camera = scene.camera.data
        camera.type = "PANO"
        owner = camera if hasattr(camera, "panorama_type") else camera.cycles
        owner.panorama_type = "EQUIRECTANGULAR"
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BLACKMAN_HARRIS", 0.01
    return scene
