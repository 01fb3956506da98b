# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain bodies of a stone that is made by a tree of 30 nodes, and displaced by it as bump.

For benchmarks: every hit computes noises and cells, at several points for the bumps.
"""

from __future__ import annotations

import bpy

from scenes import kit

WIDTH, HEIGHT, SAMPLES = 256, 256, 64
NODES = 30


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "Standard")
    kit.world(scene, (0.3, 0.35, 0.4))
    red = stone("Red", (0.5, 0.25, 0.15), 2.0)
    blue = stone("Blue", (0.2, 0.35, 0.45), 3.0)
    s, h, d = 4.0, 4.0, 2.0
    kit.quad(scene, "Floor", [(-s, -s, 0), (s, -s, 0), (s, d, 0), (-s, d, 0)], blue)
    kit.quad(scene, "Wall", [(-s, d, 0), (s, d, 0), (s, d, h), (-s, d, h)], red)
    kit.sphere(scene, "Ball", 0.7, red).location = (-0.8, 0.2, 0.7)
    kit.sphere(scene, "Other", 0.5, blue).location = (0.7, -0.3, 0.5)
    kit.area_light(scene, "Lamp", (1.5, -2.5, 3.5), (0, 0, 0.5), (1.0, 1.0), 250.0)
    kit.camera(scene, (0.0, -5.0, 1.8), (0.0, 0.0, 0.7), lens=45.0)


def stone(name: str, color: tuple[float, float, float], scale: float) -> bpy.types.Material:
    """Warped noise and cells: veins, cracks and dust in the hollows."""
    made = kit.shader(name, "BsdfPrincipled")
    tree = made.node_tree
    principled = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")

    def out(kind: str, inputs: dict, socket: int | str = 0, **settings):
        node = tree.nodes.new(f"ShaderNode{kind}")
        for key, value in settings.items():
            setattr(node, key, value)
        for key, value in inputs.items():
            if hasattr(value, "is_output"):
                tree.links.new(value, node.inputs[key])
            else:
                node.inputs[key].default_value = value
        return node.outputs[socket]

    def mix(factor, first, second):
        inputs = {0: factor, 6: first, 7: second}
        return out("Mix", inputs, 2, data_type="RGBA")

    def levels(value, low: float, high: float, to_low: float = 0.0, to_high: float = 1.0):
        return out("MapRange", {0: value, 1: low, 2: high, 3: to_low, 4: to_high})

    place = out("Mapping", {0: out("TexCoord", {}, "Object"), "Scale": (scale,) * 3})
    away = out("TexNoise", {"Vector": place, "Scale": 1.5, "Detail": 2.0}, "Color")
    away = out("VectorMath", {0: away, 1: (0.5,) * 3}, operation="SUBTRACT")
    away = out("VectorMath", {0: away, 1: (0.4,) * 3}, operation="MULTIPLY")
    warped = out("VectorMath", {0: place, 1: away})
    clouds = out("TexNoise", {"Vector": warped, "Scale": 1.2, "Detail": 6.0})
    kind = {"noise_type": "RIDGED_MULTIFRACTAL"}
    ridges = out("TexNoise", {"Vector": warped, "Scale": 2.0, "Detail": 4.0}, **kind)
    cells = out("TexVoronoi", {"Vector": warped, "Scale": 2.5})
    edges = out("TexVoronoi", {"Vector": warped, "Scale": 2.5}, feature="DISTANCE_TO_EDGE")
    veins = out("TexWave", {"Vector": warped, "Scale": 1.1, "Distortion": 3.0}, 1)
    dark, light = ([x * f for x in color] + [1.0] for f in (0.4, 1.3))
    plain = mix(out("ValToRGB", {0: clouds}), dark, light)
    veined = mix(out("ValToRGB", {0: veins}), plain, (0.7, 0.68, 0.62, 1.0))
    crack = levels(edges, 0.0, 0.06)
    cracked = mix(crack, (0.05, 0.04, 0.04, 1.0), veined)
    hollow = levels(ridges, 0.2, 1.2)
    facing = out("LayerWeight", {"Blend": 0.3}, "Facing")
    dusty = mix(
        out("Math", {0: hollow, 1: facing}, operation="MULTIPLY"), cracked, (0.5, 0.45, 0.4, 1.0)
    )
    bright = out("BrightContrast", {"Color": dusty, 1: 0.02, 2: 0.05})
    tinted = out("HueSaturation", {"Color": bright, "Saturation": 0.9})
    rough = out("Math", {0: levels(cells, 0.0, 0.8, 0.3, 0.7), 1: 0.35}, operation="MAXIMUM")
    height = out("Math", {0: crack, 1: 0.5, 2: clouds}, operation="MULTIPLY_ADD")
    displaced = out("Displacement", {"Height": height, "Midlevel": 0.5, "Scale": 0.05})
    bumped = out("Bump", {"Height": ridges, "Strength": 0.4, "Distance": 0.02})
    tree.links.new(tinted, principled.inputs["Base Color"])
    tree.links.new(rough, principled.inputs["Roughness"])
    tree.links.new(bumped, principled.inputs["Normal"])
    tree.links.new(displaced, output.inputs["Displacement"])
    assert len(tree.nodes) == NODES, len(tree.nodes)
    return made
