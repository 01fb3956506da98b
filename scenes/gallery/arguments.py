# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of `./dev gallery`. Knows no bpy, so that wrong usage is answered at once."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from scenes.driver.arguments import ROOT, from_to, resolution
from scenes.gallery.figures import FIGURES

CLOCKS = ("wall", "cpu")
SMALLEST, LARGEST = 16, 1024  # pixels on a side

# What the options are that are not given. Seconds: of each picture at equal time, and of all the
# renders that one reference is made of.
QUALITIES = {
    "quick": {"resolution": (240, 240), "seconds": 2.0, "seeds": 3, "reference_seconds": 24.0},
    "full": {"resolution": (400, 400), "seconds": 8.0, "seeds": 5, "reference_seconds": 240.0},
}


def parse(words: list[str]) -> argparse.Namespace:
    """Exits with 2 and a message that names the option if the arguments make no sense."""
    parser = _parser()
    options = parser.parse_args(words)
    for name, value in QUALITIES[options.quality].items():
        if getattr(options, name) is None:
            setattr(options, name, value)
    options.only = list(dict.fromkeys(options.only or FIGURES))
    for name in options.only:
        if name not in FIGURES:
            parser.error(f"argument --only: no figure '{name}'; there are: {', '.join(FIGURES)}")
    options.output = Path(options.output).resolve()
    try:
        options.output.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=options.output):
            pass
    except OSError as error:
        reason = error.strerror or error
        parser.error(f"argument --output: cannot write to '{options.output}': {reason}")
    return options


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="./dev gallery",
        description="Renders the lecture's comparisons, measures their errors, and writes DIR/"
        "index.html, to look at in a browser, and DIR/figures.json, with all the numbers.",
        epilog=f"Figures: {', '.join(FIGURES)}. References are kept in DIR/references and used "
        "again as long as the scene, the resolution and the time are the same.",
    )
    add = parser.add_argument
    add(
        *("-o", "--output"),
        default=ROOT / "renders" / "gallery",
        metavar="DIR",
        help="folder of the page (default: renders/gallery)",
    )
    add("--only", nargs="+", metavar="NAME", help="these figures (default: all)")
    add(
        "--quality",
        choices=tuple(QUALITIES),
        default="quick",
        help="quick: eight minutes; full: larger, with less noise, in about an hour",
    )
    add(
        "--resolution",
        type=_resolution,
        metavar="WxH",
        help=f"pictures have their scenes' proportions and fit into it, from {SMALLEST}x{SMALLEST}"
        f" to {LARGEST}x{LARGEST} (default: 240x240, full: 400x400)",
    )
    add(
        "--seconds",
        type=from_to(float, 0.02, 600.0),
        metavar="T",
        help="for each picture at equal time (default: 2, full: 8)",
    )
    add(
        "--seeds",
        type=from_to(int, 1, 32),
        metavar="N",
        help="renders that each error is the mean of (default: 3, full: 5)",
    )
    add(
        "--reference-seconds",
        type=from_to(float, 0.02, 7200.0),
        metavar="T",
        help="for each reference (default: 24, full: 240)",
    )
    add(
        "--clock",
        choices=CLOCKS,
        default="wall",
        help="what equal time is: wall time, or that of the processors over the number of threads, "
        "on a machine that others use as well (default: wall)",
    )
    add(
        "--threads",
        type=from_to(int, 0, 1024),
        default=0,
        metavar="N",
        help="of every render; 0: one for each processor (default: 0)",
    )
    return parser


def _resolution(text: str) -> tuple[int, int]:
    width, height = resolution(text)
    if not all(SMALLEST <= n <= LARGEST for n in (width, height)):
        raise argparse.ArgumentTypeError(
            f"must be from {SMALLEST}x{SMALLEST} to {LARGEST}x{LARGEST}, not {text}"
        )
    return width, height
