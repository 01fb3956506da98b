# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of panoramas: Blender's own panel shows them to Cycles alone."""

import bpy

from .engine_panels import JanusPanel

# By kind: property and label; None begins a group. As in Blender's panel.
SETTINGS = {
    "FISHEYE_EQUIDISTANT": (("fisheye_fov", "Field of View"),),
    "FISHEYE_EQUISOLID": (("fisheye_lens", "Lens"), ("fisheye_fov", "Field of View")),
    "FISHEYE_LENS_POLYNOMIAL": (
        ("fisheye_fov", "Field of View"),
        *((f"fisheye_polynomial_k{i}", f"K{i}") for i in range(5)),
    ),
    "EQUIRECTANGULAR": (
        ("latitude_min", "Latitude Min"),
        ("latitude_max", "Max"),
        None,
        ("longitude_min", "Longitude Min"),
        ("longitude_max", "Max"),
    ),
    "CENTRAL_CYLINDRICAL": (
        ("central_cylindrical_range_v_min", "Height Min"),
        ("central_cylindrical_range_v_max", "Max"),
        None,
        ("central_cylindrical_range_u_min", "Longitude Min"),
        ("central_cylindrical_range_u_max", "Max"),
        None,
        ("central_cylindrical_radius", "Cylinder Radius"),
    ),
}


def settings_of(data):
    """The panorama's settings; None where there are none, see sync/panorama.py."""
    return data if hasattr(data, "panorama_type") else getattr(data, "cycles", None)


class JANUS_CAMERA_PT_panorama(JanusPanel, bpy.types.Panel):
    bl_label = "Panorama"
    bl_context = "data"
    bl_parent_id = "DATA_PT_lens"

    @classmethod
    def poll(cls, context):
        camera = getattr(context, "camera", None)
        return super().poll(context) and camera is not None and camera.type == "PANO"

    def draw(self, context):
        settings = settings_of(context.camera)
        if settings is None:
            self.layout.label(text="Enable the add-on Cycles Render Engine", icon="ERROR")
            return
        column = self.column()
        column.prop(settings, "panorama_type")
        group = column.column(align=True)
        for entry in SETTINGS.get(settings.panorama_type, ()):
            if entry is None:
                group = column.column(align=True)
                continue
            name, label = entry
            group.prop(settings, name, text=label)


CLASSES = (JANUS_CAMERA_PT_panorama,)
