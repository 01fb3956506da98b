# SPDX-License-Identifier: GPL-3.0-or-later
"""Panoramas as the exporter sends them, and their panel."""

import math
from types import SimpleNamespace

import bpy
import pytest
from conftest import messages, part


@pytest.fixture
def settings(scene):
    """The settings of the scene's camera, which is a panorama."""
    scene.camera.data.type = "PANO"
    return part("sync.panorama").panorama(scene.camera.data)


def fits(sent, window):
    return sent["window"] == pytest.approx(window, abs=1e-6)


def test_equirectangular(settings, export):
    settings.panorama_type = "EQUIRECTANGULAR"
    settings.longitude_min, settings.longitude_max = -2.0, 1.0
    settings.latitude_min, settings.latitude_max = -0.5, 1.25
    sent = export().camera
    assert sent["type"] == "EQUIRECTANGULAR" and sent["window"] == (-2.0, 1.0, -0.5, 1.25)
    assert "shift" not in sent


def test_a_shift_moves_the_frame(scene, settings, export):
    settings.panorama_type = "EQUIRECTANGULAR"
    settings.longitude_min, settings.longitude_max = -2.0, 1.0
    settings.latitude_min, settings.latitude_max = -0.5, 1.5
    scene.camera.data.shift_x, scene.camera.data.shift_y = 0.5, -0.25
    sent = export().camera
    assert fits(sent, (-0.5, 2.5, -1.0, 1.0)) and sent["shift"] == (0.5, -0.25)


def test_equidistant_fisheye(settings, export):
    settings.panorama_type, settings.fisheye_fov = "FISHEYE_EQUIDISTANT", 3.0
    sent = export().camera
    assert sent["type"] == "FISHEYE_EQUIDISTANT" and sent["fisheye_fov"] == 3.0
    assert fits(sent, (-1.5, 1.5, -1.5, 1.5))


@pytest.mark.parametrize(
    "fit, width, height",
    [("AUTO", 30.0, 15.0), ("HORIZONTAL", 30.0, 15.0), ("VERTICAL", 40.0, 20.0)],
)
@pytest.mark.parametrize("turned", [False, True])
def test_the_frame_of_a_sensor(scene, settings, export, fit, width, height, turned):
    scene.render.resolution_x, scene.render.resolution_y = 120, 40
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = 1.0, 1.5
    data = scene.camera.data
    data.sensor_fit, data.sensor_width, data.sensor_height = fit, 30.0, 20.0
    if turned:
        scene.render.resolution_x, scene.render.resolution_y = 40, 120
        scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = 1.5, 1.0
        across = {"AUTO": (15.0, 30.0), "HORIZONTAL": (30.0, 60.0), "VERTICAL": (10.0, 20.0)}
        width, height = across[fit]
    settings.panorama_type = "FISHEYE_EQUISOLID"
    settings.fisheye_lens, settings.fisheye_fov = 8.0, 2.5
    sent = export().camera
    assert (sent["fisheye_lens"], sent["fisheye_fov"]) == (8.0, 2.5)
    assert fits(sent, (-width / 2, width / 2, -height / 2, height / 2))


def test_polynomial_fisheye(settings, export):
    settings.panorama_type = "FISHEYE_LENS_POLYNOMIAL"
    for i in range(5):
        setattr(settings, f"fisheye_polynomial_k{i}", 0.5 - i)
    sent = export().camera
    assert sent["fisheye_polynomial"] == (0.5, -0.5, -1.5, -2.5, -3.5)
    assert fits(sent, (-18.0, 18.0, -13.5, 13.5))


def test_mirror_ball_and_cubemap_face(settings, export):
    settings.panorama_type = "MIRRORBALL"
    assert fits(export().camera, (-1, 1, -1, 1))
    settings.panorama_type = "EQUIANGULAR_CUBEMAP_FACE"
    side = math.pi / 4
    assert fits(export().camera, (-side, side, -side, side))


def test_cylinder(settings, export):
    if not hasattr(settings, "central_cylindrical_radius"):
        pytest.skip("this Blender has no cylindrical panorama")
    settings.panorama_type = "CENTRAL_CYLINDRICAL"
    settings.central_cylindrical_range_u_min = -1.0
    settings.central_cylindrical_range_u_max = 2.0
    settings.central_cylindrical_range_v_min = -3.0
    settings.central_cylindrical_range_v_max = 4.0
    settings.central_cylindrical_radius = 2.0
    assert fits(export().camera, (-1.0, 2.0, -1.5, 2.0))


def test_pixels_are_the_mean_of_their_sides(scene, settings, export):
    settings.panorama_type, settings.fisheye_fov = "FISHEYE_EQUIDISTANT", 3.0
    scene.render.resolution_x, scene.render.resolution_y = 60, 20
    assert export().camera["pixel_size"] == pytest.approx(0.5 * (3.0 / 60 + 3.0 / 20))


def test_settings_that_are_not_there():
    """Before Blender 5.0 they come with Cycles."""
    refused = part("report").RenderRefused
    with pytest.raises(refused, match="'Eye' is a panorama.*Cycles.*not enabled"):
        part("sync.panorama").panorama(SimpleNamespace(name="Eye"))


def test_a_kind_to_come_is_refused_by_name():
    data = SimpleNamespace(type="PANO", panorama_type="PANINI")
    with pytest.raises(part("report").RenderRefused, match="'Eye' is a panorama of type PANINI"):
        part("sync.camera").camera_type(SimpleNamespace(name="Eye", data=data))


def test_custom_cameras_are_refused(scene, export):
    try:
        scene.camera.data.type = "CUSTOM"
    except TypeError:
        pytest.skip("this Blender has no custom cameras")
    with pytest.raises(RuntimeError, match="Camera 'Camera' is a custom camera"):
        export()
    assert len(messages("ERROR")) == 1


def test_the_panel_offers_all_settings(scene, settings):
    panel = bpy.types.JANUS_CAMERA_PT_panorama
    names = []

    class Layout(SimpleNamespace):
        def prop(self, owner, name, **_):
            assert name in owner.bl_rna.properties
            names.append(name)

        def column(self, **_):
            return self

    context = SimpleNamespace(camera=scene.camera.data, engine="JANUS")
    assert panel.poll(context)
    for kind in part("sync.panorama").PANORAMAS:
        try:
            settings.panorama_type = kind
        except TypeError:  # not in this Blender
            continue
        names.clear()
        panel.draw(SimpleNamespace(layout=Layout(), column=Layout), context)
        own = [name for name in settings.bl_rna.properties.keys() if name in names]
        assert sorted(own) == sorted(names) and names[0] == "panorama_type"
    scene.camera.data.type = "PERSP"
    assert not panel.poll(context)
