# SPDX-License-Identifier: GPL-3.0-or-later
"""Light and shadow linking: lights that shine on some objects only, or are blocked by some only.

The collection of a light says which objects it lights. Those that are to be included are lit, or if
there are none, all but those that are to be excluded. Blender works this out for Cycles, but shows
it to no script.
"""

from dataclasses import dataclass, field

import bpy

# Of sets of lights; of the core.
MOST = {"receiver": 63, "blocker": 24}


@dataclass
class _Set:
    """The lights of one collection."""

    number: int
    included: set[int] = field(default_factory=set)  # addresses of original objects
    excluded: set[int] = field(default_factory=set)

    def has(self, *addresses: int) -> bool:
        """Is an object of the collection's? `addresses`: its own, then that of who instances it."""
        for address in addresses:
            if address in self.excluded:
                return False
            if address in self.included:
                return True
        return not self.included


class Linking:
    """The sets of lights of a scene, and who is in them."""

    def __init__(self, depsgraph, log):
        self._sets = {kind: {} for kind in MOST}  # addresses of collections -> _Set
        # Those of the scene are not all: some are shown by instances alone.
        for obj in (item for item in depsgraph.ids if isinstance(item, bpy.types.Object)):
            for kind, sets in self._sets.items():
                collection = getattr(obj.original.light_linking, f"{kind}_collection")
                if collection is None or collection.as_pointer() in sets:
                    continue
                if len(sets) == MOST[kind]:
                    log.warning(
                        f"more than {MOST[kind]} lights have different collections of {kind}s: "
                        "those of this one are left out",
                        object=obj.name,
                    )
                    continue
                sets[collection.as_pointer()] = _read(collection, len(sets))

    def of_light(self, obj, owner) -> dict:
        """The arguments of set_light and set_instance that say how it shines."""
        return {
            f"{kind}_set": found.number
            for kind, sets in self._sets.items()
            if (found := self._find(sets, kind, obj, owner))
        }

    def of_object(self, obj, owner) -> dict:
        """Those of set_instance that say which lights reach it."""
        addresses = obj.original.as_pointer(), owner.original.as_pointer()
        found = {
            name: [one.number for one in self._sets[kind].values() if not one.has(*addresses)]
            for name, kind in (("unlit_by", "receiver"), ("lets_pass", "blocker"))
        }
        return {name: numbers for name, numbers in found.items() if numbers}

    @staticmethod
    def _find(sets, kind, obj, owner) -> _Set | None:
        for item in (obj.original, owner.original):
            collection = getattr(item.light_linking, f"{kind}_collection")
            if collection is not None:
                return sets.get(collection.as_pointer())
        return None


def _read(collection, number: int) -> _Set:
    """Of a child collection, all objects are as it is."""
    found = _Set(number)
    items = [(item.light_linking, [child]) for item, child in _objects(collection)]
    items += [
        (item.light_linking, list(child.all_objects))
        for item, child in zip(collection.collection_children, collection.children, strict=True)
    ]
    for linking, objects in items:
        to = found.included if linking.link_state == "INCLUDE" else found.excluded
        to.update(obj.as_pointer() for obj in objects)
    return found


def _objects(collection):
    return zip(collection.collection_objects, collection.objects, strict=True)
