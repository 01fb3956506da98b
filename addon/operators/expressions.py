# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds and removes light path expressions of the view layer."""

import bpy

from ..sync.passes import name_problem


class JANUS_OT_add_light_path_expression(bpy.types.Operator):
    """Add a render pass with the light of certain paths"""

    bl_idname = "janus.add_light_path_expression"
    bl_label = "Add Light Path Expression"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        layer = context.view_layer
        item = layer.janus.expressions.add()
        number = 1
        while name_problem(layer, item):
            item.name = f"Paths {number}"
            number += 1
        layer.janus.active_expression = len(layer.janus.expressions) - 1
        return {"FINISHED"}


class JANUS_OT_remove_light_path_expression(bpy.types.Operator):
    """Remove the selected light path expression"""

    bl_idname = "janus.remove_light_path_expression"
    bl_label = "Remove Light Path Expression"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return bool(context.view_layer.janus.expressions)

    def execute(self, context):
        janus = context.view_layer.janus
        janus.expressions.remove(janus.active_expression)
        janus.active_expression = max(min(janus.active_expression, len(janus.expressions) - 1), 0)
        return {"FINISHED"}


CLASSES = (JANUS_OT_add_light_path_expression, JANUS_OT_remove_light_path_expression)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
