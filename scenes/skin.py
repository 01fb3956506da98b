# SPDX-License-Identifier: GPL-3.0-or-later
"""A head of skin before a candle of wax: light that goes below surfaces and comes up elsewhere."""

from __future__ import annotations

import bpy

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 256, 256, 64


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene, (0.04, 0.05, 0.06))
    s = 4.0
    grey = kit.diffuse("Grey", (0.35, 0.35, 0.38))
    kit.quad(scene, "Floor", [(-s, -s, 0), (s, -s, 0), (s, s, 0), (-s, s, 0)], grey)

    bpy.ops.mesh.primitive_monkey_add(size=1.6, location=(0.25, 0.0, 0.78))
    head = bpy.context.object
    head.name = "Head"
    head.rotation_euler = (-0.35, 0.0, -0.25)
    head.modifiers.new("Smooth", "SUBSURF").render_levels = 2
    head.modifiers["Smooth"].levels = 2
    head.data.polygons.foreach_set("use_smooth", [True] * len(head.data.polygons))
    head.data.materials.append(
        below(
            "Skin",
            **{
                "Base Color": (0.8, 0.5, 0.38, 1.0),
                "Subsurface Weight": 1.0,
                "Subsurface Scale": 0.12,
                "Roughness": 0.45,
            },
        )
    )
    wax = below(
        "Wax",
        **{
            "Base Color": (0.85, 0.75, 0.55, 1.0),
            "Subsurface Weight": 1.0,
            "Subsurface Scale": 0.5,
            "Subsurface Radius": (1.0, 0.6, 0.3),
            "Roughness": 0.3,
        },
    )
    bpy.ops.mesh.primitive_cylinder_add(vertices=64, radius=0.22, depth=0.8)
    candle = bpy.context.object
    candle.name, candle.location = "Candle", (-0.85, -0.55, 0.4)
    candle.data.materials.append(wax)
    flame = kit.sphere(scene, "Flame", 0.05, kit.emission("Flame", (1.0, 0.6, 0.25), 250.0))
    flame.location, flame.scale = (-0.85, -0.55, 0.92), (1.0, 1.0, 2.0)
    kit.area_light(scene, "Key", (2.0, -2.5, 2.5), (0.2, 0, 0.8), (0.8, 0.8), 90.0)
    kit.area_light(scene, "Behind", (0.8, 2.5, 1.6), (0.2, 0, 0.8), (0.5, 0.5), 120.0)
    kit.camera(scene, (-0.3, -4.2, 1.5), (-0.1, 0.0, 0.7), lens=50.0)


def below(name: str, **inputs) -> bpy.types.Material:
    made = kit.shader(name, "BsdfPrincipled")
    node = next(n for n in made.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    return made
