# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last render could not do, where nobody can miss it."""

import bpy

from .. import bridge, report
from ..sync import cycles_settings
from .engine_panels import JanusPanel

ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR", "INFO": "INFO"}
LINE_WIDTH = 60  # characters: labels do not wrap by themselves
MAX_ENTRIES = 50


def wrapped(text: str, width: int = LINE_WIDTH) -> list[str]:
    """The text in lines of about `width` characters, broken at spaces."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + len(word) >= width:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


def draw_text(layout, text: str, icon: str) -> None:
    column = layout.column(align=True)
    column.scale_y = 0.8
    for number, line in enumerate(wrapped(text)):
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


CLASSES = (JANUS_RENDER_PT_banner, JANUS_RENDER_PT_notice, JANUS_RENDER_PT_report)
