# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: a floor and a block under one light, for each kind of light."""

from __future__ import annotations

import math

SIZE, SEEDS = 24, 4

# Name: the arguments of a light object (`lamp`), or of a world of a picture (`sky`). There is no
# sheared area light: Cycles samples it as if it were a rectangle.
LIGHTS = {
    "point": dict(kind="POINT", radius=0.0),
    "point_soft": dict(kind="POINT", radius=0.4),
    "point_sphere": dict(kind="POINT", radius=0.4, soft=False),
    "point_around_all": dict(kind="POINT", radius=3.0, soft=False),
    "settings": dict(
        kind="POINT", radius=0.3, energy=40, use_normalize=False, exposure=-1.5, temperature=2700.0
    ),
    "spot": dict(kind="SPOT", radius=0.0, spot_size=0.8, spot_blend=0.3),
    "spot_hard_square": dict(kind="SPOT", radius=0.0, spot_size=0.6, spot_blend=0, use_square=True),
    "spot_soft": dict(kind="SPOT", radius=0.3, spot_size=0.9, spot_blend=1.0),
    "spot_sphere": dict(kind="SPOT", radius=0.3, soft=False, spot_size=0.9, spot_blend=0.5),
    "spot_scaled": dict(
        kind="SPOT", radius=0.0, spot_size=0.8, spot_blend=0.4, scale=(1.6, 0.5, 0.8)
    ),
    "spot_sheared": dict(kind="SPOT", radius=0.2, spot_size=0.7, spot_blend=0.4, shear=0.5),
    "sun": dict(kind="SUN", angle=0.0, energy=2),
    "sun_60": dict(kind="SUN", angle=math.radians(60), energy=2),
    "sun_not_normalized": dict(kind="SUN", angle=0.2, energy=60, use_normalize=False),
    "sun_sheared": dict(kind="SUN", angle=0.1, energy=2, scale=(1, 2, 0.5), shear=0.5),
    "area_ellipse_scaled": dict(
        kind="AREA", shape="ELLIPSE", size=1.0, size_y=0.5, scale=(1.5, -0.7, 1)
    ),
    "area_spread": dict(kind="AREA", shape="DISK", size=0.8, spread=1.2),
    "area_narrow": dict(kind="AREA", shape="RECTANGLE", size=1.2, size_y=0.8, spread=0.7),
    "area_not_normalized": dict(kind="AREA", shape="SQUARE", size=0.8, use_normalize=False),
}
SKIES = {
    "sky": dict(),
    "sky_closest": dict(interpolation="Closest"),
    "sky_bytes": dict(space="sRGB"),
    "sky_alpha": dict(space="sRGB", alpha=0.5),
    "sky_turned": dict(rotation=(0.4, -0.3, 1.1)),
    "sky_turned_texture": dict(rotation=(0.4, -0.3, 1.1), vector_type="TEXTURE", scale=(-2, 2, 2)),
    "sky_missing": dict(missing=True),
}
CASES = [*LIGHTS, *SKIES]
WARNED = ["sky_missing"]


def samples(name: str) -> int:
    """Per pixel: small spots of light need more."""
    if name == "area_narrow":
        return 2048
    return 768 if name.startswith("spot") else 192


def lamp(scene, kind, radius=0.0, soft=True, scale=(1, 1, 1), shear=0.0, **values):
    import bpy
    from mathutils import Matrix

    data = bpy.data.lights.new("Lamp", kind)
    data.energy = 60.0
    if kind in ("POINT", "SPOT"):
        data.shadow_soft_size, data.use_soft_falloff = radius, soft
    if "temperature" in values:
        data.use_temperature = True
    if "use_normalize" in values:
        data.normalize = values.pop("use_normalize")
    for name, value in values.items():
        setattr(data, name, value)
    obj = bpy.data.objects.new("Lamp", data)
    obj.visible_camera = False
    scene.collection.objects.link(obj)
    deform = Matrix.Diagonal((*scale, 1.0))
    if shear:  # as under a parent that is scaled unevenly
        deform = deform @ Matrix(((1, shear, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))
    turn = Matrix.LocRotScale((0.3, -0.2, 1.9), Matrix.Rotation(0.25, 3, (1, 2, 1)), None)
    empty = bpy.data.objects.new("Parent", None)  # a matrix that location and scale cannot say
    scene.collection.objects.link(empty)
    obj.parent, obj.matrix_parent_inverse = empty, turn @ deform


def sky(
    scene, interpolation="Linear", space=None, alpha=1.0, rotation=None, missing=False, **mapping
):
    """A map of 16 x 8 pixels with a small sun, and a sharp edge to tell the sides."""
    import bpy
    import numpy as np

    tree = scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.interpolation = interpolation
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    if not missing:
        image = bpy.data.images.new("Sky", 16, 8, alpha=True, float_buffer=space is None)
        if space:
            image.colorspace_settings.name = space
        pixels = np.zeros((8, 16, 4), dtype=np.float32)
        pixels[..., :3] = np.random.default_rng(2).uniform(0.05, 0.6, (8, 16, 3))
        pixels[:, :8, 0] *= 0.3
        pixels[5, 5, :3] = (40.0, 35.0, 20.0) if space is None else (1.0, 0.9, 0.8)
        pixels[..., 3] = alpha
        image.pixels.foreach_set(pixels.ravel())
        image.update()
        texture.image = image
    if rotation:
        node, source = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
        node.vector_type = mapping.get("vector_type", "POINT")
        node.inputs["Rotation"].default_value = rotation
        node.inputs["Scale"].default_value = mapping.get("scale", (1, 1, 1))
        tree.links.new(source.outputs["Generated"], node.inputs["Vector"])
        tree.links.new(node.outputs["Vector"], texture.inputs["Vector"])


def stage(count: int):
    """The scene without its light, with so many samples."""
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, count)
    kit.world(scene)
    white = kit.diffuse("White", (0.8, 0.75, 0.7))
    corners = [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0)]
    kit.quad(scene, "Floor", corners, white)
    kit.box(scene, "Block", (0.5, 0.4, 0.6), white).rotation_euler = (0, 0, 0.4)
    kit.camera(scene, (0.0, -4.0, 3.2), (0.0, 0.1, 0.1), lens=55.0)
    kit.limit_bounces(scene.cycles, 1)
    return scene


def build(name: str):
    scene = stage(samples(name))
    if name in LIGHTS:
        lamp(scene, **LIGHTS[name])
    else:
        sky(scene, **SKIES[name])
    return scene
