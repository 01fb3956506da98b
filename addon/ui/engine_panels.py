# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens Blender's own panels to Janus, as every engine does, and closes them again."""

import bpy

ENGINE = "JANUS"

# Panels that stay closed though they are for every engine, or for Cycles, and why. A name that ends
# in * stands for all that begin so.
OWN = "Janus has one of its own"
EXCLUDED = {
    "DATA_PT_camera_stereoscopy": "Janus renders one view",
    "DATA_PT_light": OWN,
    "DATA_PT_lightprobe*": "for Eevee's probes",
    "DATA_PT_preview": OWN,
    "DATA_PT_spot": OWN,
    "DATA_PT_volume_render": "Janus renders no volumes",
    "MATERIAL_PT_freestyle_line": "Janus draws no lines",
    "NODE_DATA_PT_light": OWN,
    "OBJECT_PT_shadow_terminator": "Janus does not move it",
    "RENDER_PT_freestyle": "Janus draws no lines",
    "RENDER_PT_gpencil": "Janus renders no Grease Pencil",
    "RENDER_PT_simplify": OWN,
    "RENDER_PT_stereoscopy": "Janus renders one view",
    "VIEWLAYER_PT_filter": OWN,
    "VIEWLAYER_PT_freestyle*": "Janus draws no lines",
    "VIEWLAYER_PT_layer_passes*": OWN,
    "VIEWLAYER_PT_override": OWN,
}
# Made for Blender's own engines, and what Janus needs: Cycles has copies of them.
INCLUDED = {"DATA_PT_camera_dof", "DATA_PT_camera_dof_aperture"}

_opened: list[type] = []


def why_closed(panel: type) -> str:
    """Why a panel of Blender's stays closed to Janus; empty: it is open."""
    name = panel.__name__
    if name in INCLUDED:
        return ""
    for pattern, reason in EXCLUDED.items():
        start = pattern.removesuffix("*")
        if name == start or (start != pattern and name.startswith(start)):
            return reason
    engines = panel.COMPAT_ENGINES - {ENGINE}
    if "BLENDER_RENDER" not in engines:
        return "for " + ", ".join(sorted(engines))
    parent = getattr(bpy.types, getattr(panel, "bl_parent_id", ""), None)
    if hasattr(parent, "COMPAT_ENGINES") and why_closed(parent):
        return f"part of {parent.__name__}"
    return ""


def panels_of_engines() -> list[type]:
    """Those of Blender and its add-ons that are for some engines only."""
    panels = bpy.types.Panel.__subclasses__()
    return [panel for panel in panels if getattr(panel, "COMPAT_ENGINES", set()) - {ENGINE}]


def register():
    for panel in panels_of_engines():
        if ENGINE not in panel.COMPAT_ENGINES and not why_closed(panel):
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
