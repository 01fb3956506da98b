# SPDX-License-Identifier: GPL-3.0-or-later
"""Render and view layer properties, in the places and words of Cycles."""

import bpy

from ..render import denoise
from ..sync.settings import active_views, merges
from .diagnostics import draw_text
from .engine_panels import JanusPanel
from .passes import draw_problem
from .presets import (
    JANUS_PT_light_paths_presets,
    JANUS_PT_sampling_presets,
    JANUS_PT_viewport_sampling_presets,
)


class JANUS_RENDER_PT_sampling(JanusPanel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_context = "render"

    def draw(self, context):
        row = self.column().row(align=True)
        row.prop(context.scene.janus, "seed")
        row.prop(context.scene.janus, "use_animated_seed", text="", icon="TIME")


def draw_samples(column, janus, prefix: str) -> None:
    """How many samples pixels get; `prefix`: "preview_" of the viewport."""
    adaptive = getattr(janus, f"use_{prefix}adaptive_sampling")
    row = column.row(heading="Noise Threshold", align=True)
    row.prop(janus, f"use_{prefix}adaptive_sampling", text="")
    part = row.row()
    part.active = adaptive
    part.prop(janus, f"{prefix}adaptive_threshold", text="")
    if adaptive:
        column = column.column(align=True)
        column.prop(janus, f"{prefix}samples", text="Max Samples")
        column.prop(janus, f"{prefix}adaptive_min_samples", text="Min Samples")
    else:
        column.prop(janus, f"{prefix}samples", text="Samples")


class JANUS_RENDER_PT_sampling_viewport(JanusPanel, bpy.types.Panel):
    bl_label = "Viewport"
    bl_parent_id = "JANUS_RENDER_PT_sampling"

    def draw_header_preset(self, context):
        JANUS_PT_viewport_sampling_presets.draw_panel_header(self.layout)

    def draw(self, context):
        draw_samples(self.column(), context.scene.janus, "preview_")


class JANUS_RENDER_PT_sampling_render(JanusPanel, bpy.types.Panel):
    bl_label = "Render"
    bl_parent_id = "JANUS_RENDER_PT_sampling"

    def draw_header_preset(self, context):
        JANUS_PT_sampling_presets.draw_panel_header(self.layout)

    def draw(self, context):
        column = self.column()
        draw_samples(column, context.scene.janus, "")
        column.prop(context.scene.janus, "time_limit")


class DenoisePanel(JanusPanel):
    bl_label = "Denoise"
    bl_options = {"DEFAULT_CLOSED"}
    switch = prefix = ""  # the names of the settings

    def draw_header(self, context):
        self.layout.enabled = not denoise.unavailable()
        self.layout.prop(context.scene.janus, self.switch, text="")

    def draw(self, context):
        reason = denoise.unavailable()
        if reason:
            draw_text(self.layout, reason, "INFO")
        janus = context.scene.janus
        column = self.column()
        column.enabled = not reason
        column.active = getattr(janus, self.switch)
        column.prop(janus, f"{self.prefix}_input_passes", text="Passes")
        if getattr(janus, f"{self.prefix}_input_passes") != "RGB":
            column.prop(janus, f"{self.prefix}_prefilter", text="Prefilter")
        column.prop(janus, f"{self.prefix}_quality", text="Quality")
        if hasattr(janus, f"{self.prefix}_start_sample"):
            column.prop(janus, f"{self.prefix}_start_sample", text="Start Sample")


class JANUS_RENDER_PT_sampling_viewport_denoise(DenoisePanel, bpy.types.Panel):
    bl_parent_id = "JANUS_RENDER_PT_sampling_viewport"
    switch, prefix = "use_preview_denoising", "preview_denoising"


class JANUS_RENDER_PT_sampling_denoise(DenoisePanel, bpy.types.Panel):
    bl_parent_id = "JANUS_RENDER_PT_sampling_render"
    switch, prefix = "use_denoising", "denoising"


class JANUS_RENDER_PT_light_paths(JanusPanel, bpy.types.Panel):
    bl_label = "Light Paths"
    bl_context = "render"

    def draw_header_preset(self, context):
        JANUS_PT_light_paths_presets.draw_panel_header(self.layout)
        self.layout.operator("janus.copy_settings_from_cycles", text="", icon="DUPLICATE")

    def draw(self, context):
        pass


class JANUS_RENDER_PT_light_paths_max_bounces(JanusPanel, bpy.types.Panel):
    bl_label = "Max Bounces"
    bl_parent_id = "JANUS_RENDER_PT_light_paths"

    def draw(self, context):
        janus = context.scene.janus
        self.column().prop(janus, "max_bounces", text="Total")
        column = self.column().column(align=True)
        for kind in ("diffuse", "glossy", "transmission"):
            column.prop(janus, f"{kind}_bounces")
        self.column().prop(janus, "transparent_max_bounces")


class JANUS_RENDER_PT_light_paths_clamping(JanusPanel, bpy.types.Panel):
    bl_label = "Clamping"
    bl_parent_id = "JANUS_RENDER_PT_light_paths"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        column = self.column().column(align=True)
        column.prop(context.scene.janus, "sample_clamp_direct", text="Direct Light")
        column.prop(context.scene.janus, "sample_clamp_indirect", text="Indirect Light")


def impossible(scene) -> str:
    """What paths without next event estimation cannot find at all in this scene."""
    janus, camera = scene.janus, scene.camera and scene.camera.data
    if janus.integrator == "LT" and not janus.next_event and camera:
        if camera.type != "PERSP" or not camera.dof.use_dof:
            return "Light paths cannot hit this camera (t=0): it has no Depth of Field"
    if janus.integrator == "PT" and not janus.next_event:
        return not_hit()
    return ""


def not_hit() -> str:
    """What paths that hit lights (s=0) cannot find."""
    points = [light.name for light in bpy.data.lights if light.users and is_point(light)]
    return f"No path hits a light without a size (s=0), such as '{points[0]}'" if points else ""


def is_point(light) -> bool:
    if light.type == "SUN":
        return light.angle == 0.0
    return light.type in ("POINT", "SPOT") and light.shadow_soft_size == 0.0


class JANUS_RENDER_PT_bidirectional(JanusPanel, bpy.types.Panel):
    bl_label = "Bidirectional"
    bl_context = "render"

    def draw(self, context):
        janus = context.scene.janus
        column = self.column()
        column.prop(janus, "integrator")
        column.prop(janus, "next_event")
        draw_problem(column, impossible(context.scene))
        column = column.column()
        column.active = janus.integrator == "BDPT"
        column.prop(janus, "connection_mode", text="Connections")
        self._draw_counts(column.column(), janus)
        row = self.column()  # path tracing weights hits and next event estimation
        row.active = janus.integrator != "LT"
        row.prop(janus, "heuristic")
        if janus.heuristic == "NONE" and janus.integrator == "BDPT":
            column = self.column()
            column.prop(janus, "strategies", placeholder="All")
            words = janus.strategies.split()
            only_hits = bool(words) and all(word.startswith("0,") for word in words)
            draw_problem(column, janus.strategies_message or (not_hit() if only_hits else ""))
        self.layout.operator("janus.render_strategies")

    @staticmethod
    def _draw_counts(column, janus):
        column.active = janus.connection_mode == "CACHE"
        row = column.row()
        row.active = janus.heuristic == "BALANCE" and not janus.use_merging
        row.prop(janus, "adaptive_counts")
        column.prop(janus, "light_paths")
        column.prop(janus, "connections", text="Connections per Vertex")
        row = column.row()
        row.active = janus.heuristic != "NONE"
        row.prop(janus, "use_merging")
        row = column.row()
        row.active = merges(janus)
        row.prop(janus, "merge_radius")


class JANUS_RENDER_PT_stereoscopy(JanusPanel, bpy.types.Panel):
    """Of files that come with it: it has to be switched off."""

    bl_label = "Stereoscopy"
    bl_context = "output"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.scene.render.use_multiview

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_multiview", text="")

    def draw(self, context):
        render = context.scene.render
        column = self.column()
        column.prop(render, "views_format", text="Format")
        if len(active_views(render)) > 1:
            draw_problem(column, "Janus renders one view")
        column = self.column().column(heading="Views")
        for view in render.views:
            column.prop(view, "use", text=view.name)


class JANUS_VIEWLAYER_PT_override(JanusPanel, bpy.types.Panel):
    bl_label = "Override"
    bl_context = "view_layer"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layer = context.view_layer
        column = self.column()
        column.prop(layer, "material_override")
        if hasattr(layer, "world_override"):
            column.prop(layer, "world_override")
        column.prop(layer, "samples")


CLASSES = (
    JANUS_RENDER_PT_sampling,
    JANUS_RENDER_PT_sampling_viewport,
    JANUS_RENDER_PT_sampling_viewport_denoise,
    JANUS_RENDER_PT_sampling_render,
    JANUS_RENDER_PT_sampling_denoise,
    JANUS_RENDER_PT_light_paths,
    JANUS_RENDER_PT_light_paths_max_bounces,
    JANUS_RENDER_PT_light_paths_clamping,
    JANUS_RENDER_PT_bidirectional,
    JANUS_RENDER_PT_stereoscopy,
    JANUS_VIEWLAYER_PT_override,
)
