# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the figures of core/LECTURE.md anew. Run by hand, from the root of the tree:

PYTHONPATH=build/release/python .venv/bin/python scenes/lecture_figures.py [FIGURE ...]
"""

import shutil
import sys
from pathlib import Path

import bpy
import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent))

from scenes import glass_box  # noqa: E402
from scenes.driver import addon, run  # noqa: E402

SIDE, GAP, SCALE, PAPER, INK = 240, 12, 2, 0.13, 0.85
LINE = 18  # of a label
MORE_GLYPHS = {  # capitals and signs of expressions, beside those of contact sheets
    "D": (30, 17, 17, 17, 17, 17, 30),
    "E": (31, 16, 16, 30, 16, 16, 31),
    "L": (16, 16, 16, 16, 16, 16, 31),
    "S": (15, 16, 16, 14, 1, 1, 30),
    "(": (2, 4, 8, 8, 8, 4, 2),
    ")": (8, 4, 2, 2, 2, 4, 8),
    "|": (4, 4, 4, 4, 4, 4, 4),
    "*": (0, 4, 21, 14, 21, 4, 0),
    "a": (0, 0, 14, 1, 15, 17, 15),
    "b": (16, 16, 30, 17, 17, 17, 30),
    "c": (0, 0, 14, 16, 16, 16, 14),
    "f": (6, 8, 8, 28, 8, 8, 8),
    "m": (0, 0, 26, 21, 21, 21, 21),
}
MOST = {"light_paths": 16.0, "samples": 512}  # 8192 light paths for each pixel
CONSTRUCTIONS = (
    ("path tracing s=0", {"integrator": "PT", "next_event": False}),
    ("path tracing s=0 s=1", {"integrator": "PT"}),
    ("mean of all bdpt", {"heuristic": "NONE"}),
    ("light tracing t=0", {"integrator": "LT", "next_event": False, **MOST}),
    ("light tracing t=1", {"integrator": "LT"}),
    ("weighted bdpt", {}),
)
EXPRESSIONS = ("L.*E", "LS+DE", "LDD+E", "L(D|S)E", "L.*SE")


def glass_box_scene(side: int, samples: int, lens: bool = False, **settings) -> bpy.types.Scene:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    glass_box.build(scene)
    scene.render.engine = addon.ENGINE
    scene.render.resolution_x = scene.render.resolution_y = side
    for name, value in {"samples": samples, "adaptive_counts": False, **settings}.items():
        setattr(scene.janus, name, value)
    dof = scene.camera.data.dof
    dof.use_dof, dof.aperture_fstop, dof.focus_distance = lens, 0.14, 4.6  # 40 cm wide
    return scene


def rendered(janus: addon.Addon, scene: bpy.types.Scene) -> dict[str, np.ndarray]:
    """By pass: as it is displayed, float32[H, W, 3], top row first."""
    final, picture = janus.part("render.final"), janus.part("render.picture")
    final.keep_passes_of.add(scene.name_full)
    bpy.ops.render.render(scene=scene.name)
    [passes] = final.kept_passes.values()
    return {k: picture.displayed(scene, v[:, :, :3])[::-1].copy() for k, v in passes.items()}


def grid(janus: addon.Addon, name: str, columns: int, tiles: list[tuple[str, np.ndarray]]) -> None:
    """Writes labelled tiles, row by row."""
    glyphs = janus.part("render.glyphs")
    glyphs.GLYPHS.update(MORE_GLYPHS)
    side = tiles[0][1].shape[0]
    rows = -(-len(tiles) // columns)
    size = (GAP + rows * (LINE + side + GAP), GAP + columns * (side + GAP), 3)
    sheet = np.full(size, PAPER, dtype=np.float32)
    for i, (text, pixels) in enumerate(tiles):
        y, x = GAP + i // columns * (LINE + side + GAP), GAP + i % columns * (side + GAP)
        mask = glyphs.text_mask(text, SCALE)
        sheet[y : y + mask.shape[0], x : x + mask.shape[1]][mask] = INK
        sheet[y + LINE : y + LINE + side, x : x + side] = pixels
    janus.part("render.picture").save_bytes(str(FOLDER / name), sheet[::-1])


def constructions(janus: addon.Addon) -> None:
    tiles = []
    for label, settings in CONSTRUCTIONS:
        scene = glass_box_scene(SIDE, lens="t=0" in label, **{"samples": 64, **settings})
        tiles.append((label, rendered(janus, scene)["Combined"]))
    grid(janus, "lecture_constructions.png", 3, tiles)


def strategies(janus: addon.Addon) -> None:
    scene = glass_box_scene(100, 512)
    part = janus.part("render.strategies")
    part.ask(scene, 4)
    bpy.ops.render.render(scene=scene.name)
    sheet, _ = part.save(scene, bpy.app.tempdir, exposure=1.0)
    part.withdraw(scene)
    shutil.copyfile(sheet, FOLDER / "lecture_strategies.png")


def expressions(janus: addon.Addon) -> None:
    scene = glass_box_scene(176, 1024)
    for text in EXPRESSIONS:
        item = scene.view_layers[0].janus.expressions.add()
        item.name, item.expression = text.replace(".", "any"), text
    passes = list(rendered(janus, scene).values())[1:]  # without Combined
    tiles = list(zip(EXPRESSIONS, passes, strict=True))
    grid(janus, "lecture_expressions.png", len(tiles), tiles)


if __name__ == "__main__":
    FIGURES = {f.__name__: f for f in (constructions, strategies, expressions)}
    janus = addon.load()
    for figure in sys.argv[1:] or FIGURES:
        FIGURES[figure](janus)
    janus.unload()
    run.leave(0)
