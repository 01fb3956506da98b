# SPDX-License-Identifier: GPL-3.0-or-later
"""Persistent Data: what F12 sends again after an edit, and that the picture is that of a render
which sends everything."""

import bpy
import numpy as np
import pytest
from conftest import add_square, new_material, part
from persistent_kit import HEAVY, brighten, edit_mesh, equal, things


def texture():
    nodes = bpy.data.materials["Tiles"].node_tree.nodes
    return next(node for node in nodes if node.type == "TEX_IMAGE")


def move():
    things("Ball").location = (0.2, 0.6, 0.8)


def edit_mesh_and_look():
    edit_mesh()
    bpy.context.view_layer.update()
    bpy.context.scene.frame_set(7)


def add_modifier():
    things("Ball").modifiers.new("Subsurf", "SUBSURF").render_levels = 2


def simplify():
    add_modifier()
    bpy.ops.render.render()
    render = bpy.context.scene.render
    render.use_simplify, render.simplify_subdivision_render = True, 1


def add_slots():
    """The second material is on all faces but has no slot yet."""
    mesh = things("Ball").data
    mesh.materials.append(bpy.data.materials["Tiles"])
    mesh.polygons.foreach_set("material_index", [1] * len(mesh.polygons))
    mesh.update()
    bpy.ops.render.render()
    red = new_material("Red")
    nodes = red.node_tree.nodes
    shader, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    red.node_tree.links.new(shader.outputs[0], output.inputs[0])
    mesh.materials.append(red)


def remove():
    bpy.data.objects.remove(things("Twin"))


def add():
    obj = bpy.data.objects.new("Another", things("Ball").data)
    obj.location = (0.0, -0.9, 0.4)
    bpy.context.scene.collection.objects.link(obj)


def hide():
    things("Ball").hide_render = things("Twin").hide_render = True


def hide_and_show():
    hide()
    bpy.ops.render.render()
    edit_mesh()
    things("Ball").hide_render = False


def swap():
    """The data of a deleted object may come to lie where those of a new one do."""
    bpy.data.meshes.remove(things("Ball").data)
    add_square("New").location.z = 0.7


def miss_an_update():
    """A render that is refused hears of the edit, and the next does not."""
    edit_mesh()
    render = bpy.context.scene.render
    render.use_multiview = True
    with pytest.raises(RuntimeError, match="Stereoscopy"):
        bpy.ops.render.render()
    render.use_multiview = False


def look_elsewhere():
    bpy.context.scene.render.engine = "CYCLES"
    edit_mesh()
    bpy.context.scene.render.engine = "JANUS"


def paint():
    """Scripts need not tell the depsgraph."""
    bpy.data.images["Picture"].pixels.foreach_set(np.zeros(64, dtype=np.float32))


def paint_and_pack():
    paint()
    bpy.data.images["Picture"].pack()


def save_as(image, path, value):
    """The picture in a file, from which another is loaded."""
    image.pixels.foreach_set(np.full(64, value, dtype=np.float32))
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()


def replace_image():
    image = bpy.data.images["Picture"]
    image.name = "Old"
    other = bpy.data.images.new("Picture", 4, 4)
    other.generated_color = (0.0, 1.0, 0.0, 1.0)
    texture().image = other


def edit_space():
    bpy.data.images["Picture"].colorspace_settings.name = "Non-Color"


def roughen():
    nodes = bpy.data.materials["Tiles"].node_tree.nodes
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.1
    shader.inputs["Metallic"].default_value = 1.0


def override():
    white = new_material("White")
    nodes = white.node_tree.nodes
    shader, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    white.node_tree.links.new(shader.outputs[0], output.inputs[0])
    bpy.context.view_layer.material_override = white


MESH, IMAGE, NOTHING = {"set_mesh"}, {"set_image"}, set()
# What has to be sent again, or may be where nobody can be sure.
EDITS = {
    move: NOTHING,
    brighten: NOTHING,
    remove: NOTHING,
    hide: NOTHING,
    add: MESH,
    edit_mesh: MESH,
    edit_mesh_and_look: MESH,
    add_modifier: MESH,
    simplify: MESH,
    add_slots: MESH,
    hide_and_show: MESH,
    swap: MESH,
    miss_an_update: MESH,
    look_elsewhere: HEAVY,
    paint: IMAGE,
    paint_and_pack: IMAGE,
    replace_image: IMAGE,
    edit_space: IMAGE,
    roughen: IMAGE,
    override: MESH,
}


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: edit.__name__)
def test_an_edit_between_renders(renders, edit):
    bpy.data.images["Picture"].pack()
    before = renders()
    assert renders.heavy == HEAVY
    assert equal(renders(), before) and renders.heavy == NOTHING
    edit()
    after = renders()
    sent = renders.heavy
    assert sent <= EDITS[edit] and (sent or not EDITS[edit])
    assert not np.array_equal(after, before)
    assert equal(renders(), after)
    assert equal(after, renders.fresh())


def test_an_undo_between_renders(renders):
    bpy.data.images["Picture"].pack()
    bpy.ops.ed.undo_push(message="Before")
    before = renders()
    edit_mesh()
    bpy.ops.ed.undo_push(message="After")
    assert not equal(renders(), before)
    bpy.ops.ed.undo()
    assert equal(renders(), before) and renders.heavy == HEAVY
    part("sync.cache").forget_addresses()  # whatever the updates say
    assert equal(renders(), before) and renders.heavy == HEAVY
    assert equal(before, renders.fresh())


def test_images_that_are_reloaded(renders, tmp_path):
    """Their trees are updated, not they."""
    path = tmp_path / "picture.png"
    image = bpy.data.images["Picture"]
    save_as(image, path, 0.2)
    found = bpy.data.images.load(str(path))
    texture().image = found
    before = renders()
    assert equal(renders(), before) and not renders.heavy
    save_as(image, path, 0.9)
    bpy.data.images.remove(image)
    unknown = renders()  # Blender goes on with what it has read
    found.reload()
    assert found.size[0] == 4  # reads it, as an editor does that shows it
    after = renders()
    assert equal(unknown, before) and not equal(after, before)
    assert equal(after, renders.fresh())
