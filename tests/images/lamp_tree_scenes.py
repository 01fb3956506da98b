# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: a floor and a block under one lamp with a node tree."""

from __future__ import annotations

from .light_scenes import LIGHTS, lamp, stage
from .world_scenes import environment, picture

SEEDS = 4

LAMPS = {
    **{name: LIGHTS[name] for name in ("point", "point_soft", "point_sphere")},
    **{name: LIGHTS[name] for name in ("spot", "spot_sheared", "sun", "sun_60")},
    "area": dict(kind="AREA", shape="RECTANGLE", size=1.2, size_y=0.8),
    "area_ellipse": LIGHTS["area_ellipse_scaled"],
}


def emission(t, color=(1.0, 1.0, 1.0, 1.0), strength=1.0):
    return t.out("Emission", {"Color": color, "Strength": strength})


def coordinate(node: str, output: str):
    """An output as a colour. Cycles' lights can be negative, ours cannot."""

    def build(t):
        value = t.out(node, {}, output)
        factors = {0: value, 1: (0.3,) * 3, 2: (0.6,) * 3}
        color = t.out("VectorMath", factors, operation="MULTIPLY_ADD")
        return emission(t, t.out("VectorMath", {0: color, 1: (0.0,) * 3}, operation="MAXIMUM"))

    return build


# --- Trees that artists make ---------------------------------------------------------------------


def gobo(t):
    """A picture in the beam, the classic way: the normal, flattened."""
    x, y, z = t.node("SeparateXYZ", {0: t.coordinate("Normal")}).outputs
    flat = [t.out("Math", {0: part, 1: z}, operation="DIVIDE") for part in (x, y)]
    shifted = [t.out("Math", {0: part, 1: 0.5}, operation="ADD") for part in flat]
    vector = t.out("CombineXYZ", {0: shifted[0], 1: shifted[1]})
    image = picture("Gobo", 3)
    return emission(t, t.out("TexImage", {0: vector}, image=image, interpolation="Closest"))


def textured(t):
    return emission(t, t.out("TexImage", {0: t.coordinate("UV")}, image=picture("Panel", 5)), 2.0)


def surroundings(t):
    return emission(t, environment(t, vector=t.coordinate("Normal")), 1.5)


def tinted(t):
    """Warm towards one side, and black behind."""
    x, _, z = t.node("SeparateXYZ", {0: t.coordinate("Normal")}).outputs
    warm = t.out("MapRange", {"Value": x, "From Min": -1.0, "To Min": 2000.0, "To Max": 9000.0})
    front = t.out("Math", {0: z, 1: -1.0}, operation="MULTIPLY", use_clamp=True)
    return emission(t, t.out("Blackbody", {0: warm}), front)


def dappled(t):
    """Textures where nothing is linked to them, and by the direction."""
    noise = t.out("TexNoise", {"Scale": 2.0, "Distortion": 0.5}, "Color")
    rings = {"Vector": t.coordinate("Normal"), "Scale": 0.4}
    return emission(t, noise, t.out("TexWave", rings, "Fac", wave_type="RINGS"))


# --- What falls otherwise, or is measured ---------------------------------------------------------


def ies(name: str, **inputs):
    """An IES file, by the direction of the light or by another."""

    def build(t):
        from .ies_texts import TEXTS
        from .node_cases_ies import text

        made = t.node("TexIES", {"Strength": 0.05}, ies=text(name, TEXTS[name]))
        for output, node in inputs.items():
            t.tree.links.new(t.node(node).outputs[output], made.inputs["Vector"])
        return emission(t, strength=made.outputs[0])

    return build


def falloff(output: str, strength=1.0, smooth=0.0):
    return lambda t: emission(
        t, strength=t.out("LightFalloff", {"Strength": strength, "Smooth": smooth}, output)
    )


def mixed_falloff(t):
    """By the place, too."""
    linear = t.out("LightFalloff", {"Strength": 0.6, "Smooth": 0.5}, "Linear")
    return emission(t, t.out("TexNoise", {"Scale": 2.0}, "Color"), linear)


def rings(t):
    """Of light, by the distance."""
    length = t.out("LightPath", output="Ray Length")
    scaled = t.out("Math", {0: length, 1: 12.0}, operation="MULTIPLY")
    wave = t.out("Math", {0: scaled}, operation="SINE")
    return emission(t, strength=t.out("Math", {0: wave, 1: 1.2}, operation="ADD"))


def sky(model: str):
    """The air in a lamp, by the direction from its middle."""

    def build(t):
        settings = dict(sun_disc=False, sun_elevation=0.4, sun_rotation=1.0)
        direction = t.out("NewGeometry", {}, "Incoming")
        up = t.out("VectorMath", {0: direction, 1: (1.0, 1.0, -1.0)}, operation="MULTIPLY")
        node = t.node("TexSky", sky_type=model, **settings)
        if node.inputs and node.inputs[0].enabled:
            t.tree.links.new(up, node.inputs[0])
        return emission(t, node.outputs[0], 0.2)

    return build


COORDINATES = [
    *(("TexCoord", name) for name in ("Normal", "UV", "Object")),
    *(("NewGeometry", name) for name in ("Position", "Incoming")),
]
OTHERS = [
    *(("TexCoord", name) for name in ("Generated", "Camera", "Reflection")),
    *(("NewGeometry", name) for name in ("Normal", "Parametric")),
    ("NewGeometry", "True Normal"),
    ("NewGeometry", "Backfacing"),
    ("ObjectInfo", "Location"),
    ("ObjectInfo", "Color"),
    ("CameraData", "View Vector"),
]
TREES = {
    "spot_gobo": ("spot", gobo),
    "spot_textured": ("spot", textured),
    "area_textured": ("area", textured),
    "point_surroundings": ("point", surroundings),
    "point_tinted": ("point_soft", tinted),
    "point_dappled": ("point_soft", dappled),
    "area_dappled": ("area", dappled),
    "point_ies": ("point", ies("C quarter")),
    "point_sphere_ies": ("point_sphere", ies("C whole")),
    "spot_ies": ("spot", ies("C around")),
    "area_ies": ("area", ies("C around")),
    "area_ellipse_ies": ("area_ellipse", ies("C whole")),
    "sun_60_ies": ("sun_60", ies("C whole")),
    "point_soft_ies_b": ("point_soft", ies("B whole", Normal="TexCoord")),
    **{f"{name}_falloff_linear": (name, falloff("Linear", 0.5)) for name in LAMPS},
    "point_falloff_constant": ("point", falloff("Constant", 0.2)),
    "point_soft_falloff_constant": ("point_soft", falloff("Constant", 0.2, 0.7)),
    "point_sphere_falloff": ("point_sphere", falloff("Quadratic", 1.0, 2.0)),
    "area_falloff_mixed": ("area", mixed_falloff),
    "area_falloff_constant": ("area", falloff("Constant", 0.2)),
    "spot_falloff_smooth": ("spot", falloff("Quadratic", 1.0, 5.0)),
    "point_rings": ("point_soft", rings),
    "area_rings": ("area", rings),
    "sun_sky": ("sun_60", sky("MULTIPLE_SCATTERING")),
    "area_sky": ("area", sky("HOSEK_WILKIE")),
    "point_sky": ("point_soft", sky("PREETHAM")),
}
CASES = {
    **{
        f"{name}_{node}_{output}".lower().replace(" ", "_"): (name, coordinate(node, output))
        for name in LAMPS
        for node, output in COORDINATES
    },
    **{
        f"{name}_{node}_{output}".lower().replace(" ", "_"): (name, coordinate(node, output))
        for name in ("point", "area", "sun_60")
        for node, output in OTHERS
    },
    **TREES,
}
# For light paths, too.
BOTH_WAYS = [*TREES, *(f"{name}_texcoord_object" for name in LAMPS)]


def samples(name: str) -> int:
    return 512 if name.startswith("spot") else 192


def build(name: str):
    from tests.images.node_cases import Tree

    scene = stage(samples(name))
    kind, shader = CASES[name]
    lamp(scene, **LAMPS[kind])
    data = scene.objects["Lamp"].data
    data.use_nodes = True
    tree = data.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputLight")
    tree.links.new(shader(Tree(tree)), output.inputs["Surface"])
    return scene
