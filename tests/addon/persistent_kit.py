# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders with Persistent Data, and what they send."""

import bpy
import numpy as np
from conftest import part
from viewport_kit import Spy

HEAVY = {"set_mesh", "set_image"}


class SpiedCore:
    """The native core; its builders count what they are sent."""

    def __init__(self, core):
        self._core, self.builders = core, []

    def __getattr__(self, name):
        return getattr(self._core, name)

    def SceneBuilder(self):  # noqa: N802
        self.builders.append(Spy(self._core.SceneBuilder()))
        return self.builders[-1]


class Renders:
    """F12, and what it sent."""

    def __init__(self, scene, core, monkeypatch):
        self.core = SpiedCore(core)
        monkeypatch.setattr(part("bridge"), "core", lambda: self.core)
        monkeypatch.setattr(part("render.final"), "keep_passes_of", {scene.name_full})

    def __call__(self) -> np.ndarray:
        """The picture; of all view layers, if there are several."""
        for builder in self.core.builders:
            builder.calls.clear()
        bpy.ops.render.render()
        kept = part("render.final").kept_passes
        return np.stack([kept[layer.name]["Combined"] for layer in bpy.context.scene.view_layers])

    @property
    def heavy(self) -> set[str]:
        """Which expensive things the last render sent."""
        return {name for builder in self.core.builders for name in builder.calls} & HEAVY

    def fresh(self) -> np.ndarray:
        """The picture of a render that knows nothing."""
        render = bpy.context.scene.render
        render.use_persistent_data = False
        pixels = self()
        render.use_persistent_data = True
        return pixels


def equal(a, b) -> bool:
    return np.allclose(a, b, rtol=1e-5, atol=1e-6)


def things(name):
    return bpy.data.objects[name]


def edit_mesh():
    mesh = things("Ball").data
    mesh.vertices[0].co.z += 0.7
    mesh.update()


def brighten():
    things("Lamp").data.energy = 500.0
