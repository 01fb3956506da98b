# SPDX-License-Identifier: GPL-3.0-or-later
"""Render passes and the strategy pyramid: asked of the add-on, written beside the picture."""

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
    return files


def file_name(words: tuple[str, ...]) -> str:
    return "_".join(words).replace("/", "_") + ".png"
