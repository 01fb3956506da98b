# SPDX-License-Identifier: GPL-3.0-or-later
"""Persistent Data and viewports: edits of hair and points send it again, and nothing else does."""

import bpy
import numpy as np
import pytest
from persistent_kit import equal, things
from viewport_kit import Eye, followed_by, furnish

HAIR = {"set_curves", "set_points"}


def grow():
    """Hair on the ball, and a tuft beside it."""
    ball = things("Ball")
    ball.modifiers.new("Hair", "PARTICLE_SYSTEM")
    settings = ball.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 12, 0.5
    settings.radius_scale = 0.2
    curves = bpy.data.hair_curves.new("Tuft")
    curves.add_curves([3, 3])
    places = [(0, 0, 0), (0, 0, 0.5), (0, 0, 1), (0.3, 0, 0), (0.3, 0, 0.5), (0.3, 0, 1)]
    curves.attributes["position"].data.foreach_set("vector", np.float32(places).ravel())
    radius = curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", [0.1] * 6)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Tuft", curves))
    bpy.context.view_layer.update()


def lengthen():
    things("Ball").particle_systems[0].settings.hair_length = 1.0


def thicken():
    things("Ball").particle_systems[0].settings.radius_scale = 0.4


def comb():
    curves = things("Tuft").data
    curves.attributes["position"].data[2].vector = (0.4, 0.0, 0.8)
    curves.update_tag()


def widen():
    curves = things("Tuft").data
    curves.attributes["radius"].data[4].value = 0.2
    curves.update_tag()


def move():
    things("Tuft").location.x = 0.4


def shave():
    bpy.context.view_layer.use_strand = False


EDITS = {lengthen: True, thicken: True, comb: True, widen: True, move: False, shave: False}


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: edit.__name__)
def test_an_edit_between_renders(renders, edit):
    grow()

    def sent():
        return {name for builder in renders.core.builders for name in builder.calls} & HAIR

    before = renders()
    assert sent()
    assert equal(renders(), before) and not sent()
    edit()
    after = renders()
    assert bool(sent()) == EDITS[edit]
    assert not np.array_equal(after, before)
    assert equal(renders(), after)
    assert equal(after, renders.fresh())


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: edit.__name__)
def test_an_edit_in_a_viewport(scene, core, edit):
    furnish(scene)
    grow()
    eye = Eye(core)
    before = eye.wait().copy()
    eye.sent()
    with followed_by(eye):
        edit()
    after = eye.wait().copy()
    assert bool(eye.sent() & HAIR) == EDITS[edit]
    assert not np.array_equal(after, before)
    assert np.allclose(Eye(core).wait(), after, rtol=1e-4, atol=1e-5)
