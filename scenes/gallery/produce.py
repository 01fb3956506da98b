# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the figures, measures them, and writes pictures, numbers and the page."""

from __future__ import annotations

import argparse
import json
import os
import resource
import sys
import time
from collections.abc import Mapping
from pathlib import Path

import bpy
import janus_core
import numpy as np
from janus_core.errors import squared_errors

from scenes.driver import addon, run
from scenes.gallery import measure, page
from scenes.gallery.figures import FIGURES, LABELS, PATHS_PER_PIXEL, Classes, Comparison
from scenes.gallery.stage import Shot, Stage

DEFINITIONS = {
    "rmse": "root of the mean over pixels and channels of (x - r)^2, scene-linear radiance",
    "relmse": "mean over pixels and channels of (x - r)^2 / (r^2 + 0.01 m^2), m: mean of r",
    "trimmed": "relmse without the thousandth of the pixels where it is largest",
    "brightness": "mean of all pixels over that of the reference",
    "error picture": "per pixel the root of its relmse, 0 black, 1 white",
}


def produce(options: argparse.Namespace) -> None:
    begin = time.monotonic()
    janus = addon.load()
    try:
        stage = Stage(janus, options.threads, options.clock)
        figures = []
        for number, name in enumerate(options.only, 1):
            said = f"{name} ({number} of {len(options.only)})"

            def say(text: str, said: str = said) -> None:
                minutes, seconds = divmod(int(time.monotonic() - begin), 60)
                print(f"  {minutes}:{seconds:02}  {said}: {text} ...", file=sys.stderr, flush=True)

            with run.quiet():  # Blender's own words; ours go to stderr
                figures.append(_Maker(stage, options, name, say).make())
        gallery = {
            "made": {
                "version": janus_core.__version__,
                "quality": options.quality,
                "resolution": list(options.resolution),
                "threads": options.threads or os.cpu_count(),
                "seeds": options.seeds,
                "clock": options.clock,
                "seconds_each": options.seconds,
                "reference_seconds": options.reference_seconds,
                "blender": bpy.app.version_string,
                "processors": os.cpu_count(),
                "seconds": time.monotonic() - begin,
                "peak_memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
            },
            "definitions": DEFINITIONS,
            "figures": figures,
        }
        text = json.dumps(gallery, indent=2)
        (options.output / "figures.json").write_text(text + "\n", encoding="utf-8")
        page.write(gallery, options.output)
    finally:
        janus.unload()
    made = gallery["made"]
    print(
        f"{options.output / 'index.html'}  ({len(figures)} figures in {made['seconds']:.0f} s, "
        f"at most {made['peak_memory_mb']:.0f} MB)"
    )


class _Maker:
    """One figure, as the dictionary that figures.json has of it."""

    def __init__(self, stage: Stage, options: argparse.Namespace, name: str, say) -> None:
        self._stage, self._options, self._name, self._say = stage, options, name, say
        self._pictures: list[dict] = []

    def make(self) -> dict:
        figure = FIGURES[self._name]
        self._say(f"export of {figure.scene}")
        own = self._compare(figure) if isinstance(figure, Comparison) else self._sort(figure)
        width, height = self._stage.size
        return {
            "name": self._name,
            "title": figure.title,
            "scene": figure.scene,
            "width": width,
            "height": height,
            **own,
            "pictures": self._pictures,
        }

    def _compare(self, figure: Comparison) -> dict:
        options, stage = self._options, self._stage
        reference = self._reference(figure)
        self._set(figure)
        # Caches and clock rates settle; the seed is nobody's.
        stage.shoot(integrator="pt", seconds=min(0.2, options.seconds), seed=1)
        seconds = figure.patience * options.seconds
        groups = (
            ("samples", figure.at_samples, {"samples": PATHS_PER_PIXEL, "seconds": 0.0}),
            ("time", figure.at_time, {"seconds": seconds}),
        )
        for number, (group, ways, common) in enumerate(groups):
            if not ways:
                continue
            shots = measure.alternate(stage, ways, options.seeds, number, self._say, **common)
            for key, taken in shots.items():
                # The first seed, whatever it looks like.
                entry = self._add(f"{group}-{key}", LABELS[key], group, taken[0].picture)
                entry |= measure.errors(taken, reference.picture)
                entry["error_file"] = f"{self._name}-{group}-{key}-error.png"
                errors = np.sqrt(squared_errors(taken[0].picture, reference.picture))
                stage.save_grey(options.output / entry["error_file"], errors)
        self._add("reference", "reference", "reference", reference.picture)
        curves = measure.curve(stage, figure.at_time, seconds, reference.picture, self._say)
        return {
            "reference": {
                "seconds": options.reference_seconds,
                "relmse": reference.own,
                "path_tracer_differs": reference.other,
                "path_tracer_relmse": reference.other_own,
            },
            "seconds": seconds,
            "clock": options.clock,
            "paths_per_pixel": PATHS_PER_PIXEL if figure.at_samples else None,
            "curves": {LABELS[key]: points for key, points in curves.items()},
        }

    def _reference(self, figure: Comparison) -> measure.Reference:
        options = self._options
        self._set(figure, **figure.reference_variant)
        how = {"integrator": "bdpt"}
        settings = (self._stage.size, options.reference_seconds, options.clock, how, figure.second)
        settings += (dict(figure.reference_variant),)
        path = measure.reference_path(options.output / "references", figure.scene, *settings)
        seconds = options.reference_seconds
        return measure.reference(self._stage, how, figure.second, seconds, path, self._say)

    def _sort(self, figure: Classes) -> dict:
        """Pictures to be looked at, not measured."""
        seconds = self._options.reference_seconds
        self._set(figure)
        self._say(f"{seconds:g} s")
        expressions = [(key, expression) for key, expression, _ in figure.expressions]
        shot = self._stage.shoot(integrator="bdpt", seconds=seconds, expressions=expressions)
        self._add("all", "the whole picture", "all", shot.picture, shot)
        for key, expression, label in figure.expressions:
            entry = self._add(key, f"{expression}: {label}", "classes", shot.passes[key])
            whole = float(shot.picture.mean())
            entry |= {"expression": expression, "share": float(shot.passes[key].mean()) / whole}
        if figure.altered:
            key, label, inputs = figure.altered
            self._set(figure, change=lambda scene: _alter(inputs))
            self._say(label)
            altered = self._stage.shoot(integrator="bdpt", seconds=seconds)
            self._add(key, label, "all", altered.picture, altered)
        return {"seconds": seconds}

    def _set(self, figure: Comparison | Classes, change=None, **variant: object) -> None:
        self._stage.set(figure.scene, self._options.resolution, change, **variant)

    def _add(
        self, key: str, label: str, group: str, picture: np.ndarray, shot: Shot | None = None
    ) -> dict:
        """Saves the picture and notes it."""
        entry = {"key": key, "label": label, "group": group, "file": f"{self._name}-{key}.png"}
        self._stage.save(Path(self._options.output) / entry["file"], picture)
        if shot:
            entry |= measure.cost([shot])
        self._pictures.append(entry)
        return entry


def _alter(inputs: Mapping[str, float]) -> None:
    """Sets the inputs of all Principled BSDFs that there are."""
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else ():
            if node.type == "BSDF_PRINCIPLED":
                for key, value in inputs.items():
                    node.inputs[key].default_value = value
