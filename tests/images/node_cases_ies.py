# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of IES Texture: every type of file, and all directions."""

from __future__ import annotations

from .ies_texts import BROKEN, TEXTS
from .node_cases import CASES


def text(name: str, body: str):
    import bpy

    made = bpy.data.texts.new(name)
    made.write(body)
    return made


def add_cases() -> None:
    for name, body in TEXTS.items():

        def build(t, name=name, body=body):
            inputs = {"Vector": t.vector(), "Strength": 0.5}
            return t.out("TexIES", inputs, ies=text(name, body))

        CASES[f"ies {name}"] = build

    def whole():
        return text("whole", TEXTS["C whole"])

    # Each tile and each corner of it is seen from one direction alone.
    CASES["ies of the view"] = lambda t: t.out("TexIES", {"Strength": t.parts()[0]}, ies=whole())
    CASES["ies of a direction"] = lambda t: t.out(
        "TexIES", {"Vector": (0.3, -0.5, -0.7)}, ies=whole()
    )
    # Named: see test_nodes.py.
    for name, body in BROKEN.items():
        CASES[f"ies broken {name}"] = lambda t, body=body: t.out("TexIES", ies=text("Broken", body))
    CASES["ies broken none"] = lambda t: t.out("TexIES", {"Strength": t.parts()[0]})
    CASES["ies broken file"] = lambda t: t.out("TexIES", mode="EXTERNAL", filepath="//missing.ies")

    def external(t):
        import tempfile
        from pathlib import Path

        path = Path(tempfile.mkdtemp()) / "lamp.ies"
        path.write_text(TEXTS["C half"], encoding="latin-1")
        return t.out("TexIES", {"Vector": t.vector()}, mode="EXTERNAL", filepath=str(path))

    CASES["ies from a file"] = external
