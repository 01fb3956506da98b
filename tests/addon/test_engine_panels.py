# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of Blender's panels are open to Janus, in every version."""

import bpy
import pytest
import record_panels
import recordings
from conftest import part

RECORDINGS = recordings.stored(record_panels.FOLDER)
HOW = (
    "`python tests/addon/record_panels.py`, or `blender -b --factory-startup --python "
    "tests/addon/record_panels.py` where bpy is no module, writes the recording"
)


@pytest.fixture
def rule(scene):
    return part("ui.engine_panels")


def test_recording_of_this_blender_is_up_to_date(rule):
    version = recordings.version()
    found = record_panels.recording(rule)
    if version not in RECORDINGS:
        newest = list(RECORDINGS)[-1]
        new = {name: why for name, why in found.items() if name not in RECORDINGS[newest]}
        pytest.fail(f"nobody has recorded the panels of Blender {version}: {HOW}. New: {new}")
    changed = set(found.items()) ^ set(RECORDINGS[version].items())
    assert not changed, f"not as recorded: {HOW}"


def test_a_panel_is_open_or_there_is_a_reason(rule):
    for panel in rule.panels_of_engines():
        assert ("JANUS" in panel.COMPAT_ENGINES) == (rule.why_closed(panel) == ""), panel


def test_each_reason_is_of_some_panel(rule):
    """Or else its name is misspelt."""
    names = {name for recording in RECORDINGS.values() for name in recording}
    for pattern in (*rule.EXCLUDED, *rule.INCLUDED):
        start = pattern.removesuffix("*")
        assert any(name == start or start != pattern and name.startswith(start) for name in names)


@pytest.mark.parametrize("version", RECORDINGS)
def test_what_artists_need_is_open(rule, version):
    needed = (
        "DATA_PT_lens",
        "OBJECT_PT_visibility",
        "RENDER_PT_color_management",
        "RENDER_PT_format",
        "RENDER_PT_output",
        "RENDER_PT_post_processing",
        "VIEWLAYER_PT_layer",
        "WORLD_PT_context_world",
        *rule.INCLUDED,
    )
    assert {RECORDINGS[version][name] for name in needed} == {""}


def test_what_cycles_opens_is_open_or_named(rule):
    if not hasattr(bpy.types, "CYCLES_RENDER_PT_sampling"):
        pytest.skip("this Blender comes without Cycles")
    panels = [p for p in rule.panels_of_engines() if p.__module__.startswith("bl_ui")]
    of_cycles = [p for p in panels if "CYCLES" in p.COMPAT_ENGINES]
    assert len(of_cycles) > 200
    assert [p.__name__ for p in of_cycles if rule.why_closed(p).startswith("for BLENDER")] == []
    assert [p.__name__ for p in of_cycles if rule.why_closed(p).startswith("for CYCLES")] == []


def test_panels_are_closed_again(rule):
    rule.unregister()
    try:
        open_still = [p for p in rule.panels_of_engines() if "JANUS" in p.COMPAT_ENGINES]
        assert open_still == []
    finally:
        rule.register()
