# SPDX-License-Identifier: GPL-3.0-or-later
"""The F12 render of one view layer: export, build, render, hand over the pixels."""

import contextlib
import math
import time

import bpy
import numpy as np

from .. import bridge
from ..report import RenderCancelled, RenderRefused
from ..sync import cycles_settings, sync_scene
from ..sync.passes import (
    COMBINED,
    SAMPLE_COUNT,
    denoises,
    guides_of,
    requested,
    unsupported,
)
from ..sync.settings import active_views, render_settings
from ..sync.settings import frame as read_frame
from . import denoise, transport
from .partial import save_partial
from .passes import LayerResult
from .persistent import PersistentData
from .progress import POLL_SECONDS, run_to_end

# Passes that tell detail from noise, where the core has them: argument of denoise() -> key.
GUIDES = {"albedo": "Denoising Albedo", "normal": "Denoising Normal"}

# Statistics of the last view layer that was rendered in this process, for scripts that drive
# Blender (bpy.ops.render.render returns nothing): session.stats() of the core plus sync_seconds,
# commit_seconds, denoise_seconds (0 if not asked for), counts (of the scene), cancelled,
# view_layer, frame. Empty if it failed.
last_render: dict = {}

# How many renders are running. Viewports leave the machine to them.
running = 0

# Blender shows the passes of a render to no script. Those of the scenes named here are kept: name
# of a view layer -> name of a pass -> pixels. Whoever asked for them clears both.
keep_passes_of: set[str] = set()
kept_passes: dict[str, dict[str, np.ndarray]] = {}


def render_layer(engine, depsgraph, log, persistent: PersistentData) -> None:
    """Renders the depsgraph's view layer into Blender's result.

    Findings go to `log`, `persistent` is the engine's. Whatever is raised means that the render
    failed; Blender has got a full-size result then, too, and pixels that existed are saved in the
    partial file.
    """
    last_render.clear()
    kept_passes.pop(depsgraph.view_layer_eval.name, None)
    frame = read_frame(depsgraph, engine.is_animation)
    result = LayerResult(engine, frame)
    global running
    running += 1
    try:
        persistent.begin(depsgraph)
        last_render.update(_render(engine, depsgraph, frame, result, log, persistent))
    except RenderCancelled:
        log.info("Stopped by the user before the first sample")
    finally:
        running -= 1
        result.end()


def _render(engine, depsgraph, frame, result, log, persistent) -> dict:
    core = bridge.core()
    keywords = render_settings(depsgraph)
    captures = transport.requests.get(depsgraph.scene.name_full)
    if captures:
        keywords = captures.settings(keywords)
    _check_view(engine, depsgraph.scene_eval, log)
    with _user_errors(core):
        settings = core.RenderSettings(**keywords)
    scene, stats = _build(core, engine, depsgraph, frame, settings, log, persistent)
    if captures:
        with _user_errors(core):
            return stats | transport.capture(captures, core, engine, scene, settings, frame, result)
    with _user_errors(core):
        session = core.RenderSession(scene, settings)
    log.extend(session.diagnostics)
    for problem in unsupported(depsgraph.view_layer_eval):
        log.warning(problem)
    log.flush(engine)
    try:
        cancelled = _run(engine, session, settings, result)
        _hand_over(session, depsgraph, result)
    except (Exception, KeyboardInterrupt):
        _save_what_there_is(session, frame, result, log)
        raise
    started = time.perf_counter()
    denoised = denoises(depsgraph.scene_eval, depsgraph.view_layer_eval) and not cancelled
    if denoised:
        alpha = denoise.alpha_is_noisy(settings.film_transparent, stats["counts"])
        cancelled = _denoise(engine, session, settings, depsgraph, result, log, alpha)
    stats |= session.stats()
    stats |= {
        "denoise_seconds": time.perf_counter() - started if denoised else 0.0,
        "cancelled": cancelled,
        "seed": settings.seed,
        "view_layer": frame.view_layer,
        "frame": frame.number,
    }
    result.stamp(version=core.__version__, samples=stats["samples"], seed=settings.seed)
    for kind in settings.cryptomatte:
        result.stamp_matte(kind, session.manifest(kind), core.cryptomatte_hash)
    log.info(
        f"View layer '{frame.view_layer}': {stats['samples']} samples in {stats['seconds']:.2f} s,"
        f" export {stats['sync_seconds']:.2f} s, build {stats['commit_seconds']:.2f} s"
        + (f", denoising {stats['denoise_seconds']:.2f} s" if denoised else "")
    )
    return stats


def _check_view(engine, scene, log) -> None:
    """The one view of Stereoscopy that is rendered may have another camera, or stand beside it."""
    camera, names = scene.camera, active_views(scene.render)
    if not names or camera is None or camera.type != "CAMERA":
        return
    engine.active_view_set(names[0])
    seen = engine.camera_override
    if (
        (seen is not None and seen.name != camera.name)
        or engine.camera_model_matrix(camera) != camera.matrix_world
        or engine.camera_shift_x(camera) != camera.data.shift_x
    ):
        log.warning(
            f"Stereoscopy is not supported: the view '{names[0]}' shows what this camera sees",
            object=camera.name,
        )


@contextlib.contextmanager
def _user_errors(core):
    """What the core refuses here, a user has typed: it is said to the user, without a traceback."""
    try:
        yield
    except core.SceneError as error:
        raise RenderRefused(str(error)) from error


def _build(core, engine, depsgraph, frame, settings, log, persistent):
    """The immutable scene and the seconds that it took. Raises RenderCancelled."""
    started = time.perf_counter()
    if frame.capture_path:
        persistent.clear()  # all has to be sent to be captured
    else:
        persistent.start(core, depsgraph)
    kept = persistent.kept
    builder = kept.builder if kept else core.SceneBuilder()
    capture = bridge.capturing_builder(builder) if frame.capture_path else None
    engine.update_stats("", "Synchronizing objects")
    sync_scene(
        capture or builder,
        depsgraph,
        log,
        engine.test_break,
        lambda time: engine.frame_set(math.floor(time), subframe=time - math.floor(time)),
        kept,
    )
    if capture:
        capture.save(frame.capture_path, settings)
        log.info(f"Scene description saved as {frame.capture_path}")
    synced = time.perf_counter()
    engine.update_stats("", "Building scene")
    try:
        scene = builder.commit(poll=engine.test_break)
    except core.Cancelled:
        raise RenderCancelled from None
    persistent.built(scene)
    log.extend(scene.diagnostics)
    log.flush(engine)  # warnings are worth most while the render can still be stopped
    return scene, {
        "sync_seconds": synced - started,
        "commit_seconds": time.perf_counter() - synced,
        "counts": dict(scene.counts),
    }


def _run(engine, session, settings, result) -> bool:
    """Renders to the end or until the user stops, and shows the picture on the way."""

    def show():
        result.push({"Combined": session.snapshot("Combined")})

    shown = None if bpy.app.background else show
    return run_to_end(engine, session, settings.seconds, show=shown)


def _hand_over(session, depsgraph, result) -> None:
    """All passes at the end. One by one: together they can be larger than everything else."""
    scene, layer = depsgraph.scene_eval, depsgraph.view_layer_eval
    keep = scene.name_full in keep_passes_of
    kept = kept_passes.setdefault(layer.name, {}) if keep else None
    known = set(session.passes())
    for found in (COMBINED, *requested(scene, layer)):
        if found.key in known:
            pixels = session.snapshot(found.key)
            if found.key == SAMPLE_COUNT:  # as in Cycles, the part of all samples
                pixels /= max(session.progress()["samples"], 1)
            result.fill(found.name, pixels)
            if kept is not None:
                kept[found.name] = pixels
    result.show()


def _denoise(engine, session, settings, depsgraph, result, log, alpha) -> bool:
    """Puts the picture without noise into Combined; `alpha`: that, too. Returns whether the user
    stopped that.

    Blender has the noisy picture already, and keeps it if this is stopped or cannot be done.
    """
    engine.update_stats("", "Denoising")
    wanted = guides_of(depsgraph.scene_eval)
    arguments = {name: session.snapshot(key) for name, key in GUIDES.items() if key in wanted}
    arguments |= {
        "prefilter": cycles_settings.value(depsgraph.scene_eval, "denoising_prefilter"),
        "quality": cycles_settings.value(depsgraph.scene_eval, "denoising_quality"),
        "threads": settings.threads,
        "alpha": alpha,
        "cancel": engine.test_break,
    }
    try:
        pixels = denoise.denoise(session.snapshot(COMBINED.key), **arguments)
    except denoise.DenoiseCancelled:
        log.info("Denoising was stopped by the user: the picture is as it was rendered")
        return True
    except denoise.DenoiseFailed as error:
        log.warning(f"The picture is not denoised: {error}")
        return False
    result.push({COMBINED.name: pixels})
    if kept := kept_passes.get(depsgraph.view_layer_eval.name):
        kept[COMBINED.name] = pixels
    return False


def _save_what_there_is(session, frame, result, log) -> None:
    """After an error: stops the core and keeps the passes that it had finished.

    Nothing here may hide the error that brought us here.
    """
    try:
        session.cancel()
        while not session.wait(POLL_SECONDS):
            pass
        if session.progress()["samples"] == 0:
            return
        pixels = session.snapshot("Combined")
        save_partial(frame.partial_path, pixels)
        log.info(f"What was rendered before the error is saved as {frame.partial_path}")
        result.push({"Combined": pixels})
    except Exception as error:
        log.warning(f"What was rendered before the error could not be saved: {error}")
