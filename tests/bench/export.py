# SPDX-License-Identifier: GPL-3.0-or-later
"""How long Blender waits before the first sample: `./dev bench export`.

A mesh of two million triangles, and 100 000 instances made by Geometry Nodes. Times of the export
and of the build; how soon a user's Escape is noticed in both; peak memory beside Cycles'. Each
number comes from a process of its own. Targets are what the project wants; a number above its
target is marked and is no failure.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

from _sheet import sheet

ROOT = Path(__file__).resolve().parents[2]
INSTANCES = 100_000
TARGETS = {"mesh": 0.2, "instances": 1.0, "escape": 0.2}  # seconds


def main() -> None:
    parser = argparse.ArgumentParser(prog="./dev bench export", description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, metavar="N", help="default: 3")
    options = parser.parse_args()
    line = "{:<28} {:>9}   {:<10} {}"
    print(line.format("", "seen", "target", ""))
    for case in ("mesh", "instances"):
        runs = [child(case, "janus") for _ in range(options.rounds)]
        export = median(run["export"] for run in runs)
        build = median(run["build"] for run in runs)
        cycles = child(case, "cycles")
        rows = [
            (f"{case}: export", f"{export:.3f} s", TARGETS[case], export),
            (f"{case}: build (BVH)", f"{build:.3f} s", None, build),
        ]
        for phase in ("export", "build"):
            waits = [child(case, "escape", share * runs[0]["build"], phase) for share in (0.2, 0.6)]
            worst = max(wait["wait"] for wait in waits)
            rows.append((f"{case}: Escape in {phase}", f"{worst:.3f} s", TARGETS["escape"], worst))
        rows.append((f"{case}: peak memory", f"{runs[0]['peak']:.0f} MB", None, 0))
        rows.append((f"{case}: Cycles' peak memory", f"{cycles['peak']:.0f} MB", None, 0))
        for name, seen, target, value in rows:
            verdict = "" if target is None else "reached" if value <= target else "NOT REACHED"
            print(line.format(name, seen, f"{target} s" if target else "", verdict).rstrip())


def child(*words: object) -> dict:
    command = [sys.executable, __file__, "--child", *map(str, words)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)
    return json.loads(done.stdout.splitlines()[-1])


# --- In the child --------------------------------------------------------------------------------


def build_instances(bpy) -> None:
    """A ball on each point of a grid."""
    tree = bpy.data.node_groups.new("Balls", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    new = tree.nodes.new
    grid, ball = new("GeometryNodeMeshGrid"), new("GeometryNodeMeshUVSphere")
    instance, out = new("GeometryNodeInstanceOnPoints"), new("NodeGroupOutput")
    grid.inputs["Size X"].default_value = grid.inputs["Size Y"].default_value = 400
    grid.inputs["Vertices X"].default_value = 400
    grid.inputs["Vertices Y"].default_value = INSTANCES // 400
    ball.inputs["Radius"].default_value = 0.4
    for a, b in (
        (grid.outputs["Mesh"], instance.inputs["Points"]),
        (ball.outputs["Mesh"], instance.inputs["Instance"]),
        (instance.outputs["Instances"], out.inputs[0]),
    ):
        tree.links.new(a, b)
    holder = bpy.data.objects.new("Balls", bpy.data.meshes.new("Balls"))
    bpy.context.collection.objects.link(holder)
    holder.modifiers.new("Balls", "NODES").node_group = tree


def run_child(case: str, what: str, delay: float = 0.0, phase: str = "") -> dict:
    import bpy

    from scenes.driver import addon as addons

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.location = (200, 100, 300)
    scene.render.resolution_x = scene.render.resolution_y = 8
    if case == "mesh":
        sheet("Sheet")
    else:
        build_instances(bpy)
    if what == "cycles":
        scene.render.engine = "CYCLES"
        scene.cycles.samples = 1
        bpy.ops.render.render()
        return {"peak": peak_megabytes()}
    return _export(bpy, addons.load(), what == "escape", delay, phase)


def _export(bpy, addon, escape: bool, delay: float, phase: str) -> dict:
    core = addon.part("bridge").core()
    sync, log = addon.part("sync"), addon.part("report").DiagnosticsLog()
    graph = bpy.context.evaluated_depsgraph_get()
    pressed_at = float("inf")

    def stop() -> bool:
        return time.perf_counter() >= pressed_at

    builder = core.SceneBuilder()
    start = time.perf_counter()
    pressed_at = start + 0.3 * delay if escape and phase == "export" else pressed_at
    try:
        sync.sync_scene(builder, graph, log, stop)
        synced = time.perf_counter()
        pressed_at = synced + delay if escape else pressed_at
        scene = builder.commit(poll=stop)
    except (addon.part("report").RenderCancelled, core.Cancelled):
        pass
    end = time.perf_counter()
    if escape:
        return {"wait": max(0.0, end - pressed_at)}
    counts = scene.counts
    assert counts["instances"] >= 1, counts
    return {"export": synced - start, "build": end - synced, "peak": peak_megabytes()}


def peak_megabytes() -> float:
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if __name__ == "__main__":
    sys.path[0] = str(ROOT)  # for this folder, where another module has the name `scenes`
    if sys.argv[1:2] == ["--child"]:
        case, what, *rest = sys.argv[2:]
        print(json.dumps(run_child(case, what, float(rest[0]) if rest else 0.0, *rest[1:])))
        sys.stdout.flush()
        os._exit(0)  # bpy can hang when the interpreter exits
    main()
