# SPDX-License-Identifier: GPL-3.0-or-later
"""What a 3D viewport looks at: its camera, and the pixels that are to be rendered."""

from dataclasses import dataclass, replace

import bpy
import numpy as np

from .camera import camera_type, lens, window, window_of, without_scale
from .panorama import PANORAMAS, film, pixel_size


@dataclass(frozen=True)
class View:
    """Pixels count from the bottom left. The full frame stands somewhere in the region."""

    x: int  # of the full frame's corner in the region
    y: int
    width: int  # of the full frame
    height: int
    crop: tuple[int, int, int, int] | None  # the part to render: x0, y0, x1, y1 in the full frame
    camera: dict  # the arguments of SceneBuilder.set_camera
    pixel: int = 1  # the finished picture's are so many times as large as the region's

    def scaled(self, divider: int) -> dict:
        """width, height and crop of RenderSettings with pixels `divider` times as large."""
        width, height = max(self.width // divider, 1), max(self.height // divider, 1)
        if self.crop is None:
            return {"width": width, "height": height, "crop": None}
        x0, y0, x1, y1 = (round(side / divider) for side in self.crop)
        x0, y0 = min(x0, width - 1), min(y0, height - 1)
        crop = (x0, y0, min(max(x1, x0 + 1), width), min(max(y1, y0 + 1), height))
        return {"width": width, "height": height, "crop": crop}

    @property
    def rectangle(self) -> tuple[int, int, int, int]:
        """Where the picture is in the region: x, y, width, height."""
        x0, y0, x1, y1 = self.crop or (0, 0, self.width, self.height)
        return self.x + x0, self.y + y0, x1 - x0, y1 - y0


def pixel_of(scene) -> int:
    """Blender's Pixel Size; by itself, larger where its whole interface is."""
    chosen = scene.render.preview_pixel_size
    if chosen != "AUTO":
        return int(chosen)
    return 2 if bpy.context.preferences.system.pixel_size > 1.5 else 1


def read_view(region, rv3d, space, depsgraph) -> View:
    """The view of a region of a 3D viewport. Raises RenderRefused for a camera that Janus lacks.

    Blender's own matrices decide, so that zoom, offset, lens shift and sensor fit are as there.
    """
    view = _read_view(region, rv3d, space, depsgraph)
    return replace(view, pixel=pixel_of(depsgraph.scene))


def _read_view(region, rv3d, space, depsgraph) -> View:
    scene = depsgraph.scene_eval
    width, height = max(region.width, 1), max(region.height, 1)
    seen = camera_of(rv3d, space, scene)
    if seen is None:
        border = border_of(space, space.use_render_border)
        crop = pixels(border, (0, 0, width, height), width, height) if border else None
        return View(0, 0, width, height, crop, free_camera(rv3d, space, height))
    camera = seen.evaluated_get(depsgraph)
    frame = frame_in_region(camera, depsgraph, rv3d, width, height)
    kind = camera_type(camera)
    border = border_of(scene.render, scene.render.use_border)
    if kind in PANORAMAS:  # no matrix: it fills its frame, whatever the region
        return panoramic_view(camera, frame, border, width, height, depsgraph)
    crop = pixels(border, frame, width, height) if border else None
    arguments = projected(rv3d, height, camera.data.clip_start, camera.data.clip_end)
    arguments |= {"name": camera.name, "type": kind}
    if camera.data.dof.use_dof:
        arguments |= lens(camera.data, without_scale(camera.matrix_world), depsgraph)
    return View(0, 0, width, height, crop, arguments)


def camera_of(rv3d, space, scene):
    """The camera that the view looks through, if any."""
    if rv3d.view_perspective != "CAMERA":
        return None
    camera = space.camera if space.use_local_camera else scene.camera
    return camera if camera is not None and camera.type == "CAMERA" else None


def free_camera(rv3d, space, height: int) -> dict:
    """Of a view that looks through no camera."""
    arguments = projected(rv3d, height, space.clip_start, space.clip_end)
    return arguments | {"name": "Viewport", "type": "PERSP" if rv3d.is_perspective else "ORTHO"}


def projected(rv3d, height: int, clip_start: float, clip_end: float) -> dict:
    """Transform, window and clipping of the view's matrices."""
    p = rv3d.window_matrix
    transform = without_scale(rv3d.view_matrix.inverted())
    if not rv3d.is_perspective:
        # An orthographic view may begin behind the eye: with P[2][2] = -2/(f-n) and
        # P[2][3] = -(f+n)/(f-n), n = (1 + P[2][3]) / P[2][2].
        near, far = (1.0 + p[2][3]) / p[2][2], (p[2][3] - 1.0) / p[2][2]
        back = max(-near, 0.0)
        transform[:3, 3] += back * transform[:3, 2]
        clip_start, clip_end = max(near + back, 0.0), far + back
    frame = window_of(p, parallel=not rv3d.is_perspective)
    return {
        "transform": transform,
        "window": frame,
        "clip_start": clip_start,
        "clip_end": clip_end,
        "pixel_size": (frame[3] - frame[2]) / height,
    }


def frame_in_region(camera, depsgraph, rv3d, width: int, height: int):
    """Where the frame of the render is in the region of a camera view: x0, y0, x1, y1, as floats.

    Both are windows on the same plane.
    """
    whole = window_of(rv3d.window_matrix, parallel=not rv3d.is_perspective)
    frame = window(camera, depsgraph, depsgraph.scene_eval.render)
    x = [(side - whole[0]) / (whole[1] - whole[0]) * width for side in frame[:2]]
    y = [(side - whole[2]) / (whole[3] - whole[2]) * height for side in frame[2:]]
    return x[0], y[0], x[1], y[1]


def panoramic_view(camera, frame, border, width: int, height: int, depsgraph) -> View:
    data = camera.data
    x, y = round(frame[0]), round(frame[1])
    full = max(round(frame[2]) - x, 1), max(round(frame[3]) - y, 1)
    arguments = {
        "name": camera.name,
        "transform": without_scale(camera.matrix_world),
        "clip_start": data.clip_start,
        "clip_end": data.clip_end,
        **film(data, depsgraph.scene_eval.render),
    }
    arguments["pixel_size"] = pixel_size(arguments["window"], *full)
    if data.dof.use_dof:
        arguments |= lens(data, arguments["transform"], depsgraph)
    # Zoomed in, the frame is larger than the region.
    inside = pixels(border or (0.0, 0.0, 1.0, 1.0), frame, width, height)
    crop = tuple(
        min(max(side - corner, 0), most)
        for side, corner, most in zip(inside, (x, y, x, y), (*full, *full), strict=True)
    )
    empty = crop[0] >= crop[2] or crop[1] >= crop[3]
    return View(x, y, *full, (0, 0, 1, 1) if empty else crop, arguments)


def border_of(owner, used: bool) -> tuple[float, float, float, float] | None:
    """The border of scene.render or of a 3D viewport, as fractions; None: there is none."""
    if not used:
        return None
    names = ("border_min_x", "border_min_y", "border_max_x", "border_max_y")
    prefix = "" if hasattr(owner, names[0]) else "render_"
    return tuple(getattr(owner, prefix + name) for name in names)


def pixels(border, frame, width: int, height: int) -> tuple[int, int, int, int]:
    """The part of a region that a border of a frame takes up, at least one pixel of it."""
    x0, y0, x1, y1 = frame
    sides = (
        x0 + border[0] * (x1 - x0),
        y0 + border[1] * (y1 - y0),
        x0 + border[2] * (x1 - x0),
        y0 + border[3] * (y1 - y0),
    )
    left = int(np.clip(round(sides[0]), 0, width - 1))
    bottom = int(np.clip(round(sides[1]), 0, height - 1))
    right = int(np.clip(round(sides[2]), left + 1, width))
    top = int(np.clip(round(sides[3]), bottom + 1, height))
    return left, bottom, right, top
