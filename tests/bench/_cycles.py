# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles as a service, so that its renders can alternate with ours: `_cycles.py DRIVER-ARGUMENTS`.

Builds the scene once, says "ready", and for each number of samples on a line of stdin renders and
answers with the seconds that it took, export included; ends with stdin.
"""

import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

# Blender prints to stdout whatever it likes; the answers have a pipe of their own.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def main(words: list[str]) -> None:
    import bpy

    from scenes.driver import arguments, setup

    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "none.exr")
        options = arguments.parse([*words, "--engine", "cycles", "--output", output])
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = setup.open_scene(options)
        setup.apply(scene, options)
        print("ready", file=answers, flush=True)
        for line in sys.stdin:
            scene.cycles.samples = int(line)
            begin = time.perf_counter()
            bpy.ops.render.render(write_still=False, scene=scene.name)
            print(time.perf_counter() - begin, file=answers, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
    os._exit(0)  # bpy can hang when the interpreter exits
