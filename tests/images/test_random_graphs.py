# SPDX-License-Identifier: GPL-3.0-or-later
"""Random node trees through Cycles and Janus: the same picture, or a named reason for another."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from janus_core import exr

from . import node_scenes, random_graphs
from .test_nodes import ON_EDGES, TOLERANCE, tiles

COUNT = 2048 if "JANUS_FULL" in os.environ else 256
# Sheets are written as floats around LIFT: that much of a value is lost.
FLOOR = 0.05
# What Janus knows to be different, by seed: why.
ROUNDED = "textures of numbers' last digits"
STEEP = "differs inside a pixel, from Cycles to Cycles as much as to Janus"
KNOWN = {
    35: "a closure that feeds a colour of a Repeat zone",
    121: ROUNDED,
    256: STEEP,
    393: "a Bump by a texture of constants, which Cycles does not know to be one",
    565: "0 to the power of 0, which Blender computes before Cycles sees it",
    626: ROUNDED,
    695: STEEP,
    743: STEEP,
    1079: ROUNDED,
    1498: "Fresnel by a normal that is five million long",
    1898: STEEP,
    100326: STEEP,
    100410: STEEP,
    100416: STEEP,
}


def rendered(folder, first: int, count: int) -> list[dict]:
    """The sheets of these seeds, with the pictures as values of the tiles."""
    command = [
        sys.executable,
        node_scenes.__file__,
        str(folder),
        "--random",
        str(first),
        str(count),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120 + count)
    assert done.returncode == 0, done.stdout + done.stderr
    result = json.loads((folder / "sheets.json").read_text())
    for number, sheet in enumerate(result):
        for kind in ("cycles", "janus", "again"):
            picture = exr.read(folder / f"sheet_{number}_{kind}.exr")[0][..., :3]
            sheet[kind] = (picture - node_scenes.LIFT) / node_scenes.SCALE
    return result


@pytest.fixture(scope="module", params=[(0, COUNT), (random_graphs.LATER, COUNT // 4)])
def sheets(tmp_path_factory, request):
    return rendered(tmp_path_factory.mktemp("graphs"), *request.param)


def test_colors_are_finite(sheets):
    for sheet in sheets:
        assert np.isfinite(sheet["janus"]).all()


def test_colors_are_finite_where_numbers_are_not(tmp_path):
    for sheet in rendered(tmp_path, random_graphs.WILD, COUNT // 2):
        assert np.isfinite(sheet["janus"]).all()


def test_graphs_are_cycles_or_named(sheets):
    wrong, named, flat, compared = [], 0, 0, 0
    for sheet in sheets:
        said = {entry[1] for entry in sheet["said"] if entry[0] != "INFO"}
        again = {name: pixels for name, pixels, _ in tiles({**sheet, "cycles": sheet["again"]})}
        for name, cycles, janus in tiles(sheet):
            span = max(float(np.ptp(cycles)), float(np.abs(cycles).max()), FLOOR)
            # Where Cycles does not agree with itself a hundredth of a pixel away, nobody can.
            firm = np.abs(cycles - again[name]).max(axis=-1) <= TOLERANCE * span
            off = np.where(firm, np.abs(cycles - janus).max(axis=-1) / span, 0.0)
            kept = float(np.sort(off, axis=None)[-1 - int(ON_EDGES * off.size)])
            named += name in said
            flat += float(np.ptp(cycles)) < 1e-4
            compared += bool(firm.mean() > 0.5) and name not in said
            if not kept <= TOLERANCE and name not in said and int(name[6:]) not in KNOWN:
                wrong.append(f"{name}: {kept:.4f} of the range")
    count = sum(len(sheet["names"]) for sheet in sheets)
    print(f"{count} graphs: {compared} compared, {named} named, {flat} of one colour")
    assert wrong == []
    assert compared > 0.7 * count
    assert flat < 0.8 * count  # much of what there is to ask for is the same all over a mesh
    assert 0 < named < 0.3 * count
