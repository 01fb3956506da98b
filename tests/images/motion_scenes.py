# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: what moves while the shutter is open."""

from __future__ import annotations

SEEDS, SAMPLES = 4, 128
BOUNCES = 1

CASES = (
    "moves",
    "spins",
    "bends",
    "camera",
    "shining",
    "instances",
    "round_shutter",
    "still_objects",
    "one_layer_off",
)


def build(case: str):
    """A floor under a sky and a lamp; on it something that moves between the frames 0 and 2, at
    frame 1."""
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, 48, 32, SAMPLES)
    kit.limit_bounces(scene.cycles, BOUNCES)
    kit.world(scene, (0.4, 0.5, 0.7), 0.3)
    floor = kit.box(scene, "Floor", (12, 12, 0.2), kit.diffuse("Floor", (0.6, 0.55, 0.5)))
    floor.location = (0, 0, -0.1)
    kit.area_light(scene, "Lamp", (-1.5, -1.0, 3.0), (0.0, 0.0, 0.5), (1.0, 1.0), 120.0)
    kit.camera(scene, (0.0, -5.0, 2.2), (0.0, 0.0, 0.6), lens=35.0)
    scene.frame_set(1)
    render = scene.render
    render.use_motion_blur, render.motion_blur_shutter = True, 0.5
    globals()[f"_{case}"](scene, kit)
    return scene


def _keys(owner, name, first, last, frames=(0, 2)):
    """Goes from one value to another."""
    for frame, value in zip(frames, (first, last), strict=True):
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)


def _block(scene, kit, name="Block", size=(0.5, 0.5, 0.9), color=(0.8, 0.3, 0.1)):
    block = kit.box(scene, name, size, kit.diffuse(name, color))
    block.location = (0.0, 0.0, 0.7)
    return block


def _moves(scene, kit):
    block = _block(scene, kit)
    _keys(block, "location", (-3.0, 0.3, 0.7), (3.0, -0.3, 0.9))
    _keys(block, "scale", (1.0, 1.0, 0.6), (1.0, 1.0, 1.4))


def _spins(scene, kit):
    block = _block(scene, kit, size=(2.0, 0.3, 0.4))
    _keys(block, "rotation_euler", (0.0, 0.0, 0.0), (0.4, 0.2, 5.0))
    block.cycles.motion_steps = 3
    scene.render.motion_blur_position, scene.render.motion_blur_shutter = "START", 0.8


def _bends(scene, kit):
    import math

    import bpy

    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=0.7)
    ball = bpy.context.object
    ball.data.materials.append(kit.diffuse("Ball", (0.2, 0.6, 0.3)))
    for face in ball.data.polygons:
        face.use_smooth = True
    ball.location = (0.0, 0.0, 0.8)
    ball.shape_key_add(name="Basis")
    key = ball.shape_key_add(name="Long")
    for point in key.data:
        point.co.x *= 2.2
        point.co.z += 0.3 * math.sin(3.0 * point.co.x)
    _keys(key, "value", 0.0, 1.0)
    ball.cycles.motion_steps = 2
    ball.cycles.shadow_terminator_geometry_offset = 0.0  # which is not ours
    scene.render.motion_blur_shutter = 1.5


def _camera(scene, kit):
    _block(scene, kit)
    _keys(scene.camera, "location", (-0.8, -5.0, 2.0), (0.8, -4.6, 2.4))
    _keys(scene.camera, "rotation_euler", (1.2, 0.0, -0.3), (1.3, 0.2, 0.3))
    _keys(scene.camera.data, "lens", 30.0, 50.0)
    scene.render.motion_blur_position = "END"


def _shining(scene, kit):
    tube = kit.box(scene, "Tube", (0.2, 0.2, 0.8), kit.emission("Tube", (1.0, 0.7, 0.4), 6.0))
    _keys(tube, "location", (-2.5, 0.0, 0.9), (2.5, 0.5, 0.9))
    _keys(tube, "rotation_euler", (0.0, 0.0, 0.0), (0.0, 2.0, 0.0))
    tube.cycles.motion_steps = 2
    _block(scene, kit).location = (0.6, 1.0, 0.5)


def _instances(scene, kit):
    import bpy

    part = _block(scene, kit, "Part", (0.3, 0.3, 0.5))
    _keys(part, "rotation_euler", (0.0, 0.0, 0.0), (0.0, 1.5, 0.0))
    things = bpy.data.collections.new("Things")
    scene.collection.objects.unlink(part)
    things.objects.link(part)
    for i in range(3):
        empty = bpy.data.objects.new(f"Empty {i}", None)
        scene.collection.objects.link(empty)
        empty.instance_type, empty.instance_collection = "COLLECTION", things
        side = i - 1.0
        _keys(empty, "location", (1.2 * side, 0.0, 0.0), (1.2 * side, 0.0, 1.5 * i))


def _round_shutter(scene, kit):
    _moves(scene, kit)
    curve = scene.render.motion_blur_shutter_curve.curves[0]
    curve.points[0].location, curve.points[-1].location = (0.0, 0.0), (1.0, 0.0)
    curve.points.new(0.3, 1.0)
    scene.render.motion_blur_shutter_curve.update()


def _still_objects(scene, kit):
    _moves(scene, kit)
    _bends(scene, kit)
    scene.objects["Block"].cycles.use_motion_blur = False
    scene.objects["Sphere"].cycles.use_deform_motion = False
    _keys(scene.camera, "location", (-0.4, -5.0, 2.2), (0.4, -5.0, 2.2))
    scene.camera.cycles.use_motion_blur = False


def _one_layer_off(scene, kit):
    _moves(scene, kit)
    scene.view_layers[0].use_motion_blur = False
