# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input, by a real F12 with the native core: said by name, never fatal, the rest is rendered.

Each case is put before a lit square that must be seen in the end as it is without the case.
"""

import math

import bpy
import numpy as np
import pytest
from conftest import add_light, add_mesh, add_square, messages, new_material, part
from test_final import result_pixels, stop_when

NAN, INFINITE = math.nan, math.inf
FAR = 1e30  # metres: squares of it do not fit in single precision


@pytest.fixture
def lit(scene, core):
    """A square under a lamp, right in front of the camera."""
    add_square("Floor")
    lamp = add_light("POINT", "Lamp")
    lamp.location, lamp.data.energy = (0, 0, 3), 500.0
    scene.janus.samples, scene.janus.seed = 4, 1
    return scene


def render() -> np.ndarray:
    bpy.ops.render.render()
    pixels = result_pixels()
    assert np.isfinite(pixels).all()
    return pixels


def floor_brightness() -> float:
    return float(render()[4:8, 6:10, :3].mean())


def apart(obj):
    """Out of the way of the light on the floor, but in the picture's scene."""
    obj.location.x = 30.0
    return obj


def no_faces(scene):
    add_mesh("Bad", [], [])
    add_mesh("Bad points", [(0, 0, 1)], [])


def no_material(scene):
    apart(add_square("Bad"))


def empty_slots(scene):
    square = apart(add_square("Bad"))
    for _ in range(3):
        square.data.materials.append(None)
    square.data.polygons[0].material_index = 2


def slot_out_of_range(scene):
    square = apart(add_square("Bad"))
    for _ in range(2):
        square.data.materials.append(None)
    square.data.polygons[0].material_index = 30000


def vertex_not_a_number(scene):
    apart(add_mesh("Bad", [(0, 0, 0), (1, 0, 0), (0, NAN, 0)], [(0, 1, 2)]))


def vertex_infinite(scene):
    apart(add_mesh("Bad", [(0, 0, 0), (1, 0, 0), (0, INFINITE, 0)], [(0, 1, 2)]))


def vertex_far(scene):
    apart(add_mesh("Bad", [(0, 0, 0), (1, 0, 0), (0, FAR, 0)], [(0, 1, 2)]))


def no_area(scene):
    apart(add_mesh("Bad", [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))
    apart(add_mesh("Bad too", [(1, 1, 1)] * 3, [(0, 1, 2)]))


def emitter_without_area(scene):
    material = new_material("Glow")
    tree = material.node_tree
    emission, output = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("Emission", "OutputMaterial")
    )
    tree.links.new(emission.outputs[0], output.inputs[0])
    bad = apart(add_mesh("Bad", [(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))
    bad.data.materials.append(material)


def scaled_to_nothing(scene):
    add_square("Bad").scale = (0, 0, 0)


def scaled_flat(scene):
    apart(add_square("Bad")).scale = (1, 1, 0)


def scale_not_a_number(scene):
    add_square("Bad").scale = (1, NAN, 1)


def placed_far(scene):
    add_square("Bad").location = (FAR, 0, 0)
    add_light("SUN", "Sun").data.energy = 1e-4  # its light paths start on a disk around everything


def lamps_without_size(scene):
    for kind in ("POINT", "SPOT", "SUN", "AREA"):
        lamp = add_light(kind, f"Bad {kind}")
        lamp.location, lamp.data.energy = (0, 0, -2), 1e-6  # behind the floor
        lamp.rotation_euler.x = math.pi
        if kind == "AREA":
            lamp.data.size = 0.0
        elif kind == "SUN":
            lamp.data.angle = 0.0
        else:
            lamp.data.shadow_soft_size = 0.0


def lamps_without_power(scene):
    for kind in ("POINT", "SPOT", "SUN", "AREA"):
        add_light(kind, f"Bad {kind}").data.energy = 0.0


def lamps_not_a_number(scene):
    add_light("POINT", "Bad power").data.energy = NAN
    add_light("AREA", "Bad place").location = (NAN, 0, 0)
    add_light("SUN", "Bad scale").scale = (0, 0, 0)
    add_light("SPOT", "Bad beam").scale = (1, 1, 0)
    add_light("POINT", "Bad size").data.shadow_soft_size = NAN


def negative_lamp(scene):
    add_light("POINT", "Bad").data.energy = -10.0


def no_world(scene):
    scene.world = None


def world_without_output(scene):
    scene.world = bpy.data.worlds.new("Bad world")
    if bpy.app.version < (5, 0, 0):
        scene.world.use_nodes = True
    scene.world.node_tree.nodes.clear()


def material_without_output(scene):
    apart(add_square("Bad")).data.materials.append(new_material("Bad material"))


def lamp_without_output(scene):
    lamp = add_light("POINT", "Bad").data
    if lamp.node_tree is None or bpy.app.version < (5, 0, 0):
        lamp.use_nodes = True
    lamp.node_tree.nodes.clear()


def unsupported_node(scene):
    material = new_material("Bad material")
    nodes = material.node_tree.nodes
    portal, output = nodes.new("ShaderNodeBsdfRayPortal"), nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(portal.outputs[0], output.inputs[0])
    apart(add_square("Bad")).data.materials.append(material)


def volume_and_displacement(scene):
    material = new_material("Bad material")
    nodes = material.node_tree.nodes
    output = nodes.new("ShaderNodeOutputMaterial")
    for kind, socket in (("VolumeScatter", "Volume"), ("Displacement", "Displacement")):
        made = nodes.new(f"ShaderNode{kind}")
        material.node_tree.links.new(made.outputs[0], output.inputs[socket])
    material.displacement_method = "DISPLACEMENT"
    apart(add_square("Bad")).data.materials.append(material)


def volume_object(scene):
    scene.collection.objects.link(bpy.data.objects.new("Bad", bpy.data.volumes.new("Bad")))


# The case, and what has to be said (nothing: the case is no fault, or not a visible one).
CASES = {
    no_faces: (),
    no_material: (),
    empty_slots: (),
    slot_out_of_range: (),
    vertex_not_a_number: ("Object 'Bad': 1 triangle",),
    vertex_infinite: ("Object 'Bad': 1 triangle",),
    vertex_far: (),
    no_area: (),
    emitter_without_area: (),
    scaled_to_nothing: ("Object 'Bad': its transform is flat",),
    scaled_flat: ("Object 'Bad': its transform is flat",),
    scale_not_a_number: ("Object 'Bad': its transform is flat or not finite",),
    placed_far: (),
    lamps_without_size: ("Object 'Bad AREA': an area light without an area",),
    lamps_without_power: (),
    lamps_not_a_number: (
        "Object 'Bad power': its power is not finite",
        "Object 'Bad place': its transform is not finite",
        "Object 'Bad scale': its direction",
        "Object 'Bad beam': a spot light that is scaled to nothing",
        "Object 'Bad size': its radius is not finite",
    ),
    negative_lamp: ("Object 'Bad': negative light",),
    no_world: (),
    world_without_output: (),
    material_without_output: ("Material 'Bad material': there is no active output",),
    lamp_without_output: (),
    unsupported_node: ("Material 'Bad material', node 'Ray Portal BSDF'",),
    volume_and_displacement: (
        "Material 'Bad material': volumes",
        "Material 'Bad material', node 'Material Output': displacement",
    ),
    volume_object: ("Object 'Bad': volumes",),
}


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.__name__)
def test_bad_input(lit, case):
    expected = floor_brightness()
    assert messages() == [] and expected > 0.1
    case(lit)
    seen = floor_brightness()
    assert messages("ERROR") == []
    said = messages()
    for words in CASES[case]:
        assert any(words in message for message in said), said
    assert CASES[case] or said == []
    # Four samples of two different sets of paths: other lamps and floors change what is drawn.
    assert seen == pytest.approx(expected, rel=0.2)


@pytest.mark.parametrize("case", [volume_object, volume_and_displacement])
def test_what_is_left_out_is_in_the_banner(lit, case):
    banner_text = part("ui.diagnostics").banner_text
    render()
    assert banner_text(bpy.context) == ""
    case(lit)
    render()
    assert "left out" in banner_text(bpy.context)


def test_no_camera(lit):
    lit.camera = None
    with pytest.raises(RuntimeError, match="[Cc]amera"):
        bpy.ops.render.render()


def test_degenerate_camera_is_named(lit):
    lit.camera.data.clip_start = 2000.0
    with pytest.raises(RuntimeError, match="Camera.*clipping range"):
        bpy.ops.render.render()
    assert result_pixels().shape == (12, 16, 4)


@pytest.mark.parametrize("border", [(0.5, 0.5, 0.5, 0.5), (0.5, 0.501, 0.5, 0.501)])
def test_empty_border(lit, border):
    """Blender itself refuses a border without pixels."""
    lit.render.use_border = True
    (
        lit.render.border_min_x,
        lit.render.border_max_x,
        lit.render.border_min_y,
        lit.render.border_max_y,
    ) = border
    with pytest.raises(RuntimeError, match="Image too small|[Bb]order"):
        bpy.ops.render.render()
    lit.render.use_border = False
    assert floor_brightness() > 0.1


@pytest.mark.parametrize("polls", [0, 1, 2, 3, 4, 6, 8, 12])
def test_escape_at_any_moment(lit, monkeypatch, polls):
    """The n-th time that Blender is asked whether the user has pressed Escape, he has."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=256)
    lit.janus.samples = 1 << 20
    asked = 0

    def pressed():
        nonlocal asked
        asked += 1
        return asked > polls

    stop_when(monkeypatch, pressed)
    pixels = render()
    assert pixels.shape == (12, 16, 4) and messages("ERROR") == []
    stats = part("render.final").last_render
    assert not stats or stats["cancelled"]
