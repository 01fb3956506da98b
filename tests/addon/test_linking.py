# SPDX-License-Identifier: GPL-3.0-or-later
"""Light linking as the exporter sends it: sets of lights, and what is in none of them."""

import bpy
import pytest
from conftest import add_light, add_square, messages


def link(light, kind, included=(), excluded=()):
    made = bpy.data.collections.new(kind)
    setattr(light.light_linking, f"{kind}_collection", made)
    for state, objects in (("INCLUDE", included), ("EXCLUDE", excluded)):
        for obj in objects:
            made.objects.link(obj)
            made.collection_objects[-1].light_linking.link_state = state
    return made


def links(item):
    names = ("receiver_set", "blocker_set", "unlit_by", "lets_pass")
    return {name: item[name] for name in names if name in item}


def found(recorder, name):
    kind = "lights" if name in recorder.by_name("lights") else "instances"
    return links(recorder.by_name(kind)[name])


def test_nothing_is_linked(scene, export):
    add_square(), add_light("POINT", "Lamp")
    recorder = export()
    assert found(recorder, "Square") == found(recorder, "Lamp") == {}


def test_included_and_excluded(scene, export):
    a, b, c = (add_square(name) for name in "ABC")
    link(add_light("POINT", "One"), "receiver", [a], [b])
    link(add_light("SUN", "Other"), "receiver", (), [c])
    recorder = export()
    one, other = (found(recorder, name)["receiver_set"] for name in ("One", "Other"))
    assert {one, other} == {0, 1}
    assert found(recorder, "A") == {}
    assert found(recorder, "B") == {"unlit_by": [one]}
    assert found(recorder, "C") == {"unlit_by": [0, 1]}
    assert not messages()


def test_lights_of_one_collection_are_one_set(scene, export):
    square = add_square()
    lamps = [add_light("POINT", f"Lamp {i}") for i in range(3)]
    shared = link(lamps[0], "blocker", [square])
    lamps[1].light_linking.blocker_collection = shared
    add_square("Other")
    recorder = export()
    assert [found(recorder, lamp.name) for lamp in lamps] == [{"blocker_set": 0}] * 2 + [{}]
    assert found(recorder, "Square") == {}
    assert found(recorder, "Other") == {"lets_pass": [0]}


def test_surfaces_shine_too(scene, export):
    lamp, wall = add_square("Lamp"), add_square("Wall")
    link(lamp, "receiver", [wall])
    recorder = export()
    assert found(recorder, "Lamp") == {"receiver_set": 0, "unlit_by": [0]}
    assert found(recorder, "Wall") == {}


def test_children_and_instances(scene, export):
    """Children of a collection are included or excluded whole; instances are what they show, or
    else who shows them."""
    part, lone = add_square("Part"), add_square("Lone")
    things = bpy.data.collections.new("Things")
    scene.collection.objects.unlink(part)
    things.objects.link(part)
    empty = bpy.data.objects.new("Empty", None)
    scene.collection.objects.link(empty)
    empty.instance_type, empty.instance_collection = "COLLECTION", things
    receivers = link(add_light("POINT", "Lamp"), "receiver")
    child = bpy.data.collections.new("Child")
    child.objects.link(lone)
    receivers.children.link(child)
    assert found(export(), "Part") == {"unlit_by": [0]}
    assert found(export(), "Lone") == {}
    receivers.objects.link(empty)
    assert found(export(), "Part") == {}
    receivers.collection_children[0].light_linking.link_state = "EXCLUDE"
    assert found(export(), "Lone") == {"unlit_by": [0]}


def test_lamps_that_are_shown_by_instances_alone(scene, export):
    square, lamp = add_square(), add_light("POINT", "Lamp")
    add_square("Other")
    scene.collection.objects.unlink(lamp)
    things = bpy.data.collections.new("Things")
    things.objects.link(lamp)
    empty = bpy.data.objects.new("Empty", None)
    scene.collection.objects.link(empty)
    empty.instance_type, empty.instance_collection = "COLLECTION", things
    link(lamp, "receiver", [square])
    recorder = export()
    assert found(recorder, "Lamp") == {"receiver_set": 0}
    assert found(recorder, "Square") == {} and found(recorder, "Other") == {"unlit_by": [0]}


@pytest.mark.parametrize("kind, most", [("receiver", 63), ("blocker", 24)])
def test_too_many_sets_are_said(scene, export, kind, most):
    square = add_square()
    for i in range(most + 1):
        link(add_light("POINT", f"Lamp {i:02}"), kind, (), [square])
    recorder = export()
    sets = [found(recorder, name) for name in recorder.by_name("lights")]
    assert sorted(item[f"{kind}_set"] for item in sets if item) == list(range(most))
    assert len([text for text in messages() if f"more than {most} lights" in text]) == 1
