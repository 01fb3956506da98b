# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera: where it stands and which window it looks through."""

import numpy as np

from ..report import RenderRefused
from .settings import frame_size

REFUSED = {"ORTHO": "orthographic", "PANO": "panoramic", "CUSTOM": "custom"}


def sync_camera(builder, depsgraph, log) -> None:
    """Sends the scene's camera. Raises RenderRefused for what cannot be rendered at all."""
    scene = depsgraph.scene_eval
    if scene.camera is None:
        raise RenderRefused("The scene has no active camera")
    camera = scene.camera.evaluated_get(depsgraph)
    if camera.type != "CAMERA":
        raise RenderRefused(f"'{camera.name}' is the active camera, but it is no camera object")
    data = camera.data
    if data.type != "PERSP":
        kind = REFUSED.get(data.type, data.type.lower())
        raise RenderRefused(
            f"Camera '{camera.name}' is {kind}: Janus renders perspective cameras only, so far"
        )
    if data.dof.use_dof:
        log.warning(
            "depth of field is not supported yet, everything is in focus", object=camera.name
        )
    builder.set_camera(
        name=camera.name,
        type="PERSP",
        transform=without_scale(camera.matrix_world),
        window=window(camera, depsgraph, scene.render),
        clip_start=data.clip_start,
        clip_end=data.clip_end,
    )


def window(camera, depsgraph, render) -> tuple[float, float, float, float]:
    """(left, right, bottom, top) of the full frame at distance 1 in front of the camera.

    Blender's own projection matrix decides, so shift, sensor fit and pixel aspect are as there.
    With P[0][0] = 2n/(r-l) and P[0][2] = (r+l)/(r-l), x = (ndc + P[0][2]) / P[0][0] at z = -1.
    """
    width, height = frame_size(render)
    p = camera.calc_matrix_camera(
        depsgraph,
        x=width,
        y=height,
        scale_x=render.pixel_aspect_x,
        scale_y=render.pixel_aspect_y,
    )
    return (
        (p[0][2] - 1.0) / p[0][0],
        (p[0][2] + 1.0) / p[0][0],
        (p[1][2] - 1.0) / p[1][1],
        (p[1][2] + 1.0) / p[1][1],
    )


def without_scale(matrix) -> np.ndarray:
    """The 4x4 matrix with axes of length one: a scaled camera sees the same picture."""
    result = np.array(matrix, dtype=np.float64)
    lengths = np.linalg.norm(result[:3, :3], axis=0)
    result[:3, :3] /= np.where(lengths > 0.0, lengths, 1.0)
    return result
