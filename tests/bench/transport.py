# SPDX-License-Identifier: GPL-3.0-or-later
"""Speed of the integrators and of Cycles on the same machine, in one run; `./dev bench`.

Scene: the Cornell box (scenes/diffuse_box.py) at 256 x 256 with 8 bounces. Everything that is
compared alternates, and medians are shown: a shared machine is noisy. Floors and aims are what
the project wants; a number below its floor is marked and is no failure.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median

from _measure import CapturedScene, Cycles, relative_variance, spread

SIZE, BOUNCES = 256, 8
CYCLES_SAMPLES = 8  # and four times as many
VARIANCE_SAMPLES, VARIANCE_SIZE = 64, 96
EASY = ("diffuse_box", "two_lamps")
PT = {"integrator": "pt"}
BDPT = {
    "integrator": "bdpt",
    "light_paths": 1.0,
    "connections": 1.0,
    "adaptive_counts": False,
}
ZERO = {"integrator": "bdpt", "light_paths": 0.0, "connections": 0.0}
AUTOMATIC = {**BDPT, "adaptive_counts": True}  # as in Blender


@dataclass
class Row:
    """A line of the table. `good`: whether the floor is reached; None where there is none."""

    name: str
    value: float
    unit: str = ""
    spread: float | None = None  # relative, between rounds
    floor: str = ""
    aim: str = ""
    good: bool | None = None


def main() -> None:
    options = arguments()
    say = lambda text: print(f"  {text} ...", file=sys.stderr, flush=True)  # noqa: E731
    say("capturing the scene")
    box = CapturedScene("diffuse_box", SIZE, BOUNCES, options.threads)
    rows, counters = speeds(box, options, say)
    for name in EASY:
        say(f"variance x time on {name}")
        rows.append(variance_time(name, options))
    show(rows, counters, options)
    if options.json:
        result = {
            "machine": {"processor": processor(), "cpus": os.cpu_count()},
            "settings": {"size": SIZE, "bounces": BOUNCES, **vars(options), "json": None},
            "rows": [asdict(row) for row in rows],
            "counters": counters,
        }
        options.json.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./dev bench transport", description=__doc__)
    parser.add_argument("--rounds", type=int, default=5, metavar="N", help="default: 5")
    parser.add_argument("--seconds", type=float, default=1.0, metavar="T", help="of each render")
    parser.add_argument("--threads", type=int, default=2, metavar="N", help="default: 2")
    parser.add_argument("--seeds", type=int, default=24, metavar="N", help="for the variance")
    parser.add_argument("--no-cycles", action="store_true", help="leave Cycles out")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers there too")
    return parser.parse_args()


def speeds(box: CapturedScene, options: argparse.Namespace, say) -> tuple[list[Row], dict]:
    cycles = None if options.no_cycles else Cycles(box)
    seen: dict[str, list[float]] = {"pt": [], "bdpt": [], "cycles": [], "zero": []}
    counters: dict[str, dict] = {}
    for settings in (PT, BDPT, ZERO):  # caches and clock rates settle
        box.speed(0.2, **settings)
    for turn in range(options.rounds):
        say(f"round {turn + 1} of {options.rounds}")
        for name, settings in (("pt", PT), ("bdpt", BDPT)):
            speed, counters[name] = box.speed(options.seconds, **settings)
            seen[name].append(speed)
        if cycles:
            seen["cycles"].append(cycles.speed(CYCLES_SAMPLES))
        seen["zero"] += zero_counts(box, 0.3 * options.seconds)
    if cycles:
        cycles.close()
    million = {name: median(values) / 1e6 for name, values in seen.items() if values}
    floor = min(1.3, 4.0 * million["cycles"]) if cycles else 1.3
    rows = [
        Row("pt", million["pt"], "M paths/s", spread(seen["pt"]), "1.3, or 4 x Cycles", "2.0"),
        Row("bdpt, C = 1", million["bdpt"], "M pairs/s", spread(seen["bdpt"]), "0.4", "0.8"),
    ]
    rows[0].good, rows[1].good = million["pt"] >= floor, million["bdpt"] >= 0.4
    if cycles:
        rows.append(Row("Cycles", million["cycles"], "M samples/s", spread(seen["cycles"])))
        for name in ("pt", "bdpt"):
            ratios = [own / other for own, other in zip(seen[name], seen["cycles"], strict=True)]
            rows.append(Row(f"{name} / Cycles", median(ratios), "", spread(ratios)))
    zero = median(seen["zero"])
    rows.append(Row("bdpt, zero counts / pt", zero, "time", spread(seen["zero"]), "1.05", "1.0"))
    rows[-1].good = zero <= 1.05
    return rows, counters


def zero_counts(box: CapturedScene, seconds: float) -> list[float]:
    """Ratios of time per sample, in the order A B B A, of the same work."""
    a, _ = box.speed(seconds, **PT)
    b, _ = box.speed(seconds, **ZERO)
    c, _ = box.speed(seconds, **ZERO)
    d, _ = box.speed(seconds, **PT)
    return [a / b, d / c]


def variance_time(name: str, options: argparse.Namespace) -> Row:
    """Variance of a pixel at equal samples, times the time of a sample: bdpt over pt.

    With the counts that bdpt finds by itself, the passes that measure them included.
    """
    scene = CapturedScene(name, VARIANCE_SIZE, BOUNCES, options.threads)
    pictures: dict[str, list] = {"pt": [], "bdpt": []}
    times: dict[str, list[float]] = {"pt": [], "bdpt": []}
    for seed in range(options.seeds):
        for number, (key, settings) in enumerate((("pt", PT), ("bdpt", AUTOMATIC))):
            picture, stats = scene.render(
                samples=VARIANCE_SAMPLES, seed=1000 * (number + 1) + seed, **settings
            )
            pictures[key].append(picture)
            times[key].append(stats["seconds"])
    variance = relative_variance(pictures["bdpt"]) / relative_variance(pictures["pt"])
    ratios = [own / other for own, other in zip(times["bdpt"], times["pt"], strict=True)]
    value = variance * median(ratios)
    detail = f"{variance:.2f} x {median(ratios):.2f}"
    return Row(
        f"variance x time, {name}", value, detail, spread(ratios), "1.5", "1.0", value <= 1.5
    )


def show(rows: list[Row], counters: dict, options: argparse.Namespace) -> None:
    print(f"\nCornell box, {SIZE} x {SIZE}, {BOUNCES} bounces, {options.threads} threads", end="")
    print(f"; medians of {options.rounds} rounds\n")
    line = "{:<30} {:>7}  {:<12} {:>6}   {:<20} {:<5} {}"
    print(line.format("", "seen", "", "+-", "floor", "aim", ""))
    for row in rows:
        spread = "" if row.spread is None else f"{100 * row.spread:.0f} %"
        verdict = {None: "", True: "reached", False: "NOT REACHED"}[row.good]
        value = f"{row.value:.3f}"
        print(line.format(row.name, value, row.unit, spread, row.floor, row.aim, verdict).rstrip())
    for name, stats in counters.items():
        show_rays(name, stats)
    show_joins(counters["bdpt"])


def show_rays(name: str, stats: dict) -> None:
    paths = stats["paths"]["camera"]
    rays = stats["rays"]
    each = ", ".join(f"{kind} {count / paths:.2f}" for kind, count in rays.items() if count)
    total = sum(rays.values())
    print(f"\n{name}: rays per camera path: {each}; {total / paths:.2f} in all", end="")
    print(f", {total / stats['seconds'] / 1e6:.1f} M rays/s", end="")


def show_joins(stats: dict) -> None:
    """How far joins came: what each step of the order of work saved."""
    joins, rays = stats["joins"], stats["rays"]
    print("\n\nbdpt: what each step leaves of the joins that were tried")
    steps = [
        ("connections picked from the cache", joins["connections"]),
        ("  both ends face each other", joins["connections_facing"]),
        ("  survive roulette on the bound, BSDFs not black", joins["connections_evaluated"]),
        ("  survive roulette on the weighted value: rays", rays["connection"]),
    ]
    for kind, label in (("nee", "next event estimation"), ("splats", "splats")):
        steps.append((f"{label} with a value", joins[kind]))
        steps.append(("  survive roulette: rays", rays[kind.removesuffix("s")]))
    first = 1
    for label, count in steps:
        first = first if label.startswith(" ") else max(count, 1)
        print(f"  {label:<50} {count:>12,}  {100 * count / first:5.1f} %")


def processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


if __name__ == "__main__":
    main()
