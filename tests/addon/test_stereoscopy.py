# SPDX-License-Identifier: GPL-3.0-or-later
"""Janus renders one view: of several it says so, and of one what is missing."""

import bpy
import pytest
from conftest import messages
from test_panels import draw, polled


@pytest.fixture
def stereo(scene, fake_core):
    scene.render.use_multiview = True
    return scene.render


@pytest.mark.parametrize("form", ["STEREO_3D", "MULTIVIEW"])
def test_several_views_are_refused(stereo, fake_core, form):
    stereo.views_format = form
    with pytest.raises(RuntimeError, match="Stereoscopy .* 'left', 'right', .* renders one"):
        bpy.ops.render.render()
    assert not fake_core.sessions


def test_views_of_the_other_format_do_not_count(stereo, fake_core):
    stereo.views["right"].use = False
    stereo.views.new("third")
    bpy.ops.render.render()
    assert len(fake_core.sessions) == 1 and not messages()
    stereo.views_format = "MULTIVIEW"
    with pytest.raises(RuntimeError, match="'left', 'third'"):
        bpy.ops.render.render()


def test_one_view_is_rendered(stereo, fake_core):
    stereo.views["right"].use = False
    bpy.ops.render.render()
    assert len(fake_core.sessions) == 1 and not messages()


def test_a_view_from_beside_the_camera_is_named(stereo, scene, fake_core):
    stereo.views["left"].use = False
    bpy.ops.render.render()
    assert len(fake_core.sessions) == 1
    assert len(messages()) == 1 and "the view 'right'" in messages()[0]
    scene.camera.data.stereo.pivot = "RIGHT"
    bpy.ops.render.render()
    assert not messages()


def test_a_view_of_another_camera_is_named(stereo, scene, fake_core):
    stereo.views_format, stereo.views["right"].use = "MULTIVIEW", False
    scene.camera.name = "Eye_R"
    bpy.ops.render.render()
    assert not messages()
    other = bpy.data.objects.new("Eye_L", scene.camera.data)
    scene.collection.objects.link(other)
    bpy.ops.render.render()
    assert len(messages()) == 1 and "the view 'left'" in messages()[0]


def test_the_panel_is_there_to_switch_it_off(stereo, scene):
    name = "JANUS_RENDER_PT_stereoscopy"
    problem = ("Janus renders one view", "ERROR", True)
    assert polled(name, scene=scene)
    assert draw(name) == ["views_format", problem, "use", "use"]
    stereo.views["left"].use = False
    assert problem not in draw(name)
    stereo.use_multiview = False
    assert not polled(name, scene=scene)
