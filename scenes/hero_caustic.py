# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of the hero where the goblet's caustic falls, without the goblet in view.

What the camera sees of a small lamp in glass, path by path of specular events, is found by chance
in every renderer here, and a single such path can be all the error of a picture. This view has the
caustic without them: errors can be measured.
"""

from __future__ import annotations

import bpy

from scenes import hero, kit

WIDTH, HEIGHT, SAMPLES = hero.WIDTH, hero.HEIGHT, hero.SAMPLES


def build(scene: bpy.types.Scene) -> None:
    hero.build(scene)
    bpy.data.objects.remove(scene.camera)
    kit.camera(scene, (0.0, -0.72, 0.38), (-0.115, -0.055, 0.0), lens=150.0)
