# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the add-on from its source folder into bpy and registers it for the whole session.

Most tests run a fake core (fake_core.py) behind bridge.core, so they need no build. Tests that
ask for the fixture `core` use the native one; without it they are skipped, or fail where
JANUS_REQUIRE_CORE=1.
"""

import importlib
import importlib.util
import os
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from fake_core import FakeCore

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "janus_under_test"
# The module bpy 4.2 does so if any property has had an update function, of whichever add-on.
CRASHES_AT_EXIT = bpy.app.version < (4, 5, 0) and not bpy.app.binary_path


def _load():
    path = ROOT / "addon" / "__init__.py"
    spec = importlib.util.spec_from_file_location(
        PACKAGE, path, submodule_search_locations=[str(path.parent)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = package
    spec.loader.exec_module(package)
    return package


def part(name: str):
    """A module of the add-on, such as part("nodes.flatten")."""
    return importlib.import_module(f"{PACKAGE}.{name}")


_status = 0


def pytest_sessionfinish(exitstatus):
    global _status
    _status = int(exitstatus)


@pytest.hookimpl(trylast=True)
def pytest_unconfigure():
    if CRASHES_AT_EXIT:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(_status)


@pytest.fixture(scope="session", autouse=True)
def addon():
    package = _load()
    package.register()
    yield package
    # bpy 4.2 and 4.5 crash or hang at exit while a Python engine is registered and selected.
    for scene in bpy.data.scenes:
        scene.render.engine = "CYCLES"
    package.unregister()


@pytest.fixture
def scene(addon, tmp_path):
    """An empty file with a camera at z = 5 that looks down, Janus selected, 16x12 pixels."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "JANUS"
    scene.render.resolution_x, scene.render.resolution_y = 16, 12
    scene.render.filepath = str(tmp_path / "out.png")
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.location.z = 5.0
    scene.collection.objects.link(camera)
    scene.camera = camera
    part("report").forget()
    return scene


@pytest.fixture
def fake_core(addon, monkeypatch):
    """A core without light transport that records everything it is told."""
    core = FakeCore()
    monkeypatch.setattr(part("bridge"), "core", lambda: core)
    return core


@pytest.fixture
def export(scene, fake_core):
    """Renders the scene through Blender and gives what the exporter sent: a Recorder."""

    def run():
        bpy.ops.render.render()
        return fake_core.builder

    return run


@pytest.fixture
def core(addon):
    """The native core."""
    try:
        return part("bridge").core()
    except part("bridge").CoreUnavailable as error:
        if os.environ.get("JANUS_REQUIRE_CORE") == "1":
            pytest.fail(f"JANUS_REQUIRE_CORE=1: {error}")
        pytest.skip(f"no native core: {error}")


@pytest.fixture
def renders(scene, core, monkeypatch):
    """Renders of a furnished scene with Persistent Data."""
    from persistent_kit import Renders
    from viewport_kit import furnish

    furnish(scene)
    scene.render.use_persistent_data = True
    bpy.context.view_layer.update()
    return Renders(scene, core, monkeypatch)


def messages(severity: str = "WARNING") -> list[str]:
    """What the last render of the current scene said."""
    kept = part("report").kept(bpy.context.scene.name_full)
    return [str(entry) for entry, _ in kept if entry.severity == severity]


def add_mesh(name, vertices, faces, scene=None):
    """A mesh object in the scene."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    (scene or bpy.context.scene).collection.objects.link(obj)
    return obj


def add_square(name="Square", scene=None):
    corners = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    return add_mesh(name, corners, [(0, 1, 2, 3)], scene)


def add_light(kind, name="Light"):
    obj = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
    bpy.context.scene.collection.objects.link(obj)
    return obj


def new_material(name="Material"):
    """A material with an empty node tree."""
    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    material.node_tree.nodes.clear()
    return material


def environment(scene, image):
    """A world whose background shows `image`; its texture node."""
    scene.world = world = bpy.data.worlds.new("Sky")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    tree = world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    return texture


def picture(pixels, space=None, **arguments):
    pixels = np.asarray(pixels, dtype=np.float32)
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("Picture", width, height, alpha=True, **arguments)
    if space:  # first: it makes Blender fill the picture anew
        image.colorspace_settings.name = space
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image
