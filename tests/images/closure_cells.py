# SPDX-License-Identifier: GPL-3.0-or-later
"""A grid of settings for every closure. `CELLS` maps names to functions of a Tree that give the
shader, in the order in which closure_grid.py deals them out to its pages.

An input is a number, a colour, or a function of the Tree that gives a socket: what varies over the
surface. Numbers that Blender's sliders do not reach come by way of a node, as an artist's would.
"""

from __future__ import annotations

import itertools

from .closure_inputs import (
    bent,
    bumped,
    by_side,
    colors,
    facing,
    flat,
    fresnel,
    from_above,
    painted,
    ramp,
    ramped_color,
    unlit_normal,
)

RED, BLUE, GREY, WHITE = (0.9, 0.35, 0.2), (0.25, 0.45, 0.9), (0.6, 0.6, 0.6), (1.0, 1.0, 1.0)
VIVID, BRIGHT, NEGATIVE = (1.0, 0.0, 0.02), (1.6, 1.2, 0.7), (0.7, -0.5, 0.3)
CELLS = {}
GGX = ("GGX", "MULTI_GGX")
SETTINGS = ("distribution", "component", "fresnel_type", "falloff", "subsurface_method")


def shader(kind: str, **inputs):
    """One closure node. Names of inputs with _ for blanks; those of SETTINGS are none."""
    settings = {key: inputs.pop(key) for key in SETTINGS if key in inputs}

    def make(t):
        node = t.node(kind, **settings)
        for key, value in inputs.items():
            socket = node.inputs[key.replace("_", " ")]
            if callable(value):
                t.tree.links.new(value(t), socket)
            else:
                _set(t, socket, value)
        return node.outputs[0]

    return make


def _set(t, socket, value) -> None:
    color = isinstance(value, tuple)
    given = (*value, 1.0)[: len(socket.default_value)] if color else value
    socket.default_value = given
    kept = tuple(socket.default_value) if color else (socket.default_value,)
    if any(abs(a - b) > 1e-6 for a, b in zip(kept, given if color else (given,), strict=True)):
        made = t.out("CombineXYZ", dict(enumerate(value))) if color else t.value(value)
        t.tree.links.new(made, socket)


def mix(factor, first, second):
    def make(t):
        node = t.node("MixShader", {1: first(t), 2: second(t)})
        if callable(factor):
            t.tree.links.new(factor(t), node.inputs[0])
        else:
            _set(t, node.inputs[0], factor)
        return node.outputs[0]

    return make


def add(first, second):
    return lambda t: t.out("AddShader", {0: first(t), 1: second(t)})


def cell(name: str, make) -> None:
    assert name not in CELLS
    CELLS[name] = make


def grid(name: str, kind: str, fixed: dict | None = None, **axes) -> None:
    """All combinations of the values of the axes."""
    for values in itertools.product(*axes.values()):
        inputs = dict(zip(axes, values, strict=True))
        said = ", ".join(f"{key} {_said(value)}" for key, value in inputs.items())
        cell(f"{name}: {said}", shader(kind, **{**(fixed or {}), **inputs}))


def each(name: str, kind: str, fixed: dict | None = None, **lists) -> None:
    """One input at a time."""
    for key, values in lists.items():
        grid(name, kind, fixed, **{key: values})


def _said(value) -> str:
    if isinstance(value, tuple):
        return "/".join(f"{x:g}" for x in value)
    return getattr(value, "__name__", str(value))


def diffuse_cells() -> None:
    grid("Diffuse", "BsdfDiffuse", Color=(RED, WHITE, VIVID), Roughness=(0.0, 0.25, 0.5, 0.75, 1.0))
    each("Diffuse", "BsdfDiffuse", {"Color": RED, "Roughness": 0.6}, Roughness=(-0.5, 2.0))
    grid("Diffuse", "BsdfDiffuse", Color=(BRIGHT, NEGATIVE), Roughness=(0.0, 0.7))
    each(
        *("Diffuse", "BsdfDiffuse", {"Color": WHITE, "Roughness": 0.5}),
        Roughness=(ramp(-0.5, 1.5), painted),
        Color=(colors, ramped_color, facing),
        Normal=(bumped, bent, flat, unlit_normal),
    )
    each("Lambert", "BsdfDiffuse", {"Color": WHITE, "Roughness": 0.0}, Normal=(bumped, bent, flat))
    each("Translucent", "BsdfTranslucent", Color=(RED, WHITE, BRIGHT, NEGATIVE, colors, facing))
    each("Translucent", "BsdfTranslucent", {"Color": BLUE}, Normal=(bumped, bent, flat))


def glossy_cells() -> None:
    kind = "BsdfAnisotropic"
    grid("Glossy", kind, {"Color": RED}, distribution=GGX, Roughness=(0.0, 0.1, 0.25, 0.5, 0.8, 1))
    grid("Glossy", kind, {"Color": WHITE}, distribution=GGX, Roughness=(0.01, 0.4, 0.9))
    grid("Glossy", kind, distribution=("BECKMANN", "ASHIKHMIN_SHIRLEY"), Roughness=(0.0,))
    fixed = {"Color": BLUE, "Roughness": 0.5}
    for distribution in GGX:
        each(
            *(f"Glossy {distribution}", kind, {**fixed, "distribution": distribution}),
            Roughness=(-0.5, 2.0, ramp(-0.2, 1.2), painted, facing),
            Color=(BRIGHT, NEGATIVE, VIVID, colors, ramped_color),
            Normal=(bumped, bent, flat, from_above),
        )


def glass_cells() -> None:
    kind = "BsdfGlass"
    rough = (0.0, 0.1, 0.35, 0.7, 1.0)
    grid("Glass", kind, {"Color": BLUE}, distribution=GGX, IOR=(1.2, 1.5, 0.75), Roughness=rough)
    grid("Glass", kind, distribution=GGX, IOR=(1.0, 1.001, 2.4, 0.5), Roughness=(0, 0.5))
    grid("Glass", kind, distribution=("BECKMANN",), Roughness=(0.0,))
    for distribution in GGX:
        each(
            *(f"Glass {distribution}", kind, {"IOR": 1.45, "distribution": distribution}),
            Roughness=(-0.5, 2.0, ramp(-0.2, 1.2), painted),
            IOR=(ramp(0.6, 1.8), by_side(1.5, 1.2)),
        )
        each(
            *(f"Glass {distribution}", kind, {"Roughness": 0.4, "distribution": distribution}),
            IOR=(0.0, -2.0, 8.0, ramp(1.0, 2.0)),
            Color=(BRIGHT, NEGATIVE, VIVID, colors, facing),
            Normal=(bumped, bent, flat),
        )


def refraction_cells() -> None:
    kind = "BsdfRefraction"
    fixed = {"Color": BLUE, "distribution": "GGX"}
    rough = (0.0, 0.1, 0.35, 0.7, 1.0)
    grid("Refraction", kind, fixed, IOR=(1.2, 1.5, 0.75), Roughness=rough)
    grid("Refraction", kind, fixed, IOR=(1.0, 1.00005, 2.4), Roughness=(0.0, 0.5))
    grid("Refraction", kind, distribution=("BECKMANN",), Roughness=(0.0,))
    each(
        *("Refraction", kind, {**fixed, "Roughness": 0.3, "IOR": 1.3}),
        Roughness=(-0.6, 2.0, ramp(-0.4, 1.2), painted),
        IOR=(0.0, ramp(0.7, 1.5)),
        Color=(BRIGHT, NEGATIVE, colors, facing),
        Normal=(bumped, bent, flat),
    )


def plain_cells() -> None:
    colored = (WHITE, RED, VIVID, (0.0, 0.0, 0.0), BRIGHT, colors, facing, ramp(0.0, 1.5))
    each("Transparent", "BsdfTransparent", Color=colored)
    grid("Emission", "Emission", Color=(RED, WHITE, BRIGHT), Strength=(0.0, 0.4, 2.0))
    each(
        *("Emission", "Emission", {"Color": BLUE, "Strength": 0.8}),
        Strength=(ramp(0.0, 1.5), painted, facing, by_side(0.5, 1.0)),
        Color=(colors, facing),
    )
    # Both below zero: the product is light.
    cell("Emission: twice negative", shader("Emission", Color=(-0.5, -0.2, -0.7), Strength=-1.0))
    cell("Emission: above and below", add(shader("Emission", Strength=1.0), _dark(-0.4)))


def _dark(strength: float):
    return shader("Emission", Color=(1.0, 0.5, 0.2), Strength=strength)


def principled_cells() -> None:
    kind = "BsdfPrincipled"
    red, white = {"Base_Color": RED}, {"Base_Color": WHITE}
    rough = (0.0, 0.2, 0.5, 1.0)
    grid("Principled", kind, red, distribution=GGX, Metallic=(0.0, 0.5, 1.0), Roughness=rough)
    levels, indices = (0.0, 0.25, 1.0, 3.0), (1.0, 1.33, 2.5, 0.8)
    grid("Principled", kind, red, Specular_IOR_Level=levels, IOR=indices)
    grid("Principled", kind, {"Roughness": 0.2}, Specular_IOR_Level=(10.0, 40.0), IOR=(1.5, 0.6))
    grid("Principled", kind, white, Diffuse_Roughness=(0.4, 1.0), Roughness=(0.1, 0.7))
    grid("Principled", kind, white, IOR=(4.0, 8.0), Roughness=(0.05, 0.4))
    alpha = (-0.5, 0.0, 0.3, 0.8, 1.5)
    grid("Principled", kind, red, Alpha=alpha)
    grid("Principled", kind, {"Emission_Color": BLUE}, Emission_Strength=(0.4, 2.0))
    for distribution in GGX:
        clear = {"Base_Color": BLUE, "distribution": distribution}
        whole = {**clear, "Transmission_Weight": 1.0}
        grid(f"Clear {distribution}", kind, whole, IOR=(1.33, 2.0, 0.8), Roughness=(0.0, 0.3, 0.8))
        half = {**clear, "Transmission_Weight": 0.5}
        grid(f"Half clear {distribution}", kind, half, Metallic=(0.0, 0.4))
        grid(f"Clear {distribution}", kind, whole, Specular_IOR_Level=(0.0, 1.0))
        grid(f"Clear {distribution}", kind, whole, IOR=(1.0, 5.0), Roughness=(0.2,))
        normals = (bumped, bent, flat)
        each(f"Clear {distribution}", kind, {**whole, "Roughness": 0.4}, Normal=normals)
        most = {**clear, "Roughness": 0.4, "Metallic": 0.3, "IOR": 1.6}
        each(
            *(f"Principled {distribution}", kind, most),
            Metallic=(-0.5, 1.5, ramp(-0.3, 1.3), facing),
            Base_Color=(BRIGHT, NEGATIVE, colors, ramped_color),
            Roughness=(-0.5, 1.5, ramp(-0.3, 1.3), painted),
            Diffuse_Roughness=(-0.5, 2.0, ramp(-0.3, 1.3)),
            IOR=(0.0, -1.0, ramp(0.6, 2.2)),
            Specular_IOR_Level=(-1.0, ramp(-0.5, 2.0), painted),
            Transmission_Weight=(-0.5, 1.5, ramp(-0.3, 1.3)),
            Alpha=(ramp(-0.3, 1.3), painted, facing),
            Emission_Strength=(ramp(0.0, 1.0), facing),
            Normal=(bumped, bent, flat, from_above),
        )


def mixed_cells() -> None:
    red, white = shader("BsdfDiffuse", Color=RED), shader("BsdfDiffuse", Color=WHITE, Roughness=0.5)
    metal = shader("BsdfAnisotropic", Roughness=0.3, Color=GREY, distribution="GGX")
    mirror = shader("BsdfAnisotropic", Roughness=0.0, Color=WHITE)
    glass = shader("BsdfGlass", Color=BLUE, Roughness=0.3, distribution="GGX")
    clear = shader("BsdfGlass", Color=WHITE, Roughness=0.0)
    bent_glass = shader("BsdfRefraction", Roughness=0.2, IOR=1.3, distribution="GGX")
    hole, glow = shader("BsdfTransparent", Color=GREY), shader("Emission", Color=BLUE, Strength=0.7)
    leaf, plastic = shader("BsdfTranslucent", Color=BLUE), shader("BsdfPrincipled", Base_Color=RED)
    sheer = shader("BsdfPrincipled", Alpha=0.5, Transmission_Weight=0.5, Metallic=0.5)
    for factor in (-0.5, 0.0, 0.3, 1.0, 1.7, ramp(-0.5, 1.5), painted, facing, fresnel):
        cell(f"Mix {_said(factor)}: red, mirror", mix(factor, red, mirror))
        cell(f"Mix {_said(factor)}: white, glass", mix(factor, white, glass))
    for name, factor in (("half", 0.5), ("fresnel", fresnel), ("by side", by_side(0.2, 0.9))):
        cell(f"Mix {name}: hole, metal", mix(factor, hole, metal))
        cell(f"Mix {name}: clear, glow", mix(factor, clear, glow))
        cell(f"Mix {name}: leaf, plastic", mix(factor, leaf, plastic))
        cell(f"Mix {name}: sheer, refraction", mix(factor, sheer, bent_glass))
        cell(f"Mix {name}: plastic, hole", mix(factor, plastic, hole))
        cell(f"Mix {name}: of a mix", mix(factor, mix(0.3, red, metal), mix(facing, glow, leaf)))
        cell(f"Add of Mix {name}", add(mix(factor, red, metal), mix(0.8, glow, hole)))
    cell("Add: red, metal", add(shader("BsdfDiffuse", Color=(0.4, 0.3, 0.2)), metal))
    cell("Add: glow, mirror", add(glow, mirror))
    dim = shader("BsdfTranslucent", Color=(0.2, 0.3, 0.3))
    cell("Add: hole, leaf", add(hole, dim))
    cell("Add: three", add(dim, add(shader("BsdfDiffuse", Color=(0.3, 0.1, 0.2)), metal)))
    cell("Mix: six closures", mix(0.4, mix(0.5, sheer, plastic), mix(0.5, glass, white)))


def add_cells() -> None:
    from .closure_cells_layers import add_layers
    from .closure_cells_subsurface import add_subsurface
    from .closure_cells_thin_wall import add_thin_walls

    if not CELLS:
        for part in (diffuse_cells, glossy_cells, glass_cells, refraction_cells, plain_cells):
            part()
        principled_cells()
        mixed_cells()
        add_layers()
        add_subsurface()
        add_thin_walls()
