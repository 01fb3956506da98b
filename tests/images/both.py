# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the same scenes by Cycles, and captures of them for Janus.

`python both.py MODULE FOLDER [CASE...]`, or `blender -b -P both.py -- MODULE ...`, writes
FOLDER/CASE.npz (a capture) and FOLDER/CASE-N.exr (Cycles, with seed N, 1 to SEEDS) for each of the
module's CASES. One process makes them all, since starting Blender takes longer than such a picture.
A module of cases has

- CASES, the names, and SEEDS, how many pictures by Cycles;
- build(case) -> scene: the scene in an empty file, with Cycles' settings and number of samples;
- WARNED, if it is there: the cases of which Janus may warn;
- for_janus(scene), if it is there: what is different for Janus;
- save(scene, path), if it is there: how Cycles' picture is saved.

Janus gets its settings as its users do: by copying them from Cycles.
"""

from __future__ import annotations

import contextlib
import importlib
import sys
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).resolve().parents[2]


def main(cases: ModuleType, folder: Path, names: list[str]) -> int:
    import bpy

    from scenes.driver import addon as addons
    from scenes.driver import picture

    addon = addons.load()
    warned = False
    for name in names:
        # The preferences stay, and with them, in a real Blender, the extension.
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        scene = cases.build(name)
        scene.render.threads_mode, scene.render.threads = "FIXED", 2
        scene.render.engine = "CYCLES"
        for seed in range(1, cases.SEEDS + 1):
            scene.cycles.seed = seed
            bpy.ops.render.render()
            getattr(cases, "save", picture.save)(scene, folder / f"{name}-{seed}.exr")
        scene.render.engine = addons.ENGINE
        getattr(cases, "for_janus", lambda scene: None)(scene)
        with bpy.context.temp_override(scene=scene):
            bpy.ops.janus.copy_settings_from_cycles()
        scene.janus.samples = 1
        scene.janus.capture_path = str(folder / f"{name}.npz")
        bpy.ops.render.render()
        for entry, _ in addon.part("report").kept(scene.name_full):
            if entry.severity != "INFO" and name not in getattr(cases, "WARNED", ()):
                print(f"{name}: {entry}", file=sys.stderr)
                warned = True
        scene.render.engine = "CYCLES"
    with contextlib.suppress(Exception):
        addon.unload()
    return int(warned)


if __name__ == "__main__":
    if sys.path[0] == str(Path(__file__).parent):
        del sys.path[0]
    sys.path.insert(0, str(ROOT))
    from scenes.driver import run

    code = 1
    try:
        given = sys.argv[sys.argv.index("--") if "--" in sys.argv else 0 :]
        chosen = importlib.import_module(f"tests.images.{given[1]}")
        code = main(chosen, Path(given[2]), given[3:] or list(chosen.CASES))
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
    run.leave(code)
