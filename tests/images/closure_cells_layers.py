# SPDX-License-Identifier: GPL-3.0-or-later
"""More cells for closure_cells.py: cloth and toon, metals, facets of two widths, and what covers a
Principled surface."""

from __future__ import annotations

from .closure_cells import (
    BLUE,
    BRIGHT,
    GGX,
    GREY,
    NEGATIVE,
    RED,
    VIVID,
    WHITE,
    add,
    cell,
    each,
    grid,
    mix,
    shader,
)
from .closure_inputs import (
    bent,
    bumped,
    by_side,
    colors,
    displaced,
    facing,
    flat,
    from_above,
    painted,
    ramp,
)

NORMALS = (bumped, bent, flat)


def across(t):
    """A tangent around another axis than the one that surfaces have by themselves."""
    return t.out("Tangent", {}, axis="X")


def cloth_cells() -> None:
    kind = "BsdfSheen"
    grid("Sheen", kind, Color=(RED, WHITE), Roughness=(0.0, 0.1, 0.3, 0.6, 1.0))
    each(
        *("Sheen", kind, {"Color": WHITE, "Roughness": 0.5}),
        Roughness=(-0.5, 2.0, ramp(-0.2, 1.2), painted),
        Color=(BRIGHT, NEGATIVE, colors, facing),
        Normal=NORMALS,
    )
    velvet = {"distribution": "ASHIKHMIN"}
    grid("Velvet", kind, {**velvet, "Color": RED}, Roughness=(0.0, 0.2, 0.5, 1.0))
    each(*("Velvet", kind, {**velvet, "Roughness": 0.6}), Normal=NORMALS, Color=(colors,))


def toon_cells() -> None:
    kind = "BsdfToon"
    parts = ("DIFFUSE", "GLOSSY")
    grid("Toon", kind, {"Color": RED}, component=parts, Size=(0.15, 0.5, 1.0), Smooth=(0.0, 0.3))
    for component in parts:
        each(
            *(f"Toon {component}", kind, {"component": component, "Size": 0.4, "Smooth": 0.2}),
            Size=(0.0, 1.5, ramp(0.1, 0.9)),
            Smooth=(-0.5, 1.5, painted),
            Color=(BRIGHT, colors, facing),
            Normal=NORMALS,
        )


def metallic_cells() -> None:
    kind = "BsdfMetallic"
    gold = {"IOR": (0.2, 0.45, 1.4), "Extinction": (3.5, 2.4, 1.9)}
    rough = (0.0, 0.25, 0.7)
    physical = {"fresnel_type": "PHYSICAL_CONDUCTOR"}
    for distribution in GGX:
        base = {"distribution": distribution}
        grid(f"Conductor {distribution}", kind, {**base, **physical, **gold}, Roughness=rough)
        tinted = {**base, "Base_Color": RED}
        grid(f"Metal {distribution}", kind, tinted, Edge_Tint=(BLUE, WHITE), Roughness=rough)
        each(
            *(f"Metal {distribution}", kind, {**tinted, "Roughness": 0.4, "Edge_Tint": BLUE}),
            Base_Color=(BRIGHT, NEGATIVE, colors),
            Edge_Tint=(VIVID, BRIGHT, colors),
            Anisotropy=(0.4, 1.0, 1.5, ramp(-0.2, 1.0)),
            Normal=(*NORMALS, from_above),
        )
    each(
        *("Conductor", kind, {**physical, **gold, "Roughness": 0.3}),
        IOR=((0.0, 1.0, 8.0), (-1.0, 2.0, 1.0), colors),
        Extinction=((0.0, 0.0, 0.0), (-1.0, 9.0, 1.0), colors),
    )


def anisotropic_cells() -> None:
    brushed = {"Color": RED, "Roughness": 0.4}
    for distribution in GGX:
        fixed = {**brushed, "distribution": distribution}
        name, kind = f"Brushed {distribution}", "BsdfAnisotropic"
        grid(name, kind, fixed, Anisotropy=(-0.9, -0.3, 0.5, 0.95), Rotation=(0.0, 0.2))
        each(
            *(name, kind, {**fixed, "Anisotropy": 0.7, "Rotation": 0.1}),
            Roughness=(0.0, 0.1, 1.0, ramp(-0.2, 1.2)),
            Anisotropy=(-2.0, 2.0, ramp(-1.2, 1.2), painted),
            Rotation=(-3.3, ramp(0.0, 1.0)),
            Tangent=(across, from_above),
            Normal=NORMALS,
        )
        fixed = {"distribution": distribution, "Base_Color": BLUE, "Roughness": 0.45}
        name, kind = f"Principled brushed {distribution}", "BsdfPrincipled"
        grid(name, kind, fixed, Anisotropic=(0.3, 1.0), Metallic=(0.0, 0.6, 1.0))
        each(
            *(name, kind, {**fixed, "Anisotropic": 0.8, "Metallic": 1.0}),
            Anisotropic=(-1.0, 2.0, ramp(-0.2, 1.1)),
            Anisotropic_Rotation=(0.25, ramp(0.0, 1.0), by_side(0.1, 0.4)),
            Tangent=(across,),
            Normal=(bumped, bent),
        )


def beckmann_cells() -> None:
    fixed = {"Color": BLUE, "distribution": "BECKMANN"}
    rough = (0.1, 0.35, 0.7, 1.0)
    grid("Beckmann", "BsdfAnisotropic", fixed, Roughness=rough, Anisotropy=(0.0, 0.7))
    grid("Beckmann glass", "BsdfGlass", fixed, IOR=(1.2, 1.5, 0.75), Roughness=rough)
    grid("Beckmann refraction", "BsdfRefraction", fixed, IOR=(1.5, 0.75), Roughness=rough)
    grid("Beckmann metal", "BsdfMetallic", {"distribution": "BECKMANN"}, Roughness=rough)
    for kind in ("BsdfAnisotropic", "BsdfGlass", "BsdfRefraction"):
        each(f"Beckmann {kind}", kind, {**fixed, "Roughness": 0.4}, Normal=(bumped, bent))


def ashikhmin_shirley_cells() -> None:
    """Some of its directions Cycles mirrors about half vectors that it sees from behind, which its
    densities do not know: less than half a percent of light even where they are all alike.
    """
    name, kind = "Ashikhmin-Shirley", "BsdfAnisotropic"
    fixed = {"Color": BLUE, "distribution": "ASHIKHMIN_SHIRLEY"}
    grid(name, kind, fixed, Roughness=(0.0, 0.01, 0.1, 0.3, 0.6, 1.0), Anisotropy=(0.0, -0.3, 0.4))
    each(
        *(name, kind, {**fixed, "Roughness": 0.35, "Anisotropy": 0.4}),
        Rotation=(0.1, ramp(0.0, 1.0)),
        Roughness=(ramp(-0.2, 1.2),),
        Tangent=(across,),
        Normal=(bumped, bent, flat),
    )


def film_cells() -> None:
    thick = (0.05, 0.5, 150.0, 400.0, 1200.0)
    index = (0.8, 1.33, 2.0)
    for distribution in GGX:
        base = {"distribution": distribution, "Roughness": 0.2}
        grid(f"Bubble {distribution}", "BsdfGlass", base, Thin_Film_Thickness=thick)
        plastic = {**base, "Base_Color": RED}
        layered = f"Film {distribution}"
        grid(layered, "BsdfPrincipled", plastic, Thin_Film_Thickness=thick, Metallic=(0.0, 1.0))
        gold = {**base, "IOR": (0.2, 0.45, 1.4), "Extinction": (3.5, 2.4, 1.9)}
        gold["fresnel_type"] = "PHYSICAL_CONDUCTOR"
        grid(f"Film gold {distribution}", "BsdfMetallic", gold, Thin_Film_Thickness=(150.0, 500.0))
        each(
            *(f"Film metal {distribution}", "BsdfMetallic", {**base, "Thin_Film_Thickness": 350.0}),
            Edge_Tint=(VIVID, BLUE),
            Base_Color=(WHITE, RED),
            Thin_Film_IOR=index,
        )
        filmed = {**base, "Thin_Film_Thickness": 380.0}
        grid(f"Bubble {distribution}", "BsdfGlass", filmed, Thin_Film_IOR=index, IOR=(1.4, 0.8))
        clear = {**filmed, "Transmission_Weight": 1.0}
        grid(f"Film clear {distribution}", "BsdfPrincipled", clear, Specular_Tint=(WHITE, BLUE))
        each(
            *(layered, "BsdfPrincipled", filmed),
            Thin_Film_Thickness=(-10.0, ramp(-50.0, 900.0)),
            IOR=(1.0, 2.2, 0.7),
            Specular_IOR_Level=(0.0, 1.5),
            Specular_Tint=(RED, BRIGHT),
            Coat_Weight=(0.7,),
            Roughness=(0.0, 0.6),
        )


def tint_cells() -> None:
    kind = "BsdfPrincipled"
    for distribution in GGX:
        fixed = {"Base_Color": GREY, "distribution": distribution, "Roughness": 0.3}
        name = f"Tint {distribution}"
        metallic, clear = (0.0, 0.5, 1.0), {**fixed, "Transmission_Weight": 1.0}
        grid(name, kind, fixed, Specular_Tint=(RED, VIVID, BRIGHT), Metallic=metallic)
        grid(f"Clear {name}", kind, clear, Specular_Tint=(RED, BRIGHT), Roughness=(0.0, 0.4))
        levels = {"Specular_IOR_Level": (0.2, 2.0, 30.0), "IOR": (1.5, 0.7)}
        grid(name, kind, {**fixed, "Specular_Tint": BLUE}, **levels)
        each(name, kind, fixed, Specular_Tint=(NEGATIVE, colors, facing))


def cover_cells() -> None:
    kind = "BsdfPrincipled"
    red = {"Base_Color": RED}
    coated = {**red, "Coat_Weight": 1.0}
    grid("Coat", kind, red, Coat_Weight=(0.3, 1.0), Coat_Roughness=(0.0, 0.1, 0.6))
    grid("Coat", kind, coated, Coat_IOR=(0.5, 1.0, 1.2, 3.0), Coat_Tint=(WHITE, BLUE))
    each(
        *("Coat", kind, {**coated, "Coat_Tint": BLUE, "Coat_Roughness": 0.2}),
        Coat_Weight=(-0.5, 1.5, ramp(-0.2, 1.2), painted, facing),
        Coat_Roughness=(-1.0, 2.0, ramp(-0.2, 1.2)),
        Coat_IOR=(ramp(0.8, 2.5),),
        Coat_Tint=(VIVID, BRIGHT, NEGATIVE, colors),
        Coat_Normal=(bumped, bent, flat),
        Normal=(bumped, bent, flat),
        Metallic=(0.5, 1.0),
        Transmission_Weight=(0.5, 1.0),
        Alpha=(0.4,),
        Emission_Strength=(0.6, facing),
    )
    sheen = {**red, "Sheen_Weight": 1.0}
    grid("Dust", kind, red, Sheen_Weight=(0.3, 1.0), Sheen_Roughness=(0.1, 0.5, 1.0))
    each(
        *("Dust", kind, {**sheen, "Sheen_Tint": BLUE}),
        Sheen_Weight=(-0.5, 1.5, ramp(-0.2, 1.2), painted),
        Sheen_Roughness=(-1.0, 2.0, ramp(-0.2, 1.2)),
        Sheen_Tint=(WHITE, VIVID, NEGATIVE, colors),
        Normal=(bumped, bent),
        Metallic=(1.0,),
        Transmission_Weight=(0.7,),
        Emission_Strength=(0.6,),
    )
    both = {**coated, "Sheen_Weight": 0.7, "Coat_Roughness": 0.3, "Coat_Tint": GREY}
    each(
        *("Dust on a coat", kind, both),
        Coat_Normal=(bumped, bent),
        Coat_Weight=(0.4, 1.0),
        Emission_Strength=(0.5,),
        Roughness=(0.0, 0.8),
        Metallic=(0.4,),
    )
    whole = shader(kind, **both, Metallic=0.3, Transmission_Weight=0.4, Anisotropic=0.5)
    glow = shader(kind, **coated, Emission_Strength=0.5, Alpha=0.7)
    cell("Mix: covered, sheen", mix(facing, whole, shader("BsdfSheen", Color=WHITE)))
    cell("Mix: covered, glow", mix(0.4, whole, glow))
    cell("Mix: two covered", mix(painted, whole, shader(kind, **sheen, Metallic=0.5)))
    cell("Add: dust, toon", add(shader("BsdfSheen"), shader("BsdfToon", Size=0.3)))


def displaced_cells() -> None:
    """Of closures with the surface's normal, and with others, which Cycles softens then."""

    def on(name, kind, **inputs):
        cell(f"Displaced {name}", displaced(shader(kind, **inputs)))

    for normal in ({}, {"Normal": bumped}, {"Normal": bent}, {"Normal": flat}):
        said = " ".join(n.__name__ for n in normal.values())
        on(f"Lambert {said}", "BsdfDiffuse", Color=WHITE, **normal)
        on(f"Diffuse {said}", "BsdfDiffuse", Color=RED, Roughness=0.7, **normal)
        on(f"Glossy {said}", "BsdfAnisotropic", Color=GREY, Roughness=0.4, **normal)
    on("Translucent", "BsdfTranslucent", Color=BLUE)
    on("Glass", "BsdfGlass", Color=WHITE, Roughness=0.4)
    on("Sheen", "BsdfSheen", Color=WHITE)
    on("Toon", "BsdfToon", Color=WHITE, Size=0.6)
    on("Principled", "BsdfPrincipled", Base_Color=RED, Coat_Weight=0.5, Coat_Normal=flat)
    on("Metal", "BsdfPrincipled", Base_Color=RED, Metallic=0.7, Sheen_Weight=0.5)
    red = shader("BsdfDiffuse", Color=RED)
    cell("Displaced mix", displaced(mix(facing, red, shader("BsdfAnisotropic", Roughness=0.3))))


def add_layers() -> None:
    cloth_cells()
    toon_cells()
    metallic_cells()
    anisotropic_cells()
    beckmann_cells()
    ashikhmin_shirley_cells()
    film_cells()
    tint_cells()
    cover_cells()
    displaced_cells()
