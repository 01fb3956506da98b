# SPDX-License-Identifier: GPL-3.0-or-later
"""One way from a depsgraph to a scene, for F12, viewports, captures and tests alike."""

from . import passes
from .cache import Changes, SceneCache
from .camera import sync_camera
from .image import ImageSync
from .instance import InstanceSync
from .kept import KeptScene
from .material import MaterialSync
from .motion import MotionSync, shutter
from .poll import Poll
from .visibility import check_scene
from .world import sync_world


def sync_scene(
    builder,
    depsgraph,
    log,
    test_break=lambda: False,
    set_frame=None,
    kept: KeptScene | None = None,
) -> None:
    """Sends the evaluated scene to `builder` (a SceneBuilder or anything with its methods).

    set_frame(time) evaluates it anew at a time in frames; without, nothing moves. What `kept` has
    is not sent again; `builder` is its own then. Writes what cannot be rendered to `log`. Raises
    RenderRefused for what makes the whole render pointless and RenderCancelled when test_break()
    says so.
    """
    poll = Poll(test_break)
    poll()
    cache = kept.cache if kept else SceneCache(builder)
    scene = depsgraph.scene_eval
    aovs = {aov.name: aov.type for aov in passes.aovs(depsgraph.view_layer_eval)}
    open_at = shutter(scene, depsgraph.view_layer_eval) if set_frame else None
    if open_at is None:
        sync_camera(builder, depsgraph, log)
        changes = kept.take() if kept else None
        sync_objects(builder, depsgraph, cache, log, changes, poll=poll, aovs=aovs)
    else:

        def look_at(time: float) -> None:
            set_frame(time)
            if kept:
                kept.note(depsgraph)

        now = scene.frame_current + scene.frame_subframe
        motion = MotionSync(open_at, log, depsgraph.mode == "VIEWPORT")
        try:
            if open_at.center != now:
                look_at(open_at.center)
            window = sync_camera(builder, depsgraph, log)
            changes = kept.take() if kept else None
            sync_objects(
                builder, depsgraph, cache, log, changes, poll=poll, motion=motion, aovs=aovs
            )
            motion.run(builder, depsgraph, window, look_at, poll)
        finally:
            look_at(now)
        # What moved stays so in the core until it is set again: instances and the camera always
        # are, and these meshes have to be.
        cache.outdate(motion.deformed)
    if kept:
        kept.end()


def sync_objects(
    builder,
    depsgraph,
    cache: SceneCache,
    log,
    changes: Changes | None = None,
    shown=None,
    poll=lambda: None,
    motion: MotionSync | None = None,
    aovs: dict[str, str] | None = None,
) -> None:
    """Sends all but the camera. What `cache` knows from before and is not among the changes stays
    where it is. `shown`: see InstanceSync.run(). `motion` gets to know what can move.
    `aovs`: those that are wanted, see flatten_aovs().
    """
    cache.begin(changes)
    images = ImageSync(builder, depsgraph, cache, log)
    sync_world(builder, depsgraph, images, log, aovs or {})
    check_scene(depsgraph, log)
    materials = MaterialSync(builder, depsgraph, images, cache, log, aovs or {})
    InstanceSync(builder, materials, images, cache, log, poll, motion).run(depsgraph, shown)
    cache.end()
