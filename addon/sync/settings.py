# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers of a render: resolution, border, samples. Plain data, no core."""

import os
import zlib
from dataclasses import dataclass, field

import bpy
import numpy as np

from ..report import RenderRefused
from . import cycles_settings, passes

UNLIMITED_SAMPLES = 1 << 24


@dataclass(frozen=True)
class Frame:
    """What Blender wants to get back for one view layer. Pixels count from the bottom left."""

    width: int  # of the full frame, whatever the border
    height: int
    crop: tuple[int, int, int, int] | None  # x0, y0, x1, y1 inside the full frame
    scene: str
    view_layer: str
    view_layers: list[str] = field(default_factory=list)
    number: int = 1
    partial_path: str = ""  # where to save what there is if the render fails
    capture_path: str = ""  # where to save the scene description; empty: nowhere


def frame(depsgraph, is_animation: bool = False) -> Frame:
    """Reads the frame to render from the evaluated scene."""
    scene = depsgraph.scene_eval
    width, height = frame_size(scene.render)
    capture = getattr(scene, "janus", None) and scene.janus.capture_path
    return Frame(
        width=width,
        height=height,
        crop=crop_window(scene.render, width, height),
        scene=depsgraph.scene.name_full,
        view_layer=depsgraph.view_layer_eval.name,
        view_layers=[layer.name for layer in depsgraph.scene.view_layers],
        number=scene.frame_current,
        partial_path=partial_path(scene, is_animation),
        capture_path=bpy.path.abspath(capture) if capture else "",
    )


def active_views(render) -> list[str]:
    """The names of the views of Stereoscopy that are to be rendered."""
    stereo = render.views_format == "STEREO_3D"
    names = [view.name for view in render.views if view.use] if render.use_multiview else []
    return [name for name in names if not stereo or name in ("left", "right")]


def check_views(render) -> None:
    names = active_views(render)
    if len(names) > 1:
        views = ", ".join(f"'{name}'" for name in names)
        raise RenderRefused(
            f"Stereoscopy (Output properties) asks for the views {views}, and Janus renders one: "
            "switch off Stereoscopy, or all views but one"
        )


def frame_size(render) -> tuple[int, int]:
    """The full frame in pixels, rounded as Blender rounds."""
    percent = render.resolution_percentage
    return (
        max(render.resolution_x * percent // 100, 1),
        max(render.resolution_y * percent // 100, 1),
    )


def crop_window(render, width: int, height: int):
    """The render border in pixels, or None. Blender truncates in single precision; so do we."""
    if not render.use_border:
        return None

    def pixel(fraction, size):
        return int(np.float32(fraction) * np.float32(size))

    x0, x1 = pixel(render.border_min_x, width), pixel(render.border_max_x, width)
    y0, y1 = pixel(render.border_min_y, height), pixel(render.border_max_y, height)
    if x1 <= x0 or y1 <= y0:
        return None
    return (x0, y0, x1, y1)


def render_settings(depsgraph) -> dict:
    """The keyword arguments of janus_core.RenderSettings. Raises RenderRefused."""
    scene = depsgraph.scene_eval
    check_views(scene.render)
    width, height = frame_size(scene.render)
    return {
        **light_settings(scene),
        "width": width,
        "height": height,
        "crop": crop_window(scene.render, width, height),
        "samples": depsgraph.view_layer_eval.samples or cycles_settings.value(scene, "samples"),
        **adaptive_settings(scene, ""),
        "seconds": cycles_settings.value(scene, "time_limit"),
        "motion_blur": scene.render.use_motion_blur and depsgraph.view_layer_eval.use_motion_blur,
        **passes.arguments(scene, depsgraph.view_layer_eval),
    }


def view_settings(scene) -> dict:
    """The same for a viewport, but for its resolution."""
    denoising = view_denoising(scene)
    return {
        **light_settings(scene),
        "samples": cycles_settings.value(scene, "preview_samples") or UNLIMITED_SAMPLES,
        **adaptive_settings(scene, "preview_"),
        "data_passes": list(denoising["guides"]) if denoising else [],
    }


def adaptive_settings(scene, prefix: str) -> dict:
    """When pixels may stop; `prefix`: "preview_" of the viewport."""

    def shared(name):
        return cycles_settings.value(scene, name)

    adaptive = shared(f"use_{prefix}adaptive_sampling")
    return {
        "noise_threshold": shared(f"{prefix}adaptive_threshold") if adaptive else 0.0,
        "min_samples": shared(f"{prefix}adaptive_min_samples"),
    }


def view_denoising(scene) -> dict | None:
    """How a viewport is to be denoised: from which sample on, what the denoiser looks at, and its
    arguments. None: it is not.
    """

    def shared(name):
        return cycles_settings.value(scene, f"preview_denoising_{name}")

    if not cycles_settings.value(scene, "use_preview_denoising"):
        return None
    return {
        "start_sample": shared("start_sample"),
        "guides": passes.GUIDES[shared("input_passes")],
        "prefilter": shared("prefilter"),
        "quality": shared("quality"),
    }


def light_settings(scene) -> dict:
    """What does not depend on how large and how long the render is to be."""
    render, janus = scene.render, scene.janus

    def shared(name):
        return cycles_settings.value(scene, name)

    filter_type = shared("pixel_filter_type")
    averages = janus.heuristic == "NONE" and janus.integrator == "BDPT"
    return {
        "seed": frame_seed(scene),
        "threads": render.threads if render.threads_mode == "FIXED" else 0,
        "max_bounces": shared("max_bounces"),
        "max_diffuse_bounces": shared("diffuse_bounces"),
        "max_glossy_bounces": shared("glossy_bounces"),
        "max_transmission_bounces": shared("transmission_bounces"),
        "transparent_max_bounces": shared("transparent_max_bounces"),
        "clamp_direct": janus.sample_clamp_direct,
        "clamp_indirect": janus.sample_clamp_indirect,
        "integrator": janus.integrator.lower(),
        "filter": filter_type,
        # A box has no width to choose in Cycles: the panel hides the setting, which has no effect.
        "filter_width": 1.0 if filter_type == "BOX" else shared("filter_width"),
        "next_event": janus.next_event,
        "connection_mode": janus.connection_mode,
        "light_paths": janus.light_paths,
        "connections": janus.connections,
        "merge_radius": janus.merge_radius if merges(janus) else 0.0,
        "adaptive_counts": janus.adaptive_counts,
        "heuristic": "BALANCE" if janus.heuristic == "NONE" and not averages else janus.heuristic,
        "strategies": janus.strategies if averages else "",
        "film_exposure": shared("film_exposure"),
        "film_transparent": render.film_transparent,
        "film_transparent_glass": shared("film_transparent_glass"),
        "film_transparent_roughness": shared("film_transparent_roughness"),
    }


def frame_seed(scene) -> int:
    """The seed, or one of the frame that depends on it."""
    seed = scene.janus.seed
    if not cycles_settings.value(scene, "use_animated_seed"):
        return seed
    return zlib.crc32(f"{seed} {scene.frame_current} {scene.frame_subframe}".encode()) >> 1


def merges(janus) -> bool:
    """Are vertices merged? That takes the cache, and weights."""
    return janus.use_merging and janus.connection_mode == "CACHE" and janus.heuristic != "NONE"


def partial_path(scene, is_animation: bool) -> str:
    """`<output>_partial.exr`, beside the file that Blender would have written."""
    path = scene.render.frame_path(frame=scene.frame_current)
    if not is_animation:
        path = bpy.path.abspath(scene.render.filepath)
    if not path or os.path.basename(path) == "":
        path = os.path.join(path or bpy.app.tempdir, "janus")
    stem, extension = os.path.splitext(path)
    if extension.lower() not in bpy.path.extensions_image:
        stem = path
    return f"{stem}_partial.exr"
