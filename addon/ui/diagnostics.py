# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last render could not do, where nobody can miss it."""

import blf
import bpy

from .. import bridge, report
from ..sync import cycles_settings
from .engine_panels import JanusPanel

ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR", "INFO": "INFO"}
LINE_WIDTH = 60  # characters, where nobody knows how wide the region is
BESIDE = 80.0  # pixels of a line that margins, icon and button take, in the interface's scale
MAX_ENTRIES = 50
FOLLOW_SECONDS = 0.5


def wrapped(text: str, fits) -> list[str]:
    """The text in lines that `fits` calls short enough, broken at spaces."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and not fits(longer):
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def fits_region(line: str) -> bool:
    """Has the region being drawn room for it? Of labels that are too long, Blender leaves out the
    middle.
    """
    region = bpy.context.region
    if region is None:
        return len(line) <= LINE_WIDTH
    preferences = bpy.context.preferences
    scale = preferences.system.ui_scale
    blf.size(0, preferences.ui_styles[0].widget.points * scale)
    return blf.dimensions(0, line)[0] <= region.width - BESIDE * scale


def draw_text(layout, text: str, icon: str) -> None:
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, line in enumerate(wrapped(text, fits_region)):
        column.label(text=line, icon="BLANK1" if number else icon)


def banner_text(context) -> str:
    """The one sentence of the banner, empty if all is well."""
    if bridge.failure():
        return bridge.failure()
    found = [entry.severity for entry, _ in report.kept(context.scene.name_full)]
    if "ERROR" in found:
        return "The last render failed: see Janus Report"
    warnings = found.count("WARNING")
    if warnings:
        things = "1 thing" if warnings == 1 else f"{warnings} things"
        return f"The last render left out {things}: see Janus Report"
    return ""


class JANUS_RENDER_PT_banner(JanusPanel, bpy.types.Panel):
    bl_label = ""
    bl_context = "render"
    bl_options = {"HIDE_HEADER"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and banner_text(context) != ""

    def draw(self, context):
        box = self.layout.box()
        box.alert = True
        draw_text(box, banner_text(context), "ERROR")


class JANUS_RENDER_PT_notice(JanusPanel, bpy.types.Panel):
    """Where the settings come from, until the user has read it."""

    bl_label = ""
    bl_context = "render"
    bl_options = {"HIDE_HEADER"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and cycles_settings.notice(context.scene) != ""

    def draw(self, context):
        row = self.layout.box().row()
        draw_text(row, cycles_settings.notice(context.scene), "INFO")
        row.operator("janus.dismiss_notice", text="", icon="X", emboss=False)


class JANUS_RENDER_PT_report(JanusPanel, bpy.types.Panel):
    bl_label = "Janus Report"
    bl_context = "render"
    bl_order = 100

    @classmethod
    def poll(cls, context):
        return super().poll(context) and bool(report.kept(context.scene.name_full))

    def draw(self, context):
        entries = report.kept(context.scene.name_full)
        for entry, count in entries[:MAX_ENTRIES]:
            row = self.layout.row()
            draw_text(row, report.counted(entry, count), ICONS[entry.severity])
            if entry.object or entry.material:
                select = row.operator(
                    "janus.select_reported", text="", icon="RESTRICT_SELECT_OFF", emboss=False
                )
                select.object, select.material = entry.object, entry.material
        if len(entries) > MAX_ENTRIES:
            self.layout.label(text=f"and {len(entries) - MAX_ENTRIES} more")


_seen: list = []


def follow() -> float:
    """A timer that has panels drawn again when there is something else to read: renders in the
    background and viewports do not do so by themselves.
    """
    windows = bpy.context.window_manager.windows
    running = bpy.app.is_job_running("RENDER")  # greys buttons
    found = [running, *(report.kept(window.scene.name_full) for window in windows)]
    if found != _seen:
        _seen[:] = found
        for window in windows:
            for area in window.screen.areas:
                if area.type == "PROPERTIES":
                    area.tag_redraw()
    return FOLLOW_SECONDS


def register():
    if not bpy.app.background:
        bpy.app.timers.register(follow, persistent=True)


def unregister():
    if bpy.app.timers.is_registered(follow):
        bpy.app.timers.unregister(follow)


CLASSES = (JANUS_RENDER_PT_banner, JANUS_RENDER_PT_notice, JANUS_RENDER_PT_report)
