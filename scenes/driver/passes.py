# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes, the strategy pyramid and light transport: asked of the add-on, written beside the
picture."""

from __future__ import annotations

import argparse
from pathlib import Path

import bpy

from scenes.driver.addon import Addon
from scenes.driver.setup import Problem


def prepare(scene: bpy.types.Scene, options: argparse.Namespace, addon: Addon) -> None:
    """Before the render. A pass that the scene has already gets the expression that was given."""
    names = [name for name, _ in options.passes]
    for name in names:
        if names.count(name) > 1:
            raise Problem(f"--pass gives two expressions for '{name}'")
    for layer in scene.view_layers:
        expressions = layer.janus.expressions
        for name, text in options.passes:
            item = next((item for item in expressions if item.name == name), None)
            item = item or expressions.add()
            item.name, item.expression, item.enabled = name, text, True
    if options.dual:
        _ask_for_transport(scene, options, addon)
    if options.strategies:
        if scene.janus.integrator != "BDPT":
            raise Problem("only the integrator bdpt has strategies")
        addon.part("render.strategies").ask(scene, options.strategies_length)
    elif options.passes and options.output.suffix.lower() == ".png":
        addon.part("render.final").keep_passes_of.add(scene.name_full)


def save(scene: bpy.types.Scene, options: argparse.Namespace, addon: Addon) -> list[Path]:
    """After the render: what was written. Raises RuntimeError or OSError."""
    files = []
    if options.passes and options.output.suffix.lower() == ".exr":
        files.append(options.output.with_name(f"{options.output.stem}_passes.exr"))
        addon.part("render.picture").save_result(scene, str(files[-1]))
    elif options.passes:
        kept = addon.part("render.final").kept_passes
        for layer, passes in kept.items():
            for name, _ in options.passes:
                words = (options.output.stem, *[layer] * (len(kept) > 1), name)
                files.append(options.output.with_name(file_name(words)))
                addon.part("render.picture").save_display(scene, str(files[-1]), passes[name])
    if options.strategies:
        strategies = addon.part("render.strategies")
        exposure = options.strategies_exposure
        files += map(Path, strategies.save(scene, str(options.strategies), exposure))
    if options.dual:
        files += _save_transport(scene, options, addon)
    return files


def _ask_for_transport(scene: bpy.types.Scene, options: argparse.Namespace, addon: Addon) -> None:
    unfit = addon.part("sync.slide").unfit
    lights = {item.name: item.data for item in scene.objects if item.type == "LIGHT"}
    name = options.dual_light
    if name is None:
        fit = [name for name, light in lights.items() if not unfit(light)[1]]
        if len(fit) != 1:
            choice = ", ".join(fit) if fit else "none of its lights can be a projector"
            raise Problem(f"--dual-light has to name the projector of this scene: {choice}")
        name = fit[0]
    elif name not in lights:
        raise Problem(f"--dual-light: the scene has no light '{name}'")
    if reason := unfit(lights[name])[1]:
        raise Problem(f"--dual-light: '{name}': {reason}")
    limits = addon.part("properties.light")
    width, height = options.dual_resolution
    most = limits.MOST_PROJECTOR
    if max(width, height) > most:
        raise Problem(f"--dual-resolution: at most {most}x{most}, not {width}x{height}")
    render = addon.part("sync.settings").frame_size(scene.render)
    most = limits.MOST_CAMERA
    if max(render) > most:
        size = "x".join(map(str, render))
        raise Problem(f"--resolution: with --dual at most {most}x{most}, not {size}")
    samples = addon.part("sync.cycles_settings").value(scene, "samples")
    transport = addon.part("render.transport")
    request = transport.Request(name, width, height, max(render), max(samples, 2))
    transport.ask(scene, request)


def _save_transport(scene: bpy.types.Scene, options: argparse.Namespace, addon: Addon):
    matrix = addon.part("render.transport").withdraw(scene)
    options.dual.mkdir(parents=True, exist_ok=True)
    files = [options.dual / name for name in ("transport.npz", "primal.png", "dual.png")]
    matrix.save(files[0])
    save_display = addon.part("render.picture").save_display
    save_display(scene, str(files[1]), matrix.relight())
    save_display(scene, str(files[2]), matrix.dual())
    return files


def file_name(words: tuple[str, ...]) -> str:
    return "_".join(words).replace("/", "_") + ".png"
