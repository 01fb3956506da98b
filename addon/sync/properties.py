# SPDX-License-Identifier: GPL-3.0-or-later
"""What Attribute nodes find outside of meshes: properties of objects, instancers and view layers.

As in Cycles: a custom property of that name, else what lies behind the RNA path.
"""

from mathutils import Color, Euler, Quaternion, Vector

NOT_FOUND = (0.0, 0.0, 0.0, 0.0)
NO_INDEX = 2**31 - 1  # fills what persistent_id does not use
# The kinds of the keys of set_material() that are the instance's, not the mesh's.
OF_OBJECT = ("object:",)
OF_INSTANCE = ("instancer:", "dupli_generated", "dupli_uv", "particle:")


def object_attributes(obj, keys) -> dict:
    """The values of the keys that all instances of an object share."""
    names = [key.removeprefix("object:") for key in keys if key.startswith(OF_OBJECT)]
    return {f"object:{name}": _first((obj, obj.data), name) for name in names}


class InstanceProperties:
    """What instances have of their own, by the keys of set_material()."""

    def __init__(self, frame: float, log):
        self._frame = frame
        self._log = log
        self._stored = {}  # (address of an instancer, name) -> values by the number of the instance

    def attributes(self, instance, keys) -> dict:
        """The values of the keys that each instance has of its own."""
        found = {}
        for key in keys:
            if key == "dupli_generated" and instance.is_instance:
                found[key] = (*(0.5 * x - 0.5 for x in instance.orco), 1.0)
            elif key == "dupli_uv" and instance.is_instance:
                found[key] = (*instance.uv, 0.0, 1.0)
            elif key.startswith("particle:"):
                found |= self._of_particle(instance, key)
            elif key.startswith("instancer:"):
                found[key] = self._of_instancer(instance, key.removeprefix("instancer:"))
        return found

    def _of_particle(self, instance, key: str) -> dict:
        """What the node Particle Info reads. Children have nothing, as in Cycles."""
        system = instance.particle_system if instance.is_instance else None
        index = instance.persistent_id[0]
        if system is None or not 0 <= index < len(system.particles):
            return {}
        particle = system.particles[index]
        if key == "particle:times":
            return {key: (float(index), self._frame - particle.birth_time, 0.0, 1.0)}
        value = getattr(particle, key.removeprefix("particle:"))
        return {key: (value, 0.0, 0.0, 1.0) if isinstance(value, float) else (*value, 1.0)}

    def _of_instancer(self, instance, name: str) -> tuple:
        obj = instance.object
        if not instance.is_instance:
            return _first((obj, obj.data), name)
        particles = instance.particle_system
        if particles is not None:
            value = rgba(particles.settings, name)
            if value is not None:
                return value
        value = self._of_geometry(instance, name)
        if value is not None:
            return value
        return _first((instance.parent, obj, obj.data), name)

    def _of_geometry(self, instance, name: str) -> tuple | None:
        """What Geometry Nodes stored on the instance."""
        parent = instance.parent
        if not any(modifier.type == "NODES" for modifier in parent.modifiers):
            return None
        key = (parent.as_pointer(), name)
        if key not in self._stored:
            self._stored[key] = self._read_geometry(parent, name)
        values = self._stored[key]
        if values is None:
            return None
        _, number, nested = list(instance.persistent_id)[:3]
        if nested != NO_INDEX:
            self._log.warning(
                f"the attribute '{name}' of instances in instances is not supported, properties "
                "are looked for",
                object=parent.name,
            )
            return None
        return values[number]

    def _read_geometry(self, parent, name: str) -> list | None:
        if not hasattr(parent, "evaluated_geometry"):  # before Blender 4.5
            self._log.warning(
                f"what Geometry Nodes store on instances as '{name}' is not known in this version "
                "of Blender, properties are looked for",
                object=parent.name,
            )
            return None
        geometry = parent.evaluated_geometry()
        cloud = geometry.instances_pointcloud()
        attribute = cloud.attributes.get(name) if cloud else None
        if attribute is None or not len(attribute.data):
            return None
        first = attribute.data[0]
        field = next((f for f in ("value", "vector", "color") if hasattr(first, f)), None)
        values = [_as_rgba(getattr(element, field)) for element in attribute.data] if field else []
        return values if values and values[0] is not None else None


def view_layer_value(depsgraph, name: str) -> tuple:
    """What an Attribute node of type View Layer reads."""
    scene = depsgraph.scene_eval
    return _first((depsgraph.view_layer_eval, scene, scene.world), name)


def _first(owners, name: str) -> tuple:
    values = (rgba(owner, name) for owner in owners if owner is not None)
    return next((value for value in values if value is not None), NOT_FOUND)


def rgba(owner, name: str) -> tuple | None:
    """A property of an ID or a view layer as four numbers; None: it has none, or no numbers."""
    try:
        if name in owner.keys():  # noqa: SIM118 (in would ask for a path)
            return _as_rgba(owner[name])
    except TypeError:  # no ID properties
        pass
    try:
        value = owner.path_resolve(name)
        # Blender looks up properties, not their components.
        stem = name.rpartition(".")[0] if name[-1:] in "xyzwrgba" else name.rpartition("[")[0]
        if stem and isinstance(value, float | int) and _is_array(owner, stem):
            return None
    except (ValueError, TypeError, AttributeError):
        return None
    return _as_rgba(value)


def _is_array(owner, path: str) -> bool:
    try:
        return _numbers(owner.path_resolve(path)) is not None
    except (ValueError, TypeError, AttributeError):
        return False


def _as_rgba(value) -> tuple | None:
    if isinstance(value, float | int):  # bool, too
        return (float(value),) * 3 + (1.0,)
    numbers = _numbers(value)
    if numbers is None or not 1 <= len(numbers) <= 4:
        return None
    if any(isinstance(x, bool) or not isinstance(x, float | int) for x in numbers):
        return None
    default = (0.0, 0.0, 0.0, 1.0)
    return tuple(map(float, numbers)) + default[len(numbers) :]


def _numbers(value) -> list | None:
    """The elements of an array of numbers."""
    if isinstance(value, Vector | Color | Euler | Quaternion):
        return list(value)
    kind = type(value).__name__
    return list(value) if kind in ("bpy_prop_array", "IDPropertyArray") else None
