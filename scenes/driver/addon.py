# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds, loads and unloads the add-on: the installed extension, or else the source folder."""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import sys
from collections.abc import Callable
from types import ModuleType

import bpy

from scenes.driver.arguments import ROOT

EXTENSION = "bl_ext.user_default.janus"
SOURCE_PACKAGE = "janus_addon"
ENGINE = "JANUS"
IS_MODULE = not bpy.app.binary_path  # this is Python with bpy, not `blender`


class Addon:
    """The registered add-on. `part(name)` is one of its modules, such as "report"."""

    def __init__(self, package: ModuleType, source: bool):
        self.package = package
        self.source = source

    def part(self, name: str) -> ModuleType:
        return importlib.import_module(f"{self.package.__name__}.{name}")

    def version(self) -> str | None:
        """The version of the core, None where it does not load."""
        bridge = self.part("bridge")
        try:
            return bridge.core().__version__
        except bridge.CoreUnavailable:
            return None

    @contextlib.contextmanager
    def stop_when(self, stop: Callable[[], bool]):
        """Renders in this context end, with what they have, as soon as stop() is true.

        The bpy module has no Escape key and test_break() is never true in it; Blender's own
        functions cannot be overridden in an engine class, so the renderer gets a stand-in.
        """
        final = self.part("render.final")
        render_layer = final.render_layer
        final.render_layer = lambda engine, *rest: render_layer(_Stoppable(engine, stop), *rest)
        try:
            yield
        finally:
            final.render_layer = render_layer

    def unload(self) -> None:
        """Leaves no Janus behind: bpy 4.2 and 4.5 crash or hang at exit with a live engine."""
        for scene in bpy.data.scenes:
            if scene.render.engine == ENGINE:
                scene.render.engine = "CYCLES"
        if self.source:
            with contextlib.suppress(Exception):
                self.package.unregister()


def alone(path: str) -> ModuleType:
    """A file of the add-on's source that knows nothing of the rest, whatever the engine is."""
    spec = importlib.util.spec_from_file_location(f"{SOURCE_PACKAGE}_alone", ROOT / "addon" / path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class _Stoppable:
    """An engine with a test_break() that also asks somebody else."""

    def __init__(self, engine: bpy.types.RenderEngine, stop: Callable[[], bool]):
        self._engine = engine
        self._stop = stop

    def __getattr__(self, name: str):
        return getattr(self._engine, name)

    def test_break(self) -> bool:
        return self._stop() or self._engine.test_break()


def load() -> Addon:
    """Inside `blender` the installed extension is used if there is one; it is what users run."""
    if not IS_MODULE:
        installed = _enable_extension()
        if installed:
            return Addon(installed, source=False)
    path = ROOT / "addon" / "__init__.py"
    spec = importlib.util.spec_from_file_location(
        SOURCE_PACKAGE, path, submodule_search_locations=[str(path.parent)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules[SOURCE_PACKAGE] = package
    spec.loader.exec_module(package)
    package.register()
    return Addon(package, source=True)


def _enable_extension() -> ModuleType | None:
    import addon_utils

    found = {module.__name__ for module in addon_utils.modules(refresh=True)}
    if EXTENSION not in found:
        return None
    return addon_utils.enable(EXTENSION, default_set=False, persistent=False)
