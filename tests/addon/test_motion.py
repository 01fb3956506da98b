# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exporter says of motion: which times it looks at, and what it sends of them."""

import bpy
import numpy as np
import pytest
from conftest import add_light, add_square, messages, part
from fake_core import Recorder


@pytest.fixture
def moving(scene):
    """Frame 10; a square that goes by one metre in a frame along x."""
    scene.frame_set(10)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.5
    square = add_square()
    keys(square, "location", (-10, 0, 0), (10, 0, 0), (0, 20))
    return square


def keys(owner, name, first, last, frames):
    for frame, value in zip(frames, (first, last), strict=True):
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)
    for curve in curves(owner.id_data.animation_data.action):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def curves(action):
    if not hasattr(action, "layers"):  # before 4.4
        return list(action.fcurves)
    strips = [strip for layer in action.layers for strip in layer.strips]
    return [curve for strip in strips for bag in strip.channelbags for curve in bag.fcurves]


def bend(obj):
    """A shape key lifts it."""
    obj.shape_key_add(name="Basis")
    up = obj.shape_key_add(name="Up")
    for point in up.data:
        point.co.z += 1.0
    keys(up, "value", 0.0, 1.0, (9, 11))


def places(transforms):
    return [round(float(x), 5) for x in transforms[:, 0, 3]]


@pytest.mark.parametrize(
    "position, expected",
    [("CENTER", [-0.25, 0, 0.25]), ("START", [0, 0.25, 0.5]), ("END", [-0.5, -0.25, 0])],
)
def test_times_of_the_shutter(scene, moving, export, fake_core, position, expected):
    scene.render.motion_blur_position = position
    recorder = export()
    assert places(recorder.motion_of("Square")) == expected
    # The scene itself is of the centre, and Blender is left where it was.
    assert recorder.by_name()["Square"]["transform"][0, 3] == pytest.approx(expected[1])
    assert scene.frame_current == 10 and scene.frame_subframe == 0.0
    assert fake_core.settings.motion_blur
    assert recorder.camera_motion is None and recorder.shutter is None  # all alike
    assert not messages()


def test_steps_and_what_stands_still(scene, moving, export):
    add_square("Still")
    moving.cycles.motion_steps = 3
    slow = add_square("Slow")
    keys(slow, "location", (0, 0, 0), (0, 2, 0), (9, 11))
    hidden = add_square("Blurless")
    keys(hidden, "location", (0, 0, 0), (0, 2, 0), (9, 11))
    hidden.cycles.use_motion_blur = False
    recorder = export()
    assert places(recorder.motion_of("Square")) == list(np.linspace(-0.25, 0.25, 9).round(5))
    assert recorder.motion_of("Slow").shape == (3, 4, 4)
    assert recorder.motion_of("Still") is None and recorder.motion_of("Blurless") is None


def test_camera(scene, moving, export):
    keys(scene.camera, "location", (0, 0, 4), (0, 0, 8), (8, 12))
    keys(scene.camera.data, "lens", 40.0, 60.0, (8, 12))
    recorder = export()
    motion = recorder.camera_motion
    assert motion["transforms"][:, 2, 3].tolist() == pytest.approx([5.75, 6, 6.25])
    widths = [right - left for left, right, _, _ in motion["windows"]]
    assert widths == pytest.approx([36 / 48.75, 36 / 50, 36 / 51.25], rel=1e-3)
    assert recorder.camera["window"] == pytest.approx(motion["windows"][1])
    scene.camera.cycles.use_motion_blur = False
    assert export().camera_motion is None


def test_deforming_meshes(scene, moving, export):
    bend(moving)
    twin = bpy.data.objects.new("Twin", moving.data)
    scene.collection.objects.link(twin)
    recorder = export()
    key = recorder.by_name()["Square"]["mesh"]
    motion = recorder.mesh_motion[key]
    assert motion["positions"].shape == (3, 4, 3) and motion["normals"] is None
    assert motion["positions"][:, 0, 2].tolist() == pytest.approx([0.375, 0.5, 0.625])
    moving.cycles.use_deform_motion = twin.cycles.use_deform_motion = False
    assert not export().mesh_motion


@pytest.mark.parametrize("setting", ["use_deform_motion", "use_motion_blur"])
def test_who_instances_has_a_say(scene, moving, export, setting):
    bend(moving)
    things = bpy.data.collections.new("Things")
    scene.collection.objects.unlink(moving)
    things.objects.link(moving)
    empty = bpy.data.objects.new("Empty", None)
    scene.collection.objects.link(empty)
    empty.instance_type, empty.instance_collection = "COLLECTION", things
    assert export().mesh_motion
    setattr(empty.cycles, setting, False)
    recorder = export()
    assert not recorder.mesh_motion
    assert bool(recorder.instance_motion) == (setting == "use_deform_motion")


def test_topology_that_changes_is_said(scene, moving, export):
    modifier = moving.modifiers.new("Many", "SUBSURF")
    for frame, value in ((9, 1), (11, 3)):
        modifier.levels = modifier.render_levels = value
        modifier.keyframe_insert("levels", frame=frame)
        modifier.keyframe_insert("render_levels", frame=frame)
    scene.render.motion_blur_shutter = 2.0
    assert not export().mesh_motion
    assert any("'Square': its number of vertices changes" in text for text in messages())


def test_instances_go_by_who_shows_them(scene, moving, export):
    things = bpy.data.collections.new("Things")
    scene.collection.objects.unlink(moving)
    things.objects.link(moving)
    for i in range(2):
        empty = bpy.data.objects.new(f"Empty{i}", None)
        scene.collection.objects.link(empty)
        empty.instance_type, empty.instance_collection = "COLLECTION", things
        empty.location.y = 5.0 * i
        if i:
            keys(empty, "location", (0, 5, 0), (0, 5, 4), (8, 12))
            empty.cycles.motion_steps = 2
    recorder = export()
    found = sorted(recorder.instance_motion.values(), key=lambda m: m[0, 1, 3])
    assert [motion.shape[0] for motion in found] == [3, 5]
    assert found[1][:, 2, 3].tolist() == pytest.approx([1.75, 1.875, 2, 2.125, 2.25])
    assert places(found[1]) == pytest.approx([-0.25, -0.125, 0, 0.125, 0.25])


def test_shutter_curve(scene, moving, export):
    bpy.ops.render.shutter_curve_preset(shape="SHARP")
    openness = export().shutter
    assert len(openness) == 256 and openness.min() >= 0
    middle = openness[118:138].mean()
    assert openness[0] < 0.1 * middle and openness[-1] < 0.1 * middle


@pytest.mark.parametrize("how", ["scene", "layer", "shutter"])
def test_without_motion_blur(scene, moving, export, fake_core, how):
    if how == "scene":
        scene.render.use_motion_blur = False
    elif how == "layer":
        scene.view_layers[0].use_motion_blur = False
    else:
        scene.render.motion_blur_shutter = 0.0
    assert export().motion_of("Square") is None
    assert how == "shutter" or not fake_core.settings.motion_blur


def test_vector_looks_at_the_frames_around(scene, moving, export, fake_core):
    scene.render.use_motion_blur = False
    scene.render.motion_blur_position = "END"
    moving.cycles.use_motion_blur = False
    scene.view_layers[0].use_pass_vector = True
    recorder = export()
    assert places(recorder.motion_of("Square")) == [-1, 0, 1]
    assert not fake_core.settings.motion_blur and "Vector" in fake_core.settings.data_passes
    assert recorder.shutter is None


def test_cancel_leaves_the_frame(scene, moving, monkeypatch):
    """Stopped while it looks at another time."""

    class Stop(Exception):
        pass

    seen = []

    def look(*_):
        if len(seen) > 1:
            raise Stop

    monkeypatch.setattr(part("sync.motion").MotionSync, "_look", look)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    log = part("report").DiagnosticsLog()
    with pytest.raises(Stop):
        part("sync.scene_sync").sync_scene(Recorder(), depsgraph, log, set_frame=seen.append)
    assert seen == [9.75, 10.0, 10.0]


def test_lamps_stand_still(scene, moving, export):
    lamp = add_light("POINT", "Lamp")
    keys(lamp, "location", (0, 0, 0), (4, 0, 0), (9, 11))
    lights = export().by_name("lights")
    assert lights["Lamp"]["transform"][0, 3] == pytest.approx(2.0)
