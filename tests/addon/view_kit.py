# SPDX-License-Identifier: GPL-3.0-or-later
"""Views of 3D viewports without a window."""

from types import SimpleNamespace

import bpy

WIDTH, HEIGHT = 24, 18


def through_camera():
    """The region data of a view through the scene's camera that fills the region."""
    camera = bpy.context.scene.camera
    depsgraph = bpy.context.evaluated_depsgraph_get()
    return SimpleNamespace(
        view_perspective="CAMERA",
        is_perspective=camera.data.type != "ORTHO",
        window_matrix=camera.calc_matrix_camera(depsgraph, x=WIDTH, y=HEIGHT),
        view_matrix=camera.matrix_world.inverted(),
    )


def plain(**changes):
    values = {"use_local_camera": False, "camera": None, "use_render_border": False}
    values |= {"clip_start": 0.01, "clip_end": 1000.0}
    values |= {f"render_border_{side}": v for side, v in zip(SIDES, BORDER, strict=True)}
    return SimpleNamespace(**(values | changes))


SIDES, BORDER = ("min_x", "min_y", "max_x", "max_y"), (0.25, 0.5, 0.75, 1.0)
