# SPDX-License-Identifier: GPL-3.0-or-later
"""Material properties: the slots, the surface and the settings."""

import bpy

from .engine_panels import JanusPanel

TYPES_WITHOUT_SLOTS = {"GPENCIL", "GREASEPENCIL", "VOLUME"}


def draw_surface(layout, tree, empty: str = "No output node") -> None:
    """The nodes behind the Surface input of the output that Janus renders."""
    output = tree.get_output_node("CYCLES") if tree else None
    if output is None:
        layout.label(text=empty)
        return
    layout.template_node_view(tree, output, output.inputs["Surface"])


def draw_use_nodes(layout, owner) -> None:
    """The button that gives a tree to what has none; newer Blenders always have one."""
    if owner.node_tree is None or not getattr(owner, "use_nodes", True):
        layout.prop(owner, "use_nodes", icon="NODETREE")


class JANUS_MATERIAL_PT_context(JanusPanel, bpy.types.Panel):
    bl_label = ""
    bl_context = "material"
    bl_options = {"HIDE_HEADER"}

    @classmethod
    def poll(cls, context):
        if context.object and context.object.type in TYPES_WITHOUT_SLOTS:
            return False
        return super().poll(context) and bool(context.object or context.material)

    def draw(self, context):
        layout, obj = self.layout, context.object
        if obj is None:
            layout.template_ID(context.space_data, "pin_id")
            return
        row = layout.row()
        row.template_list(
            "MATERIAL_UL_matslots",
            "",
            obj,
            "material_slots",
            obj,
            "active_material_index",
            rows=3 if len(obj.material_slots) > 1 else 1,
        )
        column = row.column(align=True)
        column.operator("object.material_slot_add", icon="ADD", text="")
        column.operator("object.material_slot_remove", icon="REMOVE", text="")
        column.menu("MATERIAL_MT_context_menu", icon="DOWNARROW_HLT", text="")
        row = layout.row()
        row.template_ID(obj, "active_material", new="material.new")
        if context.material_slot:
            row.prop(context.material_slot, "link", icon_only=True)
        if obj.mode == "EDIT":
            row = layout.row(align=True)
            row.operator("object.material_slot_assign", text="Assign")
            row.operator("object.material_slot_select", text="Select")
            row.operator("object.material_slot_deselect", text="Deselect")


class PreviewPanel(JanusPanel):
    """The picture that render/preview.py makes."""

    bl_label = "Preview"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and cls.shown(context) is not None

    def draw(self, context):
        self.layout.template_preview(self.shown(context))


class JANUS_MATERIAL_PT_preview(PreviewPanel, bpy.types.Panel):
    bl_context = "material"

    @staticmethod
    def shown(context):
        material = context.material
        return None if material and material.grease_pencil else material


class MaterialPanel(JanusPanel):
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.material and not context.material.grease_pencil


class JANUS_MATERIAL_PT_surface(MaterialPanel, bpy.types.Panel):
    bl_label = "Surface"

    def draw(self, context):
        material = context.material
        if bpy.app.version < (5, 0, 0):
            draw_use_nodes(self.layout, material)
            if not material.use_nodes:
                self.layout.prop(material, "diffuse_color", text="Base Color")
                return
        self.layout.use_property_split = True
        draw_surface(self.layout, material.node_tree)


class JANUS_MATERIAL_PT_settings(MaterialPanel, bpy.types.Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        material = context.material
        column = self.column()
        column.prop(material, "pass_index")
        if hasattr(material, "cycles"):  # a file has the setting once
            column.prop(material.cycles, "emission_sampling")


CLASSES = (
    JANUS_MATERIAL_PT_context,
    JANUS_MATERIAL_PT_preview,
    JANUS_MATERIAL_PT_surface,
    JANUS_MATERIAL_PT_settings,
)
