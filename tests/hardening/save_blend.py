# SPDX-License-Identifier: GPL-3.0-or-later
"""`save_blend.py FILE`: the file that Blender starts with, with settings of Janus."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

import bpy  # noqa: E402
import conftest  # noqa: E402

if __name__ == "__main__":
    conftest._load().register()
    bpy.ops.wm.read_factory_settings()
    scene = bpy.context.scene
    scene.render.engine = "JANUS"
    scene.janus.samples = 7
    bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1], compress=True)
    sys.stdout.flush()
    os._exit(0)
