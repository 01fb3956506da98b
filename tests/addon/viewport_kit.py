# SPDX-License-Identifier: GPL-3.0-or-later
"""A viewport in the hands of a test, and what it looks at."""

import contextlib
import time
from types import SimpleNamespace

import bpy
import numpy as np
from conftest import add_square, part
from view_kit import HEIGHT, WIDTH, plain, through_camera

SAMPLES = 2


def furnish(scene):
    """A floor with a picture on it, a ball and its copy, a lamp."""
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.janus.samples = scene.janus.preview_samples = SAMPLES
    floor = add_square("Floor")
    floor.data.uv_layers.new(name="UVMap")
    floor.scale = (3.0, 3.0, 1.0)
    material = bpy.data.materials.new("Tiles")
    material.use_nodes = True
    image = bpy.data.images.new("Picture", 4, 4)
    image.pixels.foreach_set(np.random.default_rng(1).random(64, dtype=np.float32))
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    floor.data.materials.append(material)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=4, radius=0.4)
    ball = bpy.context.object
    ball.name = "Ball"
    ball.location = (-0.5, 0.0, 0.5)
    twin = bpy.data.objects.new("Twin", ball.data)
    twin.location = (0.6, 0.2, 0.4)
    scene.collection.objects.link(twin)
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    lamp.location, lamp.data.energy = (1.0, -1.0, 3.0), 100.0
    scene.collection.objects.link(lamp)
    scene.world = bpy.data.worlds.new("World")
    return scene


class Spy:
    """A SceneBuilder that counts what it is sent."""

    def __init__(self, builder):
        self.builder, self.calls = builder, []

    def __getattr__(self, name):
        target = getattr(self.builder, name)

        def call(*arguments, **keywords):
            self.calls.append(name)
            return target(*arguments, **keywords)

        return call

    def sent(self) -> set[str]:
        """What was sent since the last time."""
        found = {name for name in self.calls if name.startswith(("set_", "remove"))}
        self.calls.clear()
        return found


class Eye:
    """A viewport without a window, in the hands of a test."""

    def __init__(self, core):
        self.spies = []

        def builder():
            self.spies.append(Spy(core.SceneBuilder()))
            return self.spies[-1]

        names = ("RenderSettings", "RenderSession")
        spied = SimpleNamespace(
            SceneBuilder=builder, **{name: getattr(core, name) for name in names}
        )
        self.viewport = part("render.viewport").Viewport(spied)
        self.sync(bpy.context.evaluated_depsgraph_get())

    def sync(self, depsgraph):
        self.viewport.sync(depsgraph)
        self.depsgraph = depsgraph

    def look(self):
        rv3d, region, space = through_camera(), SimpleNamespace(width=WIDTH, height=HEIGHT), plain()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        view = part("sync.view").read_view(region, rv3d, space, depsgraph)
        settings = part("sync.settings")
        scene = depsgraph.scene
        self.viewport.look(view, settings.view_settings(scene), settings.view_denoising(scene))

    def wait(self) -> np.ndarray:
        """Draws until nothing more comes: the picture."""
        self.look()
        end = time.monotonic() + 30.0
        while self.viewport.advance() or self.viewport.busy:
            assert time.monotonic() < end, "the viewport does not come to an end"
            time.sleep(0.001)
        return self.viewport.picture.pixels

    def sent(self) -> set[str]:
        return self.spies[-1].sent()

    @property
    def counts(self):
        return self.viewport._scene.counts


@contextlib.contextmanager
def followed_by(eye):
    """What is edited inside reaches the viewport as in Blender, with the depsgraph's updates."""

    def update(_scene, depsgraph):
        eye.sync(depsgraph)

    bpy.app.handlers.depsgraph_update_post.append(update)
    try:
        yield
        bpy.context.view_layer.update()
    finally:
        bpy.app.handlers.depsgraph_update_post.remove(update)
