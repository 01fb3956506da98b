# SPDX-License-Identifier: GPL-3.0-or-later
"""Janus: bidirectional path tracing for Blender."""

import bpy

from . import properties, report, ui
from .engine import JanusRenderEngine


def register():
    properties.register()
    bpy.utils.register_class(JanusRenderEngine)
    ui.register()


def unregister():
    ui.unregister()
    bpy.utils.unregister_class(JanusRenderEngine)
    properties.unregister()
    report.forget()
