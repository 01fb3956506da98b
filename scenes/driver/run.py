# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders inside this process, which is `blender -b` or has bpy as a module."""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import signal
import sys
import time

import bpy

from scenes.driver import addon as addons
from scenes.driver import passes, picture, setup
from scenes.driver.progress import Progress
from scenes.driver.setup import Problem, one_line

OK, FAILED, INTERRUPTED = 0, 1, 130


def run(options: argparse.Namespace) -> int:
    """The exit code. Never raises, and leaves no engine registered."""
    addon = None
    try:
        with quiet():
            if addons.IS_MODULE:
                bpy.ops.wm.read_factory_settings(use_empty=True)
            if options.engine == "janus":
                addon = addons.load()
            scene = setup.open_scene(options)
            setup.apply(scene, options)
            if addon:
                passes.prepare(scene, options, addon)
        if options.save:
            with quiet():
                bpy.ops.wm.save_as_mainfile(
                    filepath=str(options.save), copy=True, check_existing=False
                )
        return _render(scene, options, addon)
    except Problem as error:
        return _fail(str(error))
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:
        return _fail(one_line(error))
    finally:
        if addon:
            addon.unload()


def leave(code: int) -> None:
    """Ends the process without the interpreter's and Blender's exit, which can hang or crash."""
    sys.stdout.flush()
    sys.stderr.flush()
    temporary = bpy.app.tempdir
    if os.path.basename(os.path.normpath(temporary)).startswith("blender_"):
        shutil.rmtree(temporary, ignore_errors=True)
    os._exit(code)


def _render(scene: bpy.types.Scene, options: argparse.Namespace, addon) -> int:
    if scene.camera is None:
        raise Problem("the scene has no camera")
    interrupted: list[bool] = []
    progress = Progress(options.engine, options.samples or 0, options.seconds or 0.0)
    watch = _Watch(progress)
    begin = time.perf_counter()
    failure = None
    with quiet(), watch, _interruptible(addon, interrupted):
        try:
            bpy.ops.render.render(write_still=False, scene=scene.name)
        except RuntimeError as error:
            failure = one_line(error)
    wall = time.perf_counter() - begin
    progress.close()

    stats = _stats(scene, options, addon, watch, wall)
    for line in stats["diagnostics"]:
        if not line.startswith("info") and not (failure and failure in line):
            print(f"  {line}", file=sys.stderr)
    interrupted = interrupted or stats.get("cancelled")
    if failure or (not stats["samples"] and interrupted):
        _write_stats(options, stats)
    if failure:
        raise Problem(failure)
    if not stats["samples"] and interrupted:
        print("stopped before there was a picture", file=sys.stderr)
        return INTERRUPTED
    with quiet():
        try:
            picture.save(scene, options.output)
            more = passes.save(scene, options, addon) if addon else []
        except (RuntimeError, OSError) as error:
            raise Problem(f"cannot write {options.output}: {one_line(error)}") from error
    _write_stats(options, stats)  # what is lost if this fails is not the picture
    print(
        f"{options.output}  ({stats['samples']} samples in {stats['seconds']:.1f} s, "
        f"set-up {stats['setup_seconds']:.1f} s)"
    )
    for path in more:
        print(path)
    return INTERRUPTED if interrupted else OK


def _write_stats(options: argparse.Namespace, stats: dict) -> None:
    if not options.stats:
        return
    try:
        options.stats.parent.mkdir(parents=True, exist_ok=True)
        options.stats.write_text(json.dumps(stats, indent=2) + "\n", encoding="utf-8")
    except OSError as error:
        raise Problem(f"cannot write {options.stats}: {error.strerror}") from error


class _Watch:
    """Listens to the status line of the render, for the progress bar and for Cycles' numbers."""

    def __init__(self, progress: Progress):
        self._progress = progress
        self.first_sample: float | None = None

    def __enter__(self):
        self._begin = time.perf_counter()
        bpy.app.handlers.render_stats.append(self._listen)
        return self

    def __exit__(self, *_):
        bpy.app.handlers.render_stats.remove(self._listen)

    @property
    def samples(self) -> int:
        return self._progress.samples

    def _listen(self, text, *_) -> None:
        self._progress.feed(str(text))
        if self.first_sample is None and "Sample " in str(text):
            self.first_sample = time.perf_counter() - self._begin


def _stats(scene, options: argparse.Namespace, addon, watch: _Watch, wall: float) -> dict:
    """What --stats writes; documented in scenes/README.md."""
    if addon:
        own = dict(addon.part("render.final").last_render)
        diagnostics = [
            f"{entry.severity.lower()}: {addon.part('report').counted(entry, count)}"
            for entry, count in addon.part("report").kept(scene.name_full)
        ]
        version = addon.version()
    else:
        setup_seconds = watch.first_sample or 0.0
        own = {"samples": watch.samples, "seconds": wall - setup_seconds}
        diagnostics, version = [], bpy.app.version_string
    seconds = own.pop("seconds", 0.0)
    return {
        "engine": options.engine,
        "version": version,
        "blender": bpy.app.version_string,
        "scene": str(options.blend or options.scene),
        "frame": scene.frame_current,
        "samples": own.pop("samples", 0),
        "seconds": seconds,
        "setup_seconds": max(wall - seconds, 0.0),
        **own,
        "diagnostics": diagnostics,
    }


@contextlib.contextmanager
def _interruptible(addon, interrupted: list[bool]):
    """Ctrl-C ends the render of Janus with the passes so far; Cycles in bpy just dies of it.

    `blender -b` has a handler of its own, which reaches the engine through test_break().
    """
    if not addons.IS_MODULE:
        yield
        return

    def stop(*_):
        interrupted.append(True)

    previous = signal.signal(signal.SIGINT, stop if addon else signal.SIG_DFL)
    try:
        with addon.stop_when(lambda: bool(interrupted)) if addon else contextlib.nullcontext():
            yield
    finally:
        signal.signal(signal.SIGINT, previous)


@contextlib.contextmanager
def quiet():
    """Sends what Blender prints to nowhere; our own words come after, or go to stderr."""
    sys.stdout.flush()
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def _fail(message: str) -> int:
    print(f"./dev render: {message}", file=sys.stderr)
    return FAILED
