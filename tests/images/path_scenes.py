# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: the room of rules_scenes.py, with things that ask Light Path for the path.

Light that Cycles looks for counts no bounce at the vertex that it lights, and light that a bounce
hits does: its picture is between the two. Janus counts it as the one or the other, so here what
shines is small or not to be hit, or seen by way of a mirror.
"""

from __future__ import annotations

from .node_cases import material
from .rules_scenes import BOUNCES, SAMPLES, SIZE, room

SEEDS = 6
RED, BLUE, GREEN = (0.9, 0.2, 0.1, 1.0), (0.2, 0.3, 0.9, 1.0), (0.2, 0.8, 0.3, 1.0)


def above(t, output: str, limit: float):
    return t.out("Math", {0: t.out("LightPath", output=output), 1: limit}, operation="GREATER_THAN")


def chosen(output: str, limit: float, first, second):
    """A shader of two: the second where an output of Light Path is above a limit."""
    return lambda t: t.out("MixShader", {0: above(t, output, limit), 1: first(t), 2: second(t)})


def matt(color):
    return lambda t: t.out("BsdfDiffuse", {"Color": color})


def shiny(color):
    return lambda t: t.out("BsdfAnisotropic", {"Color": color, "Roughness": 0.5})


def clear(t):
    return t.out("BsdfTransparent", {"Color": (0.9, 0.8, 0.7, 1.0)})


def glow(color, strength):
    return lambda t: t.out("Emission", {"Color": color, "Strength": strength})


def by_length(t):
    shade = t.out("LightPath", output="Ray Length")
    return t.out("BsdfDiffuse", {"Color": t.out("Math", {0: shade, 1: 0.2}, operation="MULTIPLY")})


def falloff(output: str, strength: float):
    def build(t):
        shade = t.out("LightFalloff", {"Strength": strength, "Smooth": 0.8}, output)
        return t.out("BsdfDiffuse", {"Color": shade})

    return build


# What is another material on the floor, the back and the block.
SURFACES = {
    "ray_depth": chosen("Ray Depth", 0.5, matt(RED), matt(BLUE)),
    "ray_depth_2": chosen("Ray Depth", 1.5, matt(RED), shiny(BLUE)),
    "diffuse_depth": chosen("Diffuse Depth", 0.5, matt(RED), matt(BLUE)),
    "glossy_depth": chosen("Glossy Depth", 0.5, shiny(RED), matt(BLUE)),
    "transmission_depth": chosen("Transmission Depth", 0.5, matt(RED), matt(BLUE)),
    "ray_length": by_length,
    "falloff_quadratic": falloff("Quadratic", 1.0),
    "falloff_linear": falloff("Linear", 0.2),
    "falloff_constant": falloff("Constant", 0.05),
}
# Three leaves before each other, and the lamp.
LEAVES = {
    "leaves_transparent_depth": chosen("Transparent Depth", 0.5, clear, matt(GREEN)),
    "leaves_ray_length": chosen("Ray Length", 1.2, matt(GREEN), clear),
    "leaves_ray_depth": chosen("Ray Depth", 0.5, matt(GREEN), clear),
    "leaves_glossy_depth": chosen("Glossy Depth", 0.5, clear, matt(GREEN)),
}
# A small lamp.
GLOWS = {
    "glow_ray_depth": chosen("Ray Depth", 1.5, glow(RED, 40.0), glow(BLUE, 80.0)),
    "glow_ray_length": lambda t: t.out(
        "Emission", {"Strength": t.out("LightFalloff", {"Strength": 20.0}, "Linear")}
    ),
    "glow_glossy_depth": chosen("Glossy Depth", 0.5, glow(RED, 40.0), glow(BLUE, 80.0)),
    "glow_mirrored": chosen("Glossy Depth", 0.5, glow(RED, 5.0), glow(BLUE, 10.0)),
}
LAMPS = {
    "lamp_ray_depth": chosen("Ray Depth", 1.5, glow(RED, 1.0), glow(BLUE, 3.0)),
    "lamp_diffuse_depth": chosen("Diffuse Depth", 0.5, glow(RED, 1.0), glow(BLUE, 3.0)),
}
# Cycles does not look for the light of these.
WORLDS = {
    "world_ray_depth": ("Ray Depth", 2.5),
    "world_diffuse_depth": ("Diffuse Depth", 1.5),
}
CASES = [*SURFACES, *LEAVES, *GLOWS, *LAMPS, *WORLDS]


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, SAMPLES)
    kit.world(scene)
    room(scene)
    objects = scene.objects
    leaf = objects["Leaf"].data.materials[0]
    if name in SURFACES:
        asked = material("Asked", SURFACES[name])
        for thing in ("Floor", "Back", "Block"):
            objects[thing].data.materials[0] = asked
    if name in LEAVES:
        asked = material("Asked", LEAVES[name])
        for i in range(3):
            x, y, z = -0.3 - 0.1 * i, -0.4 - 0.15 * i, 1.0 + 0.3 * i
            corners = [(x, y - 0.5, z), (x + 1.2, y - 0.5, z), (x + 1.2, y + 0.5, z + 0.1)]
            kit.quad(scene, f"Leaf {i}", [*corners, (x, y + 0.5, z + 0.1)], asked)
        objects["Leaf"].data.materials[0] = asked
    if name in GLOWS:
        asked = material("Asked", GLOWS[name])
        size = 0.9 if name == "glow_mirrored" else 0.3
        (x, y, z), (u, v, w) = (-0.5, -0.3, 1.5), (-0.5 + size, -0.3 + size, 1.5 + size / 3)
        kit.quad(scene, "Glow", [(x, y, z), (u, y, z), (u, v, w), (x, v, w)], asked)
    if name == "glow_mirrored":  # and no other thing is glossy
        objects["Side"].data.materials[0] = kit.metal("Mirror", (0.9, 0.9, 0.9))
        objects["Block"].data.materials[0] = leaf
    if name in LAMPS:
        data = objects["Lamp"].data
        data.use_nodes = True
        data.node_tree.nodes.clear()
        output = data.node_tree.nodes.new("ShaderNodeOutputLight")
        from .node_cases import Tree

        shown = LAMPS[name](Tree(data.node_tree))
        data.node_tree.links.new(shown, output.inputs[0])
    if name in WORLDS:
        _world(scene, *WORLDS[name])
    # Cycles hits lamps by rays, too, and then counts one vertex more. It needs to, in mirrors.
    mirrored = name == "glow_mirrored"
    objects["Lamp"].data.cycles.use_multiple_importance_sampling = mirrored
    if name not in SURFACES:
        objects["Ball"].data.materials[0] = leaf  # see rules_scenes.no_glass()
    for kind in ("diffuse", "glossy", "transmission"):
        setattr(scene.cycles, f"{kind}_bounces", 1024)
    scene.cycles.max_bounces = BOUNCES
    return scene


def _world(scene, output: str, limit: float) -> None:
    from .node_cases import Tree

    tree = scene.world.node_tree
    tree.nodes.clear()
    t = Tree(tree)
    color = t.out("MixRGB", {0: above(t, output, limit), 1: (0.4, 0.6, 1.0, 1.0), 2: RED})
    end = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(t.out("Background", {"Color": color}), end.inputs[0])
    scene.world.cycles.sampling_method = "NONE"
