# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: passes of data, through the kinds of cameras."""

from __future__ import annotations

from . import film_scenes
from .pass_scenes import save  # noqa: F401  (both.py looks for it)

SEEDS, SAMPLES = 3, 256
WIDTH, HEIGHT = 48, 36
CASES = ("perspective", "orthographic", "panorama")

TOGGLES = ("z", "mist", "position", "normal", "uv", "vector", "ambient_occlusion")
TOGGLES += ("object_index", "material_index")
MATTES = ("object", "material", "asset")


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    film_scenes.stage(scene, mirror=True)
    glass = kit.shader("Glass", "BsdfGlass", Color=(0.8, 0.9, 1.0, 1.0), Roughness=0.0, IOR=1.4)
    kit.quad(
        scene,
        "Shade",
        [(0.2, -1.1, 0.1), (1.3, -1.1, 0.1), (1.3, -0.9, 0.8), (0.2, -0.9, 0.8)],
        glass,
    )
    thin = kit.combined(
        "Thin",
        "MixShader",
        kit.diffuse("Blue", (0.2, 0.3, 0.8)),
        kit.shader("Clear", "BsdfTransparent"),
    )
    thin.node_tree.nodes["Mix Shader"].inputs[0].default_value = 0.7  # less alpha than 0.5
    kit.quad(
        scene,
        "Thin",
        [(-1.4, -0.9, 0.9), (0.1, -0.9, 0.9), (0.1, -0.8, 1.6), (-1.4, -0.8, 1.6)],
        thin,
    )
    kit.world(scene, (0.3, 0.4, 0.6), 0.5)
    scene.world.light_settings.distance = 1.5
    mist = scene.world.mist_settings
    mist.start, mist.depth, mist.falloff = 2.0, 6.0, "LINEAR"
    for number, obj in enumerate(o for o in scene.objects if o.type == "MESH"):
        obj.pass_index = number + 1
        obj.data.materials[0].pass_index = 10 * number + 5
        obj.data.uv_layers.new(name="UVMap")
    scene.objects["Ball"].parent = scene.objects["Block"]  # one asset
    scene.objects["Ball"].matrix_parent_inverse = scene.objects["Block"].matrix_world.inverted()
    layer = scene.view_layers[0]
    for toggle in TOGGLES:
        setattr(layer, f"use_pass_{toggle}", True)
    for kind in MATTES:
        setattr(layer, f"use_pass_cryptomatte_{kind}", True)
    layer.cycles.denoising_store_passes = True
    layer.janus.denoising_store_passes = True
    camera = scene.camera.data
    move(scene)
    if name == "orthographic":
        camera.type, camera.ortho_scale = "ORTHO", 4.0
    elif name == "panorama":
        look_around(camera)
    return scene


def look_around(camera) -> None:
    """Makes it a panorama of what is before it."""
    camera.type = "PANO"
    owner = camera if hasattr(camera, "panorama_type") else camera.cycles
    owner.panorama_type = "EQUIRECTANGULAR"
    owner.longitude_min, owner.longitude_max = -0.7, 0.7
    owner.latitude_min, owner.latitude_max = -0.5, 0.5


def move(scene) -> None:
    """What there is at frame 1 stays; before and after it is elsewhere, as Vector says."""
    block, camera = scene.objects["Block"], scene.camera
    for obj, way, turn in ((block, (0.4, 0.1, 0.2), 0.3), (camera, (0.1, 0.2, -0.1), 0.05)):
        place, angles = obj.location.copy(), obj.rotation_euler.copy()
        for frame in range(3):
            for i in range(3):
                obj.location[i] = place[i] + (frame - 1) * way[i]
            obj.rotation_euler.z = angles.z + (frame - 1) * turn
            obj.keyframe_insert("location", frame=frame)
            obj.keyframe_insert("rotation_euler", frame=frame)
    scene.frame_set(1)
