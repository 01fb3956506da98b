# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in Blender (-P in_blender.py -- FOLDER); renders the hero and writes FOLDER/result.json.

Janus, then Cycles, then Janus again, in one process: neither may disturb the other.
"""

import json
import sys
from pathlib import Path

import bpy
import numpy as np

WIDTH, HEIGHT, SAMPLES = 96, 64, 16

folder = Path(sys.argv[sys.argv.index("--") + 1])
sys.path.insert(0, str(folder))


def render(engine: str, name: str, file_format: str = "OPEN_EXR") -> dict:
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.image_settings.file_format = file_format
    scene.render.filepath = str(folder / name)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    rgb = pixels.reshape(-1, image.channels)[:, :3]
    return {
        "size": list(image.size),
        "mean": float(rgb.mean()),
        "deviation": float(rgb.std()),
        "finite": bool(np.isfinite(rgb).all()),
        "digest": float(rgb.astype(np.float64) @ [1.0, 2.0, 3.0] @ np.arange(len(rgb))),
    }


from scenes import diffuse_box, glass_box, hero  # noqa: E402  (the test puts them there)

scene = bpy.context.scene


def build(module) -> None:
    module.build(scene)
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.resolution_percentage = 100
    scene.janus.samples = SAMPLES
    scene.cycles.samples = SAMPLES
    scene.cycles.device = "CPU"
    scene.render.use_stamp = False


build(hero)
result = {
    "janus": render("JANUS", "janus.exr"),
    "cycles": render("CYCLES", "cycles.exr"),
    "janus_again": render("JANUS", "again.exr"),
}
build(glass_box)
result["glass_box"] = render("JANUS", "glass_box.exr")
build(diffuse_box)
result["diffuse_box"] = render("JANUS", "diffuse_box.exr")

import janus_core  # noqa: E402  (there only because the extension is installed)

result["build_info"] = janus_core.build_info()
result["core"] = janus_core.__file__
(folder / "result.json").write_text(json.dumps(result))
