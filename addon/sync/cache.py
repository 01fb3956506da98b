# SPDX-License-Identifier: GPL-3.0-or-later
"""What a builder holds of a scene from one sync to the next, so that it need not be sent again."""

from collections import Counter
from dataclasses import dataclass, field

import bpy

from ..nodes import image_key
from ..report import DiagnosticsLog

_generation = 0


def forget_addresses() -> None:
    """After an undo: data have moved, and what is known of addresses is wrong."""
    global _generation
    _generation += 1


def generation() -> int:
    """Another one after each undo."""
    return _generation


@dataclass
class SentMesh:
    key: str | None  # None: it has no faces
    findings: list  # what sending it had to say, as in DiagnosticsLog.entries()
    sources: set[int] = field(default_factory=set)  # addresses of what it comes from, as in Changes


@dataclass(frozen=True)
class Changes:
    """What has changed since the last sync of a depsgraph, as far as it is expensive to send."""

    geometry: frozenset[int]  # addresses of original objects and of their data
    images: frozenset[str]  # their keys
    only_cameras: bool  # nothing but cameras

    def __or__(self, other: "Changes") -> "Changes":
        return Changes(
            self.geometry | other.geometry,
            self.images | other.images,
            self.only_cameras and other.only_cameras,
        )


def read_changes(depsgraph) -> Changes:
    # Without any update, something is asked for that is no data-block's: local view, say.
    geometry, images, only_cameras = set(), set(), len(depsgraph.updates) > 0
    for update in depsgraph.updates:
        item = update.id.original
        if update.is_updated_geometry:
            geometry.add(item.as_pointer())
        if isinstance(item, bpy.types.Image):
            images.add(image_key(item))
        camera = isinstance(item, bpy.types.Camera) or (
            isinstance(item, bpy.types.Object) and item.type == "CAMERA"
        )
        only_cameras = only_cameras and camera
    return Changes(frozenset(geometry), frozenset(images), only_cameras)


class SceneCache:
    """Addresses of evaluated data tell meshes apart. They are used again once the data are gone, so
    an entry of an earlier sync also has to come from the same object or data as what is asked for.

    What sending had to say is said again for what need not be sent again.
    """

    def __init__(self, builder):
        self._builder = builder
        self._meshes = {}  # (address of the evaluated mesh, attributes) -> SentMesh
        self._outdated = set()  # keys of meshes that the next sync sends again
        self._images = {}  # key -> what sending it had to say
        self._materials = set()  # keys
        self._now_materials = set()  # those of the present sync
        self._placed = Counter()  # how many instances and lights
        self._now_placed = Counter()
        self._number = 0
        self.begin()

    def begin(self, changes: Changes | None = None) -> None:
        """Starts a sync; without `changes` nothing is known to be as it was."""
        self._materials |= self._now_materials  # a sync that failed has placed things, too
        self._placed |= self._now_placed
        self._now_materials, self._now_placed = set(), Counter()
        self._used_meshes, self._used_images = set(), set()
        for identity, entry in list(self._meshes.items()):
            if changes is None or not changes.geometry.isdisjoint(entry.sources):
                self._drop(identity)
            elif entry.key in self._outdated:
                self._drop(identity)
        self._outdated = set()
        for key in list(self._images):
            if changes is None or any(is_part(key, image) for image in changes.images):
                self._forget_image(key)

    def end(self) -> None:
        """Ends a sync: what it did not use goes."""
        for key in self._materials - self._now_materials:
            self._builder.remove(key)
        self._materials = self._now_materials
        for kind, before in self._placed.items():
            for number in range(self._now_placed[kind], before):
                self._builder.remove(f"{kind}:{number}")
        self._placed = self._now_placed
        for identity in self._meshes.keys() - self._used_meshes:
            self._drop(identity)
        for key in self._images.keys() - self._used_images:
            self._forget_image(key)

    def mesh(self, identity, sources: set[int], send, log) -> str | None:
        """The key of a mesh, which send(key, log) sends if it is not there; send() tells whether
        there is anything to be seen.
        """
        entry = self._meshes.get(identity)
        if entry and identity not in self._used_meshes and entry.sources.isdisjoint(sources):
            self._drop(identity)
            entry = None
        if entry is None:
            self._number += 1
            key = f"mesh:{self._number}"
            found = DiagnosticsLog()
            sent = send(key, found)
            entry = self._meshes[identity] = SentMesh(key if sent else None, found.entries())
        entry.sources |= sources
        if identity not in self._used_meshes:
            say(entry.findings, log)
        self._used_meshes.add(identity)
        return entry.key

    def outdate(self, meshes) -> None:
        """The next sync has to send the meshes with these keys again, whatever the changes."""
        self._outdated |= set(meshes)

    def image(self, key: str, send, log) -> None:
        """send(log) sends an image if it is not there."""
        if key not in self._images:
            found = DiagnosticsLog()
            send(found)
            self._images[key] = found.entries()
        if key not in self._used_images:
            say(self._images[key], log)
        self._used_images.add(key)

    def use(self, key: str) -> str:
        """Keeps the material of this key."""
        self._now_materials.add(key)
        return key

    def place(self, kind: str) -> str:
        """The key of the next instance or light."""
        number = self._now_placed[kind]
        self._now_placed[kind] = number + 1
        return f"{kind}:{number}"

    def _drop(self, identity) -> None:
        entry = self._meshes.pop(identity)
        if entry.key is not None:
            self._builder.remove(entry.key)

    def _forget_image(self, key: str) -> None:
        del self._images[key]
        self._builder.remove(key)


def is_part(key: str, image: str) -> bool:
    """Is it the key of the image `image`, of one of its frames, or of one of its tiles?"""
    return key == image or key.startswith((f"{image}@", f"{image}:"))


def say(findings, log) -> None:
    for entry, count in findings:
        log.add(entry, count)
