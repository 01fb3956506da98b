# SPDX-License-Identifier: GPL-3.0-or-later
"""World, light, camera and object properties, where Blender's own panels do not do."""

import bpy

from ..sync.visibility import LIGHT_RAYS, RAYS, SHAPE_TYPES
from .engine_panels import JanusPanel
from .material import PreviewPanel, draw_surface, draw_use_nodes


class JANUS_WORLD_PT_preview(PreviewPanel, bpy.types.Panel):
    bl_context = "world"

    @staticmethod
    def shown(context):
        return context.world


class WorldPanel(JanusPanel):
    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.world


class JANUS_WORLD_PT_surface(WorldPanel, bpy.types.Panel):
    bl_label = "Surface"

    def draw(self, context):
        world = context.world
        if bpy.app.version < (5, 0, 0):
            draw_use_nodes(self.layout, world)
            if not world.use_nodes:
                self.column().prop(world, "color")
                return
        self.layout.use_property_split = True
        draw_surface(self.layout, world.node_tree)


class JANUS_WORLD_PT_mist(WorldPanel, bpy.types.Panel):
    bl_label = "Mist Pass"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        column = self.column()
        for name in ("start", "depth", "falloff"):
            column.prop(context.world.mist_settings, name)


class JANUS_WORLD_PT_ray_visibility(WorldPanel, bpy.types.Panel):
    """The settings are Cycles' own: a file has them once."""

    bl_label = "Ray Visibility"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and hasattr(context.world, "cycles_visibility")

    def draw(self, context):
        column = self.column()
        for ray in LIGHT_RAYS:
            column.prop(context.world.cycles_visibility, ray)


def draw_light_group(layout, owner, view_layer) -> None:
    row = layout.row(align=True)
    row.prop_search(
        owner,
        "lightgroup",
        view_layer,
        "lightgroups",
        text="Light Group",
        results_are_suggestions=True,
    )
    column = row.column(align=True)
    column.enabled = bool(owner.lightgroup) and owner.lightgroup not in view_layer.lightgroups
    add = column.operator("scene.view_layer_add_lightgroup", icon="ADD", text="")
    add.name = owner.lightgroup


class JANUS_OBJECT_PT_lightgroup(JanusPanel, bpy.types.Panel):
    bl_label = "Light Group"
    bl_context = "object"
    if hasattr(bpy.types, "OBJECT_PT_shading"):  # not in Blender 4.2, where it is Cycles' own
        bl_parent_id = "OBJECT_PT_shading"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        draw_light_group(self.column(), context.object, context.view_layer)


class JANUS_WORLD_PT_lightgroup(WorldPanel, bpy.types.Panel):
    bl_label = "Light Group"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        draw_light_group(self.column(), context.world, context.view_layer)


class LightPanel(JanusPanel):
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.light


class JANUS_LIGHT_PT_preview(PreviewPanel, bpy.types.Panel):
    bl_context = "data"

    @staticmethod
    def shown(context):
        return context.light


class JANUS_LIGHT_PT_light(LightPanel, bpy.types.Panel):
    bl_label = "Light"

    def draw(self, context):
        light = context.light
        self.layout.row().prop(light, "type", expand=True)
        column = self.column()
        self._draw_color(column, light)
        column.separator()
        column.prop(light, "energy", text="Strength" if light.type == "SUN" else "Power")
        for name in ("exposure", "normalize"):
            if hasattr(light, name):
                column.prop(light, name)
        column.separator()
        self._draw_shape(column, light)

    @staticmethod
    def _draw_color(column, light):
        if hasattr(light, "use_temperature"):
            row = column.row(heading="Temperature", align=True)
            row.prop(light, "use_temperature", text="")
            part = row.row()
            part.active = light.use_temperature
            part.prop(light, "temperature", text="")
        tinted = getattr(light, "use_temperature", False)
        column.prop(light, "color", text="Tint" if tinted else "Color")

    @staticmethod
    def _draw_shape(column, light):
        if light.type in ("POINT", "SPOT"):
            column.prop(light, "shadow_soft_size", text="Radius")
            column.prop(light, "use_soft_falloff")
        elif light.type == "SUN":
            column.prop(light, "angle")
        elif light.type == "AREA":
            column.prop(light, "shape")
            if light.shape in ("SQUARE", "DISK"):
                column.prop(light, "size")
            else:
                column.prop(light, "size", text="Size X")
                column.prop(light, "size_y", text="Y")
            column.prop(light, "spread")


class JANUS_LIGHT_PT_beam(LightPanel, bpy.types.Panel):
    bl_label = "Beam Shape"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.light.type == "SPOT"

    def draw(self, context):
        light = context.light
        column = self.column()
        column.prop(light, "spot_size", text="Spot Size")
        column.prop(light, "spot_blend", text="Blend", slider=True)
        column.prop(light, "use_square")
        column.prop(light, "show_cone")


class JANUS_LIGHT_PT_nodes(LightPanel, bpy.types.Panel):
    bl_label = "Nodes"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        draw_use_nodes(self.layout, context.light)
        if context.light.node_tree and getattr(context.light, "use_nodes", True):
            self.layout.use_property_split = True
            draw_surface(self.layout, context.light.node_tree)


class JANUS_LIGHT_PT_settings(LightPanel, bpy.types.Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        light = context.light
        column = self.column()
        if hasattr(light, "cycles"):  # a file has the setting once
            column.prop(light.cycles, "max_bounces")
        column.prop(light, "use_shadow", text="Cast Shadow")


class VisibilityPanel(JanusPanel):
    """Blender's panel of the visibility shows these settings in other engines only."""

    bl_context = "object"
    bl_parent_id = "OBJECT_PT_visibility"

    @classmethod
    def poll(cls, context):
        obj = context.object
        if not super().poll(context) or not obj:
            return False
        kinds = SHAPE_TYPES | {"LIGHT"}
        return obj.type in kinds or obj.instance_type == "COLLECTION"


def draw_shadow_catcher(panel, context):
    """Below Holdout, which Blender's panel has."""
    if VisibilityPanel.poll(context):
        panel.layout.use_property_split = True
        panel.layout.column().prop(context.object, "is_shadow_catcher")


class JANUS_OBJECT_PT_ray_visibility(VisibilityPanel, bpy.types.Panel):
    bl_label = "Ray Visibility"

    def draw(self, context):
        obj = context.object
        column = self.column()
        for ray in LIGHT_RAYS if obj.type == "LIGHT" else RAYS:
            column.prop(obj, f"visible_{ray}", text=ray.capitalize())


CLASSES = (
    JANUS_WORLD_PT_preview,
    JANUS_WORLD_PT_surface,
    JANUS_WORLD_PT_mist,
    JANUS_WORLD_PT_ray_visibility,
    JANUS_WORLD_PT_lightgroup,
    JANUS_LIGHT_PT_preview,
    JANUS_LIGHT_PT_light,
    JANUS_LIGHT_PT_beam,
    JANUS_LIGHT_PT_nodes,
    JANUS_LIGHT_PT_settings,
    JANUS_OBJECT_PT_lightgroup,
    JANUS_OBJECT_PT_ray_visibility,
)


def register():
    bpy.types.OBJECT_PT_visibility.append(draw_shadow_catcher)


def unregister():
    bpy.types.OBJECT_PT_visibility.remove(draw_shadow_catcher)
