# SPDX-License-Identifier: GPL-3.0-or-later
"""Janus: bidirectional path tracing for Blender."""

import bpy

from . import operators, properties, report, ui
from .engine import JanusRenderEngine


def register():
    properties.register()
    bpy.utils.register_class(JanusRenderEngine)
    operators.register()
    ui.register()


def unregister():
    ui.unregister()
    operators.unregister()
    bpy.utils.unregister_class(JanusRenderEngine)
    properties.unregister()
    report.forget()
