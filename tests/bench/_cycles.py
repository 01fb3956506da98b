# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles as a service, so that its renders can alternate with ours: `_cycles.py DRIVER-ARGUMENTS`.

Builds the scene once and says "ready". Each line of stdin is a render, as JSON: {"samples": N,
"seed": N, "guiding": true or false, "output": an .exr or null}. The answers are JSON as well:
{"seconds": ..., "cpu": ...}, of the render with its export, but not of writing the file; `cpu` is
the processor time of all threads. It ends with stdin.
"""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

# In the place of this folder, where another module has the name `scenes`.
sys.path[0] = str(Path(__file__).resolve().parents[2])

# Blender prints to stdout whatever it likes; the answers have a pipe of their own.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def main(words: list[str]) -> None:
    import bpy

    from scenes.driver import arguments, picture, setup

    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "none.exr")
        options = arguments.parse([*words, "--engine", "cycles", "--output", output])
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = setup.open_scene(options)
        setup.apply(scene, options)
        scene.cycles.use_animated_seed = False
        print("ready", file=answers, flush=True)
        for line in sys.stdin:
            wanted = json.loads(line)
            scene.cycles.samples = wanted["samples"]
            scene.cycles.seed = wanted["seed"]
            scene.cycles.use_guiding = wanted["guiding"]
            begin, cpu = time.perf_counter(), time.process_time()
            bpy.ops.render.render(write_still=False, scene=scene.name)
            answer = {"seconds": time.perf_counter() - begin, "cpu": time.process_time() - cpu}
            if wanted["output"]:
                picture.save(scene, Path(wanted["output"]))
            print(json.dumps(answer), file=answers, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
    os._exit(0)  # bpy can hang when the interpreter exits
