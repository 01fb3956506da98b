# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion blur: of the render, and of an object."""

import bpy

from ..sync.visibility import SHAPE_TYPES
from .engine_panels import JanusPanel

CURVE_SHAPES = (
    ("SMOOTH", "SMOOTHCURVE"),
    ("ROUND", "SPHERECURVE"),
    ("ROOT", "ROOTCURVE"),
    ("SHARP", "SHARPCURVE"),
    ("LINE", "LINCURVE"),
    ("MAX", "NOCURVE"),
)


class JANUS_RENDER_PT_motion_blur(JanusPanel, bpy.types.Panel):
    bl_label = "Motion Blur"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        render = context.scene.render
        column = self.column()
        column.active = render.use_motion_blur
        column.prop(render, "motion_blur_position", text="Position")
        column.prop(render, "motion_blur_shutter")


class JANUS_RENDER_PT_motion_blur_curve(JanusPanel, bpy.types.Panel):
    bl_label = "Shutter Curve"
    bl_parent_id = "JANUS_RENDER_PT_motion_blur"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        render = context.scene.render
        column = self.column()
        column.active = render.use_motion_blur
        column.template_curve_mapping(render, "motion_blur_shutter_curve")
        row = column.row(align=True)
        for shape, icon in CURVE_SHAPES:
            row.operator("render.shutter_curve_preset", icon=icon, text="").shape = shape


class JANUS_OBJECT_PT_motion_blur(JanusPanel, bpy.types.Panel):
    """The settings are Cycles' own: a file has them once."""

    bl_label = "Motion Blur"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        obj = context.object
        kinds = SHAPE_TYPES | {"CAMERA", "EMPTY"}
        return super().poll(context) and obj and obj.type in kinds and hasattr(obj, "cycles")

    def draw_header(self, context):
        self.layout.prop(context.object.cycles, "use_motion_blur", text="")

    def draw(self, context):
        settings = context.object.cycles
        column = self.column()
        column.active = context.scene.render.use_motion_blur and settings.use_motion_blur
        column.prop(settings, "motion_steps", text="Steps")
        if context.object.type != "CAMERA":
            column.prop(settings, "use_deform_motion", text="Deformation")


CLASSES = (
    JANUS_RENDER_PT_motion_blur,
    JANUS_RENDER_PT_motion_blur_curve,
    JANUS_OBJECT_PT_motion_blur,
)
