# SPDX-License-Identifier: GPL-3.0-or-later
"""light.janus: the light as a projector (dual photography)."""

import bpy
from bpy.props import IntProperty, PointerProperty, StringProperty

from .view_layer import heard

MOST_PROJECTOR, MOST_CAMERA = 256, 512


@heard
class CaptureSettings:
    """Of a capture: those of a light, and of the operator."""

    projector_width: IntProperty(
        name="Resolution X",
        description="Pixels in a row of the projector's picture, at most 256",
        min=1,
        max=MOST_PROJECTOR,
        default=64,
        subtype="PIXEL",
    )
    projector_height: IntProperty(
        name="Resolution Y",
        description="Rows of pixels of the projector's picture, at most 256",
        min=1,
        max=MOST_PROJECTOR,
        default=64,
        subtype="PIXEL",
    )
    camera_size: IntProperty(
        name="Camera Pixels",
        description="Pixels on the longer side of the camera's picture, at most 512. It has no "
        "more than the render, and its shape",
        min=1,
        max=MOST_CAMERA,
        default=256,
        subtype="PIXEL",
    )
    samples: IntProperty(
        name="Samples",
        description="Samples of each camera pixel. A few more are taken first, to see where the "
        "matrix needs small blocks",
        min=2,
        max=1 << 20,
        soft_max=4096,
        default=128,
    )
    memory: IntProperty(
        name="Memory",
        description="Megabytes for the sums while the matrix is captured: more of it makes "
        "smaller blocks",
        min=16,
        max=1 << 18,
        soft_max=8192,
        default=256,
    )


@heard
class JanusLightSettings(CaptureSettings, bpy.types.PropertyGroup):
    """Settings of a light as a projector"""

    matrix_path: StringProperty(
        name="Matrix",
        description="The file of the light transport matrix, .npz (empty: in Blender's temporary "
        "folder)",
        subtype="FILE_PATH",
    )
    slide: PointerProperty(
        name="Slide",
        description="The image that the projector shows (none: the light as it was captured, with "
        "its nodes)",
        type=bpy.types.Image,
    )


def register():
    bpy.utils.register_class(JanusLightSettings)
    bpy.types.Light.janus = PointerProperty(type=JanusLightSettings)


def unregister():
    del bpy.types.Light.janus
    bpy.utils.unregister_class(JanusLightSettings)
