# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: a room whose ball, pane and floor are of one material, one kind of it a case.

For Janus alone (test_agreement.py): path tracing, light tracing and BDPT must be the same picture.
Light tracing shows all of them but for what the camera sees by way of a mirror, and what a surface
lets through for one side or view alone (tests/core/integrator/shader_agreement_test.cpp). Emission
that depends on the view it does see.
"""

from __future__ import annotations

SEEDS, SIZE, BOUNCES = 0, 32, 6  # of Cycles: none

# --- The materials: each gives the shader of a Tree ----------------------------------------------


def _picture(t, seed: int):
    from .world_scenes import picture

    return t.out("TexImage", {0: t.coordinate("UV")}, image=picture(f"Picture {seed}", seed))


def _level(t, seed: int, low: float, high: float):
    """A number from a picture, whose mean is about 0.3."""
    inputs = {"Value": t.out("RGBToBW", {0: _picture(t, seed)}), "From Max": 0.6}
    return t.out("MapRange", {**inputs, "To Min": low, "To Max": high})


def _waves(t, axis: str = "X"):
    along = t.node("SeparateXYZ", {0: t.coordinate("Object")}).outputs[axis]
    return t.out(
        "Math", {0: t.out("Math", {0: along, 1: 18.0}, operation="MULTIPLY")}, operation="SINE"
    )


def textured(t):
    return t.out(
        "BsdfPrincipled",
        {
            "Base Color": t.out("Gamma", {0: _picture(t, 2), 1: 0.5}),
            "Roughness": _level(t, 3, 0.3, 0.8),
            "Metallic": _level(t, 4, 0.0, 1.0),
        },
    )


def bumped(t):
    normal = t.out("Bump", {"Height": _waves(t), "Strength": 0.7, "Distance": 0.03})
    inputs = {"Base Color": (0.8, 0.7, 0.6, 1.0), "Roughness": 0.4, "Normal": normal}
    return t.out("BsdfPrincipled", inputs)


def displaced(t):
    """As bump; and bumped, too."""
    t.displace(t.out("Displacement", {"Height": _waves(t), "Midlevel": 0.0, "Scale": 0.02}))
    normal = t.out("Bump", {"Height": _waves(t, "Y"), "Strength": 0.5, "Distance": 0.03})
    shine = t.out("BsdfAnisotropic", {"Color": (0.9, 0.9, 0.8, 1.0), "Roughness": 0.4})
    matt = t.out("BsdfDiffuse", {"Color": (0.4, 0.7, 0.8, 1.0), "Normal": normal})
    leaf = t.out("BsdfTranslucent", {"Color": (0.6, 0.7, 0.3, 1.0)})
    first = t.out("MixShader", {0: t.out("Fresnel", {"IOR": 1.6}), 1: matt, 2: shine})
    return t.out("MixShader", {0: 0.3, 1: first, 2: leaf})


def normal_mapped(t):
    inputs = {"A_Color": _picture(t, 5), "B_Color": (0.5, 0.5, 1.0, 1.0)}
    tilt = t.out("Mix", inputs, "Result_Color", data_type="RGBA")
    normal = t.out("NormalMap", {"Color": tilt, "Strength": 0.8})
    inputs = {"Base Color": (0.7, 0.8, 0.6, 1.0), "Roughness": 0.5, "Normal": normal}
    return t.out("BsdfPrincipled", inputs)


def mixed(t):
    """Diffuse, metal, a leaf and holes."""
    red = t.out("BsdfDiffuse", {"Color": (0.8, 0.3, 0.2, 1.0)})
    metal = t.out("BsdfAnisotropic", {"Color": (0.9, 0.9, 0.8, 1.0), "Roughness": 0.4})
    leaf = t.out("BsdfTranslucent", {"Color": (0.4, 0.7, 0.3, 1.0)})
    hole = t.out("BsdfTransparent", {"Color": (0.9, 0.8, 0.7, 1.0)})
    first = t.out("MixShader", {0: _level(t, 2, 0.0, 1.0), 1: red, 2: metal})
    second = t.out("MixShader", {0: _level(t, 3, 0.2, 0.8), 1: leaf, 2: hole})
    return t.out("MixShader", {0: 0.4, 1: first, 2: second})


def mirrored(t):
    """A mirror is a part of it: a light path cannot show it to the camera."""
    red = t.out("BsdfDiffuse", {"Color": (0.8, 0.3, 0.2, 1.0)})
    mirror = t.out("BsdfAnisotropic", {"Color": (0.9, 0.9, 0.8, 1.0), "Roughness": 0.0})
    return t.out("MixShader", {0: _level(t, 2, 0.2, 0.8), 1: red, 2: mirror})


def emissive(t):
    glow = t.out("Emission", {"Color": (1.0, 0.7, 0.4, 1.0), "Strength": 0.6})
    return t.out("AddShader", {0: t.out("BsdfDiffuse", {"Color": (0.5, 0.5, 0.6, 1.0)}), 1: glow})


def textured_emissive(t):
    glow = t.out("Emission", {"Color": _picture(t, 2), "Strength": _level(t, 3, 0.0, 4.0)})
    return t.out("AddShader", {0: t.out("BsdfDiffuse", {"Color": (0.5, 0.5, 0.6, 1.0)}), 1: glow})


def view_dependent(t):
    """By the angle (Layer Weight, Fresnel) and by the direction (Incoming) of the view."""
    incoming = t.out("NewGeometry", {}, "Incoming")
    color = t.out(
        "VectorMath", {0: incoming, 1: (0.35,) * 3, 2: (0.5,) * 3}, operation="MULTIPLY_ADD"
    )
    base = t.out("BsdfDiffuse", {"Color": color})
    coat = t.out("BsdfAnisotropic", {"Color": (0.9, 0.9, 0.9, 1.0), "Roughness": 0.45})
    leaf = t.out("BsdfTranslucent", {"Color": (0.7, 0.8, 0.3, 1.0)})
    coated = t.out("MixShader", {0: t.out("Fresnel", {"IOR": 1.8}), 1: base, 2: coat})
    facing = t.out("LayerWeight", {"Blend": 0.3}, "Facing")
    return t.out("MixShader", {0: facing, 1: coated, 2: leaf})


def glowing_rim(t):
    """Light that is seen from the side only."""
    glow = t.out("Emission", {"Color": (1.0, 0.6, 0.3, 1.0), "Strength": 3.0})
    facing = t.out("LayerWeight", {"Blend": 0.3}, "Facing")
    grey = t.out("BsdfDiffuse", {"Color": (0.5, 0.5, 0.5, 1.0)})
    return t.out("MixShader", {0: facing, 1: grey, 2: glow})


def covered(t):
    """Dust on a tinted coat over plastic and metal."""
    inputs = {"Base Color": (0.8, 0.3, 0.2, 1.0), "Metallic": _level(t, 4, 0.0, 0.6)}
    coat = {"Coat Weight": 0.8, "Coat Roughness": 0.35, "Coat Tint": (0.5, 0.7, 0.9, 1.0)}
    sheen = {"Sheen Weight": _level(t, 3, 0.0, 1.0), "Sheen Tint": (0.9, 0.9, 0.5, 1.0)}
    tint = {"Specular Tint": (0.9, 0.5, 0.7, 1.0), "Emission Strength": 0.3}
    return t.out("BsdfPrincipled", {**inputs, **coat, **sheen, **tint})


def brushed(t):
    inputs = {"Base Color": (0.9, 0.7, 0.4, 1.0), "Edge Tint": (0.6, 0.8, 0.9, 1.0)}
    turned = {"Roughness": 0.5, "Anisotropy": 0.8, "Rotation": _level(t, 3, 0.0, 1.0)}
    return t.out("BsdfMetallic", {**inputs, **turned})


def cloth(t):
    sheen = t.out("BsdfSheen", {"Color": _picture(t, 2), "Roughness": _level(t, 3, 0.2, 1.0)})
    velvet = t.out("BsdfSheen", {"Roughness": 0.5}, distribution="ASHIKHMIN")
    ground = t.out("BsdfDiffuse", {"Color": (0.3, 0.2, 0.4, 1.0)})
    first = t.out("AddShader", {0: ground, 1: sheen})
    return t.out("MixShader", {0: _level(t, 4, 0.0, 0.7), 1: first, 2: velvet})


def comic(t):
    normal = t.out("Bump", {"Height": _waves(t), "Strength": 0.5, "Distance": 0.03})
    base = t.out("BsdfToon", {"Size": 0.7, "Smooth": 0.2, "Normal": normal})
    shine = t.out("BsdfToon", {"Size": 0.3, "Smooth": 0.3}, component="GLOSSY")
    return t.out("MixShader", {0: _level(t, 2, 0.0, 0.8), 1: base, 2: shine})


def below(t):
    """The medium varies from place to place, so that both ends of a walk have one of their own."""
    fixed = {"Scale": 0.4, "Radius": (1.0, 0.5, 0.3), "Roughness": 0.8}
    wax = t.out("SubsurfaceScattering", {**fixed, "Color": _picture(t, 2)})
    plain = t.out("BsdfDiffuse", {"Color": (0.5, 0.6, 0.7, 1.0)})
    return t.out("MixShader", {0: _level(t, 3, 0.0, 0.5), 1: wax, 2: plain})


# Only the pane is one: right of column SEEN the camera sees no mirror, but what it throws there.
MIRRORS = {"mirrored"}
SEEN = 17

NOISY = {"below"}  # light walks come up where the camera sees little of it

CASES = {
    "textured": textured,
    "bumped": bumped,
    "displaced": displaced,
    "normal_mapped": normal_mapped,
    "mixed": mixed,
    "mirrored": mirrored,
    "emissive": emissive,
    "textured_emissive_mesh": textured_emissive,
    "view_dependent": view_dependent,
    "view_dependent_emission": glowing_rim,
    "covered": covered,
    "brushed": brushed,
    "cloth": cloth,
    "comic": comic,
    "below": below,
}


def build(name: str):
    import bpy

    from scenes import kit
    from scenes.textured import unfold
    from tests.images.node_cases import material

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE)
    kit.limit_bounces(scene.cycles, BOUNCES)
    kit.world(scene)
    subject = material(name, CASES[name])
    white = kit.diffuse("White", (0.7, 0.7, 0.7))
    s = 1.2
    kit.quad(scene, "Back", [(-s, s, 0), (s, s, 0), (s, s, 2), (-s, s, 2)], white)
    kit.quad(scene, "Left", [(-s, -s, 0), (-s, s, 0), (-s, s, 2), (-s, -s, 2)], white)
    corners = [(-s, -s, 0), (s, -s, 0), (s, s, 0), (-s, s, 0)]
    others = white if name in MIRRORS else subject
    floor = kit.quad(scene, "Floor", corners, others)
    ball = kit.sphere(scene, "Ball", 0.5, others, 32)
    ball.location = (0.45, 0.2, 0.55)
    h = 0.4
    pane = kit.quad(scene, "Pane", [(-h, 0, -h), (h, 0, -h), (h, 0, h), (-h, 0, h)], subject)
    pane.location, pane.rotation_euler = (-0.5, 0.0, 0.5), (0.2, 0.1, 0.5)
    for body in (floor, ball, pane):
        unfold(body)
    kit.area_light(scene, "Lamp", (0.2, -0.4, 2.4), (0.0, 0.0, 0.0), (1.4, 1.4), 60.0)
    kit.camera(scene, (0.2, -4.5, 1.6), (0.0, 0.1, 0.7), lens=60.0)
    return scene
