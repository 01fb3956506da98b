# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: what the film leaves out. Holdouts, a transparent film's glass, exposure."""

from __future__ import annotations

SIZE, SEEDS, SAMPLES, BOUNCES = 24, 6, 512, 4

# Name: settings of the render, of Cycles and of the stage.
HOLDOUTS = {
    "holdout_objects": {"held": ("Block", "Ball", "Side"), "film": True},
    "holdout_opaque_film": {"held": ("Block", "Ball"), "film": False},
    "holdout_collection": {"collection": ("Block", "Glow"), "film": True},
    "holdout_closure": {"closure": ("Block", "Floor"), "film": True},
    "holdout_behind_pane": {"held": ("Block", "Glow"), "film": True, "pane": 0.0},
    "holdout_behind_clear_pane": {
        "held": ("Block", "Glow"),
        "film": True,
        "pane": 0.0,
        "clear": 0.1,
    },
    "holdout_in_a_mirror": {"held": ("Block", "Glow"), "film": True, "mirror": True},
    "holdout_pane": {"held": ("Leaf",), "film": True},
}
# Cycles leaves the world out where a walk finds it behind clear glass, but not where next event
# estimation does, so that rough glass shows some of it. Janus leaves it out everywhere: to be
# compared with Cycles' picture without that.
GLASS = {
    "glass_smooth": {"pane": 0.0, "clear": 0.1},
    "glass_below_the_threshold": {"pane": 0.3, "clear": 0.35},
    "glass_at_the_threshold": {"pane": 0.3, "clear": 0.3},
    "glass_above_the_threshold": {"pane": 0.4, "clear": 0.35},
    "glass_not_clear": {"pane": 0.0},
    "glass_mixed": {"pane": 0.2, "mixed": 0.5, "clear": 0.35},
    "glass_principled": {"pane": 0.2, "principled": True, "clear": 0.35},
}
EXPOSURE = {"exposure": {"film": True, "held": ("Block",), "exposure": 2.5}}
CASES = {**HOLDOUTS, **{name: {"film": True, **case} for name, case in GLASS.items()}, **EXPOSURE}


def stage(scene, mirror: bool = False) -> None:
    """A few things on a floor before the sky."""
    from scenes import kit

    white = kit.diffuse("White", (0.8, 0.75, 0.7))
    corners = [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0)]
    kit.quad(scene, "Floor", corners, white)
    red = kit.shader(
        "Plastic", "BsdfPrincipled", **{"Base Color": (0.7, 0.3, 0.2, 1.0), "Roughness": 0.5}
    )
    kit.box(scene, "Block", (0.7, 0.6, 0.9), red).location = (-0.5, 0.3, 0.0)
    glossy = kit.shader("Metal", "BsdfAnisotropic", "GGX", Color=(0.9, 0.8, 0.6, 1), Roughness=0.4)
    kit.sphere(scene, "Ball", 0.35, glossy, 32).location = (0.5, -0.3, 0.4)
    glow = kit.emission("Glow", (1.0, 0.6, 0.3), 3.0)
    kit.quad(
        scene, "Glow", [(0.2, 0.8, 0.5), (1.2, 0.8, 0.5), (1.2, 0.9, 1.2), (0.2, 0.9, 1.2)], glow
    )
    leaf = kit.combined(
        "Leaf",
        "MixShader",
        kit.diffuse("Green", (0.3, 0.7, 0.3)),
        kit.shader("Through", "BsdfTransparent", Color=(0.9, 0.7, 0.8, 1.0)),
    )
    kit.quad(
        scene,
        "Leaf",
        [(-1.2, -0.7, 0.3), (0.0, -0.7, 0.3), (0.0, -0.6, 1.2), (-1.2, -0.6, 1.2)],
        leaf,
    )
    wall = kit.shader("Mirror", "BsdfAnisotropic", "GGX", Roughness=0.0) if mirror else glossy
    side = [(-1.5, -1.5, 0), (-1.5, 1.5, 0), (-1.5, 1.5, 2.0), (-1.5, -1.5, 2.0)]
    kit.quad(scene, "Side", side, wall)
    kit.area_light(scene, "Lamp", (1.4, -0.9, 2.6), (0.0, 0.1, 0.3), (1.2, 1.2), 50.0)
    kit.camera(scene, (0.3, -4.6, 1.6), (0.0, 0.1, 0.75), lens=45.0)


def pane(scene, roughness: float, mixed=None, principled: bool = False) -> None:
    """Before the stage, and a sky with a bright part that it shows. No lamp shines through a rough
    one: where Cycles joins a lamp to rough glass, it adds light."""
    import bpy
    import numpy as np

    from scenes import kit

    color = (0.9, 0.95, 1.0, 1.0)
    glass = kit.shader("Pane", "BsdfGlass", "GGX", Color=color, Roughness=roughness, IOR=1.3)
    if mixed:
        other = kit.shader("Other", "BsdfGlass", "GGX", Color=color, Roughness=mixed, IOR=1.3)
        glass = kit.combined("Both", "MixShader", glass, other)
    if principled:
        inputs = {"Base Color": color, "Roughness": roughness, "Transmission Weight": 0.7}
        glass = kit.shader("Principled", "BsdfPrincipled", IOR=1.3, **inputs)
    corners = [(-1.0, -2.0, 0.2), (1.2, -2.0, 0.2), (1.2, -1.9, 1.9), (-1.0, -1.9, 1.9)]
    kit.quad(scene, "Pane", corners, glass)
    pixels = np.full((8, 16, 4), (0.25, 0.3, 0.4, 1.0), dtype=np.float32)
    pixels[4:6, 3:5, :3] = (3.0, 2.5, 1.5)  # ahead
    image = bpy.data.images.new("Sky", 16, 8, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    tree = scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    scene.world.cycles.sampling_method = "NONE"
    if roughness > 0.0:
        bpy.data.objects.remove(scene.objects["Lamp"])


def with_holes(scene, name: str) -> None:
    """Mixes the material of an object with Holdout."""
    material = scene.objects[name].data.materials[0].copy()
    scene.objects[name].data.materials[0] = material
    tree = material.node_tree
    mix, holdout = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeHoldout")
    mix.inputs["Fac"].default_value = 0.4
    output = tree.get_output_node("CYCLES").inputs["Surface"]
    tree.links.new(output.links[0].from_socket, mix.inputs[1])
    tree.links.new(holdout.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], output)


def build(name: str):
    import bpy

    from scenes import kit

    case = CASES[name]
    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, SAMPLES)
    kit.world(scene, (0.3, 0.35, 0.45))
    stage(scene, case.get("mirror", False))
    if "pane" in case:
        pane(scene, case["pane"], case.get("mixed"), case.get("principled", False))
    for held in case.get("held", ()):
        scene.objects[held].is_holdout = True
    if "collection" in case:
        outer, inner = (bpy.data.collections.new(n) for n in ("Outer", "Inner"))
        scene.collection.children.link(outer)
        outer.children.link(inner)
        for held, collection in zip(case["collection"], (outer, inner), strict=True):
            scene.collection.objects.unlink(scene.objects[held])
            collection.objects.link(bpy.data.objects[held])
        # Those in it are held, those in collections inside are not.
        scene.view_layers[0].layer_collection.children["Outer"].holdout = True
    for obj in case.get("closure", ()):
        with_holes(scene, obj)
    scene.render.film_transparent = case["film"]
    cycles = scene.cycles
    cycles.film_exposure = case.get("exposure", 1.0)
    cycles.film_transparent_glass = "clear" in case
    cycles.film_transparent_roughness = case.get("clear", 0.1)
    kit.limit_bounces(cycles, BOUNCES)
    return scene
