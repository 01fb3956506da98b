# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: the scene of panes, before the world and on a transparent film."""

from __future__ import annotations

CASES = {"world": False, "film_transparent": True}
SEEDS, SAMPLES, BOUNCES = 6, 256, 4


def build(name: str):
    import bpy

    from scenes import kit, panes

    scene = bpy.context.scene
    panes.build(scene)
    scene.render.film_transparent = CASES[name]
    scene.cycles.samples = SAMPLES
    kit.limit_bounces(scene.cycles, BOUNCES)
    return scene
