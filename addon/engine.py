# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's callbacks and the one place where errors end."""

import traceback

import bpy

from . import bridge, report
from .render import final, passes


class JanusRenderEngine(bpy.types.RenderEngine):
    """Bidirectional path tracing"""

    bl_idname = "JANUS"
    bl_label = "Janus"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False  # True, the default, hides Cycles' nodes in the editor
    bl_use_spherical_stereo = False

    # Blender versions differ in what they pass; a TypeError here renders black without an error.
    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)

    def update_render_passes(self, scene=None, renderlayer=None):
        passes.register_passes(self, scene, renderlayer)

    def render(self, depsgraph):
        log = report.DiagnosticsLog()
        try:
            final.render_layer(self, depsgraph, log)
        except (report.RenderRefused, bridge.CoreUnavailable) as error:
            log.error(str(error))
        except Exception as error:  # everything else is ours to fix: show where it happened
            traceback.print_exc()
            log.error(f"{type(error).__name__}: {error}")
        scene = depsgraph.scene
        layers = [layer.name for layer in scene.view_layers]
        report.keep(scene.name_full, depsgraph.view_layer.name, layers, log)
        log.flush(self)
