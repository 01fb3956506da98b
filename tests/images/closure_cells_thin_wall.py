# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells for closure_cells.py: Principled's thin walls, which are there from Blender 5.2 on. Their
balls are bubbles: light goes through two walls."""

from __future__ import annotations

from .closure_cells import BLUE, RED, WHITE, each, grid, mix, shader
from .closure_inputs import bent, bumped, painted, ramp

NAME = "Thin wall"
KIND = "BsdfPrincipled"
GLASS = {"Thin_Wall": True, "Transmission_Weight": 1.0, "Base_Color": (0.9, 0.7, 0.4)}
LEAF = {"Thin_Wall": True, "Subsurface_Weight": 1.0, "Base_Color": RED}


def add_thin_walls() -> None:
    from .closure_cells import cell

    grid(NAME, KIND, GLASS, IOR=(1.1, 1.5, 2.5), Roughness=(0.0, 0.2, 0.5, 1.0))
    rough = {**GLASS, "Roughness": 0.4}
    each(
        *(NAME, KIND, rough),
        Specular_Tint=(BLUE,),
        Base_Color=(WHITE, (0.0, 0.5, 1.0)),
        IOR=(0.8, 1.0),
        Alpha=(0.6,),
        Anisotropic=(0.8,),
        Coat_Weight=(0.8,),
        Sheen_Weight=(0.8,),
        Normal=(bumped, bent),
        Thin_Wall=(painted, ramp(-0.5, 2.0)),
        Transmission_Weight=(0.5, painted),
        distribution=("GGX",),
    )
    smooth = {**GLASS, "Roughness": 0.0}
    each(
        *(f"{NAME}, smooth", KIND, smooth),
        Alpha=(0.6,),
        Coat_Weight=(0.8,),
        Normal=(bent,),
        IOR=(0.8,),
        Metallic=(0.4,),
    )
    film = {"Thin_Film_Thickness": 350.0, "Thin_Film_IOR": 1.8}
    grid(f"{NAME}, film", KIND, {**GLASS, **film}, Roughness=(0.0, 0.4), Specular_Tint=(WHITE, RED))
    for rough in (0.0, 0.8):
        fixed = {**LEAF, "Diffuse_Roughness": rough}
        grid(f"{NAME}, leaf {rough}", KIND, fixed, Subsurface_Anisotropy=(-0.7, 0.0, 0.6, 1.0))
        each(
            *(f"{NAME}, leaf {rough}", KIND, fixed),
            Normal=(bumped, bent),
            Subsurface_Weight=(0.5, painted),
            Coat_Weight=(1.0,),
        )
    both = {**LEAF, "Transmission_Weight": 0.5, "Metallic": 0.2}
    grid(f"{NAME}, both", KIND, both, Roughness=(0.0, 0.5))
    cell(f"{NAME}, mixed", mix(0.5, shader(KIND, **GLASS), shader(KIND, **LEAF)))
