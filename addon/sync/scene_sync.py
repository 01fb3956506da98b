# SPDX-License-Identifier: GPL-3.0-or-later
"""One way from a depsgraph to a scene, for F12, viewports, captures and tests alike."""

from .cache import Changes, SceneCache
from .camera import sync_camera
from .image import ImageSync
from .instance import InstanceSync
from .material import MaterialSync
from .poll import Poll
from .visibility import check_scene
from .world import sync_world


def sync_scene(builder, depsgraph, log, test_break=lambda: False) -> None:
    """Sends the evaluated scene to `builder` (a SceneBuilder or anything with its methods).

    Writes what cannot be rendered to `log`. Raises RenderRefused for what makes the whole render
    pointless and RenderCancelled when test_break() says so.
    """
    poll = Poll(test_break)
    poll()
    sync_camera(builder, depsgraph, log)
    sync_objects(builder, depsgraph, SceneCache(builder), log, poll=poll)


def sync_objects(
    builder,
    depsgraph,
    cache: SceneCache,
    log,
    changes: Changes | None = None,
    shown=None,
    poll=lambda: None,
) -> None:
    """Sends all but the camera. What `cache` knows from before and is not among the changes stays
    where it is. `shown`: see InstanceSync.run().
    """
    cache.begin(changes)
    images = ImageSync(builder, depsgraph, cache, log)
    sync_world(builder, depsgraph, images, log)
    check_scene(depsgraph, log)
    materials = MaterialSync(builder, depsgraph, images, cache, log)
    InstanceSync(builder, materials, images, cache, log, poll).run(depsgraph, shown)
    cache.end()
