# SPDX-License-Identifier: GPL-3.0-or-later
"""A product shot: a perfume flask of lacquer and metal in front of a paper sweep.

Lit by an image of two softboxes and a strip light in a grey studio. An easy scene: every surface
sees its light, so path tracing does well and light paths have hardly anything to add. What
bidirectional path tracing costs shows here.
"""

from __future__ import annotations

import bpy
import numpy as np

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 128


def softbox(d: np.ndarray, centre: kit.Point3, half: kit.Point2) -> np.ndarray:
    """1 inside a rectangle on the sphere around `centre`, with edges that fade a little."""
    forward = np.array(centre) / np.linalg.norm(centre)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    ahead = d @ forward
    x = np.abs(d @ right) / np.maximum(ahead, 1e-3) / half[0]
    y = np.abs(d @ np.cross(right, forward)) / np.maximum(ahead, 1e-3) / half[1]
    edge = np.clip((1.0 - np.maximum(x, y)) / 0.06, 0.0, 1.0)
    return np.where(ahead > 0.0, edge, 0.0)[..., None]


def lights(d: np.ndarray) -> np.ndarray:
    grey = 0.16 + 0.10 * d[..., 2:3] * np.ones(3)
    key = 9.0 * softbox(d, (-1.0, -0.55, 0.75), (0.55, 0.42)) * np.array([1.0, 0.95, 0.88])
    fill = 2.6 * softbox(d, (1.0, -0.8, 0.45), (0.45, 0.60)) * np.array([0.82, 0.91, 1.0])
    strip = 7.0 * softbox(d, (1.0, 0.75, 0.6), (0.12, 0.75))
    return grey + key + fill + strip


def sweep(scene: bpy.types.Scene) -> None:
    """Paper that runs from the table up the wall in one curve."""
    paper = kit.diffuse("Paper", (0.62, 0.60, 0.58))
    profile = kit.spline(
        [(-1.5, 0.0), (0.25, 0.0), (0.45, 0.02), (0.62, 0.12), (0.70, 0.34), (0.71, 1.2)], 12
    )
    vertices = [(x, y, z) for y, z in profile for x in (-2.5, 2.5)]
    faces = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(len(profile) - 1)]
    kit.mesh_object(scene, "Sweep", vertices, faces, paper, smooth=True)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", "AgX - Medium High Contrast")
    props.environment(scene, lights, 0.6)
    sweep(scene)

    lacquer = props.principled("Lacquer", (0.012, 0.060, 0.085), 0.2)
    label = props.principled("Label", (0.80, 0.76, 0.66), 0.5)
    gold = props.principled("Gold", (0.93, 0.68, 0.34), 0.22, 1.0)
    cream = props.principled("Cream", (0.72, 0.52, 0.38), 0.45)
    props.block(scene, "Flask", (0.105, 0.050, 0.125), lacquer, (-0.035, 0.0, 0.0), -16, 0.010)
    props.block(scene, "Label", (0.062, 0.002, 0.052), label, (-0.042, -0.0245, 0.036), -16, 5e-4)
    collar = [
        (0.0, 0.0),
        (0.021, 0.0),
        (0.022, 0.001),
        (0.022, 0.009),
        (0.021, 0.010),
        (0.0, 0.010),
    ]
    kit.lathe(scene, "Collar", collar, gold, 96).location = (-0.035, 0.0, 0.125)
    props.block(scene, "Stopper", (0.044, 0.044, 0.046), gold, (-0.035, 0.0, 0.1355), -16, 0.006)

    jar = [(0.0, 0.0), (0.034, 0.0), (0.038, 0.004), (0.038, 0.036), (0.035, 0.040), (0.0, 0.040)]
    kit.lathe(scene, "Jar", jar, cream, 128).location = (0.072, -0.042, 0.0)
    lid = [
        (0.0, 0.0),
        (0.037, 0.0),
        (0.0385, 0.0015),
        (0.0385, 0.016),
        (0.036, 0.0185),
        (0.0, 0.0185),
    ]
    kit.lathe(scene, "Lid", lid, gold, 128).location = (0.072, -0.042, 0.0402)
    pebble = kit.sphere(scene, "Pebble", 0.022, props.principled("Stone", (0.30, 0.28, 0.26), 0.7))
    pebble.location, pebble.scale = (0.118, 0.035, 0.0126), (1.2, 0.9, 0.57)

    kit.camera(scene, (0.08, -0.74, 0.20), (0.016, 0.0, 0.083), lens=70.0)
