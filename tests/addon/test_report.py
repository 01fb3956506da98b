# SPDX-License-Identifier: GPL-3.0-or-later
"""The report leads to what it is about."""

import bpy
import pytest
from conftest import add_square, part


@pytest.fixture
def things(scene):
    paint = bpy.data.materials.new("Paint")
    for name in ("Door", "Gate", "Wall"):
        obj = add_square(name)
        if name != "Wall":
            obj.data.materials.append(paint)
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Bulb", "POINT"))
    scene.collection.objects.link(lamp)
    bpy.context.view_layer.update()
    return scene


def selected(**about) -> set[str]:
    bpy.data.objects["Wall"].select_set(True)
    assert bpy.ops.janus.select_reported(**about) == {"FINISHED"}
    found = {obj.name for obj in bpy.context.view_layer.objects if obj.select_get()}
    assert bpy.context.view_layer.objects.active.name in found
    return found


@pytest.mark.parametrize(
    ("about", "names"),
    [
        ({"object": "Gate"}, {"Gate"}),
        ({"material": "Paint"}, {"Door", "Gate"}),
        ({"material": "Bulb"}, {"Lamp"}),
        ({"object": "Gate", "material": "Bulb"}, {"Gate", "Lamp"}),
    ],
)
def test_selects_what_it_is_about(things, about, names):
    assert selected(**about) == names


def test_what_cannot_be_selected_changes_nothing(things):
    bpy.data.objects["Wall"].select_set(True)
    bpy.data.objects["Gate"].hide_set(True)
    for about in ({"object": "Nobody"}, {"object": "Gate"}, {}):
        assert bpy.ops.janus.select_reported(**about) == {"CANCELLED"}
    assert bpy.data.objects["Wall"].select_get()


def test_a_viewport_does_not_hide_why_a_render_failed(scene):
    report = part("report")

    def log(severity, message):
        found = report.DiagnosticsLog()
        found.add(report.Entry(severity, message))
        return found

    def said():
        return [(entry.severity, entry.message) for entry, _ in report.kept("Scene")]

    report.forget()
    report.keep("Scene", "Layer", ["Layer"], log("WARNING", "old"))
    report.keep_of_viewport("Scene", "Layer", ["Layer"], log("WARNING", "new"))
    assert said() == [("WARNING", "new")]
    report.keep("Scene", "Layer", ["Layer"], log("ERROR", "failed"))
    for message in ("first", "second"):
        report.keep_of_viewport("Scene", "Layer", ["Layer"], log("WARNING", message))
        assert said() == [("ERROR", "failed"), ("WARNING", message)]
    report.keep("Scene", "Layer", ["Layer"], log("INFO", "well"))
    assert said() == [("INFO", "well")]


def test_lines_are_as_long_as_fits():
    wrapped = part("ui.diagnostics").wrapped
    text = "a line of words and oneverylongone at its end"
    lines = wrapped(text, lambda line: len(line) <= 12)
    assert lines == ["a line of", "words and", "oneverylongone", "at its end"]
    assert wrapped("", lambda line: False) == [""]


def test_panels_follow_the_report(scene):
    diagnostics, report = part("ui.diagnostics"), part("report")
    assert diagnostics.follow() > 0.0
    before = list(diagnostics._seen)
    log = report.DiagnosticsLog()
    log.warning("something new")
    report.keep(scene.name_full, "ViewLayer", ["ViewLayer"], log)
    diagnostics.follow()
    assert (diagnostics._seen != before) == bool(bpy.context.window_manager.windows)
