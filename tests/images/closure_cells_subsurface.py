# SPDX-License-Identifier: GPL-3.0-or-later
"""More cells for closure_cells.py: light that goes below the surface."""

from __future__ import annotations

from .closure_cells import GREY, RED, VIVID, WHITE, add, cell, each, grid, mix, shader
from .closure_inputs import bent, bumped, colors, displaced, facing, painted, ramp

NORMALS = (bumped, bent)
SKIN = "RANDOM_WALK_SKIN"  # whose roughness is its own
WALKS = ("RANDOM_WALK", SKIN)
NEARLY_WHITE, DARK = (0.97, 0.95, 0.9), (0.05, 0.02, 0.0)


def node_cells() -> None:
    kind = "SubsurfaceScattering"
    for walk in WALKS:
        fixed = {"falloff": walk, "Color": RED, "Scale": 0.3}
        name = f"Subsurface {walk}"
        grid(name, kind, fixed, Color=(RED, NEARLY_WHITE, DARK, GREY), Scale=(0.02, 1.0, 5.0))
        if walk != SKIN:
            each(name, kind, fixed, Roughness=(0.0, 0.2, 0.6, 2.0))
        each(
            *(name, kind, fixed),
            IOR=(0.5, 1.01, 1.2, 2.5, 9.0),
            Anisotropy=(-0.5, 0.3, 0.8, 1.5),
            Radius=((0.0, 1.0, 0.3), (1.0, 1.0, 1.0), (-1.0, 0.5, 2.0)),
            Color=(WHITE, VIVID, (1.3, 0.7, 0.4), colors),
            Scale=(0.0, ramp(-0.2, 1.0)),
            Normal=NORMALS,
        )


def principled_cells() -> None:
    kind = "BsdfPrincipled"
    fixed = {"Base_Color": RED, "Subsurface_Weight": 0.8, "Subsurface_Scale": 0.4}
    grid(
        *("Skin", kind, fixed),
        subsurface_method=WALKS,
        Roughness=(0.05, 0.4, 1.0),
        Subsurface_Weight=(0.3, 1.0),
    )
    each("Skin", kind, {**fixed, "subsurface_method": SKIN}, Subsurface_IOR=(1.1, 2.0))
    each("Skin", kind, fixed, Transmission_Weight=(0.3,))
    for walk in WALKS:
        each(
            *(f"Skin {walk}", kind, {**fixed, "subsurface_method": walk}),
            IOR=(1.0, 1.2, 2.0),
            Specular_IOR_Level=(0.0, 1.0),
            Subsurface_Anisotropy=(0.7,),
            Subsurface_Weight=(-0.5, 2.0, painted, facing),
            Base_Color=(colors, (1.3, 0.7, 0.4)),
            Coat_Weight=(1.0,),
            Sheen_Weight=(1.0,),
            Metallic=(0.5,),
            Alpha=(0.6,),
            Normal=NORMALS,
        )


def add_subsurface() -> None:
    node_cells()
    principled_cells()
    wax = shader("SubsurfaceScattering", Color=RED, Scale=0.4)
    jade = shader("SubsurfaceScattering", Color=(0.3, 0.8, 0.5), Scale=0.1, Roughness=0.4)
    cell("Mix: wax, jade", mix(0.4, wax, jade))
    cell("Mix: wax, diffuse", mix(painted, wax, shader("BsdfDiffuse", Color=WHITE)))
    cell("Mix: wax, glass", mix(facing, wax, shader("BsdfGlass", Roughness=0.3)))
    cell("Displaced wax", displaced(wax))
    cell("Add: wax, glossy", add(wax, shader("BsdfAnisotropic", Color=GREY, Roughness=0.3)))
