# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: one room under the rules for whole paths."""

from __future__ import annotations

SIZE, SEEDS, SAMPLES, BOUNCES = 24, 6, 256, 5
KINDS = ("diffuse", "glossy", "transmission")

# Name: limits of bounces by kind. What is not named has no limit but that of all bounces.
CAPS = {f"{kind}_{limit}": {kind: limit} for kind in KINDS for limit in (0, 1, 2)}
CAPS |= {"mixed": {"diffuse": 1, "glossy": 1, "transmission": 2}}

# Name: what is hidden from a ray. Cycles gives the segment to a light one type in next event
# estimation and another one where a bounce hits the light; so its lamps are not to be hit here.
RAYS = ("camera", *KINDS, "shadow")
HIDDEN = {f"{thing}_{ray}": (thing, ray) for thing in ("objects", "glow") for ray in RAYS}
HIDDEN |= {f"{thing}_{ray}": (thing, ray) for thing in ("lamp", "world") for ray in KINDS}
HIDDEN |= {"world_camera": ("world", "camera")}
# Name: other rules of the lamp, of its light data.
LAMP = {
    "lamp_no_shadow": ("use_shadow", False),
    "lamp_bounces_0": ("cycles.max_bounces", 0),
    "lamp_bounces_1": ("cycles.max_bounces", 1),
}
# Name: what the leaf asks Light Path, to look otherwise to those rays.
ASKED = {f"asks_{ray}": f"Is {ray.title()} Ray" for ray in (*RAYS, "reflection")}
CASES = [*CAPS, *HIDDEN, *LAMP, *ASKED]


def room(scene) -> None:
    """Every label, alone and shared, within one's reach of a lamp. Nothing is smooth: Cycles' own
    noise must stay small."""
    from scenes import kit

    white = kit.diffuse("White", (0.8, 0.75, 0.7))
    plastic = kit.shader(
        "Plastic", "BsdfPrincipled", **{"Base Color": (0.7, 0.3, 0.2, 1.0), "Roughness": 0.5}
    )
    metal = kit.shader(
        "Metal", "BsdfAnisotropic", "GGX", Color=(0.9, 0.85, 0.7, 1.0), Roughness=0.5
    )
    glass = kit.shader(
        "Glass", "BsdfGlass", "GGX", Color=(0.9, 0.95, 1.0, 1.0), Roughness=0.5, IOR=1.4
    )
    leaf = kit.shader("Leaf", "BsdfTranslucent", Color=(0.6, 0.9, 0.5, 1.0))
    kit.quad(
        scene, "Floor", [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0)], white
    )
    kit.quad(
        scene, "Back", [(-1.5, 1.5, 0), (1.5, 1.5, 0), (1.5, 1.5, 2.4), (-1.5, 1.5, 2.4)], white
    )
    kit.quad(
        scene,
        "Side",
        [(-1.5, -1.5, 0), (-1.5, 1.5, 0), (-1.5, 1.5, 2.4), (-1.5, -1.5, 2.4)],
        metal,
    )
    kit.box(scene, "Block", (0.7, 0.6, 0.7), plastic).location = (-0.55, 0.5, 0.0)
    kit.sphere(scene, "Ball", 0.45, glass, 32).location = (0.6, -0.2, 0.5)
    kit.quad(
        scene, "Leaf", [(0.2, 0.7, 0.1), (1.3, 0.9, 0.1), (1.3, 0.5, 1.3), (0.2, 0.4, 1.3)], leaf
    )
    kit.area_light(scene, "Lamp", (0.4, -0.6, 2.3), (0.0, 0.1, 0.3), (1.2, 1.2), 60.0)
    kit.camera(scene, (0.3, -4.6, 1.9), (0.0, 0.1, 0.75), lens=50.0)


def no_glass(scene) -> None:
    """Where light shines through the ball: in rough glass that is lit from within, Cycles' next
    event estimation also counts refraction by microfacets that face into the surface."""
    scene.objects["Ball"].data.materials[0] = scene.objects["Leaf"].data.materials[0]


def hide(scene, thing: str, ray: str) -> None:
    """Hides a part of the room from a ray."""
    from scenes import kit

    objects = scene.objects
    objects["Lamp"].data.cycles.use_multiple_importance_sampling = False
    if thing in ("lamp", "world"):  # what is left without the lamp must not be dark
        kit.world(scene, (0.5, 0.6, 0.8))
    if thing == "world":
        setattr(scene.world.cycles_visibility, ray, False)
    elif thing == "glow":
        glow = kit.shader("Glow", "Emission", Color=(1.0, 0.6, 0.3, 1.0), Strength=4.0)
        corners = [(-0.9, -0.5, 0.9), (-0.4, -0.5, 0.9), (-0.4, 0.0, 1.1), (-0.9, 0.0, 1.1)]
        kit.quad(scene, "Glow", corners, glow)
        setattr(objects["Glow"], f"visible_{ray}", False)
    elif thing == "objects":
        for obj in ("Block", "Ball", "Leaf"):
            setattr(objects[obj], f"visible_{ray}", False)
    else:
        setattr(objects["Lamp"], f"visible_{ray}", False)
    if ray == "shadow":
        no_glass(scene)
    # Of these, Cycles' own rules differ between next event estimation and hits.
    if thing in ("lamp", "world"):
        refraction = kit.shader("Bent", "BsdfRefraction", "GGX", Roughness=0.5, IOR=1.4)
        objects["Ball"].data.materials[0] = refraction
        if thing == "world" or ray == "transmission":
            objects["Leaf"].data.materials[0] = refraction


def ask(scene, output: str) -> None:
    """Rays that answer yes meet another leaf: a red one, or none that shadow rays would meet."""
    from scenes import kit

    scene.objects["Lamp"].data.cycles.use_multiple_importance_sampling = False
    leaf = scene.objects["Leaf"].data.materials[0]
    if output == "Is Shadow Ray":
        other = kit.shader("Other", "BsdfTransparent", Color=(0.9, 0.4, 0.2, 1.0))
        no_glass(scene)
    else:
        other = kit.diffuse("Other", (0.9, 0.1, 0.1))
    mixed = kit.combined("Asked", "MixShader", leaf, other)
    tree = mixed.node_tree
    path = tree.nodes.new("ShaderNodeLightPath")
    mix = next(node for node in tree.nodes if node.type == "MIX_SHADER")
    tree.links.new(path.outputs[output], mix.inputs[0])
    scene.objects["Leaf"].data.materials[0] = mixed


def build(name: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, SAMPLES)
    kit.world(scene)
    room(scene)
    if name in HIDDEN:
        hide(scene, *HIDDEN[name])
    if name in ASKED:
        ask(scene, ASKED[name])
    if name in LAMP:
        data = scene.objects["Lamp"].data
        data.cycles.use_multiple_importance_sampling = False
        path, value = LAMP[name]
        owner = data.cycles if path.startswith("cycles.") else data
        setattr(owner, path.removeprefix("cycles."), value)
        no_glass(scene)
    for kind in KINDS:
        setattr(scene.cycles, f"{kind}_bounces", CAPS.get(name, {}).get(kind, 1024))
    scene.cycles.max_bounces = BOUNCES
    return scene
