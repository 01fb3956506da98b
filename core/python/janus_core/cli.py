# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `python -m janus_core`: renders a captured scene to an OpenEXR file.

Exit codes: 0 done, 1 rendering or a file failed, 2 wrong usage, 3 the scene cannot be rendered,
130 interrupted. Of an interrupted or failed render the passes so far are in the picture.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from . import (
    Cancelled,
    Diagnostic,
    Error,
    RenderSession,
    RenderSettings,
    SceneError,
    __version__,
    capture,
    check_expression,
    exr,
)
from ._files import write_text
from ._progress import ProgressBar

OK, FAILED, USAGE, SCENE, INTERRUPTED = 0, 1, 2, 3, 130

FILTERS = ("blackman-harris", "gaussian", "box")
INTEGRATORS = ("bdpt", "pt", "lt")
FOREVER = 1 << 24  # samples, where only the time is limited
POLL_SECONDS = 0.1


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command with `arguments` (default: those of the process); the exit code."""
    parser = _parser()
    try:
        options = parser.parse_args(arguments)
    except SystemExit as stopped:
        return stopped.code
    try:
        return _run(options)
    except _UsageError as error:
        parser.print_usage(sys.stderr)
        return _fail(USAGE, f"error: {error}")
    except SceneError as error:
        return _fail(SCENE, f"the scene cannot be rendered: {error}")
    except KeyboardInterrupt:
        return _fail(INTERRUPTED, "interrupted; nothing was written")
    except (Error, ImportError) as error:
        return _fail(FAILED, str(error))
    except OSError as error:
        return _fail(FAILED, f"{error.filename}: {error.strerror}" if error.filename else error)
    except MemoryError as error:
        return _fail(FAILED, f"out of memory: {error}" if str(error) else "out of memory")


class _UsageError(Exception):
    """Options that make no sense with this scene."""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m janus_core",
        description="Renders a captured scene (.npz) to an OpenEXR file (32-bit float, linear).",
        epilog="What is not given is taken from the file. "
        "Ctrl-C stops and writes the picture so far; twice, at once and without it. "
        "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 wrong scene, 130 interrupted.",
    )
    add = parser.add_argument
    add("file", metavar="FILE", help="what a capture has saved, such as ./dev render --capture")
    add("-o", "--output", required=True, type=_exr_name, metavar="OUT.exr")
    add("--samples", type=_number(int, 1, 2**31 - 1), metavar="N", help="samples per pixel")
    add(
        "--seconds",
        type=_number(float, 0.0),
        metavar="T",
        help="stop after T seconds of rendering (0: no limit); without --samples, only then",
    )
    add("--integrator", choices=INTEGRATORS)
    add("--max-bounces", type=_number(int, 0, 1024), metavar="N")
    add("--threads", type=_number(int, 0, 1024), metavar="N", help="0: all")
    add("--seed", type=_number(int, 0, 2**32 - 1), metavar="N")
    add(
        "--resolution",
        type=_resolution,
        metavar="WxH",
        help="in pixels, such as 640x360; the shape of the picture stays",
    )
    add("--filter", choices=FILTERS, help="pixel filter")
    add(
        "--pass",
        dest="passes",
        action="append",
        type=_named_expression,
        default=[],
        metavar="NAME=EXPRESSION",
        help="also write the light of certain paths, such as Caustics='LS+DE', as channels "
        "NAME.R, NAME.G, NAME.B of the output (repeatable)",
    )
    add("--stats", metavar="F.json", help="write samples, seconds, rays, findings, settings")
    add("-q", "--quiet", action="store_true", help="say nothing but errors")
    add("--version", action="version", version=f"janus_core {__version__}")
    return parser


def _run(options: argparse.Namespace) -> int:
    _check_outputs(options)
    started = time.perf_counter()
    builder, captured = capture.load(options.file)
    settings = RenderSettings(**_changed(captured.to_dict(), options))
    loaded = time.perf_counter()
    with _interruptible() as stop:
        try:
            scene = builder.commit(poll=stop)
        except Cancelled:
            raise KeyboardInterrupt from None
        stats: dict[str, Any] = {
            "version": __version__,
            "scene": os.fspath(options.file),
            "load_seconds": loaded - started,
            "commit_seconds": time.perf_counter() - loaded,
            "counts": dict(scene.counts),
            "settings": settings.to_dict(),
            "diagnostics": [describe(found) for found in scene.diagnostics],
        }
        session = RenderSession(scene, settings)
        stats["diagnostics"] += [describe(found) for found in session.diagnostics]
        if not options.quiet:
            for text in stats["diagnostics"]:
                print(text, file=sys.stderr)
        error = _render(session, settings, options.quiet, stop)
    stats |= session.stats()
    stats["cancelled"] = stop()
    if stats["samples"] > 0:
        _write(options, session, settings, stats)
    if error:
        return _fail(FAILED, f"rendering failed: {error}")
    if stop():
        what = f"{options.output} has {stats['samples']} samples"
        what = what if stats["samples"] else "nothing was written"
        return _fail(INTERRUPTED, f"interrupted; {what}")
    return OK


def _render(
    session: RenderSession, settings: RenderSettings, quiet: bool, stop: Callable[[], bool]
) -> Error | MemoryError | None:
    """Renders to the end, or until `stop`. What ended it too early; its whole passes are kept."""
    bar = None if quiet else ProgressBar(sys.stderr, settings.seconds)
    session.start()
    while not session.wait(POLL_SECONDS):
        if stop():
            session.cancel()
        if bar:
            bar.show(session.progress())
    if bar:
        bar.close()
    try:
        session.finish()
    except (Error, MemoryError) as error:
        return error
    return None


def _write(
    options: argparse.Namespace,
    session: RenderSession,
    settings: RenderSettings,
    stats: dict[str, Any],
) -> None:
    stamp = {
        "janus/version": __version__,
        "janus/integrator": settings.integrator,
        "janus/samples": str(stats["samples"]),
        "janus/seed": str(settings.seed),
        "janus/seconds": f"{stats['seconds']:.3f}",
    }
    layers = {name: session.snapshot(name) for name in session.passes()}
    exr.write_layers(options.output, layers, stamp)
    if options.stats:
        write_text(options.stats, json.dumps(stats, indent=2) + "\n")
    if not options.quiet:
        setup = stats["load_seconds"] + stats["commit_seconds"]
        print(
            f"{options.output}  ({stats['samples']} samples in {stats['seconds']:.1f} s, "
            f"set-up {setup:.1f} s)"
        )


def _changed(settings: dict[str, Any], options: argparse.Namespace) -> dict[str, Any]:
    """The captured settings with what the options say instead."""
    for name in ("samples", "seconds", "integrator", "max_bounces", "threads", "seed"):
        if getattr(options, name) is not None:
            settings[name] = getattr(options, name)
    if options.samples is not None and options.seconds is None:
        settings["seconds"] = 0.0
    if options.seconds and options.samples is None:
        settings["samples"] = FOREVER
    named = dict(settings["expressions"]) | dict(options.passes)
    settings["expressions"] = list(named.items())
    if options.filter:
        settings["filter"] = options.filter.upper().replace("-", "_")
    if options.resolution:
        _resize(settings, *options.resolution)
    return settings


def _resize(settings: dict[str, Any], width: int, height: int) -> None:
    """The camera's window is part of the scene, so only the number of pixels can change."""
    old_width, old_height = settings["width"], settings["height"]
    x, y = width / old_width, height / old_height
    if abs(old_height * x - height) > 1.0 and abs(old_width * y - width) > 1.0:
        raise _UsageError(
            f"--resolution {width}x{height} has another shape than the scene's "
            f"{old_width}x{old_height}"
        )
    settings["width"], settings["height"] = width, height
    if settings["crop"] is not None:
        x0, y0, x1, y1 = settings["crop"]
        x0, y0 = round(x0 * x), round(y0 * y)
        settings["crop"] = (x0, y0, max(round(x1 * x), x0 + 1), max(round(y1 * y), y0 + 1))


def describe(found: Diagnostic) -> str:
    """One line: `warning: material 'Water', node 'Noise': not supported`."""
    named = (("object", found.object), ("material", found.material), ("node", found.node))
    where = ", ".join(f"{kind} '{name}'" for kind, name in named if name)
    return f"{found.severity.lower()}: {where + ': ' if where else ''}{found.message}"


def _check_outputs(options: argparse.Namespace) -> None:
    """Refuses, before hours of rendering, what could not be written after them."""
    exr.require()
    for path in filter(None, (options.output, options.stats)):
        folder = os.path.dirname(path) or "."
        if not os.path.isdir(folder):
            raise Error(f"cannot write {path}: there is no folder {folder}")
        if os.path.isdir(path):
            raise Error(f"cannot write {path}: it is a folder")
        if not os.access(folder, os.W_OK):
            raise Error(f"cannot write {path}: the folder is not writable")


@contextlib.contextmanager
def _interruptible() -> Iterator[Callable[[], bool]]:
    """Inside, the first Ctrl-C only makes the function that it gives return True."""
    interrupted: list[bool] = []

    def on_interrupt(*_: object) -> None:
        interrupted.append(True)
        signal.signal(signal.SIGINT, signal.default_int_handler)

    previous = signal.getsignal(signal.SIGINT)
    if previous == signal.SIG_IGN:  # as nohup and background jobs want it
        yield lambda: False
        return
    signal.signal(signal.SIGINT, on_interrupt)
    try:
        yield lambda: bool(interrupted)
    finally:
        signal.signal(signal.SIGINT, previous)


def _number(kind: type, lowest: float, highest: float = float("inf")) -> Callable[[str], Any]:
    def convert(text: str) -> Any:
        value = kind(text)
        if not lowest <= value <= highest or value == float("inf"):
            raise argparse.ArgumentTypeError(f"{text} is not from {lowest} to {highest}")
        return value

    convert.__name__ = kind.__name__  # for argparse's message
    return convert


def _resolution(text: str) -> tuple[int, int]:
    match = re.fullmatch(r"(\d+)[x×](\d+)", text)
    if not match or not all(0 < int(side) <= 65536 for side in match.groups()):
        raise argparse.ArgumentTypeError(f"'{text}' is not WxH, such as 640x360")
    return int(match[1]), int(match[2])


def _named_expression(text: str) -> tuple[str, str]:
    name, equals, expression = text.partition("=")
    if not equals or not name or "." in name:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=EXPRESSION, such as Caustics=LS+DE")
    if problem := check_expression(expression):
        raise argparse.ArgumentTypeError(f"{text}: {problem}")
    return name, expression


def _exr_name(text: str) -> str:
    if not text.lower().endswith(".exr"):
        raise argparse.ArgumentTypeError(f"'{text}' does not end in .exr")
    return text


def _fail(code: int, message: object) -> int:
    print(f"janus_core: {message}", file=sys.stderr)
    return code
