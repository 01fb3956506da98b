# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that the depsgraph shows: objects, their instances, and the lights among them."""

import numpy as np

from .curves import HAIR, curves_arrays, hair_systems, particle_hair, points_arrays
from .light import sync_light
from .linking import Linking
from .mesh import mesh_arrays
from .properties import OF_INSTANCE, OF_OBJECT, InstanceProperties, object_attributes
from .visibility import (
    SHAPE_TYPES,
    UNSUPPORTED_TYPES,
    check_object,
    is_shadow_catcher,
    light_group,
    surface_seen_by,
)

MASK = 0xFFFFFFFF  # of 32 bits
POLL_EVERY = 64  # instances of what is known


class InstanceSync:
    """Walks depsgraph.object_instances once and sends what it finds."""

    def __init__(self, builder, materials, images, cache, log, poll, motion=None):
        self._builder = builder
        self._cache = cache
        self._materials = materials
        self._images = images
        self._log = log
        self._poll = poll
        self._motion = motion
        self._kinds = {}  # addresses of an object, its data and who shows it -> arguments
        self._checked = set()  # addresses of objects
        self._hairy = {}  # the same -> whether hair grows on it
        self._senders = {
            "MESH": self._send_mesh,
            "CURVES": self._send_curves,
            "POINTCLOUD": self._send_points,
        }
        self._attributes = {}  # key of a mesh -> those that it was sent with

    def run(self, depsgraph, shown=None) -> None:
        """`shown`: of an original object, whether it is part of the picture."""
        self._depsgraph = depsgraph
        self._properties = InstanceProperties(depsgraph.scene_eval.frame_current_final, self._log)
        self._linking = Linking(depsgraph, self._log)
        self._viewport = depsgraph.mode == "VIEWPORT"
        layer = self._view_layer = depsgraph.view_layer
        self._strands = layer.use_strand
        self._shown = {"MESH": layer.use_solid, "CURVES": layer.use_strand, "POINTCLOUD": True}
        # What passes read of meshes, whatever the materials.
        self._of_passes = frozenset(["uv:"] if self._view_layer.use_pass_uv else [])
        for number, instance in enumerate(depsgraph.object_instances):
            if number % POLL_EVERY == 0:
                self._poll()
            obj = instance.object  # transient: nothing of it may be kept
            origin = obj.original.as_pointer()
            if origin not in self._checked:
                self._checked.add(origin)
                self._check(obj)
            if not (shown is None or shown(owner_of(instance).original)):
                continue
            kind = obj.type
            if (
                kind == "MESH"
                and instance.show_particles
                and self._grows_hair(instance, obj, origin)
            ):
                self._surface(instance, obj, origin, HAIR)
            if not instance.show_self:
                continue
            if self._shown.get(kind):
                self._surface(instance, obj, origin)
            elif kind == "LIGHT":
                key = self._cache.place("light")
                matrix = instance.matrix_world
                owner = owner_of(instance)
                links = self._linking.of_light(obj, owner)
                links["lights_catchers"] = is_shadow_catcher(obj, owner)
                sync_light(
                    self._builder, key, obj, matrix, depsgraph, self._images, links, self._log
                )
            elif kind in UNSUPPORTED_TYPES:
                self._log.warning(UNSUPPORTED_TYPES[kind], object=obj.name)

    def _grows_hair(self, instance, obj, origin: int) -> bool:
        if origin not in self._hairy:
            self._hairy[origin] = self._strands and bool(hair_systems(obj, self._viewport))
        return self._hairy[origin] and not made_by_nodes(instance)

    def _surface(self, instance, obj, origin: int, part: str = "") -> None:
        # Instances may be a million: what they have in common is read once, and what Blender makes
        # anew at each look (objects, matrices) is looked at once.
        owner = instance.parent if instance.is_instance else obj
        kind = (origin, obj.data.as_pointer(), owner.as_pointer() if owner is not obj else 0, part)
        if kind not in self._kinds:
            self._poll()
            self._kinds[kind] = self._arguments(instance, part)
        arguments, own_keys = self._kinds[kind]
        if arguments is None:
            return
        if own_keys:
            own = self._properties.attributes(instance, own_keys)
            arguments = arguments | {"attributes": arguments["attributes"] | own}
        key = self._cache.place("instance")
        arguments["transform"] = np.array(instance.matrix_world, dtype=np.float64)
        arguments["random"] = object_random(obj, instance.random_id)
        self._builder.set_instance(key, **arguments)
        if self._motion:
            mesh = arguments["mesh"]
            attributes = self._attributes[mesh]
            self._motion.saw(instance, owner, key, mesh, attributes, part, self._depsgraph)

    def _arguments(self, instance, part: str) -> tuple[dict | None, list[str]]:
        """Those of set_instance that all instances of a kind share (None: there are no faces), and
        the keys of the attributes that each has of its own.
        """
        obj = instance.object
        materials = self._materials.keys(obj)
        keys = self._materials.attributes(materials) | self._of_passes
        of_mesh = frozenset(key for key in keys if not key.startswith(OF_OBJECT + OF_INSTANCE))
        mesh = self._shape(obj, owner_of(instance), of_mesh, part)
        if mesh is None:
            return None, []
        shared = {
            "name": obj.name,
            "mesh": mesh,
            "materials": materials,
            "color": tuple(obj.color),
            "object_index": obj.pass_index,
            "light_group": light_group(obj, self._view_layer),
            "asset": asset_name(obj),
            "attributes": object_attributes(obj, keys),
            **surface_seen_by(instance, self._view_layer),
            **self._linking.of_light(obj, owner_of(instance)),
            **self._linking.of_object(obj, owner_of(instance)),
        }
        return shared, [key for key in keys if key.startswith(OF_INSTANCE)]

    def _shape(self, obj, owner, attributes: frozenset[str], part: str) -> str | None:
        """The key of the object's geometry, which is sent on first sight.

        Geometry goes by its evaluated mesh, which is shared by all who show it unchanged. Names
        would be wrong: instances made by Geometry Nodes carry the name of their maker.
        """
        identity = (obj.data.as_pointer(), attributes)
        if part == HAIR:  # is the object's, whoever else has its mesh
            identity = (obj.original.as_pointer(), attributes, part)
        sources = {item.original.as_pointer() for item in (obj, obj.data, owner)}
        send = self._send_hair if part == HAIR else self._senders[obj.type]
        key = self._cache.mesh(
            identity, sources, lambda key, log: send(key, obj, attributes, log), self._log
        )
        self._attributes[key] = attributes
        return key

    def _send_mesh(self, key: str, obj, attributes: frozenset[str], log) -> bool:
        try:
            arrays = mesh_arrays(obj.to_mesh(), len(obj.material_slots), attributes, log)
            if arrays is None:
                return False
            self._builder.set_mesh(key, name=obj.data.name, **arrays)
            return True
        finally:
            obj.to_mesh_clear()

    def _send_curves(self, key: str, obj, attributes: frozenset[str], log) -> bool:
        arrays = curves_arrays(obj.data, attributes, log)
        if arrays is not None:
            self._builder.set_curves(key, name=obj.data.name, **arrays)
        return arrays is not None

    def _send_points(self, key: str, obj, attributes: frozenset[str], log) -> bool:
        arrays = points_arrays(obj.data, attributes, log)
        if arrays is not None:
            self._builder.set_points(key, name=obj.data.name, **arrays)
        return arrays is not None

    def _send_hair(self, key: str, obj, attributes: frozenset[str], _log) -> bool:
        arrays = particle_hair(obj, self._viewport, attributes, len(obj.material_slots))
        if arrays is not None:
            self._builder.set_curves(key, name=obj.name, **arrays)
        return arrays is not None

    def _check(self, obj) -> None:
        """Looks for unsupported settings."""
        if obj.type in SHAPE_TYPES:
            check_object(obj, self._depsgraph.scene_eval, self._log)


def owner_of(instance):
    """The object that shows an instance: itself, or what instances it."""
    return instance.parent if instance.is_instance else instance.object


def made_by_nodes(instance) -> bool:
    """Is what it shows not its object's own, but made by a modifier?"""
    obj = instance.object
    real = instance.instance_object if instance.is_instance else obj
    return real.data is None or real.data.as_pointer() != obj.data.as_pointer()


def asset_name(obj) -> str:
    """Cryptomatte's assets: a thing and all that hangs on it."""
    while obj.parent is not None:
        obj = obj.parent
    return obj.name


def object_random(obj, random_id: int) -> float:
    """The number that Object Info calls Random. Instances have one; objects go by their name."""
    return (random_id or hash_name(obj.name)) / 0xFFFFFFFF


def hash_name(name: str) -> int:
    """Cycles' hash of a name: 37 to the power of the place, then one round of Jenkins' lookup3."""
    text = 0
    for byte in name.encode():
        text = (text * 37 + byte) & MASK
    a = b = c = (0xDEADBEEF + (2 << 2) + 13) & MASK
    a = (a + text) & MASK
    c = ((c ^ b) - _rotate(b, 14)) & MASK
    a = ((a ^ c) - _rotate(c, 11)) & MASK
    b = ((b ^ a) - _rotate(a, 25)) & MASK
    c = ((c ^ b) - _rotate(b, 16)) & MASK
    a = ((a ^ c) - _rotate(c, 4)) & MASK
    b = ((b ^ a) - _rotate(a, 14)) & MASK
    return ((c ^ b) - _rotate(b, 24)) & MASK


def _rotate(x: int, bits: int) -> int:
    return (x << bits | x >> (32 - bits)) & MASK
