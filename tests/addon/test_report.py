# SPDX-License-Identifier: GPL-3.0-or-later
"""The report leads to what it is about."""

import bpy
import pytest
from conftest import add_square


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
