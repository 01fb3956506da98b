# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens or builds the scene and gives it the settings of the command line."""

from __future__ import annotations

import argparse
import contextlib
import importlib

import bpy

from scenes import kit
from scenes.driver.addon import ENGINE

FOREVER = 1 << 24  # samples, where only the time is limited


class Problem(Exception):
    """Something that ends the render; the message is one line for the user."""


def open_scene(options: argparse.Namespace) -> bpy.types.Scene:
    """The scene to render, built or read; scripts inside a .blend never run."""
    if options.blend is None:
        scene = bpy.context.scene
        importlib.import_module(f"scenes.{options.scene}").build(scene)
        return scene
    try:
        bpy.ops.wm.open_mainfile(filepath=str(options.blend), load_ui=False, use_scripts=False)
    except RuntimeError as error:
        # Blender also raises for what is only reported, such as a missing library.
        if bpy.data.filepath != str(options.blend):
            raise Problem(f"cannot open {options.blend}: {one_line(error)}") from error
    return bpy.context.scene


def apply(scene: bpy.types.Scene, options: argparse.Namespace) -> None:
    """What holds for every engine, then the engine's own settings."""
    render = scene.render
    render.use_compositing = False
    render.use_sequencer = False
    render.use_persistent_data = False
    render.filepath = str(options.output)  # a failed render keeps what it has beside it
    if options.resolution:
        render.resolution_x, render.resolution_y = options.resolution
        render.resolution_percentage = 100
    if options.threads is not None:
        render.threads_mode = "FIXED" if options.threads else "AUTO"
        render.threads = options.threads or render.threads
    if options.samples:
        for layer in scene.view_layers:
            layer.samples = 0  # no layer overrides the scene
    if options.frame is not None:
        scene.frame_set(options.frame)
    if options.engine == "cycles":
        _apply_cycles(scene, options)
    else:
        _apply_janus(scene, options)


def _apply_janus(scene: bpy.types.Scene, options: argparse.Namespace) -> None:
    scene.render.engine = ENGINE
    janus = scene.janus
    samples = options.samples
    if samples is None and options.seconds:
        samples = FOREVER
    given = {
        "samples": samples,
        "time_limit": options.seconds,
        **dict.fromkeys(map("{}_bounces".format, kit.BOUNCES), options.max_bounces),
        "integrator": options.integrator and options.integrator.upper(),
        "pixel_filter_type": filter_name(options),
        "seed": options.seed,
        "next_event": False if options.no_next_event else None,
        "connection_mode": options.connection_mode and options.connection_mode.upper(),
        "heuristic": options.heuristic and options.heuristic.upper(),
        "strategies": options.strategy,
        "capture_path": options.capture and str(options.capture),
    }
    for name, value in given.items():
        if value is not None:
            setattr(janus, name, value)
    if options.samples and options.seconds is None:
        janus.time_limit = 0.0


def _apply_cycles(scene: bpy.types.Scene, options: argparse.Namespace) -> None:
    """Cycles without the tricks that Janus does not use: clamps, adaptive sampling, denoising."""
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    with contextlib.suppress(TypeError):
        cycles.device = "CPU"
    kit.unbiased_cycles(cycles)
    samples = options.samples
    if samples is None and options.seconds:
        samples = FOREVER
    if samples:
        cycles.samples = samples
    if options.seconds is not None or options.samples:
        cycles.time_limit = options.seconds or 0.0
    if options.max_bounces is not None:
        kit.limit_bounces(cycles, options.max_bounces)
    if options.filter:
        cycles.pixel_filter_type = filter_name(options)
    if options.seed is not None:
        cycles.seed = options.seed
        cycles.use_animated_seed = False


def filter_name(options: argparse.Namespace) -> str | None:
    return options.filter and options.filter.upper().replace("-", "_")


def one_line(error: BaseException) -> str:
    """A message without Blender's "Error: " and line breaks."""
    text = " ".join(str(error).split())
    return text.removeprefix("Error: ") or type(error).__name__
