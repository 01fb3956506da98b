# SPDX-License-Identifier: GPL-3.0-or-later
"""What passes and other ways to make paths cost; `./dev bench lecture`.

CPU time of the same samples, with as many passes as the rows say over without: renders of both
alternate, with the same seeds, and the median over the rounds is shown with half the distance
between its quartiles. Below, ways to make paths beside the usual one: what a sample takes.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Mapping

import numpy as np
from _measure import CapturedScene

SCENES = ("diffuse_box", "studio")
SIZE = 256
FLOOR, AIM = 10.0, 3.0  # per cent, for four expressions
EXPRESSIONS = {
    "four expressions": ("LS+DE", "LDD+E", "L(D|S)E", "L(D|S)*E"),
    "sixteen": tuple(f"L{middle}{end}E" for middle in ("", "D", "G", "S") for end in "DGS.")
    + ("LE", "L.*T.*E", "L.*<SR>.*E", "L.+DE"),
}
LIGHT = [f"{kind}{what}" for kind in ("Diff", "Gloss", "Trans") for what in ("Dir", "Ind", "Col")]
ROWS = {
    **{name: {"expressions": [(t, t) for t in texts]} for name, texts in EXPRESSIONS.items()},
    "Cycles' passes of light": {"light_passes": [*LIGHT, "Emit", "Env"]},
    "strategy images (bdpt)": {"strategy_images": 5},
}
WAYS = {
    "without next event estimation": {"next_event": False},
    "classic bdpt": {"integrator": "bdpt", "connection_mode": "CLASSIC"},
    "strategies averaged": {"integrator": "bdpt", "heuristic": "NONE"},
}


def main() -> None:
    options = arguments()
    titles = [f"{i} {s}" for s in options.scenes for i in ("pt", "bdpt")]
    print(("{:<32}" + " {:>20}" * len(titles)).format("more CPU time, per cent", *titles))
    scenes = {}
    for name in options.scenes:
        print(f"  capturing {name} ...", file=sys.stderr, flush=True)
        scenes[name] = CapturedScene(name, SIZE, None, 2, "box")
    for row, changes in {**ROWS, **WAYS}.items():
        cells = []
        for scene in scenes.values():
            for integrator in ("pt", "bdpt"):
                if integrator == "pt" and ("strateg" in row or "bdpt" in row):
                    cells.append("-")
                    continue
                cells.append(cell(scene, integrator, changes, options))
        line = ("{:<32}" + " {:>20}" * len(cells)).format(row, *cells)
        print(line + (f"   floor {FLOOR:g}, aim {AIM:g}" if row == "four expressions" else ""))


def cell(scene: CapturedScene, integrator: str, changes: Mapping, options) -> str:
    plain = {"integrator": integrator, "adaptive_counts": False, "seconds": 0.0}
    plain["samples"] = options.samples
    ratios = []
    for seed in range(options.rounds):
        without = cpu(scene, {**plain, "seed": seed})
        ratios.append(cpu(scene, {**plain, **changes, "seed": seed}) / without - 1.0)
    low, middle, high = 100.0 * np.quantile(ratios, (0.25, 0.5, 0.75))
    return f"{middle:+.1f} +- {(high - low) / 2:.1f}"


def cpu(scene: CapturedScene, settings: Mapping) -> float:
    begin = time.process_time()
    scene.render(**settings)
    return time.process_time() - begin


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./dev bench lecture", description=__doc__)
    parser.add_argument("--scenes", nargs="+", default=SCENES, metavar="NAME")
    parser.add_argument("--rounds", type=int, default=7, metavar="N", help="default: 7")
    parser.add_argument("--samples", type=int, default=16, metavar="N", help="default: 16")
    return parser.parse_args()


if __name__ == "__main__":
    main()
