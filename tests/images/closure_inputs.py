# SPDX-License-Identifier: GPL-3.0-or-later
"""What drives the inputs of the closures in closure_cells.py: functions of a Tree that give a
socket. They vary with the place on a ball, with its side, or with the view."""

from __future__ import annotations


def _named(name: str, make):
    make.__name__ = name
    return make


def _height(t):
    return t.node("SeparateXYZ", {0: t.coordinate("Object")}).outputs["Z"]


def ramp(low: float, high: float):
    """From `low` at the bottom of a ball to `high` at its top."""

    def make(t):
        inputs = {"Value": _height(t), "From Min": -0.49, "From Max": 0.49}
        return t.out("MapRange", {**inputs, "To Min": low, "To Max": high}, clamp=False)

    return _named(f"ramp {low:g} to {high:g}", make)


def ramped_color(t):
    """Beyond 0 and 1 in each channel."""
    return t.out("CombineXYZ", {0: ramp(-0.3, 1.4)(t), 1: ramp(1.2, -0.2)(t), 2: ramp(0.2, 0.9)(t)})


def colors(t):
    """A picture of 16 x 8 pixels around the ball."""
    from .world_scenes import picture

    scaled = t.out(
        "VectorMath", {0: t.coordinate("Object"), 1: (1.5, 2.5, 0.0)}, operation="MULTIPLY"
    )
    return t.out("TexImage", {0: scaled}, image=picture("Paint", 5))


def painted(t):
    """The same as a number."""
    return t.out("RGBToBW", {0: colors(t)})


def facing(t):
    return t.out("LayerWeight", {"Blend": 0.4}, "Facing")


def fresnel(t):
    return t.out("Fresnel", {"IOR": 1.7})


def by_side(front: float, back: float):
    def make(t):
        inputs = {"Value": t.out("NewGeometry", {}, "Backfacing"), "To Min": front, "To Max": back}
        return t.out("MapRange", inputs, clamp=False)

    return _named(f"{front:g} or {back:g} behind", make)


# --- Normals -------------------------------------------------------------------------------------


def _wave(t):
    return t.out(
        "Math",
        {0: t.out("Math", {0: _height(t), 1: 30.0}, operation="MULTIPLY")},
        operation="SINE",
    )


def bumped(t):
    return t.out("Bump", {"Height": _wave(t), "Strength": 0.6, "Distance": 0.02})


def displaced(make):
    """The shader, of a material that is displaced as well."""

    def build(t):
        inputs = {"Height": _wave(t), "Midlevel": 0.0, "Scale": 0.012}
        t.displace(t.out("Displacement", inputs))
        return make(t)

    return build


def bent(t):
    """A normal map of one colour, in object space."""
    inputs = {"Color": (0.75, 0.4, 0.65, 1.0), "Strength": 0.4}
    return t.out("NormalMap", inputs, space="OBJECT")


def flat(t):
    """The facets of the mesh."""
    return t.out("NewGeometry", {}, "True Normal")


def from_above(t):
    """A plain direction: on half of the ball it looks into the surface."""
    return t.out("CombineXYZ", {0: 0.3, 1: -0.8, 2: 0.5})


def unlit_normal(t):
    """No direction at all: the surface's own is used."""
    return t.out("CombineXYZ", {0: 0.0, 1: 0.0, 2: 0.0})
