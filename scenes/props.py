# SPDX-License-Identifier: GPL-3.0-or-later
"""What furnishes the larger scenes: bevelled bodies, walls with openings, tiles, lamps, skies."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import bpy
import numpy as np

from scenes import kit
from scenes.kit import Color, Point3

SUN = math.radians(0.53)  # the angle under which the real one is seen
Opening = tuple[float, float, float, float]  # x0, x1, z0, z1


def principled(
    name: str, color: Color, roughness: float = 0.5, metallic: float = 0.0, **inputs: object
) -> bpy.types.Material:
    """Blender's everyday material; further inputs by name, with _ for blanks."""
    more = {key.replace("_", " "): value for key, value in inputs.items()}
    return kit.shader(
        *(name, "BsdfPrincipled", "MULTI_GGX"),
        **{"Base Color": (*color, 1.0), "Roughness": roughness, "Metallic": metallic, **more},
    )


def place(
    item: bpy.types.Object, location: Point3, degrees: float = 0.0, tilt: float = 0.0
) -> bpy.types.Object:
    """Moves the object, turned about z after a tilt about its own x."""
    item.location = location
    item.rotation_euler = (math.radians(tilt), 0.0, math.radians(degrees))
    return item


def block(
    scene: bpy.types.Scene,
    name: str,
    size: Point3,
    material: bpy.types.Material,
    location: Point3,
    degrees: float = 0.0,
    bevel: float = 0.01,
) -> bpy.types.Object:
    """A box on its location with rounded edges: only those catch the light as real ones do."""
    item = place(kit.box(scene, name, size, material), location, degrees)
    item.data.polygons.foreach_set("use_smooth", [True] * len(item.data.polygons))
    rounded = item.modifiers.new("Bevel", "BEVEL")
    rounded.width, rounded.segments, rounded.harden_normals = bevel, 3, True
    return item


def wall(
    scene: bpy.types.Scene,
    name: str,
    size: Point3,
    material: bpy.types.Material,
    openings: Sequence[Opening] = (),
) -> bpy.types.Object:
    """A wall from x = 0 along x, y = 0 to its thickness, on z = 0; openings go right through."""
    length, thickness, height = size
    xs = sorted({0.0, length, *(x for o in openings for x in o[:2])})
    zs = sorted({0.0, height, *(z for o in openings for z in o[2:])})

    def solid(i: int, k: int) -> bool:
        if not (0 <= i < len(xs) - 1 and 0 <= k < len(zs) - 1):
            return False
        x, z = (xs[i] + xs[i + 1]) / 2, (zs[k] + zs[k + 1]) / 2
        return not any(x0 < x < x1 and z0 < z < z1 for x0, x1, z0, z1 in openings)

    def corner(i: int, j: int, k: int) -> int:
        return (k * 2 + j) * len(xs) + i

    vertices = [(x, y, z) for z in zs for y in (0.0, thickness) for x in xs]
    faces = []
    for i in range(len(xs) - 1):
        for k in range(len(zs) - 1):
            if not solid(i, k):
                continue
            a, b, c, d = (corner(i + x, 0, k + z) for x, z in ((0, 0), (1, 0), (1, 1), (0, 1)))
            e, f, g, h = (n + len(xs) for n in (a, b, c, d))
            faces += [(a, b, c, d), (f, e, h, g)]
            sides = [((i - 1, k), (e, a, d, h)), ((i + 1, k), (b, f, g, c))]
            sides += [((i, k - 1), (e, f, b, a)), ((i, k + 1), (d, c, g, h))]
            faces += [face for neighbour, face in sides if not solid(*neighbour)]
    return kit.mesh_object(scene, name, vertices, faces, material)


def tiles(
    scene: bpy.types.Scene,
    name: str,
    corner: Point3,
    u: Point3,
    v: Point3,
    counts: tuple[int, int],
    materials: Sequence[bpy.types.Material],
    choose: Callable[[int, int], int],
    gap: float = 0.06,
) -> bpy.types.Object:
    """A rectangle of flat tiles; `gap`: the part of a tile's side that the joints take.

    `choose(column, row)` is the index of the material of a tile. The front is to u x v.
    """
    across = [
        (i + 0.5 * gap + side * (1 - gap)) / counts[0] for i in range(counts[0]) for side in (0, 1)
    ]
    along = [
        (i + 0.5 * gap + side * (1 - gap)) / counts[1] for i in range(counts[1]) for side in (0, 1)
    ]
    vertices = [
        tuple(p + s * a + t * b for p, a, b in zip(corner, u, v, strict=True))
        for t in along
        for s in across
    ]
    row = len(across)
    faces, chosen = [], []
    for k in range(counts[1]):
        for i in range(counts[0]):
            first = 2 * k * row + 2 * i
            faces.append((first, first + 1, first + row + 1, first + row))
            chosen.append(choose(i, k))
    item = kit.mesh_object(scene, name, vertices, faces, materials[0])
    for material in materials[1:]:
        item.data.materials.append(material)
    item.data.polygons.foreach_set("material_index", chosen)
    return item


def lamp(
    scene: bpy.types.Scene,
    name: str,
    kind: str,
    eye: Point3,
    energy: float,
    color: Color = (1.0, 1.0, 1.0),
    target: Point3 | None = None,
    **settings: object,
) -> bpy.types.Object:
    """A POINT, SPOT or SUN lamp, with Blender's names for its settings. Cameras do not see it."""
    data = bpy.data.lights.new(name, kind)
    data.energy, data.color = energy, color
    for key, value in settings.items():
        setattr(data, key, value)
    item = bpy.data.objects.new(name, data)
    item.location = eye
    if target is not None:  # rounded for the reason that kit.area_light gives
        item.rotation_euler = [round(angle, 4) for angle in kit.aim(eye, target).to_euler()]
    item.visible_camera = False
    scene.collection.objects.link(item)
    return item


def environment(
    scene: bpy.types.Scene,
    radiance: Callable[[np.ndarray], np.ndarray],
    strength: float = 1.0,
    height: int = 128,
) -> None:
    """A world of a lat-long image; radiance([..., 3] unit directions) -> [..., 3] RGB."""
    kit.world(scene)
    width = 2 * height
    longitude = math.pi * (1.0 - 2.0 * (np.arange(width) + 0.5) / width)  # as Blender lays it out
    latitude = math.pi * ((np.arange(height) + 0.5) / height - 0.5)
    across, up = np.meshgrid(longitude, latitude)
    directions = np.stack(
        [np.cos(up) * np.cos(across), np.cos(up) * np.sin(across), np.sin(up)], axis=-1
    )
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[..., :3] = radiance(directions)
    image = bpy.data.images.new("Sky", width, height, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    tree = scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    background = tree.nodes["Background"]
    background.inputs["Strength"].default_value = strength
    tree.links.new(texture.outputs["Color"], background.inputs["Color"])
