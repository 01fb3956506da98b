# SPDX-License-Identifier: GPL-3.0-or-later
"""How it feels in Blender: `./dev bench blender`.

The time to the first pixels of a rendered viewport; how soon it shows that one object of a scene
with two million triangles has moved; what F12 takes beyond the core's own time, and how long it
prepares each frame of an animation; and the peak memory of the same render beside Cycles'. Without
a window: a viewport's picture is there when Blender could draw it. Each number comes from a process
of its own. A number above its target is marked and is no failure.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from types import SimpleNamespace

from _sheet import sheet

ROOT = Path(__file__).resolve().parents[2]
VIEW = (1280, 720)  # pixels of the viewport
SAMPLES = 16


def main() -> None:
    parser = argparse.ArgumentParser(prog="./dev bench blender", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, metavar="N", help="default: 3")
    rounds = range(parser.parse_args().rounds)
    hero = [child("first", "hero") for _ in rounds]
    large = [child("first", "large") for _ in rounds]
    moved = [child("move") for _ in rounds]
    camera = [child("camera") for _ in rounds]
    final = [child("final", "janus") for _ in rounds]
    prepared = [child("animation", "alone") for _ in rounds]
    persistent = [child("animation", "persistent") for _ in rounds]
    cycles = child("final", "cycles")
    overhead = 100.0 * median(run["f12"] / run["core"] - 1.0 for run in final)
    rows = [
        ("hero: first pixels of a viewport", seconds(hero), "s", 0.5, None),
        ("2 M triangles: first pixels", seconds(large), "s", None, None),
        ("2 M triangles: an object moves", seconds(moved), "s", 1.0, 0.3),
        ("2 M triangles: the view turns", seconds(camera), "s", None, None),
        ("2 M triangles: F12 beyond the core", overhead, "%", None, 5.0),
        ("2 M triangles: set-up of a frame", seconds(prepared), "s", None, None),
        ("the same with Persistent Data", seconds(persistent), "s", None, None),
        ("2 M triangles: peak memory", final[0]["peak"], "MB", None, None),
        ("2 M triangles: Cycles' peak memory", cycles["peak"], "MB", None, None),
    ]
    line = "{:<36} {:>10}   {:>8} {:>8}   {}"
    print(line.format("", "seen", "floor", "aim", "").rstrip())
    for name, seen, unit, floor, aim in rows:
        print(
            line.format(name, f"{seen:.3g} {unit}", floor or "", aim or "", said(seen, floor, aim))
        )


def seconds(runs: list[dict]) -> float:
    return median(run["seconds"] for run in runs)


def said(seen: float, floor: float | None, aim: float | None) -> str:
    if floor is not None and seen > floor:
        return "FLOOR NOT REACHED"
    if aim is not None:
        return "reached" if seen <= aim else "aim not reached"
    return "" if floor is None else "reached"


def child(*words: str) -> dict:
    command = [sys.executable, __file__, "--child", *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    return json.loads(done.stdout.splitlines()[-1])


def peak() -> float:
    """Memory that the process has had at most, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def large_scene(scene) -> None:
    """A hilly mesh, a ball above it, a lamp and the sky."""
    from scenes import kit

    hills = sheet("Hills")
    hills.scale, hills.location = (0.01, 0.01, 0.05), (-5.0, -5.0, 0.0)
    hills.data.materials.append(kit.diffuse("Grass", (0.3, 0.5, 0.2)))
    kit.sphere(scene, "Ball", 0.5, kit.diffuse("Red", (0.8, 0.2, 0.1)), 32).location.z = 1.0
    kit.area_light(scene, "Lamp", (2.0, -3.0, 5.0), (0.0, 0.0, 0.0), (1.0, 1.0), 500.0)
    kit.world(scene, (0.4, 0.5, 0.7), 0.5)
    kit.camera(scene, (0.0, -7.0, 4.0), (0.0, 0.0, 0.5), lens=40.0)


def set_up(name: str):
    """(scene, add-on) with the scene selected for Janus."""
    import bpy

    from scenes.driver import addon as addons

    addon = addons.load()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    if name == "large":
        large_scene(scene)
    else:
        __import__(f"scenes.{name}", fromlist=["build"]).build(scene)
    scene.render.engine = addons.ENGINE
    scene.render.resolution_x, scene.render.resolution_y = VIEW
    bpy.context.view_layer.update()
    return scene, addon


class Eye:
    """A viewport that looks through the scene's camera."""

    def __init__(self, scene, addon):
        import bpy

        core = addon.part("bridge").core()
        self._scene, self._part = scene, addon.part
        self._viewport = addon.part("render.viewport").Viewport(core)
        self._viewport.sync(bpy.context.evaluated_depsgraph_get())

    def sync(self, _scene, depsgraph) -> None:
        self._viewport.sync(depsgraph)

    def look(self) -> None:
        import bpy

        depsgraph, camera = bpy.context.evaluated_depsgraph_get(), self._scene.camera
        rv3d = SimpleNamespace(
            view_perspective="CAMERA",
            is_perspective=True,
            window_matrix=camera.calc_matrix_camera(depsgraph, x=VIEW[0], y=VIEW[1]),
            view_matrix=camera.matrix_world.inverted(),
        )
        region = SimpleNamespace(width=VIEW[0], height=VIEW[1])
        space = SimpleNamespace(use_local_camera=False, camera=None)
        view = self._part("sync.view").read_view(region, rv3d, space, depsgraph)
        self._viewport.look(view, self._part("sync.settings").view_settings(self._scene))

    def wait(self) -> None:
        """Until there is another picture."""
        self.look()
        while not self._viewport.advance():
            time.sleep(0.001)


def first(name: str) -> dict:
    scene, addon = set_up(name)
    addon.part("bridge").core()
    started = time.perf_counter()
    Eye(scene, addon).wait()
    return {"seconds": time.perf_counter() - started}


def changed(change) -> dict:
    """From an edit of the large scene to the picture with it."""
    import bpy

    scene, addon = set_up("large")
    eye = Eye(scene, addon)
    eye.wait()
    time.sleep(2.0)  # somebody looks at it
    bpy.app.handlers.depsgraph_update_post.append(eye.sync)
    started = time.perf_counter()
    change(bpy.data.objects)
    bpy.context.view_layer.update()
    eye.wait()
    return {"seconds": time.perf_counter() - started}


def move(objects) -> None:
    objects["Ball"].location.x += 0.5


def turn(objects) -> None:
    objects["Camera"].location.x += 0.5


def final(engine: str) -> dict:
    import bpy

    scene, addon = set_up("large")
    if engine == "cycles":
        scene.render.engine, scene.cycles.samples = "CYCLES", SAMPLES
    scene.janus.samples = SAMPLES
    started = time.perf_counter()
    bpy.ops.render.render()
    taken = time.perf_counter() - started
    stats = addon.part("render.final").last_render
    core = stats["seconds"] + stats["commit_seconds"] if engine == "janus" else 0.0
    return {"f12": taken, "core": core, "peak": peak()}


def animation(mode: str) -> dict:
    """Export and build of a frame after the first; an object moves."""
    import bpy

    scene, addon = set_up("large")
    scene.render.use_persistent_data = mode == "persistent"
    scene.render.resolution_x, scene.render.resolution_y = 64, 36
    scene.janus.samples, scene.frame_end = 1, 4
    scene.render.filepath = bpy.app.tempdir
    ball = bpy.data.objects["Ball"]
    for frame, x in ((1, 0.0), (4, 1.0)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
    stats, frames = addon.part("render.final").last_render, []

    def note(*_):
        frames.append(stats["sync_seconds"] + stats["commit_seconds"])

    bpy.app.handlers.render_post.append(note)
    bpy.ops.render.render(animation=True)
    return {"seconds": median(frames[1:])}


CHILDREN = {
    "first": first,
    "move": lambda: changed(move),
    "camera": lambda: changed(turn),
    "final": final,
    "animation": animation,
}

if __name__ == "__main__":
    if sys.argv[1:2] == ["--child"]:
        import os

        sys.path[0] = str(ROOT)  # scenes/, not the scenes.py beside this file
        print(json.dumps(CHILDREN[sys.argv[2]](*sys.argv[3:])), flush=True)
        os._exit(0)  # some versions of bpy do not end by themselves with an engine registered
    main()
