# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes core/NODES.md: what Janus makes of each shader node, and how far from Cycles it is.

`python node_document.py [--write]` prints the document, or writes it. It is made of the recordings
of all Blenders (record_nodes.py), the core's table of nodes, what is declared in node_coverage.py,
and the measurements of tests/images (node_differences.json).
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import node_coverage
import record_nodes
import recordings

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from tests.images import closure_cells  # noqa: E402

DOCUMENT = ROOT / "core" / "NODES.md"
DIFFERENCES = ROOT / "tests" / "images" / "node_differences.json"


# By what has no closure of its own: what is used.
INSTEAD = {"BURLEY": "a random walk"}


class Versions:
    """Which Blenders have what."""

    def __init__(self, recordings: dict[str, dict]):
        self.all = list(recordings)
        self.labels = {}  # of the newest that has the node
        self._of = {}  # (kind,), (kind, entry) or (kind, setting, item) -> [version]
        for version, recording in recordings.items():
            for entry in recording.values():
                kind = node_coverage.kind_of(entry)
                self.labels[kind] = entry["label"]
                for key in dict.fromkeys(_keys(kind, entry)):
                    self._of.setdefault(key, []).append(version)

    def said(self, *key: str) -> str:
        """Such as "4.3+"; nothing for what is in all versions that have what is around it."""
        there, around = self._of[key], self._of[key[:-1]] if key[:-1] else self.all
        if there == around:
            return ""
        first, last = self.all.index(there[0]), self.all.index(there[-1])
        if there != self.all[first : last + 1]:
            return ", ".join(there)
        if last == len(self.all) - 1:
            return f"{there[0]}+"
        return f"to {there[-1]}" if first == 0 else f"{there[0]} to {there[-1]}"

    def entries(self, kind: str) -> str:
        """The sockets and items of a node that not all versions have."""
        found = {}
        for key in self._of:
            if key[0] == kind and len(key) > 1:
                found.setdefault(self.said(*key), []).append(key[-1])
        found.pop("", None)
        return "; ".join(f"{', '.join(names)} in {when}" for when, names in found.items())


def _keys(kind: str, entry: dict):
    yield (kind,)
    for identifier, *_ in entry["inputs"] + entry["outputs"]:
        yield kind, identifier
    for setting, items in entry["settings"].items():
        yield kind, setting
        for item in items:
            yield kind, setting, item


def document() -> str:
    """core/NODES.md."""
    versions = Versions(recordings.stored(record_nodes.FOLDER))
    differences = json.loads(DIFFERENCES.read_text())
    known, rows = node_coverage.core_nodes(), []
    counts = {"exact": 0, "partly": 0, "refused": 0, "not for Cycles": 0}
    for kind, label in sorted(versions.labels.items(), key=lambda item: (item[1], item[0])):
        status, notes = _status(kind, known.get(kind))
        counts[status] += 1
        if kind in known and (entries := versions.entries(kind)):
            notes.append(entries)
        limit = differences.get(kind)
        cells = (
            *(label, f"`{kind}`", versions.said(kind), status),
            *("" if limit is None else f"{limit:.0e}".replace("e-0", "e-"), "; ".join(notes)),
        )
        rows.append("| " + " | ".join(cells) + " |")
    total = ", ".join(f"{number} {status}" for status, number in counts.items())
    closure_cells.add_cells()
    said = {"first": versions.all[0], "last": versions.all[-1], "total": total}
    return TEXT.format(**said, cells=len(closure_cells.CELLS)) + "\n".join([*rows, ""])


TEXT = """\
# Shader nodes

What Janus makes of the shader nodes of Blender {first} to {last}: {total}.

*Exact* nodes give Cycles' results for every setting and input. What is *partly* supported or
*refused* is named in the UI and in the log, with material and node, where it is used.

*Blender* says which versions have the node, where not all have it: 4.3+ is 4.3 and newer.
*Off* is the largest difference from Cycles over all settings and versions, rounded up, as a share
of the range of values (`tests/images/test_nodes.py`; the edges of steps are left out). Both engines
throw their samples within a hundredth of a pixel, not at the same places: that alone is 1e-3 on a
steep slope. From 5.1 on Cycles rounds its normals, which bumps and normal maps show; in pictures
it is the tables of colour spaces. Closures are compared over a grid of their settings, {cells}
cells, each to 1 % of its mean (`tests/images/test_closures.py`).

Written by `tests/addon/node_document.py --write`; a test keeps it up to date.

| Node | Type | Blender | | Off | Remarks |
|---|---|---|---|---|---|
"""


def _status(kind: str, core: dict | None) -> tuple[str, list[str]]:
    remarks = node_coverage.REMARKS
    remarks = [remarks[kind]] if kind in remarks else []
    if kind in node_coverage.NOT_FOR_CYCLES:
        return "not for Cycles", remarks
    if kind in node_coverage.REFUSED:
        return "refused", [node_coverage.REFUSED[kind]]
    if core is None:
        return "partly" if remarks else "exact", remarks
    named = [item for _, items in core["settings"].values() for item in items]
    notes = [f"{INSTEAD[item]} for {item}" for item in named]
    return "partly" if notes or remarks else "exact", notes + remarks


if __name__ == "__main__":
    text = document()
    if "--write" in sys.argv:
        DOCUMENT.write_text(text)
    else:
        print(text)
