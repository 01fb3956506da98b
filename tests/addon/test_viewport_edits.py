# SPDX-License-Identifier: GPL-3.0-or-later
"""What an edit sends to the core, and that the picture then is that of a fresh start."""

import bpy
import numpy as np
import pytest
from conftest import add_square
from viewport_kit import Eye, followed_by, furnish


@pytest.fixture
def world_of_things(scene):
    return furnish(scene)


def edit_mesh():
    mesh = bpy.data.objects["Ball"].data
    mesh.vertices[0].co.z += 0.7
    mesh.update()


def edit_picture():
    image = bpy.data.images["Picture"]
    image.pixels.foreach_set(np.zeros(64, dtype=np.float32))
    image.update_tag()


def add_modifier():
    bpy.data.objects["Ball"].modifiers.new("Subsurf", "SUBSURF")


def assign(name, path, value):
    def edit():
        owner = bpy.data.objects[name]
        *steps, last = path.split(".")
        for step in steps:
            owner = getattr(owner, step)
        setattr(owner, last, value)

    return edit


def roughen():
    nodes = bpy.data.materials["Tiles"].node_tree.nodes
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.1
    shader.inputs["Metallic"].default_value = 1.0


def recolor():
    world = bpy.data.worlds["World"]
    world.use_nodes = True
    background = next(n for n in world.node_tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.1, 0.9, 0.2, 1.0)


def remove_twin():
    bpy.data.objects.remove(bpy.data.objects["Twin"])


def add_another():
    obj = bpy.data.objects.new("Another", bpy.data.objects["Ball"].data)
    obj.location = (0.0, -0.9, 0.4)
    bpy.context.scene.collection.objects.link(obj)


def hide():
    bpy.data.objects["Ball"].hide_viewport = True


def swap_places_and_data():
    """The data of a deleted object may come to lie where those of a new one do."""
    bpy.data.meshes.remove(bpy.data.objects["Ball"].data)
    square = add_square("New")
    square.location.z = 0.7


MOVES = {"set_instance"}
EDITS = {
    "move": (assign("Ball", "location", (0.2, 0.6, 0.8)), MOVES),
    "move the floor": (assign("Floor", "location", (0.0, 0.0, -1.0)), MOVES),
    "ray visibility": (assign("Ball", "visible_camera", False), MOVES),
    "lamp": (assign("Lamp", "data.energy", 500.0), {"set_light"}),
    "move the lamp": (assign("Lamp", "location", (-1.0, 0.0, 2.0)), {"set_light"}),
    "material": (roughen, {"set_material"}),
    "world": (recolor, {"set_world"}),
    "mesh": (edit_mesh, {"set_mesh", "set_instance", "remove"}),
    "modifier": (add_modifier, {"set_mesh", "set_instance", "remove"}),
    "picture": (edit_picture, {"set_image", "remove"}),
    "remove": (remove_twin, {"set_instance", "set_light", "remove"}),
    "add": (add_another, {"set_instance", "set_light", "set_mesh", "remove"}),
    "hide": (hide, {"set_instance", "set_light", "remove", "set_mesh"}),
    "swap": (swap_places_and_data, {"set_instance", "set_light", "remove", "set_mesh"}),
}


@pytest.mark.parametrize("name", EDITS)
def test_an_edit_sends_what_has_changed(world_of_things, core, name):
    edit, expected = EDITS[name]
    eye = Eye(core)
    before = eye.wait()
    assert eye.sent() >= {"set_mesh", "set_image", "set_world", "set_light", "set_camera"}
    with followed_by(eye):
        edit()
    after = eye.wait()
    sent = eye.sent()
    assert sent and sent <= expected
    assert not np.array_equal(after, before)
    if "set_mesh" not in expected:
        assert eye.counts["meshes_built"] == 0
    assert np.allclose(after, Eye(core).wait(), rtol=1e-5, atol=1e-6)
