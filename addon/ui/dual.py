# SPDX-License-Identifier: GPL-3.0-or-later
"""Dual photography, among the properties of a light."""

import bpy

from ..sync.slide import unfit
from .data import LightPanel


class JANUS_LIGHT_PT_dual(LightPanel, bpy.types.Panel):
    bl_label = "Dual Photography"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.light.type in ("SPOT", "AREA")

    def draw(self, context):
        light, settings = context.light, context.light.janus
        column = self.column()
        setting, reason = unfit(light)
        if reason:  # here, too, so that it can be put right at once
            row = column.row()
            row.alert = True
            row.prop(light, setting)
            column.label(text=reason, icon="ERROR")
        part = column.column(align=True)
        part.prop(settings, "projector_width")
        part.prop(settings, "projector_height", text="Y")
        column.prop(settings, "camera_size")
        column.prop(settings, "samples")
        column.prop(settings, "memory")
        column.prop(settings, "matrix_path")
        row = column.row()
        row.enabled = not reason
        row.operator("janus.capture_transport", icon="RENDER_STILL")
        column.separator()
        column.prop(settings, "slide")
        row = column.row(align=True)
        row.operator("janus.relight")
        row.operator("janus.show_dual")


CLASSES = (JANUS_LIGHT_PT_dual,)
