# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain bodies whose Principled materials take colour, roughness and normal from pictures.

For benchmarks: every hit reads three pictures and builds a tangent frame.
"""

from __future__ import annotations

import bpy
import numpy as np

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 256, 256, 64
PIXELS = 1024  # of a side


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene, (0.3, 0.35, 0.4))
    brick = material("Brick", (0.5, 0.25, 0.15), 1)
    tile = material("Tile", (0.2, 0.35, 0.45), 2)
    s, h, d = 4.0, 4.0, 2.0
    quads = {
        "Floor": ([(-s, -s, 0), (s, -s, 0), (s, d, 0), (-s, d, 0)], tile),
        "Wall": ([(-s, d, 0), (s, d, 0), (s, d, h), (-s, d, h)], brick),
    }
    for name, (corners, of) in quads.items():
        unfold(kit.quad(scene, name, corners, of))
    ball = kit.sphere(scene, "Ball", 0.7, brick)
    ball.location = (-0.8, 0.2, 0.7)
    other = kit.sphere(scene, "Other", 0.5, tile)
    other.location = (0.7, -0.3, 0.5)
    for body in (ball, other):
        unfold(body)
    kit.area_light(scene, "Lamp", (1.5, -2.5, 3.5), (0, 0, 0.5), (1.0, 1.0), 250.0)
    kit.camera(scene, (0.0, -5.0, 1.8), (0.0, 0.0, 0.7), lens=45.0)


def unfold(body: bpy.types.Object) -> None:
    """A UV map: the longer two of the three coordinates."""
    mesh = body.data
    layer = mesh.uv_layers.new(name="UVMap")
    points = np.array([mesh.vertices[loop.vertex_index].co for loop in mesh.loops])
    axes = np.sort(np.argsort(np.ptp(points, axis=0))[1:])
    layer.data.foreach_set("uv", (0.37 * points[:, axes]).astype(np.float32).ravel())


def material(name: str, color: tuple[float, float, float], seed: int) -> bpy.types.Material:
    made = kit.shader(name, "BsdfPrincipled")
    tree = made.node_tree
    principled = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    height = waves(seed)
    slope = np.stack(np.gradient(height, axis=(1, 0)), axis=-1) * 40.0
    normal = np.concatenate([0.5 - 0.5 * slope, np.ones_like(slope[..., :1])], axis=-1)
    colors = picture(f"{name} color", color * (0.4 + 0.6 * height[..., None]), "sRGB")
    rough = picture(f"{name} roughness", np.repeat(0.3 + 0.4 * height[..., None], 3, -1))
    bent = tree.nodes.new("ShaderNodeNormalMap")
    for image, socket in (
        (colors, principled.inputs["Base Color"]),
        (rough, principled.inputs["Roughness"]),
        (picture(f"{name} normal", normal), bent.inputs["Color"]),
    ):
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = image
        tree.links.new(texture.outputs["Color"], socket)
    tree.links.new(bent.outputs["Normal"], principled.inputs["Normal"])
    return made


def waves(seed: int) -> np.ndarray:
    """A height field that repeats, 0 to 1."""
    rng = np.random.default_rng(seed)
    v, u = np.mgrid[0:PIXELS, 0:PIXELS] * (2 * np.pi / PIXELS)
    field = sum(
        np.sin(a * u + b * v + phase) / (1 + abs(a) + abs(b))
        for a, b, phase in zip(
            rng.integers(-20, 21, 24), rng.integers(-20, 21, 24), rng.uniform(0, 6, 24), strict=True
        )
    )
    return (field - field.min()) / np.ptp(field)


def picture(name: str, values: np.ndarray, space: str = "Non-Color") -> bpy.types.Image:
    image = bpy.data.images.new(name, PIXELS, PIXELS, alpha=False)
    image.colorspace_settings.name = space
    pixels = np.ones((PIXELS, PIXELS, 4), dtype=np.float32)
    pixels[..., :3] = np.clip(values, 0.0, 1.0)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image
