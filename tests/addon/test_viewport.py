# SPDX-License-Identifier: GPL-3.0-or-later
"""Rendered viewports: what a change sends, and that the picture is that of a fresh start."""

import contextlib
import time
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from conftest import add_square, part
from view_kit import HEIGHT, WIDTH, plain, through_camera

SAMPLES = 2


@pytest.fixture
def world_of_things(scene):
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


def rendered(scene, path) -> np.ndarray:
    """What F12 makes of the scene."""
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(4 * WIDTH * HEIGHT, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(HEIGHT, WIDTH, 4)


def test_shows_what_f12_renders(world_of_things, core, tmp_path):
    eye = Eye(core)
    picture = eye.wait()
    assert picture.shape == (HEIGHT, WIDTH, 4) and picture[..., :3].std() > 0.01
    assert np.allclose(
        picture, rendered(world_of_things, tmp_path / "f12.exr"), rtol=1e-5, atol=1e-6
    )


def edit_mesh():
    mesh = bpy.data.objects["Ball"].data
    mesh.vertices[0].co.z += 0.7
    mesh.update()


def edit_picture():
    image = bpy.data.images["Picture"]
    image.pixels.foreach_set(np.zeros(64, dtype=np.float32))
    image.update_tag()


def add_modifier():
    bpy.data.objects["Ball"].modifiers.new("Subsurf", "SUBSURF")


def assign(name, path, value):
    def edit():
        owner = bpy.data.objects[name]
        *steps, last = path.split(".")
        for step in steps:
            owner = getattr(owner, step)
        setattr(owner, last, value)

    return edit


def roughen():
    nodes = bpy.data.materials["Tiles"].node_tree.nodes
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Roughness"].default_value = 0.1
    shader.inputs["Metallic"].default_value = 1.0


def recolor():
    world = bpy.data.worlds["World"]
    world.use_nodes = True
    background = next(n for n in world.node_tree.nodes if n.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.1, 0.9, 0.2, 1.0)


def remove_twin():
    bpy.data.objects.remove(bpy.data.objects["Twin"])


def add_another():
    obj = bpy.data.objects.new("Another", bpy.data.objects["Ball"].data)
    obj.location = (0.0, -0.9, 0.4)
    bpy.context.scene.collection.objects.link(obj)


def hide():
    bpy.data.objects["Ball"].hide_viewport = True


def swap_places_and_data():
    """The data of a deleted object may come to lie where those of a new one do."""
    bpy.data.meshes.remove(bpy.data.objects["Ball"].data)
    square = add_square("New")
    square.location.z = 0.7


MOVES = {"set_instance"}
EDITS = {
    "move": (assign("Ball", "location", (0.2, 0.6, 0.8)), MOVES),
    "move the floor": (assign("Floor", "location", (0.0, 0.0, -1.0)), MOVES),
    "ray visibility": (assign("Ball", "visible_camera", False), MOVES),
    "lamp": (assign("Lamp", "data.energy", 500.0), {"set_light"}),
    "move the lamp": (assign("Lamp", "location", (-1.0, 0.0, 2.0)), {"set_light"}),
    "material": (roughen, {"set_material"}),
    "world": (recolor, {"set_world"}),
    "mesh": (edit_mesh, {"set_mesh", "set_instance", "remove"}),
    "modifier": (add_modifier, {"set_mesh", "set_instance", "remove"}),
    "picture": (edit_picture, {"set_image", "remove"}),
    "remove": (remove_twin, {"set_instance", "set_light", "remove"}),
    "add": (add_another, {"set_instance", "set_light", "set_mesh", "remove"}),
    "hide": (hide, {"set_instance", "set_light", "remove", "set_mesh"}),
    "swap": (swap_places_and_data, {"set_instance", "set_light", "remove", "set_mesh"}),
}


@pytest.mark.parametrize("name", EDITS)
def test_an_edit_sends_what_has_changed(world_of_things, core, name):
    edit, expected = EDITS[name]
    eye = Eye(core)
    before = eye.wait()
    assert eye.sent() >= {"set_mesh", "set_image", "set_world", "set_light", "set_camera"}
    with followed_by(eye):
        edit()
    after = eye.wait()
    sent = eye.sent()
    assert sent and sent <= expected
    assert not np.array_equal(after, before)
    if "set_mesh" not in expected:
        assert eye.counts["meshes_built"] == 0
    assert np.allclose(after, Eye(core).wait(), rtol=1e-5, atol=1e-6)


def test_what_does_not_show_starts_nothing(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    eye.sent()
    with followed_by(eye):
        bpy.data.objects["Ball"].select_set(True)
        bpy.data.objects["Ball"].location = bpy.data.objects["Ball"].location
        world_of_things.render.fps = 30
    eye.look()
    assert not eye.viewport.busy and not eye.sent()
    assert eye.viewport.picture.pixels is before


def test_the_camera_moves_alone(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    eye.sent()
    with followed_by(eye):
        world_of_things.camera.location.x += 0.5
    after = eye.wait()
    assert eye.sent() == {"set_camera"} and eye.counts["meshes_built"] == 0
    assert not np.array_equal(after, before)


def test_after_an_undo_nothing_is_taken_for_known(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    part("render.viewport").forget_addresses()
    with followed_by(eye):
        bpy.data.objects["Ball"].location.x += 0.1
        bpy.data.objects["Ball"].location.x -= 0.1
    assert np.array_equal(eye.wait(), before)
    assert len(eye.spies) == 2 and "set_mesh" in eye.sent()


def test_a_steady_change_shows(world_of_things, core):
    """As long as someone turns the view, each draw sees another camera."""
    eye = Eye(core)
    eye.wait()
    shown = set()
    end = time.monotonic() + 10.0
    while len(shown) < 3 and time.monotonic() < end:
        world_of_things.camera.location.x += 0.01
        bpy.context.view_layer.update()
        eye.look()
        if eye.viewport.advance():
            shown.add(eye.viewport.picture.pixels.tobytes())
    assert len(shown) == 3


def test_drafts_come_first_where_samples_are_slow(world_of_things, core):
    eye = Eye(core)
    eye.look()
    eye.viewport._seconds = 1.0  # for a sample of a pixel
    sizes = []
    end = time.monotonic() + 30.0
    while (eye.viewport.busy or not sizes) and time.monotonic() < end:
        if eye.viewport.advance():
            sizes.append(eye.viewport.picture.pixels.shape[:2])
            assert eye.viewport.picture.rectangle == (0, 0, WIDTH, HEIGHT)
            eye.viewport._seconds = 1.0
    assert sizes[:4] == [(HEIGHT // d, WIDTH // d) for d in (8, 4, 2, 1)]


def test_a_draft_that_ends_between_two_draws_is_seen(world_of_things, core):
    eye = Eye(core)
    eye.look()
    eye.viewport.advance()
    first = eye.viewport.picture
    end = time.monotonic() + 10.0
    while first is None and time.monotonic() < end:
        eye.viewport._session and eye.viewport._session.wait(10.0)
        eye.viewport.advance()
        first = eye.viewport.picture
    assert first.pixels.shape[:2] == (HEIGHT // 4, WIDTH // 4)


def test_can_be_denoised(world_of_things, core):
    if reason := part("render.denoise").unavailable():
        pytest.skip(reason)
    eye = Eye(core)
    noisy = eye.wait()
    world_of_things.janus.use_preview_denoising = True
    clean = eye.wait()
    assert clean.shape == noisy.shape and np.array_equal(clean[..., 3], noisy[..., 3])
    assert 0.0 < np.abs(clean - noisy).mean() < 0.3 * noisy.mean()
    world_of_things.janus.use_preview_denoising = False
    assert np.array_equal(eye.wait(), noisy)


def test_pauses_and_goes_on(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    world_of_things.janus.preview_samples = 1 << 20
    eye.look()
    eye.viewport.advance()
    eye.viewport.pause()
    assert eye.viewport._session.wait(5.0)
    world_of_things.janus.preview_samples = SAMPLES
    assert np.array_equal(eye.wait(), before)


def test_renders_say_that_they_run(scene, fake_core):
    final, seen = part("render.final"), []
    fake_core.script = lambda session: seen.append(final.running)
    bpy.ops.render.render()
    fake_core.script = lambda session: 1 / 0
    with pytest.raises(RuntimeError):
        bpy.ops.render.render()
    assert set(seen) == {1} and final.running == 0


def test_settings_start_again(world_of_things, core):
    eye = Eye(core)
    few = eye.wait()
    world_of_things.janus.preview_samples = 5
    many = eye.wait()
    assert eye.viewport.status == "Sample 5/5"
    assert not np.array_equal(few, many)
    assert "set_mesh" in eye.sent() and len(eye.spies) == 1


def test_what_is_refused_leaves_the_picture(world_of_things, core):
    eye = Eye(core)
    before = eye.wait()
    data = world_of_things.camera.data
    data.type = "PANO"
    part("sync.camera").panorama(data).panorama_type = "MIRRORBALL"
    bpy.context.view_layer.update()
    with pytest.raises(part("report").RenderRefused, match="mirror ball"):
        eye.look()
    assert eye.viewport.picture.pixels is before
    data.type = "PERSP"
    bpy.context.view_layer.update()
    assert np.array_equal(eye.wait(), before)
