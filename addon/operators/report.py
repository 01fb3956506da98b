# SPDX-License-Identifier: GPL-3.0-or-later
"""From a finding of the report to what it is about."""

import bpy
from bpy.props import StringProperty


class JANUS_OT_select_reported(bpy.types.Operator):
    """Select the objects that this is about"""

    bl_idname = "janus.select_reported"
    bl_label = "Select Reported Objects"
    bl_options = {"REGISTER", "UNDO"}

    object: StringProperty(name="Object", options={"SKIP_SAVE"})
    material: StringProperty(name="Material", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def execute(self, context):
        found = reported(context.view_layer, self.object, self.material)
        if not found:
            self.report({"WARNING"}, "No such object can be selected in this view layer")
            return {"CANCELLED"}
        for obj in context.view_layer.objects:
            obj.select_set(obj in found)
        context.view_layer.objects.active = found[0]
        return {"FINISHED"}


def reported(view_layer, name: str, material: str) -> list:
    """The objects of the view layer that can be selected: those with the name (their own or their
    data's), and those that have the material or are the light with that name."""
    return [
        obj
        for obj in view_layer.objects
        if obj.visible_get(view_layer=view_layer)
        and not obj.hide_select
        and (
            (name and name in (obj.name, getattr(obj.data, "name", "")))
            or (material and material in names_of_shading(obj))
        )
    ]


def names_of_shading(obj) -> set[str]:
    names = {slot.material.name for slot in obj.material_slots if slot.material}
    return names | {obj.data.name} if obj.type == "LIGHT" else names


def register():
    bpy.utils.register_class(JANUS_OT_select_reported)


def unregister():
    bpy.utils.unregister_class(JANUS_OT_select_reported)
