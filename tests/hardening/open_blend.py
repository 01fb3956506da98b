# SPDX-License-Identifier: GPL-3.0-or-later
"""`open_blend.py render|keep FILE`: opens a file and renders it small with Janus, or saves it as
somebody does who has no Janus."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

import bpy  # noqa: E402
import conftest  # noqa: E402


def render(path: str) -> None:
    conftest._load().register()
    bpy.ops.wm.open_mainfile(filepath=path)
    final = conftest.part("render.final")
    for scene in [s for s in bpy.data.scenes if s.camera]:
        scene.render.engine = "JANUS"
        scene.render.resolution_x, scene.render.resolution_y = 48, 32
        scene.render.resolution_percentage = 100
        print(f"{scene.name}: {scene.janus.samples} samples of the file")
        scene.janus.samples = 2
        final.keep_passes_of.add(scene.name_full)
        bpy.ops.render.render(scene=scene.name)
        assert final.last_render["samples"] == 2
        kept = final.kept_passes[final.last_render["view_layer"]]["Combined"]
        assert all(x == x and abs(x) < 1e30 for x in kept.reshape(-1).tolist())
        print(f"rendered {scene.name}")


def keep(path: str) -> None:
    bpy.ops.wm.open_mainfile(filepath=path)
    bpy.ops.wm.save_as_mainfile(filepath=path)


if __name__ == "__main__":
    {"render": render, "keep": keep}[sys.argv[1]](sys.argv[2])
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)  # bpy may hang at exit
