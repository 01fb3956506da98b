# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's callbacks and the one place where errors end."""

import traceback

import bpy
from bpy.app.handlers import persistent

from . import bridge, report
from .render import final, passes, preview, viewport_draw
from .render.persistent import PersistentData
from .render.viewport import Viewport
from .sync.cache import forget_addresses
from .sync.settings import view_denoising, view_settings
from .sync.view import read_view


class JanusRenderEngine(bpy.types.RenderEngine):
    """Bidirectional path tracing"""

    bl_idname = "JANUS"
    bl_label = "Janus"
    bl_use_preview = True
    bl_use_postprocess = True
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False  # True, the default, hides Cycles' nodes in the editor
    bl_use_spherical_stereo = False

    # Blender versions differ in what they pass; a TypeError here renders black without an error.
    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self._persistent = PersistentData()
        self._viewport = None  # made when one is to be drawn
        self._problem = ""  # of the last sync for it
        self._last_trace = ""

    def update_render_passes(self, scene=None, renderlayer=None):
        passes.register_passes(self, scene, renderlayer)

    def render(self, depsgraph):
        if self.is_preview:
            self._try(lambda: preview.render_preview(self, depsgraph))
            return
        log = report.DiagnosticsLog()
        try:
            final.render_layer(self, depsgraph, log, self._persistent)
        except (report.RenderRefused, bridge.CoreUnavailable) as error:
            log.error(str(error))
        except KeyboardInterrupt:  # in the bpy module, where Ctrl-C is Python's
            log.error("Stopped by Ctrl-C")
        except Exception as error:  # everything else is ours to fix: show where it happened
            traceback.print_exc()
            log.error(f"{type(error).__name__}: {error}")
        scene = depsgraph.scene
        layers = [layer.name for layer in scene.view_layers]
        report.keep(scene.name_full, depsgraph.view_layer.name, layers, log)
        log.flush(self)

    # --- Viewports. What goes wrong is said over the picture, which stays. ---

    def view_update(self, context, depsgraph):
        self._problem = self._try(lambda: self._sync_viewport(context.space_data, depsgraph))

    def view_draw(self, context, depsgraph):
        problem = self._try(lambda: self._draw_viewport(context, depsgraph)) or self._problem
        if problem:
            self.update_stats("", problem)

    def _sync_viewport(self, space, depsgraph) -> None:
        if self._viewport is None:
            self._viewport = Viewport(bridge.core())
            self._screen = viewport_draw.PictureOnScreen()
            self._waker = viewport_draw.Waker(self)
        self._part = local_part(space)
        self._viewport.sync(depsgraph, in_part(space) if any(self._part) else None)
        scene = depsgraph.scene
        layers = [layer.name for layer in scene.view_layers]
        name = depsgraph.view_layer.name
        report.keep_of_viewport(scene.name_full, name, layers, self._viewport.log)

    def _draw_viewport(self, context, depsgraph) -> None:
        viewport, space = self._viewport, context.space_data
        if viewport is None:
            return
        if self._part != local_part(space):
            self.tag_update()
        try:
            view = read_view(context.region, context.region_data, space, depsgraph)
            # Of the original scene: its evaluated copy does not follow each property.
            settings = view_settings(depsgraph.scene)
            viewport.look(view, settings, view_denoising(depsgraph.scene))
            if final.running:
                viewport.pause()
                self.update_stats("", "Waiting for the render")
                self._waker.wake(viewport_draw.PAUSE_SECONDS)
                return
            viewport.advance()
            self.update_stats("", viewport.status)
            if viewport.busy:
                self._waker.wake()
        finally:
            if viewport.picture is not None:
                self._screen.draw(viewport.picture)

    def _try(self, work) -> str:
        """Does the work; what went wrong, for the viewport's line of text."""
        try:
            work()
        except (report.RenderRefused, bridge.CoreUnavailable) as error:
            return str(error)
        except Exception as error:  # the core's complaint about the scene, or ours to fix
            text = "".join(traceback.format_exception(error))
            if text != self._last_trace:  # not at every redraw
                print(text)
            self._last_trace = text
            return f"{type(error).__name__}: {error}"
        return ""


def local_part(space) -> tuple[bool, bool]:
    """What a viewport may show less than the others: local view, local collections."""
    return space.local_view is not None, space.use_local_collections


def in_part(space):
    return lambda obj: obj.visible_in_viewport_get(space)


@persistent
def _on_undo(*_):
    forget_addresses()


@persistent
def _on_render(*_):
    """Blender does not hear of all that scripts set of what add-ons have added. With Persistent
    Data its copy of the scene is not made anew for each render."""
    if not bpy.app.background:  # another thread may be looking at it, and it is users who edit
        return
    for scene in bpy.data.scenes:
        if scene.render.engine == JanusRenderEngine.bl_idname and scene.render.use_persistent_data:
            scene.update_tag()


HANDLERS = (
    (bpy.app.handlers.undo_post, _on_undo),
    (bpy.app.handlers.redo_post, _on_undo),
    (bpy.app.handlers.render_pre, _on_render),
)


def register():
    bpy.utils.register_class(JanusRenderEngine)
    for handlers, function in HANDLERS:
        handlers.append(function)


def unregister():
    for handlers, function in HANDLERS:
        handlers.remove(function)
    bpy.utils.unregister_class(JanusRenderEngine)
