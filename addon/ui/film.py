# SPDX-License-Identifier: GPL-3.0-or-later
"""Render properties of the picture, of the machine, and of scenes that are too much for it."""

import bpy

from .engine_panels import JanusPanel


class JANUS_RENDER_PT_simplify(JanusPanel, bpy.types.Panel):
    """Blender's own would stand above all others, as it was there first."""

    bl_label = "Simplify"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_simplify", text="")

    def draw(self, context):
        pass


class SimplifyPanel(JanusPanel):
    bl_parent_id = "JANUS_RENDER_PT_simplify"
    suffix = ""  # of the names of the settings

    def draw(self, context):
        render = context.scene.render
        column = self.column()
        column.active = render.use_simplify
        column.prop(render, f"simplify_subdivision{self.suffix}", text="Max Subdivision")
        column.prop(render, f"simplify_child_particles{self.suffix}", text="Max Child Particles")
        if not self.suffix and hasattr(render, "use_simplify_normals"):
            column.prop(render, "use_simplify_normals", text="Normals")


class JANUS_RENDER_PT_simplify_viewport(SimplifyPanel, bpy.types.Panel):
    bl_label = "Viewport"


class JANUS_RENDER_PT_simplify_render(SimplifyPanel, bpy.types.Panel):
    bl_label = "Render"
    suffix = "_render"


class JANUS_RENDER_PT_film(JanusPanel, bpy.types.Panel):
    bl_label = "Film"
    bl_context = "render"

    def draw(self, context):
        janus = context.scene.janus
        column = self.column()
        column.prop(janus, "film_exposure")
        column.prop(janus, "pixel_filter_type", text="Pixel Filter")
        if janus.pixel_filter_type != "BOX":
            column.prop(janus, "filter_width", text="Width")


class JANUS_RENDER_PT_film_transparency(JanusPanel, bpy.types.Panel):
    bl_label = "Transparent"
    bl_parent_id = "JANUS_RENDER_PT_film"

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "film_transparent", text="")

    def draw(self, context):
        janus = context.scene.janus
        column = self.column()
        column.active = context.scene.render.film_transparent
        column.prop(janus, "film_transparent_glass")
        row = column.row()
        row.active = janus.film_transparent_glass
        row.prop(janus, "film_transparent_roughness")


class JANUS_RENDER_PT_performance(JanusPanel, bpy.types.Panel):
    bl_label = "Performance"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        render = context.scene.render
        column = self.column()
        column.prop(render, "threads_mode")
        threads = column.column()
        threads.enabled = render.threads_mode == "FIXED"
        threads.prop(render, "threads")


class JANUS_RENDER_PT_performance_compositor(JanusPanel, bpy.types.Panel):
    bl_label = "Compositor"
    bl_parent_id = "JANUS_RENDER_PT_performance"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        render = context.scene.render
        column = self.column()
        column.row().prop(render, "compositor_device", text="Device", expand=True)
        if render.compositor_device == "GPU":
            column.prop(render, "compositor_precision", text="Precision")


class JANUS_RENDER_PT_performance_final_render(JanusPanel, bpy.types.Panel):
    bl_label = "Final Render"
    bl_parent_id = "JANUS_RENDER_PT_performance"

    def draw(self, context):
        self.column().prop(context.scene.render, "use_persistent_data", text="Persistent Data")


class JANUS_RENDER_PT_performance_viewport(JanusPanel, bpy.types.Panel):
    bl_label = "Viewport"
    bl_parent_id = "JANUS_RENDER_PT_performance"

    def draw(self, context):
        self.column().prop(context.scene.render, "preview_pixel_size", text="Pixel Size")


SIMPLIFY = (
    JANUS_RENDER_PT_simplify,
    JANUS_RENDER_PT_simplify_viewport,
    JANUS_RENDER_PT_simplify_render,
)
CLASSES = (
    JANUS_RENDER_PT_film,
    JANUS_RENDER_PT_film_transparency,
    JANUS_RENDER_PT_performance,
    JANUS_RENDER_PT_performance_compositor,
    JANUS_RENDER_PT_performance_final_render,
    JANUS_RENDER_PT_performance_viewport,
)
