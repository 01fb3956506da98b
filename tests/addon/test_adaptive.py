# SPDX-License-Identifier: GPL-3.0-or-later
"""Adaptive sampling: from Cycles' settings or Janus' own to the core."""

import bpy
import pytest
from conftest import add_light, add_square, part


def sent(scene):
    settings = part("sync.settings")
    depsgraph = bpy.context.evaluated_depsgraph_get()
    final, view = settings.render_settings(depsgraph), settings.view_settings(scene)
    return tuple((s["samples"], s["noise_threshold"], s["min_samples"]) for s in (final, view))


def test_off_until_somebody_asks(scene):
    assert scene.cycles.use_adaptive_sampling  # Cycles' default
    assert sent(scene) == ((64, 0.0, 0), (1024, 0.0, 0))


def test_it_belongs_to_the_samples_of_cycles(scene):
    scene.cycles.samples, scene.cycles.adaptive_threshold = 3000, 0.02
    assert sent(scene)[0] == (3000, pytest.approx(0.02), 0)
    scene.cycles.use_adaptive_sampling = False
    scene.update_tag()  # scripts have to say so
    assert sent(scene)[0] == (3000, 0.0, 0)


def test_own_settings(scene):
    janus = scene.janus
    janus.use_adaptive_sampling, janus.adaptive_threshold = True, 0.05
    janus.adaptive_min_samples = 7
    janus.use_preview_adaptive_sampling = True
    final, view = sent(scene)
    assert final == (64, pytest.approx(0.05), 7)
    assert view == (1024, pytest.approx(0.1), 0)


def test_a_quiet_picture_ends_early(scene, core):
    add_square()
    add_light("SUN")
    janus = scene.janus
    janus.samples, janus.use_adaptive_sampling, janus.adaptive_threshold = 500, True, 0.5
    bpy.ops.render.render()
    assert 16 <= part("render.final").last_render["samples"] < 100
