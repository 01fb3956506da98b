# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets, as Blender keeps them: the user's, and those in presets/."""

from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from .engine_panels import ENGINE

FOLDER = Path(__file__).resolve().parents[1]  # where presets/ is
SAMPLING = (
    "samples",
    "use_adaptive_sampling",
    "adaptive_threshold",
    "adaptive_min_samples",
    "time_limit",
    "use_denoising",
    "denoising_input_passes",
    "denoising_prefilter",
    "denoising_quality",
)
VIEWPORT_SAMPLING = (
    "preview_samples",
    "use_preview_adaptive_sampling",
    "preview_adaptive_threshold",
    "preview_adaptive_min_samples",
    "use_preview_denoising",
    "preview_denoising_start_sample",
    "preview_denoising_input_passes",
    "preview_denoising_prefilter",
    "preview_denoising_quality",
)
LIGHT_PATHS = (
    "max_bounces",
    "diffuse_bounces",
    "glossy_bounces",
    "transmission_bounces",
    "transparent_max_bounces",
    "sample_clamp_direct",
    "sample_clamp_indirect",
)


def folders_can_be_named() -> bool:
    """The first releases of Blender 4.2 look for presets of add-ons nowhere but in old places."""
    return hasattr(bpy.utils, "register_preset_path")


class Presets(PresetPanel):
    bl_space_type = "PROPERTIES"
    bl_region_type = "HEADER"
    COMPAT_ENGINES = {ENGINE}
    preset_operator = "script.execute_preset"

    def path_menu(self, searchpaths, *rest, **how):
        if not folders_can_be_named():
            searchpaths = [*searchpaths, str(FOLDER / "presets" / self.preset_subdir)]
        bpy.types.Menu.path_menu(self, searchpaths, *rest, **how)


class JANUS_PT_sampling_presets(Presets, bpy.types.Panel):
    bl_label = "Sampling Presets"
    preset_subdir = "janus/sampling"
    preset_add_operator = "janus.sampling_preset_add"


class JANUS_PT_viewport_sampling_presets(Presets, bpy.types.Panel):
    bl_label = "Viewport Sampling Presets"
    preset_subdir = "janus/viewport_sampling"
    preset_add_operator = "janus.viewport_sampling_preset_add"


class JANUS_PT_light_paths_presets(Presets, bpy.types.Panel):
    bl_label = "Light Paths Presets"
    preset_subdir = "janus/light_paths"
    preset_add_operator = "janus.light_paths_preset_add"


class AddPreset(AddPresetBase):
    preset_defines = ["janus = bpy.context.scene.janus"]


class JANUS_OT_sampling_preset_add(AddPreset, bpy.types.Operator):
    """Add a sampling preset"""

    bl_idname = "janus.sampling_preset_add"
    bl_label = "Add Sampling Preset"
    preset_menu = "JANUS_PT_sampling_presets"
    preset_subdir = "janus/sampling"
    preset_values = [f"janus.{name}" for name in SAMPLING]


class JANUS_OT_viewport_sampling_preset_add(AddPreset, bpy.types.Operator):
    """Add a viewport sampling preset"""

    bl_idname = "janus.viewport_sampling_preset_add"
    bl_label = "Add Viewport Sampling Preset"
    preset_menu = "JANUS_PT_viewport_sampling_presets"
    preset_subdir = "janus/viewport_sampling"
    preset_values = [f"janus.{name}" for name in VIEWPORT_SAMPLING]


class JANUS_OT_light_paths_preset_add(AddPreset, bpy.types.Operator):
    """Add a preset of bounces and clamping"""

    bl_idname = "janus.light_paths_preset_add"
    bl_label = "Add Light Paths Preset"
    preset_menu = "JANUS_PT_light_paths_presets"
    preset_subdir = "janus/light_paths"
    preset_values = [f"janus.{name}" for name in LIGHT_PATHS]


CLASSES = (
    JANUS_PT_sampling_presets,
    JANUS_PT_viewport_sampling_presets,
    JANUS_PT_light_paths_presets,
    JANUS_OT_sampling_preset_add,
    JANUS_OT_viewport_sampling_preset_add,
    JANUS_OT_light_paths_preset_add,
)


def register():
    if folders_can_be_named():
        bpy.utils.register_preset_path(str(FOLDER))


def unregister():
    if folders_can_be_named():
        bpy.utils.unregister_preset_path(str(FOLDER))
