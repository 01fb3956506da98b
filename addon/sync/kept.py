# SPDX-License-Identifier: GPL-3.0-or-later
"""What F12 keeps of a scene from one render to the next, and how it knows what that is still worth.

With Persistent Data, Blender keeps one engine and one depsgraph for all view layers of a scene. It
tells of an evaluation what has changed since the one before, and only once: whoever misses one,
because a render was refused or stopped, knows nothing any more.
"""

import os
import zlib

import bpy

from ..nodes import image_key
from .cache import Changes, SceneCache, generation, read_changes
from .image import ANIMATED
from .loading import tile_path

NOTHING = Changes(frozenset(), frozenset(), True)


class KeptScene:
    """A builder, and what it has got.

    note() is for each evaluation of the depsgraph before the next; take() begins a sync, end() says
    that it has succeeded.
    """

    def __init__(self, builder):
        self.builder = builder
        self.cache = SceneCache(builder)
        self._pending = NOTHING
        self._complete = False
        self._generation = generation()
        self._marks = {}  # of images at the last sync

    def note(self, depsgraph) -> None:
        found = read_changes(depsgraph)
        self._pending |= Changes(found.geometry, found.images | images_of_trees(depsgraph), False)

    def take(self) -> Changes | None:
        """What has changed since the last sync; None: nobody knows."""
        known = self._complete and self._generation == generation()
        found, self._pending = self._pending, NOTHING
        self._complete, self._generation = False, generation()
        before, self._marks = self._marks, marks()
        edited = (k for k, mark in self._marks.items() if mark is None or mark != before.get(k))
        return found | Changes(frozenset(), frozenset(edited), False) if known else None

    def end(self) -> None:
        self._marks = marks(self._marks)  # there are more of them: what was sent has been read
        self._complete = True


def images_of_trees(depsgraph) -> set[str]:
    """The keys of what the updated node trees show. Reloading an image updates the trees, not the
    image."""
    trees = (update.id.original for update in depsgraph.updates)
    nodes = (node for tree in trees if isinstance(tree, bpy.types.NodeTree) for node in tree.nodes)
    images = (getattr(node, "image", None) for node in nodes)
    return {image_key(image) for image in images if isinstance(image, bpy.types.Image)}


def marks(known=()) -> dict[str, tuple | None]:
    """Of all images, by key; but for those that are known, where it may take long to find."""
    found = dict(known)
    for image in bpy.data.images:
        key = image_key(image)
        found[key] = found.get(key) or mark(image)
    return found


def mark(image) -> tuple | None:
    """Stays the same as long as the pixels do, None: they may be any.

    Scripts that write pixels need not tell the depsgraph. But until it is saved or packed the image
    is dirty then, and after that what it is read from has changed.
    """
    if image.is_dirty or image.source in ANIMATED:
        return None
    if image.source == "TILED":
        paths = [tile_path(image, tile) for tile in image.tiles]
    elif image.has_data:
        paths = [bpy.path.abspath(image.filepath_raw, library=image.library)]
    else:
        return None
    files = (item.packed_file for item in image.packed_files)
    packed = tuple(zlib.crc32(file.data) for file in files if file)
    return image.session_uid, packed, tuple(map(_state, paths))


def _state(path: str) -> tuple | None:
    try:
        found = os.stat(path)
    except (OSError, ValueError):
        return None
    return path, found.st_mtime_ns, found.st_size
