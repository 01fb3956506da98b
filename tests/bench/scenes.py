# SPDX-License-Identifier: GPL-3.0-or-later
"""Error at equal time on eleven scenes: Janus beside Cycles; `./dev bench scenes`.

Everything renders 128 x 128 pixels with two threads for eight seconds, with five seeds and a box
filter, which every renderer has; bdpt finds its counts by itself, as in Blender. `merged` is bdpt
that also merges vertices, with a radius of 4 mm: what it blurs is in its error. Cycles has its
light tree on, and of its renders with and without path guiding the better ones count. All engines
alternate, seed by seed, because a machine is never quiet. Of each scene, the references take twelve
minutes, once, and are kept on disk; all the renders take five.

The error is relMSE, with the formula of janus_core.errors, as mean over the seeds. A second table
has it without the thousandth of the pixels where it is largest. Neither tells all where some path
is found by chance alone (a caustic behind glass): in the first, who is lucky enough never to find
it wins; in the second, who has all the light of a caustic in few pixels.

LuxCore's BIDIR (roulette off, as it is biased with it) and Mitsuba's path tracer take part where
the scene is so plain that they can be given exactly the same (_plain.py), if `--peers` names a
Python that has them: `pip install pyluxcore mitsuba` in a virtual environment of their own.

Export and building are in no engine's time. Janus has a clock of its own for that. Cycles renders
a number of samples, and what a render of one sample takes is subtracted: its own time limit would
only be looked at between batches of samples that grow, and would hide how long the last one was.
No engine ends exactly on time: an error is scaled by (time taken) / (time given), as that of
independent samples. With `--clock cpu` the time is that of the processors over the number of
threads: renders take as long as they need for it on a machine that others use as well.

Floors are what the project wants; a number below its floor is marked and is no failure.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from _measure import CapturedScene, Cycles, Peer, Shot, Unavailable
from _reference import KINDS, Reference, References
from janus_core.errors import relative_error, trimmed_error

SCENES = (
    *("hero", "hero_caustic", "hidden_light", "metal_ring", "ajar_door", "pool"),
    *("many_lights", "hdri_interior", "cornell_box", "studio", "sunlit_exterior"),
)
HARD = (
    "hidden_light",
    "hero",
    "hero_caustic",
    "metal_ring",
)  # at least 3 times better than the best peer
EASY = ("studio", "sunlit_exterior")  # at most 1.1 times worse than Cycles and than our own pt
HARD_FLOOR, EASY_FLOOR = 3.0, 1.1
ENGINES = ("bdpt", "merged", "pt", "cycles", "guided", "luxcore", "mitsuba")
OWN = ENGINES[:3]
MERGE_RADIUS = 0.004  # metres
SERVICES = {"luxcore": "_luxcore.py", "mitsuba": "_mitsuba.py"}
MAX_STRETCH = 8.0
FIRST_SEED = {"bdpt": 100, "pt": 200, "cycles": 300, "guided": 400, "reference": 500}
FIRST_SEED |= {"luxcore": 600, "mitsuba": 700, "merged": 800}


@dataclass
class Row:
    """A scene. By engine: errors, their standard errors (relative), rates in M samples/s, and how
    bright all its pictures together are beside the reference.

    An engine that does not take part is not in them.
    """

    scene: str
    reference: Reference
    errors: dict[str, float]
    trimmed: dict[str, float]
    spreads: dict[str, float]
    rates: dict[str, float]
    brightness: dict[str, float]
    notes: list[str]

    def best(self, *engines: str) -> str:
        return min(self.errors.keys() & set(engines), key=self.errors.__getitem__)

    def peer(self) -> str:
        return self.best(*(engine for engine in ENGINES if engine not in OWN))

    def ratio(self, engine: str, own: str = "bdpt") -> tuple[float, float]:
        """(error over that of `own`, its standard error): above 1, ours is better."""
        ratio = self.errors[engine] / self.errors[own]
        return ratio, ratio * math.hypot(self.spreads[engine], self.spreads[own])

    def floors(self) -> list[tuple[str, bool]]:
        if self.scene in HARD:
            return [
                (f"{own}: {HARD_FLOOR:g} x the best peer", ratio >= HARD_FLOOR)
                for own, (ratio, _) in ((own, self.ratio(self.peer(), own)) for own in OWN[:2])
            ]
        if self.scene in EASY:
            return [
                (f"1/{EASY_FLOOR:g} of {name}", self.ratio(engine)[0] >= 1.0 / EASY_FLOOR)
                for engine, name in ((self.best("cycles", "guided"), "Cycles"), ("pt", "pt"))
            ]
        return []


class Bench:
    """One scene in all engines."""

    def __init__(self, scene: str, options: argparse.Namespace, say) -> None:
        self.name, self.options, self.say = scene, options, say
        self.captured = CapturedScene(scene, options.size, None, options.threads, "box")
        self.cycles = Cycles(self.captured)
        for guiding in (False, True):  # kernels load
            self.cycles.render(1, 0, guiding)
        self._calibrated: dict[bool, tuple[dict, float]] = {}
        self._stretch = 1.0  # wall time of a second of our clock, lately
        self.peers: dict[str, Peer] = {}
        self.absent: list[str] = []  # peers that do not take part, and why
        for name, service in SERVICES.items() if options.peers else ():
            try:
                self.peers[name] = Peer(service, options.peers, self.captured, options.threads)
            except Unavailable as reason:
                self.absent.append(f"{name}: {reason}")

    def close(self) -> None:
        for service in (self.cycles, *self.peers.values()):
            service.close()

    def shot(self, engine: str, seconds: float, seed: int) -> Shot:
        if engine in ("cycles", "guided"):
            shot = self._cycles_shot(engine == "guided", seconds, seed)
        elif engine in self.peers:
            shot = self.peers[engine].shot(seconds * self._stretch, seed)
        else:
            wall = seconds * self._stretch
            merging = {"merge_radius": MERGE_RADIUS} if engine == "merged" else {}
            integrator = "pt" if engine == "pt" else "bdpt"
            shot = self.captured.shot(wall, integrator=integrator, seed=seed, **merging)
        self._stretch = min(max(shot.seconds / self.clock(shot), 1.0), MAX_STRETCH)
        return shot

    def _cycles_shot(self, guiding: bool, seconds: float, seed: int) -> Shot:
        if guiding not in self._calibrated:
            self._calibrate(guiding)
        none, rate = self._calibrated[guiding]
        shot = self.cycles.shot(max(round(rate * seconds), 2), none, seed, guiding)
        # The next one is as long as this one says: the machine may be another than a while ago.
        self._calibrated[guiding] = (none, shot.samples / self.clock(shot))
        return shot

    def _calibrate(self, guiding: bool) -> None:
        """What a render of one sample takes, and how many more fit into a second."""
        runs = [self.cycles.render(1, 0, guiding) for _ in range(3)]
        none = {key: float(np.median([run[key] for run in runs])) for key in runs[0]}
        samples, seconds = 4, 0.0
        while seconds < 0.15 * self.options.seconds:
            samples *= 2
            shot = self.cycles.shot(samples, none, 0, guiding)
            seconds = self.clock(shot)
        self._calibrated[guiding] = (none, samples / seconds)

    def references(self) -> References:
        options = self.options
        settings = {"size": options.size, "seconds": options.reference_seconds, "filter": "box"}
        references = References(self.name, settings)
        if references.missing:
            for kind in KINDS:
                self.say(f"{self.name}: reference, {kind}")
                seed = FIRST_SEED["reference"] + 10 * KINDS.index(kind)
                half = options.reference_seconds / 2
                references.add(kind, [self.shot(kind, half, seed + i).picture for i in (0, 1)])
            references.save()
        return references

    def run(self) -> Row:
        references = self.references()
        engines = [name for name in ENGINES if name not in SERVICES or name in self.peers]
        shots: dict[str, list[Shot]] = {engine: [] for engine in engines}
        for turn in range(self.options.seeds):
            self.say(f"{self.name}: seed {turn + 1} of {self.options.seeds}")
            for engine in engines:
                seed = FIRST_SEED[engine] + turn
                shots[engine].append(self.shot(engine, self.options.seconds, seed))

        def errors(picture: np.ndarray, of=relative_error) -> dict[str, np.ndarray]:
            """By engine, of each seed, as if exactly the time given had been taken."""
            return {
                engine: np.array([of(s.picture, picture) * self.taken(s) for s in taken])
                for engine, taken in shots.items()
            }

        reference = references.choose(
            lambda picture, of: min(found.mean() for found in errors(picture, of).values())
        )
        found = errors(reference.picture)
        spreads = {
            engine: float(values.std(ddof=1) / math.sqrt(len(values)) / values.mean())
            for engine, values in found.items()
        }
        return Row(
            *(self.name, reference, _means(found)),
            *(_means(errors(reference.picture, trimmed_error)), spreads),
            {engine: self.rate(taken) for engine, taken in shots.items()},
            {
                engine: float(np.mean([s.picture.mean() for s in taken]) / reference.picture.mean())
                for engine, taken in shots.items()
            },
            self.notes(reference, references),
        )

    def rate(self, shots: list[Shot]) -> float:
        samples = self.options.size**2 * sum(shot.samples for shot in shots)
        return 1e-6 * samples / sum(self.clock(shot) for shot in shots)

    def clock(self, shot: Shot) -> float:
        return shot.cpu / self.options.threads if self.options.clock == "cpu" else shot.seconds

    def taken(self, shot: Shot) -> float:
        return self.clock(shot) / self.options.seconds

    def notes(self, reference: Reference, references: References) -> list[str]:
        notes = list(self.absent)
        if not reference.good:
            notes.append("the reference's own error is more than a tenth of the smallest one")
        for one, other in (("pt", "cycles"), ("bdpt", "pt"), ("bdpt", "cycles")):
            if not references.agree(one, other):
                seen, expected = references.differ(one, other)
                notes.append(
                    f"references of {one} and {other} differ by {seen:.2g}, expected {expected:.2g}"
                )
        return notes


def main() -> None:
    options = arguments()
    say = lambda text: print(f"  {text} ...", file=sys.stderr, flush=True)  # noqa: E731
    rows = []
    for scene in options.scenes:
        bench = Bench(scene, options, say)
        try:
            rows.append(bench.run())
        finally:
            bench.close()
    show(rows, options)
    if options.json:
        result = {"settings": {**vars(options), "json": None}, "rows": [plain(r) for r in rows]}
        options.json.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="./dev bench scenes", description=__doc__)
    add = parser.add_argument
    add("--scenes", nargs="+", default=SCENES, metavar="NAME", help="default: all")
    add("--seconds", type=float, default=8.0, metavar="T", help="of each render, default: 8")
    add("--seeds", type=int, default=5, metavar="N", help="default: 5, at least 2")
    add("--threads", type=int, default=2, metavar="N", help="default: 2")
    add("--size", type=int, default=128, metavar="N", help="pixels of a side, default: 128")
    add(
        *("--reference-seconds", "-r"),
        **dict(type=float, default=240.0, metavar="T"),
        help="for each of three renderers, once: build/bench-references keeps them; default: 240",
    )
    add("--clock", choices=("wall", "cpu"), default="wall", help="default: wall")
    add("--peers", metavar="PYTHON", help="a Python that has pyluxcore and mitsuba")
    add("--json", type=Path, metavar="FILE", help="write the numbers there too")
    options = parser.parse_args()
    if options.seeds < 2:
        parser.error("--seeds must be 2 or more")
    return options


def _means(by_engine: dict[str, np.ndarray]) -> dict[str, float]:
    return {engine: float(values.mean()) for engine, values in by_engine.items()}


def show(rows: list[Row], options: argparse.Namespace) -> None:
    print(f"\nrelMSE after {options.seconds:g} s ({options.clock} clock), ", end="")
    print(f"{options.size} x {options.size}, {options.threads} threads, {options.seeds} seeds\n")
    line = "{:<16}" + " {:>8}" * len(ENGINES) + "  {:>13} {:>13} {:>13}  {}"
    titles = ("bdpt", "merged", "pt", "Cycles", "guided", "LuxCore", "Mitsuba")
    titles += ("best / bdpt", "best / merged", "pt / bdpt")
    print(line.format("scene", *titles, "floors"))
    for row in rows:
        verdicts = [f"{name}: {'PASS' if good else 'FAIL'}" for name, good in row.floors()]
        pairs = ((row.peer(), "bdpt"), (row.peer(), "merged"), ("pt", "bdpt"))
        ratios = ["{:.2f} +- {:.2f}".format(*row.ratio(*pair)) for pair in pairs]
        print(
            line.format(
                row.scene, *_cells(row.errors, ".1e"), *ratios, ", ".join(verdicts)
            ).rstrip()
        )
    print("\nwithout the thousandth of the pixels with the largest errors")
    for row in rows:
        peer = min(row.trimmed.keys() - set(OWN), key=row.trimmed.get)
        pairs = ((peer, "bdpt"), (peer, "merged"), ("pt", "bdpt"))
        ratios = [f"{row.trimmed[engine] / row.trimmed[own]:.2f}" for engine, own in pairs]
        print(line.format(row.scene, *_cells(row.trimmed, ".1e"), *ratios, "").rstrip())
    print("\nbrightness beside the reference's")
    for row in rows:
        print(line.format(row.scene, *_cells(row.brightness, ".3f"), "", "", "", "").rstrip())
    print("\nM samples/s, and the reference")
    for row in rows:
        reference = f"{row.reference.kind}, its own relMSE {row.reference.error:.1e}"
        print(line.format(row.scene, *_cells(row.rates, ".3f"), "", "", "", reference))
        for note in row.notes:
            print(f"    {note}")


def _cells(values: dict[str, float], form: str) -> list[str]:
    return [f"{values[name]:{form}}" if name in values else "-" for name in ENGINES]


def plain(row: Row) -> dict:
    """A row as JSON, without the picture."""
    reference = {**asdict(row.reference), "picture": None}
    return {**asdict(row), "reference": reference, "peer": row.peer(), "floors": row.floors()}


if __name__ == "__main__":
    main()
