# SPDX-License-Identifier: GPL-3.0-or-later
"""Every setting of every node of values through Cycles: the same picture, pixel by pixel."""

import json
import subprocess
import sys

import numpy as np
import pytest
from janus_core import exr

from . import node_scenes

# Of the range of a tile's values. Both engines throw their samples within a hundredth of a pixel,
# so a tile differs by that much of its slope; the mean of SAMPLES leaves an eighth of it.
TOLERANCE = 3e-3
# Where Blender and Cycles do not use the same table of OpenColorIO's: so much more.
LOOSE = {"image bytes in Khronos PBR Neutral sRGB": 1.5}
# Pixels of a tile that an edge of a step may cross: there half of the samples lie on either side.
ON_EDGES = 0.12


@pytest.fixture(scope="module")
def sheets(tmp_path_factory):
    folder = tmp_path_factory.mktemp("nodes")
    command = [sys.executable, node_scenes.__file__, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    result = json.loads((folder / "sheets.json").read_text())
    for number, sheet in enumerate(result):
        for engine in ("cycles", "janus"):
            picture = exr.read(folder / f"sheet_{number}_{engine}.exr")[0][..., :3]
            sheet[engine] = (picture - node_scenes.LIFT) / node_scenes.SCALE
    return result


def tiles(sheet):
    """(name, Cycles' pixels, Janus' pixels) without the tile's border."""
    size = node_scenes.TILE
    for number, name in enumerate(sheet["names"]):
        y = number // node_scenes.COLUMNS * size
        x = number % node_scenes.COLUMNS * size
        inside = np.s_[y + 3 : y + size - 3, x + 3 : x + size - 3]
        yield name, sheet["cycles"][inside], sheet["janus"][inside]


def test_every_node_is_cycles(sheets):
    wrong, largest = [], {}
    for sheet in sheets:
        for name, cycles, janus in tiles(sheet):
            span = max(float(cycles.max() - cycles.min()), float(np.abs(cycles).max()), 1e-6)
            off = np.abs(cycles - janus).max(axis=-1) / span
            allowed = int(ON_EDGES * off.size)
            kept = float(np.sort(off, axis=None)[-1 - allowed])
            largest[name] = kept
            if not kept <= TOLERANCE * LOOSE.get(name, 1.0):
                wrong.append(f"{name}: {kept:.4f} of the range")
    worst = sorted(largest, key=largest.get, reverse=True)[:5]
    print(f"{len(largest)} cases; largest: {[(name, round(largest[name], 5)) for name in worst]}")
    assert len(largest) > 900
    assert wrong == []


def test_nothing_is_said_but_of_missing_pictures(sheets):
    said = [entry for sheet in sheets for entry in sheet["said"] if entry[0] != "INFO"]
    missing = {"image missing", "sequence 0 1 0 False", "sequence 100 1 50 False"}
    missing |= {f"tiles True False {name}" for name in ("Closest", "Linear")}
    assert sorted(entry[1] for entry in said) == sorted(missing)
    assert all("missing" in entry[3] for entry in said)
