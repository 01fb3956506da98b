# SPDX-License-Identifier: GPL-3.0-or-later
"""Persistent Data in animations, with and without motion blur."""

import bpy
import numpy as np
import pytest
from conftest import add_square, part
from persistent_kit import equal, things


def animate(moving=True):
    """Over frames 1 to 3: a ball that moves, and forms that change in all the ways there are."""
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    ball, twin = things("Ball"), things("Twin")
    twin.data = twin.data.copy()
    key(ball, "location", (-0.5, 0.0, 0.5), (0.5, 0.0, 0.9))
    twin.shape_key_add(name="Basis")
    up = twin.shape_key_add(name="Up")
    up.data[0].co.z += 1.0
    key(up, "value", 0.0, 1.0)


def key(owner, name, first, last):
    for frame, value in ((1, first), (3, last)):
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)


def skin():
    """A square on a bone; what an armature deforms says so in another way than shape keys."""
    square = add_square("Skin")
    square.location = (-1.2, -1.0, 0.6)
    square.vertex_groups.new(name="Bone").add([0, 1], 1.0, "REPLACE")
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    rig.data.edit_bones.new("Bone").tail = (0.0, 0.0, 1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    square.modifiers.new("Armature", "ARMATURE").object = rig
    key(rig.pose.bones["Bone"], "location", (0.0, 0.0, 0.0), (0.7, 0.0, 0.3))


def breathe():
    """A cube that Geometry Nodes make as large as the time says."""
    tree = bpy.data.node_groups.new("Breath", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    kinds = ("GeometryNodeInputSceneTime", "GeometryNodeMeshCube", "NodeGroupOutput")
    time, cube, output = map(tree.nodes.new, kinds)
    tree.links.new(time.outputs["Seconds"], cube.inputs["Size"])
    tree.links.new(cube.outputs["Mesh"], output.inputs[0])
    holder = bpy.data.objects.new("Breath", bpy.data.meshes.new("Breath"))
    holder.location = (1.0, 0.9, 0.5)
    holder.modifiers.new("Nodes", "NODES").node_group = tree
    bpy.context.scene.collection.objects.link(holder)


@pytest.fixture
def animated(renders):
    animate()
    skin()
    breathe()
    bpy.data.images["Picture"].pack()
    return renders


def film(scene, renders) -> list[np.ndarray]:
    """The pictures of an animation."""
    pictures = []
    kept = part("render.final").kept_passes

    def take(*_):
        pictures.append(np.stack([kept[layer.name]["Combined"] for layer in scene.view_layers]))

    bpy.app.handlers.render_post.append(take)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.render_post.remove(take)
    return pictures


@pytest.mark.parametrize("blur", ["", "CENTER", "START", "vectors"])
def test_animations(scene, animated, blur):
    scene.render.use_motion_blur = blur in ("CENTER", "START")
    scene.render.motion_blur_position = blur if scene.render.use_motion_blur else "CENTER"
    scene.view_layers[0].use_pass_vector = blur == "vectors"
    kept = film(scene, animated)
    scene.render.use_persistent_data = False
    alone = film(scene, animated)
    assert len(kept) == len(alone) == 3
    assert not any(equal(kept[i], kept[i + 1]) for i in range(2))
    for a, b in zip(kept, alone, strict=True):
        assert equal(a, b)


@pytest.mark.parametrize("blur", [False, True])
def test_what_stands_still_is_sent_once(scene, animated, fake_core, monkeypatch, blur):
    """The floor and the ball keep their keys; the core need not build them again."""
    monkeypatch.setattr(part("bridge"), "core", lambda: fake_core)
    scene.render.use_motion_blur = blur
    seen, moving, deformed, outdated = [], [], set(), set()
    monkeypatch.setattr(
        part("sync.cache").SceneCache, "outdate", lambda _, keys: outdated.update(keys)
    )

    def look(*_):
        recorder = fake_core.builder
        seen.append({name: item["mesh"] for name, item in recorder.by_name().items()})
        moving.append((recorder.motion_of("Ball") is not None, len(recorder.mesh_motion)))
        deformed.update(recorder.mesh_motion)

    bpy.app.handlers.render_post.append(look)
    try:
        bpy.ops.render.render(animation=True)
    finally:
        bpy.app.handlers.render_post.remove(look)
    assert moving == [(blur, 3 if blur else 0)] * 3 and outdated == deformed
    for name in ("Floor", "Ball"):
        assert len({meshes[name] for meshes in seen}) == 1
    for name in ("Twin", "Skin", "Breath"):
        assert len({meshes[name] for meshes in seen}) == 3


def test_motion_ends_with_the_setting(scene, animated):
    scene.render.use_motion_blur = True
    scene.frame_set(2)
    blurred = animated()
    scene.render.use_motion_blur = False
    sharp = animated()
    assert not equal(blurred, sharp)
    assert equal(sharp, animated.fresh())


def test_each_evaluation_is_looked_at(scene, animated, monkeypatch):
    """At the begin, in the middle of the shutter, at its three times, and at the end."""
    kept = part("sync.kept").KeptScene
    frames, note = [], kept.note

    def noting(self, depsgraph):
        frames.append(depsgraph.scene_eval.frame_current_final)
        note(self, depsgraph)

    monkeypatch.setattr(kept, "note", noting)
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_position = True, "START"
    animated()
    animated()
    times = [2.25, 2.0, 2.25, 2.5, 2.0]
    assert frames == [*times, 2.0, *times]
