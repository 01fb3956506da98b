# SPDX-License-Identifier: GPL-3.0-or-later
"""What materials cost: nanoseconds to shade a point, and samples beside Cycles on scenes of
pictures and of procedural textures; `./dev bench materials`.

The scenes are textured.py, procedural.py and skin.py of scenes/ at 256 x 256 with 8 bounces. Engines
alternate, and medians are shown: a shared machine is noisy. Floors and aims are what the project
wants; a number below its floor is marked and is no failure.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path
from statistics import median

import janus_core
from _measure import CapturedScene, Cycles, spread

SIZE, BOUNCES, CYCLES_SAMPLES = 256, 8, 8
# pt over Cycles
SCENES = {"textured": (2.0, 4.0), "procedural": (1.0, 2.0), "skin": (1.0, 2.0)}
SAID = {
    "constant": "constant Principled",
    "textured": "three pictures and a normal map",
    "procedural": "30 nodes, displaced and bumped",
    "flat": "the same without bumps",
}
BENCH = Path(janus_core.__file__).parents[2] / "tests" / "bench" / "janus_shading_bench"


def main() -> None:
    parser = argparse.ArgumentParser(prog="./dev bench materials", description=__doc__)
    parser.add_argument("--rounds", type=int, default=5, metavar="N", help="default: 5")
    parser.add_argument("--seconds", type=float, default=1.0, metavar="T", help="of each render")
    parser.add_argument("--threads", type=int, default=2, metavar="N", help="default: 2")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers there too")
    options = parser.parse_args()
    done = subprocess.run([os.fspath(BENCH)], check=True, capture_output=True, text=True)
    print(done.stderr, end="", file=sys.stderr)
    shading = json.loads(done.stdout)
    for name, said in SAID.items():
        print(f"{said:<39} {shading[name]:8.1f} ns per evaluation")
    found = {scene: beside_cycles(scene, options) for scene in SCENES}
    if options.json:
        result = {"shading_ns": shading, **found}
        options.json.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


def beside_cycles(scene_name: str, options: argparse.Namespace) -> dict:
    print(f"{scene_name}:")
    floor, aim = SCENES[scene_name]
    scene = CapturedScene(scene_name, SIZE, BOUNCES, options.threads)
    cycles = Cycles(scene)
    seen: dict[str, list[float]] = {"pt": [], "bdpt": [], "Cycles": []}
    for turn in range(options.rounds):
        print(f"  round {turn + 1} of {options.rounds} ...", file=sys.stderr, flush=True)
        for name in ("pt", "bdpt"):
            seen[name].append(scene.speed(options.seconds, integrator=name)[0])
        seen["Cycles"].append(cycles.speed(CYCLES_SAMPLES))
    cycles.close()
    for name, values in seen.items():
        million = median(values) / 1e6
        print(f"{name:<39} {million:8.3f} M samples/s (+-{100 * spread(values):.0f} %)")
    ratios = [own / other for own, other in zip(seen["pt"], seen["Cycles"], strict=True)]
    ratio = median(ratios)
    verdict = "PASS" if ratio >= floor else "FAIL"
    print(
        f"pt / Cycles                             {ratio:8.2f} (+-{100 * spread(ratios):.0f} %), ",
        end="",
    )
    print(f"floor {floor:g}: {verdict}, aim {aim:g}")
    return {"samples_per_second": seen, "ratio": ratio}


if __name__ == "__main__":
    main()
