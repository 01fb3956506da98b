# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels. Small ones of our own, and Blender's own opened to this engine."""

import bpy

from . import (
    camera,
    data,
    diagnostics,
    dual,
    engine_panels,
    film,
    material,
    motion,
    passes,
    presets,
    scene,
)

CLASSES = (  # in the order of Cycles' panels
    *presets.CLASSES,
    *diagnostics.CLASSES,
    *scene.CLASSES,
    *film.SIMPLIFY,
    *motion.CLASSES,
    *film.CLASSES,
    *passes.CLASSES,
    *material.CLASSES,
    *data.CLASSES,
    *dual.CLASSES,
    *camera.CLASSES,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    engine_panels.register()
    data.register()
    presets.register()
    diagnostics.register()


def unregister():
    diagnostics.unregister()
    presets.unregister()
    data.unregister()
    engine_panels.unregister()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
