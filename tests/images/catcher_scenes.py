# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: shadow catchers, with the pass of what they show."""

from __future__ import annotations

from .pass_scenes import save  # noqa: F401

WIDTH, HEIGHT, SEEDS, SAMPLES, BOUNCES = 32, 24, 6, 768, 4

# Name: what is different on the stage.
FACTORS = {
    "plain": {},
    "opaque_film": {"film": False},
    "dark_world": {"world": 0.0},
    "only_world": {"lamp": None},
    "sun": {"lamp": "SUN"},
    "colours": {"second": True},
    "glow": {"glow": "Glow", "film": False},
    "glowing_catcher": {"glow": "Glow", "catchers": ("Floor", "Glow")},
    "mirror": {"ball": 0.0},
    "glossy_catcher": {"floor": "GLOSSY"},
    "clear_catcher_opaque_film": {"floor": "CLEAR", "cellar": True, "film": False},
    "leaf": {"leaf": True},
    "glass": {"pane": True},
    "two_catchers": {"catchers": ("Floor", "Side"), "side": True},
    "wall_beside": {"side": True},
    "holdouts": {"held": ("Block",), "side": True},
    "held_catcher": {"held": ("Side",), "catchers": ("Floor", "Side"), "side": True},
    "hidden_object": {"hidden": ("Block",)},
    "hidden_catcher": {"hidden": ("Side",), "catchers": ("Floor", "Side"), "side": True},
    "indirect_only": {"indirect": ("Block",)},
    "synthetic_lamp": {"second": True, "synthetic": ("Second",)},
    "not_in_mirrors": {"no_glossy": ("Floor",), "ball": 0.0},
    "exposure": {"exposure": 2.5, "film": False},
}
# The finished picture, with the shadows in it.
COMPOSITES = {
    "composite": {"composite": True},
    "composite_on_background": {"composite": True, "film": False},
}
# Where a transparent film has light come through a catcher from nowhere, Cycles counts what is
# missing once for the scene and once for the catchers alone, and shows less of the shadows.
OTHERWISE = {"clear_catcher": {"floor": "CLEAR", "cellar": True}}
CASES = {**FACTORS, **OTHERWISE, **COMPOSITES}


def stage(scene, case: dict) -> None:
    from scenes import kit

    floors = {
        None: lambda: kit.diffuse("Sand", (0.8, 0.7, 0.5)),
        "GLOSSY": lambda: kit.shader(
            "Tiles", "BsdfAnisotropic", "GGX", Color=(0.8, 0.8, 0.7, 1.0), Roughness=0.5
        ),
        "CLEAR": lambda: kit.combined(
            "Veil",
            "MixShader",
            kit.diffuse("Cloth", (0.8, 0.7, 0.5)),
            kit.shader("Holes", "BsdfTransparent", Color=(0.9, 0.8, 0.9, 1.0)),
        ),
    }
    white = floors[case.get("floor")]()
    kit.quad(
        scene, "Floor", [(-1.6, -1.6, 0), (1.6, -1.6, 0), (1.6, 1.6, 0), (-1.6, 1.6, 0)], white
    )
    red = kit.diffuse("Red", (0.7, 0.25, 0.2))
    kit.box(scene, "Block", (0.6, 0.6, 0.7), red).location = (-0.5, 0.4, 0.0)
    metal = kit.shader(
        "Metal", "BsdfAnisotropic", "GGX", Color=(0.9, 0.8, 0.6, 1), Roughness=case.get("ball", 0.5)
    )
    kit.sphere(scene, "Ball", 0.35, metal, 32).location = (0.5, -0.2, 0.4)
    if "glow" in case:
        corners = [(0.3, 0.8, 0.4), (1.3, 0.8, 0.4), (1.3, 0.9, 1.2), (0.3, 0.9, 1.2)]
        kit.quad(scene, "Glow", corners, kit.emission("Glow", (1.0, 0.6, 0.3), 3.0))
    if case.get("side"):
        side = [(-1.5, 1.1, 0.01), (0.6, 1.5, 0.01), (0.6, 1.5, 1.0), (-1.5, 1.1, 1.0)]
        kit.quad(scene, "Side", side, kit.diffuse("Green", (0.3, 0.7, 0.3)))
    if case.get("cellar"):
        blue = kit.diffuse("Blue", (0.2, 0.3, 0.8))
        kit.box(scene, "Cellar", (0.9, 0.9, 0.4), blue).location = (0.3, -0.5, -0.9)
    if case.get("leaf"):
        leaf = kit.combined(
            "Leaf",
            "MixShader",
            kit.diffuse("Green", (0.3, 0.7, 0.3)),
            kit.shader("Through", "BsdfTransparent", Color=(0.9, 0.7, 0.8, 1.0)),
        )
        corners = [(-1.0, -1.5, 0.2), (0.3, -1.5, 0.2), (0.3, -1.2, 1.2), (-1.0, -1.2, 1.2)]
        kit.quad(scene, "Leaf", corners, leaf)
    if case.get("pane"):
        pane = kit.shader("Pane", "BsdfGlass", Color=(0.9, 0.95, 1.0, 1.0), Roughness=0.0, IOR=1.3)
        corners = [(-1.0, -1.8, 0.1), (0.2, -1.8, 0.1), (0.2, -1.6, 1.6), (-1.0, -1.6, 1.6)]
        kit.quad(scene, "Pane", corners, pane)
    kit.camera(scene, (0.3, -4.4, 3.4), (0.0, 0.0, 0.2), lens=50.0)


def lamps(scene, case: dict) -> None:
    import bpy

    from scenes import kit

    level = case.get("world", 1.0)
    kit.world(scene, (0.3 * level, 0.35 * level, 0.45 * level))
    if case.get("lamp", "AREA") == "AREA":
        kit.area_light(scene, "Lamp", (1.4, -0.9, 2.6), (0.0, 0.1, 0.3), (1.2, 1.2), 50.0)
    if case.get("lamp") == "SUN":
        sun = bpy.data.lights.new("Lamp", "SUN")
        sun.energy, sun.angle = 1.5, 0.3
        lamp = bpy.data.objects.new("Lamp", sun)
        lamp.rotation_euler = (0.7, 0.4, 0.2)
        scene.collection.objects.link(lamp)
    if case.get("second"):
        second = kit.area_light(
            scene, "Second", (-1.8, 0.9, 2.0), (0.0, 0.0, 0.2), (0.6, 0.6), 60.0
        )
        second.data.color = (0.2, 0.4, 1.0)


def build(name: str):
    import bpy

    from scenes import kit

    case = CASES[name]
    scene = bpy.context.scene
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    stage(scene, case)
    lamps(scene, case)
    scene.render.film_transparent = case.get("film", True)
    for catcher in case.get("catchers", ("Floor",)):
        scene.objects[catcher].is_shadow_catcher = True
    for lamp in case.get("synthetic", ()):
        scene.objects[lamp].is_shadow_catcher = False
    for held in case.get("held", ()):
        scene.objects[held].is_holdout = True
    for what, ray in (("hidden", "camera"), ("no_glossy", "glossy")):
        for obj in case.get(what, ()):
            setattr(scene.objects[obj], f"visible_{ray}", False)
    if "indirect" in case:
        collection = bpy.data.collections.new("Unseen")
        scene.collection.children.link(collection)
        for obj in case["indirect"]:
            scene.collection.objects.unlink(scene.objects[obj])
            collection.objects.link(bpy.data.objects[obj])
        scene.view_layers[0].layer_collection.children["Unseen"].indirect_only = True
    layer = scene.view_layers[0]
    layer.cycles.use_pass_shadow_catcher = "composite" not in case
    layer.use_pass_environment = True
    scene.cycles.film_exposure = case.get("exposure", 1.0)
    kit.limit_bounces(scene.cycles, BOUNCES)
    return scene
