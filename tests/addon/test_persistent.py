# SPDX-License-Identifier: GPL-3.0-or-later
"""Persistent Data: view layers, scenes, settings and findings, and when it is freed."""

import gc
import weakref
from types import SimpleNamespace

import bpy
import pytest
from conftest import messages, new_material, part
from persistent_kit import HEAVY, brighten, edit_mesh, equal, things
from viewport_kit import furnish


def test_view_layers_with_different_things(scene, renders):
    """One depsgraph goes from layer to layer."""
    collection = bpy.data.collections.new("Left out")
    scene.collection.children.link(collection)
    scene.collection.objects.unlink(things("Ball"))
    collection.objects.link(things("Ball"))
    other = scene.view_layers.new("Other")
    other.layer_collection.children["Left out"].exclude = True
    scene.view_layers.new("Third").material_override = new_material("Black")
    before = renders()
    assert not equal(before[0], before[1])
    assert equal(renders(), before)
    edit_mesh()
    brighten()
    after = renders()
    assert not equal(after[0], before[0])
    assert equal(after, renders.fresh())


def test_another_scene_between_renders(scene, renders):
    before = renders()
    other = scene.copy()
    other.name = "Other"
    bpy.ops.render.render(scene="Other")
    edit_mesh()
    after = renders()
    assert not equal(after, before) and equal(after, renders.fresh())


def test_findings_are_said_by_each_render(scene, fake_core, monkeypatch):
    """Those of meshes and images, too, which are not looked at again."""
    furnish(scene)
    scene.render.use_persistent_data = True
    bpy.data.images["Picture"].pack()
    monkeypatch.setattr(part("sync.image"), "kind_of_space", lambda name: "UNKNOWN")
    mesh = things("Ball").data
    mesh.attributes.new("Turn", "QUATERNION", "EDGE")
    mesh.materials.append(bpy.data.materials["Tiles"])
    bpy.ops.render.render()
    fake_core.builder.attributes["Tiles"] = ["attribute:Turn"]
    said = []
    for _ in range(2):
        bpy.ops.render.render()
        said.append(messages())
    assert said[0] == said[1] and len(said[0]) == 2


def test_what_was_not_sent_to_the_end_is_sent_again(renders, monkeypatch):
    before = renders()
    edit_mesh()
    cache = part("sync.cache").SceneCache
    with monkeypatch.context() as patch:
        patch.setattr(cache, "end", lambda self: 1 / 0)
        with pytest.raises(RuntimeError, match="ZeroDivisionError"):
            bpy.ops.render.render()
    after = renders()
    assert renders.heavy == HEAVY
    assert not equal(after, before) and equal(after, renders.fresh())


def test_hierarchies_are_shared(renders):
    stats = part("render.final").last_render
    renders()
    assert stats["counts"]["meshes_built"] == 2
    things("Ball").location.x += 0.1
    renders()
    assert stats["counts"]["meshes_built"] == 0


def test_meshes_that_moved_are_sent_again(addon):
    """The core takes no motion for a mesh that it has built."""
    sent, removed = [], []
    cache = part("sync.cache").SceneCache(SimpleNamespace(remove=removed.append))
    none = part("sync.kept").NOTHING

    def sync():
        cache.begin(none)
        for number in range(2):
            cache.mesh(number, {number}, lambda key, log: sent.append(key) or True, None)
        cache.end()

    sync()
    cache.outdate({sent[0]})
    sync()
    assert removed == sent[:1] and len(sent) == 3
    sync()
    assert len(sent) == 3


def free_by_switch(scene):
    scene.render.use_persistent_data = False


def free_by_engine(scene):
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    bpy.ops.render.render()


def free_by_loading(_scene):
    bpy.ops.wm.read_factory_settings(use_empty=True)


@pytest.mark.parametrize("free", [free_by_switch, free_by_engine, free_by_loading])
def test_what_is_kept_is_freed(scene, fake_core, free):
    furnish(scene)
    scene.render.use_persistent_data = True
    bpy.ops.render.render()
    builder = weakref.ref(fake_core.builder)
    bpy.ops.render.render()
    assert builder() is fake_core.builder
    fake_core.builder = None
    assert builder() is not None
    free(scene)
    gc.collect()
    assert builder() is None


def test_settings_are_those_of_now(scene, fake_core):
    """Scripts set them, and Blender is not told."""
    furnish(scene)
    scene.render.use_persistent_data = True
    bpy.ops.render.render()
    scene.janus.samples, scene.janus.integrator = 3, "PT"
    scene.cycles.max_bounces = 7  # counts where the file has no setting of ours
    scene.janus.property_unset("max_bounces")
    scene.view_layers[0].janus.use_pass_caustics = True
    bpy.ops.render.render()
    settings = fake_core.settings
    assert (settings.samples, settings.integrator, settings.max_bounces) == (3, "pt", 7)
    assert settings.expressions


def test_settings_are_those_of_now_in_a_window(scene, fake_core):
    """There, Blender must hear of them."""
    furnish(scene)
    scene.render.use_persistent_data = True
    handlers, on_render = bpy.app.handlers.render_pre, part("engine")._on_render
    handlers.remove(on_render)
    try:
        bpy.ops.render.render()
        scene.janus.samples, scene.janus.integrator = 3, "PT"
        bpy.ops.render.render()
        assert (fake_core.settings.samples, fake_core.settings.integrator) == (3, "pt")
        bpy.ops.janus.add_light_path_expression()
        bpy.ops.render.render()
        assert len(fake_core.settings.expressions) == 1
        scene.view_layers[0].janus.expressions[0].expression = "LDE"
        bpy.ops.render.render()
        assert fake_core.settings.expressions[0][1] == "LDE"
        bpy.ops.janus.remove_light_path_expression()
        bpy.ops.render.render()
        assert not fake_core.settings.expressions
    finally:
        handlers.append(on_render)


def test_nothing_is_kept_by_default(scene, fake_core):
    bpy.ops.render.render()
    builder = weakref.ref(fake_core.builder)
    fake_core.builder = None
    gc.collect()
    assert builder() is None


def test_captures_hold_all(renders, scene, tmp_path):
    bpy.data.images["Picture"].pack()
    renders()
    scene.janus.capture_path = str(tmp_path / "scene.janus")
    renders()
    assert renders.heavy == HEAVY
    scene.janus.capture_path = ""
    edit_mesh()
    after = renders()
    assert equal(after, renders.fresh())
