# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens Blender's own panels to Janus, as every engine does, and closes them again."""

import bpy

ENGINE = "JANUS"

# Panels that would offer what Janus does not do, or does in a panel of its own.
EXCLUDED = {
    "DATA_PT_light",
    "DATA_PT_spot",
    "NODE_DATA_PT_light",
    "DATA_PT_volume_render",
    "MATERIAL_PT_freestyle_line",
    "RENDER_PT_freestyle",
    "RENDER_PT_gpencil",
    "RENDER_PT_stereoscopy",
    "VIEWLAYER_PT_filter",
    "VIEWLAYER_PT_layer_passes",
}
EXCLUDED_PREFIXES = ("VIEWLAYER_PT_freestyle", "DATA_PT_lightprobe")

_opened: list[type] = []


def wanted_panels() -> list[type]:
    """Panels made for every engine, less those that do not apply."""
    return [
        panel
        for panel in bpy.types.Panel.__subclasses__()
        if "BLENDER_RENDER" in getattr(panel, "COMPAT_ENGINES", ())
        and panel.__name__ not in EXCLUDED
        and not panel.__name__.startswith(EXCLUDED_PREFIXES)
    ]


def register():
    for panel in wanted_panels():
        if ENGINE not in panel.COMPAT_ENGINES:
            panel.COMPAT_ENGINES.add(ENGINE)
            _opened.append(panel)


def unregister():
    for panel in _opened:
        panel.COMPAT_ENGINES.discard(ENGINE)
    _opened.clear()


class JanusPanel:
    """What all panels of Janus share."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES

    def column(self):
        """A column laid out as Blender lays out properties."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout.column()
