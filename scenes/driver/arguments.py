# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line of `./dev render`. Knows no bpy, so that wrong usage is answered at once."""

from __future__ import annotations

import argparse
import ast
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"

FILTERS = ("blackman-harris", "gaussian", "box")
INTEGRATORS = ("bdpt", "pt", "lt")
CONNECTION_MODES = ("cache", "classic")
HEURISTICS = ("balance", "power", "none")
FORMATS = (".png", ".exr")
JANUS_ONLY = (
    "integrator",
    "capture",
    "no_next_event",
    "connection_mode",
    "heuristic",
    "strategy",
    "strategies",
    "passes",
    "dual",
)


def scene_names() -> list[str]:
    """The scenes of this folder: every module with a build()."""

    def is_scene(path: Path) -> bool:
        body = ast.parse(path.read_text(encoding="utf-8")).body
        return any(isinstance(n, ast.FunctionDef) and n.name == "build" for n in body)

    return sorted(path.stem for path in SCENES.glob("*.py") if is_scene(path))


def parse(arguments: list[str]) -> argparse.Namespace:
    """Exits with 2 and a message if the arguments make no sense."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.scene.lower().endswith(".blend"):
        options.blend = Path(options.scene).resolve()
        if not options.blend.is_file():
            parser.error(f"there is no file '{options.scene}'")
    else:
        options.blend = None
        if options.scene not in scene_names():
            names = ", ".join(scene_names())
            parser.error(f"there is no scene '{options.scene}'; there are: {names} (or a .blend)")
    name = options.blend.stem if options.blend else options.scene
    default = ROOT / "renders" / f"{name}.png"
    options.output = Path(options.output).resolve() if options.output else default
    if options.output.suffix.lower() not in FORMATS:
        parser.error(f"--output must end in {' or '.join(FORMATS)}, not '{options.output.name}'")
    if options.strategy:
        options.heuristic = options.heuristic or "none"
        if options.heuristic != "none":
            parser.error("--strategy chooses strategies without weights: --heuristic none")
    for key in ("stats", "capture", "save", "strategies", "dual"):
        if getattr(options, key):
            setattr(options, key, Path(getattr(options, key)).resolve())
    if options.dual and (options.strategies or options.passes):
        parser.error("--dual renders neither passes nor strategies")
    if options.engine != "janus":
        for key in JANUS_ONLY:
            if getattr(options, key):
                parser.error(f"--{key.replace('_', '-')} is for the engine janus")
    return options


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="./dev render",
        description="Renders a scene with Janus, through Blender, and says where the picture is.",
        epilog=f"Scenes: {', '.join(scene_names())}. What is not given is taken from the scene. "
        "Ctrl-C stops and keeps the picture so far.",
    )
    add = parser.add_argument
    add(
        "scene",
        nargs="?",
        default="hero",
        metavar="SCENE",
        help="a scene of scenes/ or a .blend file (default: hero)",
    )
    add(
        "-o",
        "--output",
        metavar="FILE",
        help=".png (with the scene's view transform) or .exr (scene linear, 32-bit float); "
        "default: renders/SCENE.png",
    )
    add("--samples", type=_at_least(int, 1), metavar="N", help="samples per pixel")
    add(
        "--seconds",
        type=_at_least(float, 0.0),
        metavar="T",
        help="stop after T seconds of rendering (0: no limit); without --samples, only then",
    )
    add("--integrator", choices=INTEGRATORS, help="default: bdpt")
    add(
        "--no-next-event",
        action="store_true",
        help="paths must hit lights, and light paths the camera's aperture, by chance",
    )
    add("--connection-mode", choices=CONNECTION_MODES, help="bdpt: light vertex cache, or pairs")
    add("--heuristic", choices=HEURISTICS, help="weights; none: bdpt's strategies, averaged")
    add(
        "--strategy",
        metavar="'S,T ...'",
        help="bdpt, without weights: only these, S vertices from the light and T from the camera, "
        "* for any, such as '0,* 1,2'",
    )
    add("--max-bounces", type=_at_least(int, 0), metavar="N")
    add("--filter", choices=FILTERS, help="pixel filter")
    add("--resolution", type=resolution, metavar="WxH", help="in pixels, such as 640x400")
    add("--threads", type=_at_least(int, 0), metavar="N", help="0: all")
    add("--seed", type=_at_least(int, 0), metavar="N")
    add("--frame", type=int, metavar="N", help="frame of the animation")
    add(
        "--pass",
        dest="passes",
        action="append",
        type=_named_expression,
        default=[],
        metavar="NAME=EXPRESSION",
        help="also render the light of certain paths, such as Caustics='LS+DE' (repeatable): with "
        "a .png, OUTPUT_NAME.png for each; with an .exr, OUTPUT_passes.exr with all passes of the "
        "scene as layers",
    )
    add(
        "--strategies",
        metavar="DIR",
        help="bdpt: also write what each strategy finds, with its weight and alone: DIR/"
        "strategies.png, a labelled contact sheet, and DIR/strategies.exr with a layer for each",
    )
    add(
        "--strategies-length",
        type=from_to(int, 1, 12),
        default=5,
        metavar="N",
        help="edges of the longest paths that are shown (default: 5)",
    )
    add(
        "--strategies-exposure",
        type=float,
        default=0.0,
        metavar="EV",
        help="stops by which the contact sheet is brightened, which it then says (default: 0)",
    )
    add(
        "--dual",
        metavar="DIR",
        help="capture the light transport between a projector (a spot or area light) and the "
        "camera: DIR/transport.npz, DIR/primal.png, and DIR/dual.png, what the projector sees",
    )
    add("--dual-light", metavar="NAME", help="the projector (default: the only light that can be)")
    add(
        "--dual-resolution",
        type=resolution,
        default=(64, 64),
        metavar="WxH",
        help="pixels of the projector's picture, at most 256x256 (default: 64x64)",
    )
    add("--stats", metavar="FILE", help="write a JSON file with samples, seconds, rays, findings")
    add("--capture", metavar="FILE", help="save the scene for `python -m janus_core` (.npz)")
    add("--save", metavar="FILE", help="save the scene as a .blend, as it is rendered")
    add(
        "--engine",
        choices=("janus", "cycles"),
        default="janus",
        help="cycles: the same with Cycles, to compare",
    )
    add(
        "--blender",
        metavar="PATH",
        help="use this Blender (`PATH -b`) instead of the bpy module",
    )
    return parser


def _at_least(kind, lowest):
    def convert(text: str):
        value = kind(text)
        if not value >= lowest:
            raise argparse.ArgumentTypeError(f"must be {lowest} or more")
        return value

    convert.__name__ = kind.__name__  # for argparse's message
    return convert


def from_to(kind, lowest, highest):
    def convert(text: str):
        value = kind(text)
        if not lowest <= value <= highest:
            raise argparse.ArgumentTypeError(f"must be from {lowest} to {highest}")
        return value

    convert.__name__ = kind.__name__
    return convert


def _named_expression(text: str) -> tuple[str, str]:
    name, equals, expression = text.partition("=")
    if not name or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=EXPRESSION, such as Sharp=LS+DE")
    return name, expression


def resolution(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d+)[x×](\d+)", text)
    if not match or not all(0 < int(n) <= 65536 for n in match.groups()):
        raise argparse.ArgumentTypeError(f"'{text}' is not WxH, such as 640x400")
    return int(match[1]), int(match[2])


def without_blender(arguments: list[str]) -> list[str]:
    """The same words without `--blender PATH`, in either way of writing it."""
    left: list[str] = []
    words = iter(arguments)
    for word in words:
        if word == "--blender":
            next(words, None)
        elif not word.startswith("--blender="):
            left.append(word)
    return left
