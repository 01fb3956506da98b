# SPDX-License-Identifier: GPL-3.0-or-later
"""F12 of a picture that no memory holds, and of one after it."""

import os
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

import bpy  # noqa: E402
import conftest  # noqa: E402
from viewport_kit import furnish  # noqa: E402


def main() -> None:
    conftest._load().register()
    scene = bpy.context.scene
    scene.render.engine = "JANUS"
    furnish(scene)
    scene.view_layers[0].use_pass_normal = True
    scene.janus.samples = 1
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
    scene.render.resolution_x = scene.render.resolution_y = 1 << 16
    try:
        bpy.ops.render.render()
        print("nothing was wrong")
    except RuntimeError as error:
        assert "less resolution" in str(error), error
        scene.render.resolution_x = scene.render.resolution_y = 32
        print("a small one:", *bpy.ops.render.render())
    sys.stdout.flush()
    os._exit(0)  # bpy may hang at exit


if __name__ == "__main__":
    main()
