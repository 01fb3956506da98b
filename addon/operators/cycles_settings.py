# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles' settings become Janus' own: when a file first meets Janus, and on demand."""

import bpy
from bpy.app.handlers import persistent

from ..sync import cycles_settings

ENGINE = "JANUS"
_subscriber = object()


class JANUS_OT_copy_settings_from_cycles(bpy.types.Operator):
    """Copy bounces, film, samples, time limit and denoising from Cycles"""

    bl_idname = "janus.copy_settings_from_cycles"
    bl_label = "Copy Settings from Cycles"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not hasattr(context.scene, "cycles"):
            cls.poll_message_set("The Cycles add-on is disabled")
            return False
        return True

    def execute(self, context):
        cycles_settings.adopt(context.scene, again=True)
        self.report({"INFO"}, cycles_settings.notice(context.scene))
        return {"FINISHED"}


class JANUS_OT_dismiss_notice(bpy.types.Operator):
    """Hide this notice"""

    bl_idname = "janus.dismiss_notice"
    bl_label = "Dismiss"
    bl_options = {"INTERNAL", "UNDO"}

    def execute(self, context):
        if not cycles_settings.adopted(context.scene):
            cycles_settings.adopt(context.scene)
        context.scene.janus.cycles_notice = False
        return {"FINISHED"}


CLASSES = (JANUS_OT_copy_settings_from_cycles, JANUS_OT_dismiss_notice)


def adopt_where_used() -> None:
    """Gives each scene that Janus renders settings of its own."""
    for scene in bpy.data.scenes:
        if scene.render.engine == ENGINE and scene.is_editable:
            if not cycles_settings.adopted(scene):
                cycles_settings.adopt(scene)


@persistent
def _on_undo(*_):
    adopt_where_used()


@persistent
def _on_load(*_):
    _subscribe()  # loading a file forgets subscriptions
    adopt_where_used()


def _subscribe() -> None:
    bpy.msgbus.clear_by_owner(_subscriber)
    bpy.msgbus.subscribe_rna(
        key=(bpy.types.RenderSettings, "engine"),
        owner=_subscriber,
        args=(),
        notify=adopt_where_used,
    )


HANDLERS = (
    (bpy.app.handlers.load_post, _on_load),
    (bpy.app.handlers.undo_post, _on_undo),
    (bpy.app.handlers.redo_post, _on_undo),
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for handlers, handler in HANDLERS:
        handlers.append(handler)
    _subscribe()


def unregister():
    bpy.msgbus.clear_by_owner(_subscriber)
    for handlers, handler in HANDLERS:
        handlers.remove(handler)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
