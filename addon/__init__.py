# SPDX-License-Identifier: GPL-3.0-or-later
"""Janus: bidirectional path tracing for Blender."""

from . import engine, operators, properties, report, ui


def register():
    properties.register()
    engine.register()
    operators.register()
    ui.register()


def unregister():
    ui.unregister()
    operators.unregister()
    engine.unregister()
    properties.unregister()
    report.forget()
