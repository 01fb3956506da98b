# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene of panes, also on a transparent film: pictures by Cycles, and captures.

`python pane_scenes.py FOLDER SAMPLES` writes FOLDER/CASE.npz (a capture) and FOLDER/CASE-SEED.exr
(Cycles) for each of CASES.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

CASES = {"world": False, "film_transparent": True}
SEEDS, BOUNCES = 6, 4


def main(folder: Path, samples: int) -> int:
    import bpy

    from scenes import panes
    from scenes.driver import addon as addons
    from scenes.driver import picture, setup

    given = {"output": folder / "x.exr", "resolution": None, "threads": None, "frame": None}
    given |= dict.fromkeys(("seconds", "integrator", "filter", "capture"))
    given |= {"max_bounces": BOUNCES}
    for name, transparent in CASES.items():
        bpy.ops.wm.read_factory_settings(use_empty=True)
        addon = addons.load()
        try:
            scene = bpy.context.scene
            panes.build(scene)
            scene.render.film_transparent = transparent
            capture = {"engine": "janus", "capture": folder / f"{name}.npz"}
            setup.apply(scene, argparse.Namespace(**given | capture, samples=1, seed=0))
            bpy.ops.render.render()
        finally:
            addon.unload()
        for seed in range(1, SEEDS + 1):
            values = given | {"engine": "cycles", "samples": samples, "seed": seed}
            setup.apply(scene, argparse.Namespace(**values))
            bpy.ops.render.render()
            picture.save(scene, folder / f"{name}-{seed}.exr")
    return 0


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
    from scenes.driver import run

    code = 1
    try:
        code = main(Path(sys.argv[1]), int(sys.argv[2]))
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
    run.leave(code)
