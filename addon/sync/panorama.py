# SPDX-License-Identifier: GPL-3.0-or-later
"""Panoramas: their kind, and what their film shows."""

import math

from ..report import RenderRefused
from .settings import frame_size

PANORAMAS = (
    "EQUIRECTANGULAR",
    "EQUIANGULAR_CUBEMAP_FACE",
    "MIRRORBALL",
    "FISHEYE_EQUIDISTANT",
    "FISHEYE_EQUISOLID",
    "FISHEYE_LENS_POLYNOMIAL",
    "CENTRAL_CYLINDRICAL",
)


def panorama(data):
    """Where this Blender keeps the settings of panoramas: before 5.0 they were Cycles' own.

    Raises RenderRefused if it has none.
    """
    if hasattr(data, "panorama_type"):
        return data
    if hasattr(data, "cycles"):
        return data.cycles
    raise RenderRefused(
        f"Camera '{data.name}' is a panorama. Before Blender 5.0 the settings of panoramas belong "
        "to the add-on Cycles Render Engine, which is not enabled"
    )


def film(data, render) -> dict:
    """The arguments of set_camera that a panorama has in the place of a projection.

    Windows are in the units that the core has for each kind.
    """
    settings = panorama(data)
    kind = settings.panorama_type
    arguments = {}
    if kind == "EQUIRECTANGULAR":
        frame = (
            settings.longitude_min,
            settings.longitude_max,
            settings.latitude_min,
            settings.latitude_max,
        )
    elif kind == "CENTRAL_CYLINDRICAL":
        radius = settings.central_cylindrical_radius
        frame = (
            settings.central_cylindrical_range_u_min,
            settings.central_cylindrical_range_u_max,
            settings.central_cylindrical_range_v_min / radius,
            settings.central_cylindrical_range_v_max / radius,
        )
    elif kind == "EQUIANGULAR_CUBEMAP_FACE":
        frame = around_middle(0.5 * math.pi, 0.5 * math.pi)
    elif kind == "MIRRORBALL":
        frame = around_middle(2.0, 2.0)
    else:
        arguments["fisheye_fov"] = settings.fisheye_fov
        if kind == "FISHEYE_EQUIDISTANT":
            frame = around_middle(settings.fisheye_fov, settings.fisheye_fov)
        else:
            frame = around_middle(*sensor(data, render))
        if kind == "FISHEYE_EQUISOLID":
            arguments["fisheye_lens"] = settings.fisheye_lens
        elif kind == "FISHEYE_LENS_POLYNOMIAL":
            arguments["fisheye_polynomial"] = tuple(
                getattr(settings, f"fisheye_polynomial_k{i}") for i in range(5)
            )
    if data.shift_x or data.shift_y:
        x, y = data.shift_x * (frame[1] - frame[0]), data.shift_y * (frame[3] - frame[2])
        frame = (frame[0] + x, frame[1] + x, frame[2] + y, frame[3] + y)
        arguments["shift"] = (data.shift_x, data.shift_y)
    return {"type": kind, "window": frame, **arguments}


def around_middle(width: float, height: float) -> tuple[float, float, float, float]:
    return (-0.5 * width, 0.5 * width, -0.5 * height, 0.5 * height)


def sensor(data, render) -> tuple[float, float]:
    """The width and height of the part of the sensor that is the frame, in millimetres."""
    width, height = frame_size(render)
    x, y = width * render.pixel_aspect_x, height * render.pixel_aspect_y
    if data.sensor_fit == "VERTICAL":
        return data.sensor_height * x / y, data.sensor_height
    if data.sensor_fit == "HORIZONTAL" or x > y:
        return data.sensor_width, data.sensor_width * y / x
    return data.sensor_width * x / y, data.sensor_width


def pixel_size(frame, width: int, height: int) -> float:
    """How large a pixel is on the film, as Cycles has it: the mean of its two sides."""
    return 0.5 * (abs(frame[1] - frame[0]) / width + abs(frame[3] - frame[2]) / height)
