# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the strategy pyramid and shows it."""

import os

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty

from ..render import strategies

ENGINE = "JANUS"
POLL_SECONDS = 0.2


class JANUS_OT_render_strategies(bpy.types.Operator):
    """Render what each technique finds, with its weight and alone, and show a contact sheet"""

    bl_idname = "janus.render_strategies"
    bl_label = "Render Strategies"

    length: IntProperty(
        name="Longest Path",
        description="Number of edges of the longest paths that are shown. Memory for two pictures "
        "is needed for each technique, and there are 19 at the length of 5",
        min=1,
        max=12,
        soft_max=8,
        default=5,
    )
    exposure: FloatProperty(
        name="Exposure",
        description="Stops by which the contact sheet is brightened, which it then says: most "
        "techniques of long paths are dark",
        soft_min=-10.0,
        soft_max=10.0,
        default=0.0,
    )
    directory: StringProperty(
        name="Folder",
        description="Where strategies.png and strategies.exr are saved (empty: in Blender's "
        "temporary folder)",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        scene = context.scene
        if scene.render.engine != ENGINE or scene.janus.integrator != "BDPT":
            cls.poll_message_set("Only Janus' integrator Bidirectional has strategies")
            return False
        return not bpy.app.is_job_running("RENDER")

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        scene = context.scene
        folder = bpy.path.abspath(self.directory)
        folder = folder or os.path.join(bpy.app.tempdir, "strategies")
        strategies.ask(scene, self.length)
        if bpy.app.background:
            try:
                bpy.ops.render.render(scene=scene.name)
                show(strategies.save(scene, folder, self.exposure))
            except (OSError, RuntimeError) as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
            finally:
                strategies.withdraw(scene)
        else:
            bpy.ops.render.render("INVOKE_DEFAULT", scene=scene.name)
            wait = _Waiting(scene.name, folder, self.exposure)
            bpy.app.timers.register(wait, first_interval=POLL_SECONDS)
        return {"FINISHED"}


class _Waiting:
    """A timer that waits for the render in the background of Blender's window, then shows it."""

    def __init__(self, scene: str, folder: str, exposure: float):
        self._scene, self._folder, self._exposure = scene, folder, exposure

    def __call__(self) -> float | None:
        if bpy.app.is_job_running("RENDER"):
            return POLL_SECONDS
        scene = bpy.data.scenes.get(self._scene)
        if scene is None:
            return None
        try:
            show(strategies.save(scene, self._folder, self._exposure))
        except (OSError, RuntimeError) as error:
            _complain(str(error))
        finally:
            strategies.withdraw(scene)
        return None


def show(files: list[str]) -> None:
    """Loads the files; Image Editors show as many as there are editors, but at least the first."""
    images = [bpy.data.images.load(path, check_existing=True) for path in files]
    for image in images:
        image.reload()
    editors = _image_editors()
    if images and not editors and not bpy.app.background:
        bpy.ops.wm.window_new()
        area = bpy.context.window_manager.windows[-1].screen.areas[0]
        area.ui_type = "IMAGE_EDITOR"
        editors = [area]
    for area, image in zip(editors, images, strict=False):
        area.spaces.active.image = image


def _image_editors() -> list[bpy.types.Area]:
    windows = bpy.context.window_manager.windows
    areas = (area for window in windows for area in window.screen.areas)
    return [area for area in areas if area.ui_type == "IMAGE_EDITOR"]


def _complain(text: str) -> None:
    def draw(menu, _context):
        menu.layout.label(text=text)

    bpy.context.window_manager.popup_menu(draw, title="Render Strategies", icon="ERROR")


def _draw_in_menu(menu, context):
    if context.scene.render.engine == ENGINE:
        menu.layout.separator()
        menu.layout.operator_context = "INVOKE_DEFAULT"
        menu.layout.operator("janus.render_strategies", icon="RENDER_RESULT")


def register():
    bpy.utils.register_class(JANUS_OT_render_strategies)
    bpy.types.TOPBAR_MT_render.append(_draw_in_menu)


def unregister():
    bpy.types.TOPBAR_MT_render.remove(_draw_in_menu)
    bpy.utils.unregister_class(JANUS_OT_render_strategies)
