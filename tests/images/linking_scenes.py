# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: light and shadow linking."""

from __future__ import annotations

SEEDS, SAMPLES = 4, 128
BOUNCES = 2

# Who lights what is said in build().
CASES = (
    "included",
    "excluded",
    "emitter",
    "sun",
    "blockers",
    "blocked_but",
    "both",
    "instances",
    "no_blocker",
)


def build(case: str):
    """Three things on a floor, with two lamps: a soft and a strong one, and a little sky."""
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, 48, 32, SAMPLES)
    kit.limit_bounces(scene.cycles, BOUNCES)
    kit.world(scene, (0.4, 0.5, 0.7), 0.2)
    floor = kit.box(scene, "Floor", (12, 12, 0.2), kit.diffuse("Floor", (0.6, 0.55, 0.5)))
    floor.location = (0, 0, -0.1)
    colors = {"Left": (0.8, 0.2, 0.1), "Middle": (0.2, 0.7, 0.2), "Right": (0.1, 0.2, 0.8)}
    for i, (name, color) in enumerate(colors.items()):
        block = kit.box(scene, name, (0.6, 0.6, 1.0), kit.diffuse(name, color))
        block.location = (1.3 * (i - 1), 0.0, 0.5)
    soft = kit.area_light(scene, "Soft", (-1.5, -2.0, 3.0), (0, 0, 0.5), (1.5, 1.5), 60.0)
    strong = bpy.data.objects.new("Strong", bpy.data.lights.new("Strong", "POINT"))
    strong.data.energy, strong.data.shadow_soft_size = 120.0, 0.1
    strong.location = (2.0, -1.5, 2.5)
    scene.collection.objects.link(strong)
    kit.camera(scene, (0.0, -5.5, 2.4), (0.0, 0.0, 0.6), lens=35.0)
    globals()[f"_{case}"](scene, kit, soft, strong)
    return scene


def _collection(light, kind, included=(), excluded=()):
    """A collection of what the light lights ("receiver"), or is blocked by ("blocker")."""
    import bpy

    made = bpy.data.collections.new(f"{kind} of {light.name}")
    setattr(light.light_linking, f"{kind}_collection", made)
    for state, objects in (("INCLUDE", included), ("EXCLUDE", excluded)):
        for obj in objects:
            made.objects.link(obj)
            made.collection_objects[-1].light_linking.link_state = state
    return made


def _named(scene, *names):
    return [scene.objects[name] for name in names]


def _included(scene, _kit, soft, strong):
    _collection(strong, "receiver", _named(scene, "Middle", "Floor"))


def _excluded(scene, _kit, soft, strong):
    _collection(strong, "receiver", (), _named(scene, "Middle"))
    _collection(soft, "receiver", (), _named(scene, "Floor", "Left"))


def _emitter(scene, kit, soft, strong):
    """A surface that shines on one thing; a mirror that it does not shine on does not show it."""
    lamp = kit.box(scene, "Lamp", (0.8, 0.1, 0.5), kit.emission("Lamp", (1.0, 0.8, 0.5), 8.0))
    lamp.location = (0.6, -1.4, 0.4)
    _collection(lamp, "receiver", _named(scene, "Right"))
    mirror = kit.shader("Mirror", "BsdfGlossy", Color=(0.8, 0.8, 0.8, 1.0), Roughness=0.0)
    scene.objects["Middle"].data.materials[0] = mirror


def _sun(scene, _kit, soft, strong):
    """Cycles' light tree makes a linked sun too bright."""
    import bpy

    scene.cycles.use_light_tree = False

    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 2.0, 0.1, (0.7, 0.3, 0.0)
    scene.collection.objects.link(sun)
    _collection(sun, "receiver", _named(scene, "Left", "Floor"))
    _collection(sun, "blocker", _named(scene, "Right"))


def _blockers(scene, _kit, soft, strong):
    _collection(strong, "blocker", _named(scene, "Left"))


def _blocked_but(scene, kit, soft, strong):
    """The lamp is the surface of an object; what lets its light pass lets that of others not."""
    lamp = kit.box(scene, "Lamp", (0.5, 0.5, 0.1), kit.emission("Lamp", (1.0, 0.8, 0.5), 12.0))
    lamp.location = (1.2, -1.2, 2.0)
    _collection(lamp, "blocker", (), _named(scene, "Right"))
    _collection(soft, "blocker", (), _named(scene, "Left", "Middle"))


def _both(scene, _kit, soft, strong):
    _collection(strong, "receiver", _named(scene, "Floor"))
    _collection(strong, "blocker", _named(scene, "Middle"))
    _collection(soft, "receiver", (), _named(scene, "Floor"))


def _instances(scene, _kit, soft, strong):
    """Children of the collection are as it is; instances go by what they show."""
    import bpy

    pair = bpy.data.collections.new("Pair")
    for obj in _named(scene, "Left", "Right"):
        scene.collection.objects.unlink(obj)
        pair.objects.link(obj)
    for i in range(2):
        empty = bpy.data.objects.new(f"Empty {i}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", pair
        empty.location = (0.0, 1.6 * i, 0.0)
        scene.collection.objects.link(empty)
    receivers = _collection(strong, "receiver", _named(scene, "Floor"))
    group = bpy.data.collections.new("Group")
    group.objects.link(scene.objects.get("Left") or bpy.data.objects["Left"])
    receivers.children.link(group)


def _no_blocker(scene, _kit, soft, strong):
    """A collection that nothing is in blocks everything; a lamp without shadows stays one."""
    _collection(strong, "blocker")
    soft.data.use_shadow = False
    _collection(soft, "blocker", _named(scene, "Left"))
