# SPDX-License-Identifier: GPL-3.0-or-later
"""Dual photography in Blender: operators, settings, panel, and what they refuse."""

import math
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from conftest import add_light, add_square, messages, part, picture
from test_final import load_pixels


@pytest.fixture
def projector(scene, core):
    """A spot above a square, and a camera that looks at it."""
    add_square("Square")
    scene.janus.samples = 4
    lamp = add_light("SPOT", "Slides")
    lamp.location, lamp.data.energy = (0.3, 0.0, 3.0), 500.0
    lamp.data.shadow_soft_size = 0.0
    lamp.data.spot_size, lamp.data.spot_blend = math.radians(40.0), 0.0
    settings = lamp.data.janus
    settings.projector_width, settings.projector_height = 12, 10
    settings.samples, settings.camera_size = 8, 16
    bpy.context.view_layer.objects.active = lamp
    yield lamp
    transport = part("render.transport")
    assert transport.requests == {} and transport.matrices == {}


def load(path):
    return part("bridge").dual().TransportMatrix.load(str(path))


def image(name):
    found = bpy.data.images[name]
    pixels = np.empty(len(found.pixels), dtype=np.float32)
    found.pixels.foreach_get(pixels)
    return pixels.reshape(found.size[1], found.size[0], -1)[..., :3]


def test_capture_makes_file_and_images(projector, tmp_path):
    path = tmp_path / "t.npz"
    assert bpy.ops.janus.capture_transport(filepath=str(path)) == {"FINISHED"}
    matrix = load(path)
    assert matrix.camera_size == (16, 12) and matrix.projector_size == (12, 10)
    assert matrix.samples == 8
    assert projector.data.janus.matrix_path == str(path)
    assert np.allclose(image("Slides Primal"), matrix.relight(), rtol=1e-5)
    assert np.allclose(image("Slides Dual"), matrix.dual(), rtol=1e-5)
    assert image("Slides Primal").max() > 0.0 and image("Slides Dual").max() > 0.0
    assert messages("ERROR") == []


def test_what_is_captured_is_what_is_rendered(projector, scene, tmp_path):
    scene.janus.pixel_filter_type, scene.janus.samples = "BOX", 64
    bpy.ops.janus.capture_transport(filepath=str(tmp_path / "t.npz"), samples=64)
    captured = image("Slides Primal")
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(tmp_path / "plain.exr")
    bpy.ops.render.render(write_still=True)
    plain = load_pixels(tmp_path / "plain.exr")[..., :3]
    assert np.allclose(captured.mean(axis=(0, 1)), plain.mean(axis=(0, 1)), rtol=0.02)
    assert np.corrcoef(captured.ravel(), plain.ravel())[0, 1] > 0.99


def test_render_result_has_the_frame(projector, scene, tmp_path):
    """More pixels than the matrix, and a border."""
    scene.render.resolution_x, scene.render.resolution_y = 64, 48
    scene.render.use_border = scene.render.use_crop_to_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75
    scene.render.border_min_y, scene.render.border_max_y = 0.0, 0.5
    path = tmp_path / "t.npz"
    bpy.ops.janus.capture_transport(filepath=str(path))
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    bpy.data.images["Render Result"].save_render(str(tmp_path / "r.exr"), scene=scene)
    shown = load_pixels(tmp_path / "r.exr")
    expected = load(path).relight()[:6, 4:12].repeat(4, axis=0).repeat(4, axis=1)
    assert np.allclose(shown[..., :3], expected, rtol=1e-3, atol=1e-6)
    assert np.all(shown[..., 3] == 1.0)


def test_relight(projector, tmp_path):
    path = tmp_path / "t.npz"
    bpy.ops.janus.capture_transport(filepath=str(path))
    matrix = load(path)
    pixels = np.ones((10, 12, 4), dtype=np.float32)
    pixels[..., :3] = np.random.default_rng(1).random((10, 12, 3))
    picture(pixels, float_buffer=True)
    assert bpy.ops.janus.relight(slide="Picture", exposure=1.0) == {"FINISHED"}
    expected = 2.0 * matrix.relight(matrix.shown(pixels))
    assert np.allclose(image("Slides Primal"), expected, rtol=1e-4, atol=1e-7)
    assert bpy.ops.janus.relight() == {"FINISHED"}
    assert np.allclose(image("Slides Primal"), matrix.relight(), rtol=1e-4, atol=1e-7)
    projector.data.janus.slide = bpy.data.images["Picture"]
    assert bpy.ops.janus.relight() == {"FINISHED"}
    assert np.allclose(image("Slides Primal"), 0.5 * expected, rtol=1e-4, atol=1e-7)
    bpy.data.images.remove(bpy.data.images["Slides Dual"])
    assert bpy.ops.janus.show_dual() == {"FINISHED"}
    assert np.allclose(image("Slides Dual"), matrix.dual(), rtol=1e-5)


def test_slides_have_the_colours_that_they_show(scene, core):
    """Bytes are encoded, floats are not."""
    pixels = np.full((2, 2, 4), 0.5, dtype=np.float32)
    pixels[..., 3] = 1.0
    coded = picture(pixels, space="sRGB")
    read = part("sync.slide").read_slide
    assert np.allclose(read(coded.name, pytest.fail), 0.2140, atol=0.002)
    plain = picture(pixels, float_buffer=True)
    assert np.allclose(read(plain.name, pytest.fail), 0.5)


@pytest.mark.parametrize(
    ("change", "word"),
    [
        (lambda light: setattr(light, "type", "POINT"), "Only spot and area lights"),
        (lambda light: setattr(light, "shadow_soft_size", 0.1), "Radius of 0"),
        (lambda light: setattr(light, "spot_size", math.radians(170)), "160 degrees"),
    ],
)
def test_unfit_lights_are_named(projector, change, word, tmp_path):
    change(projector.data)
    with pytest.raises(RuntimeError, match=rf"'Slides'.*{word}"):
        bpy.ops.janus.capture_transport(filepath=str(tmp_path / "t.npz"))
    assert list(tmp_path.iterdir()) == []


def test_unfit_area_lights(projector, tmp_path):
    lamp = add_light("AREA", "Panel")
    lamp.location.z, lamp.data.spread = 2.0, 1.0
    arguments = {"light": "Panel", "filepath": str(tmp_path / "t.npz"), "samples": 4}
    with pytest.raises(RuntimeError, match="'Panel'.*Spread of 0"):
        bpy.ops.janus.capture_transport(**arguments)
    lamp.data.spread = 0.0
    assert bpy.ops.janus.capture_transport(**arguments) == {"FINISHED"}
    assert load(tmp_path / "t.npz").projector["type"] == "ORTHO"


def test_what_the_core_refuses_is_said(projector, tmp_path):
    """A sheared lamp is seen by the core alone. The next render is as usual."""
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.scene.collection.objects.link(parent)
    parent.scale = (1.0, 3.0, 1.0)
    projector.parent = parent
    projector.rotation_euler = (0.0, 0.0, 0.7)
    with pytest.raises(RuntimeError, match="Slides.*sheared"):
        bpy.ops.janus.capture_transport(filepath=str(tmp_path / "t.npz"))
    assert bpy.ops.render.render() == {"FINISHED"}


def test_wrong_names_and_files(projector, tmp_path):
    with pytest.raises(RuntimeError, match="no object 'Nobody'"):
        bpy.ops.janus.capture_transport(light="Nobody")
    with pytest.raises(RuntimeError, match="'Square' is no light"):
        bpy.ops.janus.capture_transport(light="Square")
    with pytest.raises(RuntimeError, match="capture the light transport first"):
        bpy.ops.janus.relight()
    (tmp_path / "no.npz").write_text("nothing")
    with pytest.raises(RuntimeError, match="not a light transport matrix"):
        bpy.ops.janus.show_dual(filepath=str(tmp_path / "no.npz"))
    with pytest.raises(RuntimeError, match="folder"):
        bpy.ops.janus.capture_transport(filepath=str(tmp_path / "folder" / "t.npz"))
    path = str(tmp_path / "t.npz")
    assert bpy.ops.janus.capture_transport(filepath=path) == {"FINISHED"}
    with pytest.raises(RuntimeError, match="no image 'Gone'"):
        bpy.ops.janus.relight(slide="Gone")


def test_fields_have_limits(projector):
    settings = projector.data.janus
    settings.projector_width, settings.camera_size, settings.samples = 1000, 10000, 0
    assert (settings.projector_width, settings.camera_size, settings.samples) == (256, 512, 2)


def test_only_where_it_can_be(projector, scene):
    scene.camera = None
    with pytest.raises(RuntimeError, match="no active camera"):
        bpy.ops.janus.capture_transport()
    scene.render.engine = "CYCLES"
    with pytest.raises(RuntimeError, match="Only Janus"):
        bpy.ops.janus.capture_transport()


def test_escape(projector, monkeypatch, tmp_path):
    """Before the first sample nothing is written; later the samples so far are."""
    final, transport = part("render.final"), part("render.transport")
    asked = []

    class Stopped:
        def __init__(self, engine):
            self._engine = engine

        def __getattr__(self, name):
            return getattr(self._engine, name)

        def test_break(self):
            asked.append(True)
            return len(asked) > limit

    run = transport.capture
    monkeypatch.setattr(
        transport,
        "capture",
        lambda request, core, engine, *rest: run(request, core, Stopped(engine), *rest),
    )
    path = tmp_path / "t.npz"
    limit = 0
    many = {"filepath": str(path), "samples": 1 << 20, "camera_size": 512}
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = 512
    with pytest.raises(RuntimeError, match="before its first sample"):
        bpy.ops.janus.capture_transport(**many)
    assert not path.exists()
    scene.render.resolution_x, scene.render.resolution_y = 16, 12
    limit = 20
    assert bpy.ops.janus.capture_transport(filepath=str(path), samples=1 << 20) == {"FINISHED"}
    assert 0 < load(path).samples < 1 << 20
    assert final.last_render["cancelled"]


def test_panel(projector):
    from test_panels import Layout

    def draw(light):
        layout = Layout()
        panel = bpy.types.JANUS_LIGHT_PT_dual
        context = SimpleNamespace(light=light, engine="JANUS")
        assert panel.poll(context)
        stub = SimpleNamespace(layout=layout, column=lambda: layout)
        panel.draw(stub, context)
        return layout.drawn

    drawn = draw(projector.data)
    assert {"projector_width", "camera_size", "memory", "janus.capture_transport"} <= set(drawn)
    projector.data.shadow_soft_size = 1.0
    drawn = draw(projector.data)
    assert drawn[0] == "shadow_soft_size" and "Radius of 0" in drawn[1][0]
    point = add_light("POINT", "Point")
    assert not bpy.types.JANUS_LIGHT_PT_dual.poll(SimpleNamespace(light=point.data, engine="JANUS"))
