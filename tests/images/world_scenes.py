# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: a few things in the light of worlds whose node tree is more than a picture.

Where a world asks by which ray it is seen, Cycles does not look for it: where it does, it tells
every ray that it is of none of the types. world_views.py has the same worlds to look at.
"""

from __future__ import annotations

SEEDS, SIZE = 4, 24


def picture(name: str, seed: int, sun: bool = False):
    """16 x 8 pixels, with a sharp edge to tell the sides."""
    import bpy
    import numpy as np

    image = bpy.data.images.new(name, 16, 8, alpha=True, float_buffer=True)
    pixels = np.ones((8, 16, 4), dtype=np.float32)
    pixels[..., :3] = np.random.default_rng(seed).uniform(0.05, 0.6, (8, 16, 3))
    pixels[:, :8, seed % 3] *= 0.3
    if sun:
        pixels[5, 5, :3] = (40.0, 35.0, 20.0)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image


def environment(t, seed: int = 2, sun: bool = False, vector=None, **properties):
    inputs = {} if vector is None else {"Vector": vector}
    image = picture(f"Sky {seed}", seed, sun)
    return t.out("TexEnvironment", inputs, image=image, **properties)


def background(t, color=(1.0, 1.0, 1.0, 1.0), strength=1.0):
    return t.out("Background", {"Color": color, "Strength": strength})


def height(t):
    return t.node("SeparateXYZ", {0: t.coordinate("Generated")}).outputs["Z"]


# --- The trees: each gives the shader of the world -----------------------------------------------


def gradient(t):
    half = t.out("Math", {0: height(t), 1: 0.5, 2: 0.5}, operation="MULTIPLY_ADD")
    ramp = t.node("ValToRGB", {0: half})
    stops = ramp.color_ramp.elements
    stops[0].color, stops[1].color = (0.05, 0.04, 0.03, 1), (0.2, 0.4, 1.0, 1)
    stops.new(0.5).color = (0.9, 0.6, 0.3, 1)
    return background(t, ramp.outputs[0])


def mixed(t):
    first, second = environment(t, 2, True), environment(t, 4, interpolation="Closest")
    inputs = {"Factor_Float": height(t), "A_Color": first, "B_Color": second}
    color = t.out("Mix", inputs, "Result_Color", data_type="RGBA", blend_type="MIX")
    return background(t, color)


def graded(t):
    bright = t.out("HueSaturation", {"Hue": 0.6, "Saturation": 1.4, "Color": environment(t)})
    color = t.out("Gamma", {0: bright, 1: 1.5})
    curves = t.node("RGBCurve", {"Color": color})
    curves.mapping.curves[3].points.new(0.3, 0.5)
    strength = t.out("Math", {0: height(t), 1: 0.9, 2: 1.2}, operation="MULTIPLY_ADD")
    return background(t, curves.outputs[0], strength)


def stretched(t):
    inputs = {"Vector": t.coordinate("Generated"), "Scale": (1.0, 0.6, 2.0)}
    moved = {**inputs, "Location": (0.1, 0.2, 0.4), "Rotation": (0.3, 0.0, 1.0)}
    return background(t, environment(t, vector=t.out("Mapping", moved)))


def ball(t):
    return background(t, environment(t, projection="MIRROR_BALL"))


def cubic(t):
    return background(t, environment(t, interpolation="Cubic"))


def flat(t):
    inputs = {"Vector": t.coordinate("Generated"), "Scale": (0.4, 0.7, 1.0)}
    vector = t.out("Mapping", inputs)
    return background(t, t.out("TexImage", {0: vector}, image=picture("Flat", 7)))


def added(t):
    sum_of = {0: background(t, environment(t, 2, True), 0.5), 1: gradient(t)}
    return t.out("AddShader", sum_of)


def emission(t):
    return t.out("Emission", {"Color": environment(t), "Strength": 1.5})


def sharp_sun(t):
    """A sun by arithmetic, on a sky that is black below."""
    dot = t.out(
        "VectorMath",
        {0: t.coordinate("Generated"), 1: (-0.48, -0.36, 0.8)},
        "Value",
        operation="DOT_PRODUCT",
    )
    sun = t.out("Math", {0: dot, 1: 0.97}, operation="GREATER_THAN")
    above = t.out("Math", {0: height(t), 1: 0.0}, operation="MAXIMUM")
    return background(
        t, (1.0, 0.9, 0.7, 1.0), t.out("Math", {0: sun, 1: 8.0, 2: above}, operation="MULTIPLY_ADD")
    )


def clouds(t):
    """Textures where nothing is linked to them."""
    noise = t.out("TexNoise", {"Scale": 3.0, "Detail": 1.5})
    cells = t.out("TexVoronoi", {"Scale": 2.0}, "Color")
    return background(t, cells, noise)


def by_ray(output: str):
    def build(t):
        other = background(t, (0.9, 0.2, 0.1, 1.0))
        inputs = {0: t.out("LightPath", {}, output), 1: background(t, environment(t)), 2: other}
        return t.out("MixShader", inputs)

    return build


TREES = (
    *(gradient, mixed, graded, stretched, ball, cubic, flat, added, emission, sharp_sun),
    clouds,
)
LIT = {
    "gradient": gradient,
    "mixed": mixed,
    "graded": graded,
    "added": added,
    "sharp_sun": sharp_sun,
    "clouds": clouds,
    "by_camera": by_ray("Is Camera Ray"),
}
BY_RAY = {
    f"by_{name.lower()}": by_ray(f"Is {name} Ray")
    for name in ("Diffuse", "Glossy", "Reflection", "Transmission")
}
CASES = {**LIT, **BY_RAY}


def samples(name: str) -> int:
    return 512 if name in BY_RAY else 192


def things(scene) -> None:
    """Diffuse, a mirror and glass before the sky."""
    from scenes import kit

    white = kit.diffuse("White", (0.8, 0.75, 0.7))
    corners = [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0)]
    kit.quad(scene, "Floor", corners, white)
    kit.box(scene, "Block", (0.5, 0.4, 0.6), white).rotation_euler = (0, 0, 0.4)
    mirror = [(-1.4, 0.4, 0.0), (-0.5, 0.9, 0.0), (-0.5, 0.9, 0.9), (-1.4, 0.4, 0.9)]
    kit.quad(scene, "Mirror", mirror, kit.metal("Mirror", (0.9, 0.8, 0.6)))
    kit.box(scene, "Glass", (0.5, 0.3, 0.8), kit.glass("Glass")).location = (0.9, -0.4, 0.1)
    kit.camera(scene, (0.0, -4.0, 2.2), (0.0, 0.1, 0.3), lens=50.0)


def set_tree(scene, shader) -> None:
    """Gives the scene a world: shader(tree) makes its nodes and gives the last socket."""
    from scenes import kit
    from tests.images.node_cases import Tree

    kit.world(scene)
    tree = scene.world.node_tree
    tree.nodes.remove(tree.nodes["Background"])
    output = tree.get_output_node("CYCLES")
    tree.links.new(shader(Tree(tree)), output.inputs["Surface"])


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, samples(name))
    set_tree(scene, CASES[name])
    things(scene)
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(scene.cycles, f"{kind}_bounces", 6)
    if name in BY_RAY:
        scene.world.cycles.sampling_method = "NONE"
    return scene
