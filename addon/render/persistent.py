# SPDX-License-Identifier: GPL-3.0-or-later
"""Persistent Data: what an engine keeps from one of its renders to the next.

Blender frees the engine when the setting is switched off, a file is loaded, or another engine or
scene is rendered.
"""

from ..sync.kept import KeptScene


class PersistentData:
    """`kept` is None where nothing is to be kept."""

    def __init__(self):
        self.clear()

    def clear(self) -> None:
        self.kept: KeptScene | None = None
        self._scene = None

    def begin(self, depsgraph) -> None:
        """First of all in a render, however that ends."""
        if not depsgraph.scene.render.use_persistent_data:
            self.clear()
        elif self.kept is not None:
            self.kept.note(depsgraph)

    def start(self, core, depsgraph) -> None:
        if self.kept is None and depsgraph.scene.render.use_persistent_data:
            self.kept = KeptScene(core.SceneBuilder())

    def built(self, scene) -> None:
        """As long as this scene lives, the next one shares its meshes."""
        self._scene = scene if self.kept is not None else None
