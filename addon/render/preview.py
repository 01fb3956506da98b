# SPDX-License-Identifier: GPL-3.0-or-later
"""Previews of materials, worlds and lights: small pictures of scenes that Blender makes for them.

Blender asks for them in a job of its own and gives up one as soon as the next edit comes.
"""

from .. import bridge
from ..report import DiagnosticsLog, RenderCancelled
from ..sync import sync_scene
from ..sync.settings import frame, light_settings
from .passes import LayerResult
from .progress import Rhythm

SAMPLES = 32
POLL_SECONDS = 0.02


def render_preview(engine, depsgraph) -> None:
    """Renders the preview scene. Findings go nowhere: the render of the real scene repeats them.

    Raises what makes a render impossible; Blender has got a picture then, too.
    """
    result = LayerResult(engine, frame(depsgraph))
    try:
        _render(engine, depsgraph, result)
    except RenderCancelled:
        pass
    finally:
        result.end()


def _render(engine, depsgraph, result) -> None:
    core = bridge.core()
    builder = core.SceneBuilder()
    sync_scene(builder, depsgraph, DiagnosticsLog(), engine.test_break)
    try:
        scene = builder.commit(poll=engine.test_break)
    except core.Cancelled:
        raise RenderCancelled from None
    size = frame(depsgraph)
    settings = light_settings(depsgraph.scene_eval)
    settings |= {"width": size.width, "height": size.height, "samples": SAMPLES}
    session = core.RenderSession(scene, core.RenderSettings(**settings))
    session.start()
    rhythm = Rhythm()
    while not session.wait(POLL_SECONDS):
        if engine.test_break():
            session.cancel()
        elif rhythm.due():
            result.push({"Combined": session.snapshot()})
            rhythm.shown(0.0)
    session.finish()
    result.push({"Combined": session.snapshot()})
