# SPDX-License-Identifier: GPL-3.0-or-later
"""Which passes a view layer renders, and of what."""

import bpy

from ..sync.passes import aov_problem, name_problem
from .diagnostics import draw_text
from .engine_panels import JanusPanel


def draw_problem(layout, text: str) -> None:
    """What is wrong with the field above; nothing if nothing is."""
    if text:
        column = layout.column()
        column.alert = True
        draw_text(column, text, "ERROR")


class JANUS_VIEWLAYER_PT_passes(JanusPanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        pass


class PassesPanel(JanusPanel):
    bl_context = "view_layer"
    bl_parent_id = "JANUS_VIEWLAYER_PT_passes"


class JANUS_VIEWLAYER_PT_passes_data(PassesPanel, bpy.types.Panel):
    bl_label = "Data"

    def draw(self, context):
        layer = context.view_layer
        column = self.column().column(heading="Include", align=True)
        column.prop(layer, "use_pass_combined")
        for name in ("z", "mist", "position", "normal"):
            column.prop(layer, f"use_pass_{name}")
        row = column.row()
        row.active = not context.scene.render.use_motion_blur  # then there is none
        row.prop(layer, "use_pass_vector")
        column.prop(layer, "use_pass_uv")
        column.prop(layer.janus, "denoising_store_passes")
        column = self.column().column(heading="Indexes", align=True)
        column.prop(layer, "use_pass_object_index")
        column.prop(layer, "use_pass_material_index")
        column = self.column().column(heading="Debug", align=True)
        column.prop(layer.janus, "pass_debug_sample_count")
        self.column().prop(layer, "pass_alpha_threshold")


class JANUS_VIEWLAYER_PT_passes_cryptomatte(PassesPanel, bpy.types.Panel):
    bl_label = "Cryptomatte"

    def draw(self, context):
        layer = context.view_layer
        column = self.column().column(heading="Include", align=True)
        for kind in ("object", "material", "asset"):
            column.prop(layer, f"use_pass_cryptomatte_{kind}", text=kind.capitalize())
        column = self.column()
        column.active = any(
            getattr(layer, f"use_pass_cryptomatte_{kind}")
            for kind in ("object", "material", "asset")
        )
        column.prop(layer, "pass_cryptomatte_depth", text="Levels")


class JANUS_VIEWLAYER_PT_passes_light(PassesPanel, bpy.types.Panel):
    bl_label = "Light"

    def draw(self, context):
        layer = context.view_layer
        layout = self.column()
        for kind in ("diffuse", "glossy", "transmission"):
            column = layout.column(heading=kind.capitalize(), align=True)
            for part in ("direct", "indirect", "color"):
                column.prop(layer, f"use_pass_{kind}_{part}", text=part.capitalize())
        column = layout.column(heading="All Surfaces", align=True)
        column.prop(layer.janus, "use_pass_direct")
        column.prop(layer.janus, "use_pass_indirect")
        column.prop(layer.janus, "use_pass_interreflections")
        column.prop(layer.janus, "use_pass_caustics")
        column = layout.column(heading="Other", align=True)
        column.prop(layer, "use_pass_emit", text="Emission")
        column.prop(layer, "use_pass_environment")
        column.prop(layer, "use_pass_ambient_occlusion")
        column.prop(layer.janus, "use_pass_shadow_catcher")


class JANUS_VIEWLAYER_PT_passes_lightgroups(PassesPanel, bpy.types.Panel):
    bl_label = "Light Groups"

    def draw(self, context):
        layer = context.view_layer
        row = self.layout.row()
        row.template_list(
            "UI_UL_list",
            "lightgroups",
            layer,
            "lightgroups",
            layer,
            "active_lightgroup_index",
            rows=3,
        )
        column = row.column(align=True)
        column.operator("scene.view_layer_add_lightgroup", icon="ADD", text="")
        column.operator("scene.view_layer_remove_lightgroup", icon="REMOVE", text="")
        column.separator()
        column.menu("VIEWLAYER_MT_lightgroup_sync", icon="DOWNARROW_HLT", text="")


class JANUS_VIEWLAYER_PT_passes_aov(PassesPanel, bpy.types.Panel):
    bl_label = "Shader AOV"

    def draw(self, context):
        layer = context.view_layer
        row = self.layout.row()
        row.template_list(
            "VIEWLAYER_UL_aov", "aovs", layer, "aovs", layer, "active_aov_index", rows=3
        )
        column = row.column(align=True)
        column.operator("scene.view_layer_add_aov", icon="ADD", text="")
        column.operator("scene.view_layer_remove_aov", icon="REMOVE", text="")
        if layer.active_aov:
            draw_problem(self.layout, aov_problem(layer, layer.active_aov))


class JANUS_UL_light_path_expressions(bpy.types.UIList):
    def draw_item(self, context, layout, _data, item, _icon, _active, _property, _index=0, _flag=0):
        wrong = bool(item.message or name_problem(context.view_layer, item))
        row = layout.row()
        row.alert = wrong
        row.active = item.enabled
        row.prop(item, "name", text="", emboss=False, icon="ERROR" if wrong else "NONE")
        row.prop(item, "expression", text="", emboss=False)
        row.prop(item, "enabled", text="")


class JANUS_VIEWLAYER_PT_passes_expressions(PassesPanel, bpy.types.Panel):
    bl_label = "Light Path Expressions"

    def draw(self, context):
        layer = context.view_layer
        janus = layer.janus
        row = self.layout.row()
        row.template_list(
            "JANUS_UL_light_path_expressions",
            "",
            janus,
            "expressions",
            janus,
            "active_expression",
            rows=3,
        )
        column = row.column(align=True)
        column.operator("janus.add_light_path_expression", icon="ADD", text="")
        column.operator("janus.remove_light_path_expression", icon="REMOVE", text="")
        if janus.active_expression < len(janus.expressions):
            item = janus.expressions[janus.active_expression]
            column = self.column()
            column.prop(item, "name")
            draw_problem(column, name_problem(layer, item))
            column.prop(item, "expression")
            draw_problem(column, item.message)


class JANUS_VIEWLAYER_PT_filter(JanusPanel, bpy.types.Panel):
    bl_label = "Filter"
    bl_context = "view_layer"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layer, scene = context.view_layer, context.scene
        column = self.column().column(heading="Include", align=True)
        column.prop(layer, "use_sky", text="Environment")
        column.prop(layer, "use_solid", text="Surfaces")
        column.prop(layer, "use_strand", text="Hair")
        column = self.column().column(heading="Use", align=True)
        for owner, name, text, asked in (
            (layer, "use_motion_blur", "Motion Blur", scene.render.use_motion_blur),
            (layer.janus, "use_denoising", "Denoising", scene.janus.use_denoising),
        ):
            row = column.row()
            row.active = asked
            row.prop(owner, name, text=text)


CLASSES = (
    JANUS_VIEWLAYER_PT_passes,
    JANUS_VIEWLAYER_PT_passes_data,
    JANUS_VIEWLAYER_PT_passes_light,
    JANUS_VIEWLAYER_PT_passes_cryptomatte,
    JANUS_VIEWLAYER_PT_passes_aov,
    JANUS_VIEWLAYER_PT_passes_lightgroups,
    JANUS_UL_light_path_expressions,
    JANUS_VIEWLAYER_PT_passes_expressions,
    JANUS_VIEWLAYER_PT_filter,
)
