# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport looks at: camera, window and border."""

from types import SimpleNamespace

import bpy
import numpy as np
from conftest import part
from mathutils import Matrix
from view_kit import BORDER, HEIGHT, SIDES, WIDTH, plain, through_camera


def read(rv3d, space=None, width=WIDTH, height=HEIGHT):
    region = SimpleNamespace(width=width, height=height)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return part("sync.view").read_view(region, rv3d, space or plain(), depsgraph)


def test_a_camera_view_is_the_render(scene):
    view = read(through_camera())
    window = part("sync.camera").window(
        scene.camera, bpy.context.evaluated_depsgraph_get(), scene.render
    )
    assert np.allclose(view.camera["window"], window, rtol=1e-5)
    assert view.crop is None and view.rectangle == (0, 0, WIDTH, HEIGHT)
    assert view.scaled(4) == {"width": 6, "height": 4, "crop": None}


def test_the_border_of_the_render_lies_in_the_camera_frame(scene):
    scene.render.use_border = True
    for side, value in zip(SIDES, BORDER, strict=True):
        setattr(scene.render, f"border_{side}", value)
    bpy.context.view_layer.update()
    rv3d = through_camera()
    # The frame takes up the middle half of the region.
    rv3d.window_matrix = Matrix.Diagonal((0.5, 0.5, 1.0, 1.0)) @ rv3d.window_matrix
    view = read(rv3d, width=80, height=60)
    assert view.crop == (30, 30, 50, 45)
    assert view.rectangle == (30, 30, 20, 15)
    assert view.scaled(8)["crop"] == (4, 4, 6, 6)
    assert read(rv3d, plain(use_render_border=True), 80, 60).crop == view.crop


def free_view(**changes):
    values = {"view_perspective": "PERSP", "is_perspective": True}
    values |= {"view_matrix": Matrix.Translation((0, 0, -5))}
    values["window_matrix"] = through_camera().window_matrix
    return SimpleNamespace(**(values | changes))


def test_a_free_view_has_the_clipping_of_its_space(scene):
    view = read(free_view(), plain(clip_start=0.5, clip_end=50.0))
    assert (view.camera["clip_start"], view.camera["clip_end"]) == (0.5, 50.0)
    assert view.camera["name"] == "Viewport" and view.camera["transform"][2, 3] == 5.0
    assert view.crop is None
    assert read(free_view(), plain(use_render_border=True)).crop == (6, 9, 18, 18)


def test_an_orthographic_view_begins_behind_the_eye(scene):
    """Its depth goes from -100 to 100 around the eye."""
    window_matrix = Matrix.Diagonal((0.5, 0.5, -0.01, 1.0))
    view = read(
        free_view(is_perspective=False, window_matrix=window_matrix, view_perspective="ORTHO")
    )
    assert view.camera["type"] == "ORTHO"
    assert view.camera["window"] == (-2.0, 2.0, -2.0, 2.0)
    assert np.allclose(view.camera["transform"][:3, 3], (0, 0, 105))
    assert np.allclose((view.camera["clip_start"], view.camera["clip_end"]), (0, 200))


def test_a_panorama_fills_its_frame(scene):
    data = scene.camera.data
    window_matrix = through_camera().window_matrix
    data.type = "PANO"
    part("sync.camera").panorama(data).panorama_type = "EQUIRECTANGULAR"
    bpy.context.view_layer.update()
    rv3d = through_camera()
    rv3d.window_matrix = Matrix.Diagonal((0.5, 0.5, 1.0, 1.0)) @ window_matrix
    view = read(rv3d, width=80, height=60)
    assert view.camera["type"] == "EQUIRECTANGULAR"
    assert (view.x, view.y, view.width, view.height) == (20, 15, 40, 30)
    assert view.rectangle == (20, 15, 40, 30)
    rv3d.window_matrix = Matrix.Diagonal((2.0, 2.0, 1.0, 1.0)) @ window_matrix
    view = read(rv3d, width=80, height=60)  # zoomed in: its middle alone is to be seen
    assert (view.width, view.height) == (160, 120)
    assert view.crop == (40, 30, 120, 90) and view.rectangle == (0, 0, 80, 60)


def test_a_panorama_is_that_of_the_render(scene, export):
    data = scene.camera.data
    data.type, data.shift_x, data.lens = "PANO", 0.1, 20.0
    settings = part("sync.panorama").panorama(data)
    settings.panorama_type, settings.fisheye_fov = "FISHEYE_EQUISOLID", 2.5
    data.dof.use_dof, data.dof.aperture_fstop = True, 0.5
    sent = export().camera
    seen = read(through_camera()).camera
    assert set(seen) == set(sent) and seen["aperture_radius"] > 0.0
    for name in set(sent) - {"transform", "pixel_size"}:  # the region has other pixels
        assert seen[name] == sent[name]
