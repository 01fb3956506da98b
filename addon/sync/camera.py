# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera: where it stands, which window it looks through, and its lens."""

import numpy as np

from ..report import RenderRefused
from .panorama import PANORAMAS, film, panorama, pixel_size
from .settings import frame_size


def sync_camera(builder, depsgraph, log) -> tuple[float, float, float, float]:
    """Sends the scene's camera, and returns its window. Raises RenderRefused for what cannot be
    rendered at all."""
    scene = depsgraph.scene_eval
    if scene.camera is None:
        raise RenderRefused("The scene has no active camera")
    camera = scene.camera.evaluated_get(depsgraph)
    if camera.type != "CAMERA":
        raise RenderRefused(f"'{camera.name}' is the active camera, but it is no camera object")
    data = camera.data
    kind = camera_type(camera)
    transform = without_scale(camera.matrix_world)
    width, height = frame_size(scene.render)
    if kind in PANORAMAS:
        seen = film(data, scene.render)
        seen["pixel_size"] = pixel_size(seen["window"], width, height)
    else:
        frame = window(camera, depsgraph, scene.render)
        seen = {"type": kind, "window": frame, "pixel_size": (frame[3] - frame[2]) / height}
    builder.set_camera(
        name=camera.name,
        transform=transform,
        clip_start=data.clip_start,
        clip_end=data.clip_end,
        **seen,
        **(lens(data, transform, depsgraph) if data.dof.use_dof else {}),
    )
    return seen["window"]


def camera_type(camera) -> str:
    """PERSP, ORTHO or one of PANORAMAS. Raises RenderRefused for all others, with their name."""
    kind = camera.data.type
    if kind in ("PERSP", "ORTHO"):
        return kind
    what = f"a {kind.lower()} camera"
    if kind == "PANO":
        projection = panorama(camera.data).panorama_type
        if projection in PANORAMAS:
            return projection
        what = f"a panorama of type {projection}"
    raise RenderRefused(
        f"Camera '{camera.name}' is {what}: Janus renders perspective, orthographic and "
        "panoramic cameras"
    )


def lens(data, transform, depsgraph) -> dict:
    """The arguments of set_camera for depth of field, with sizes as in Cycles.

    The f-stop divides the focal length; an orthographic camera counts as having one of a metre.
    """
    dof = data.dof
    focal_length = 1.0 if data.type == "ORTHO" else 0.001 * data.lens
    return {
        "aperture_radius": 0.5 * focal_length / max(dof.aperture_fstop, 1e-5),
        "focus_distance": focus_distance(dof, transform, depsgraph),
        "aperture_blades": dof.aperture_blades,
        "aperture_rotation": dof.aperture_rotation,
        "aperture_ratio": dof.aperture_ratio,
    }


def focus_distance(dof, transform, depsgraph) -> float:
    """Along the view axis, to the focus object (or its bone) if there is one."""
    if dof.focus_object is None:
        return dof.focus_distance
    focus = dof.focus_object.evaluated_get(depsgraph)
    matrix = focus.matrix_world
    if focus.pose and dof.focus_subtarget in focus.pose.bones:
        matrix = matrix @ focus.pose.bones[dof.focus_subtarget].matrix
    to_camera = transform[:3, 3] - np.array(matrix.translation)
    return float(abs(transform[:3, 2] @ to_camera))


def window(camera, depsgraph, render) -> tuple[float, float, float, float]:
    """(left, right, bottom, top) of the full frame at distance 1 in front of the camera; of an
    orthographic one in metres.

    Blender's own projection matrix decides, so shift, sensor fit and pixel aspect are as there.
    """
    width, height = frame_size(render)
    p = camera.calc_matrix_camera(
        depsgraph,
        x=width,
        y=height,
        scale_x=render.pixel_aspect_x,
        scale_y=render.pixel_aspect_y,
    )
    return window_of(p, parallel=camera.data.type == "ORTHO")


def window_of(p, parallel: bool) -> tuple[float, float, float, float]:
    """The same from a projection matrix.

    With P[0][0] = 2n/(r-l) and P[0][2] = (r+l)/(r-l), x = (ndc + P[0][2]) / P[0][0] at z = -1.
    Orthographic: ndc = P[0][0] x + P[0][3].
    """
    x, y = (-p[0][3], -p[1][3]) if parallel else (p[0][2], p[1][2])
    return (
        (x - 1.0) / p[0][0],
        (x + 1.0) / p[0][0],
        (y - 1.0) / p[1][1],
        (y + 1.0) / p[1][1],
    )


def without_scale(matrix) -> np.ndarray:
    """The 4x4 matrix with axes of length one: a scaled camera sees the same picture."""
    result = np.array(matrix, dtype=np.float64)
    lengths = np.linalg.norm(result[:3, :3], axis=0)
    result[:3, :3] /= np.where(lengths > 0.0, lengths, 1.0)
    return result
