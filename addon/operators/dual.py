# SPDX-License-Identifier: GPL-3.0-or-later
"""Dual photography: captures the light transport of a projector, relights, and shows the dual."""

import os

import bpy
from bpy.props import FloatProperty, StringProperty

from .. import bridge
from ..properties.light import CaptureSettings
from ..render import transport
from ..report import RenderRefused
from ..sync.slide import read_slide, unfit

ENGINE = "JANUS"
POLL_SECONDS = 0.2


def find_light(context, name: str):
    """The light object of that name, or the active one. Raises RenderRefused if there is none."""
    obj = context.scene.objects.get(name) if name else context.object
    if name and obj is None:
        raise RenderRefused(f"There is no object '{name}' in the scene")
    if obj is None or obj.type != "LIGHT":
        raise RenderRefused(f"'{obj.name}' is no light" if obj else "No light is selected")
    return obj


def matrix_path(light, path: str = "") -> str:
    """Where the matrix of the light data is, or is to be."""
    found = bpy.path.abspath(path or light.janus.matrix_path)
    name = bpy.path.clean_name(light.name)
    return found or os.path.join(bpy.app.tempdir, f"{name}_transport.npz")


def label(light, kind: str) -> str:
    """The name of the image of that kind."""
    return f"{light.name[:50]} {kind}"


class _Named:
    """Operators of a light object."""

    light: StringProperty(
        name="Light",
        description="Name of the light object (empty: the active one)",
        options={"SKIP_SAVE"},
    )
    filepath: StringProperty(
        name="Matrix",
        description="The matrix's file, .npz (empty: that of the light's settings)",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )

    def execute(self, context):
        try:
            return self.run(context)
        except (RenderRefused, bridge.CoreUnavailable, OSError, RuntimeError, ValueError) as error:
            self.report({"ERROR"}, str(error))
        except Exception as error:  # of the core, which is not imported here
            if type(error).__module__.partition(".")[0] != "janus_core":
                raise
            self.report({"ERROR"}, str(error))
        return {"CANCELLED"}


class JANUS_OT_capture_transport(_Named, CaptureSettings, bpy.types.Operator):
    """Capture how light gets from each pixel of this projector to each pixel of the camera"""

    bl_idname = "janus.capture_transport"
    bl_label = "Capture Light Transport"

    @classmethod
    def poll(cls, context):
        if context.scene.render.engine != ENGINE:
            cls.poll_message_set("Only Janus captures light transport")
            return False
        if context.scene.camera is None:
            cls.poll_message_set("The scene has no active camera")
            return False
        return not bpy.app.is_job_running("RENDER")

    def run(self, context):
        scene = context.scene
        obj = find_light(context, self.light)
        settings = obj.data.janus
        chosen = {
            name: getattr(self if self.properties.is_property_set(name) else settings, name)
            for name in CaptureSettings.__annotations__
        }
        _, reason = unfit(obj.data)
        if reason:
            raise RenderRefused(f"'{obj.name}': {reason}")
        path = matrix_path(obj.data, self.filepath)
        request = transport.Request(
            obj.name,
            chosen["projector_width"],
            chosen["projector_height"],
            chosen["camera_size"],
            chosen["samples"],
            chosen["memory"],
        )
        done = _Done(scene.name, obj.data.name, path)
        names = {"scene": scene.name, "layer": context.view_layer.name}
        transport.ask(scene, request)
        if bpy.app.background:
            try:
                bpy.ops.render.render(**names)
            finally:
                done()
            if done.problem:
                raise RenderRefused(done.problem)
        else:
            bpy.ops.render.render("INVOKE_DEFAULT", **names)
            bpy.app.timers.register(done, first_interval=POLL_SECONDS)
        return {"FINISHED"}


class _Done:
    """Takes what a render has captured, as a timer that waits for its end."""

    def __init__(self, scene: str, light: str, path: str):
        self._scene, self._light, self._path = scene, light, path
        self.problem = ""

    def __call__(self) -> float | None:
        if not bpy.app.background and bpy.app.is_job_running("RENDER"):
            return POLL_SECONDS
        scene = bpy.data.scenes.get(self._scene)
        matrix = transport.withdraw(scene) if scene else None
        light = bpy.data.lights.get(self._light)
        if matrix is None or light is None:
            return None  # the render has said why
        try:
            matrix.save(self._path)
        except Exception as error:
            self.problem = str(error)
            if not bpy.app.background:
                _complain(self.problem)
            return None
        light.janus.matrix_path = self._path
        image = transport.show(label(light, "Primal"), matrix.relight())
        transport.show(label(light, "Dual"), matrix.dual())
        show_in_editor(image)
        return None


class JANUS_OT_relight(_Named, bpy.types.Operator):
    """Show the scene in the light of this projector with a slide, without rendering"""

    bl_idname = "janus.relight"
    bl_label = "Relight"

    slide: StringProperty(
        name="Slide",
        description="Name of the image that the projector shows (empty: that of the light's "
        "settings, or none: the light as it was captured, with its nodes)",
        options={"SKIP_SAVE"},
    )
    exposure: FloatProperty(
        name="Exposure",
        description="Stops by which the projector is brighter",
        soft_min=-10.0,
        soft_max=10.0,
        default=0.0,
    )

    def run(self, context):
        light = find_light(context, self.light).data
        matrix = load(light, self.filepath)
        chosen = light.janus.slide
        slide = self.slide or (chosen.name if chosen else "")
        watts = matrix.own_watts
        if slide:
            watts = matrix.shown(read_slide(slide, self._warn))
        image = transport.show(label(light, "Primal"), matrix.relight(watts * 2.0**self.exposure))
        show_in_editor(image)
        return {"FINISHED"}

    def _warn(self, message: str) -> None:
        self.report({"WARNING"}, f"The slide: {message}")


class JANUS_OT_show_dual(_Named, bpy.types.Operator):
    """Show what this projector would see if it were the camera, and the camera the light"""

    bl_idname = "janus.show_dual"
    bl_label = "Dual Picture"

    def run(self, context):
        light = find_light(context, self.light).data
        image = transport.show(label(light, "Dual"), load(light, self.filepath).dual())
        show_in_editor(image)
        return {"FINISHED"}


def load(light, path: str):
    """The matrix of the light data. Raises what TransportMatrix.load() does."""
    found = matrix_path(light, path)
    if not os.path.exists(found):
        raise RenderRefused(f"There is no file {found}: capture the light transport first")
    return bridge.dual().TransportMatrix.load(found)


def show_in_editor(image) -> None:
    """In the first Image Editor, if there is one."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.ui_type == "IMAGE_EDITOR":
                area.spaces.active.image = image
                return


def _complain(text: str) -> None:
    def draw(menu, _context):
        menu.layout.label(text=text)

    bpy.context.window_manager.popup_menu(draw, title="Light Transport", icon="ERROR")


CLASSES = (JANUS_OT_capture_transport, JANUS_OT_relight, JANUS_OT_show_dual)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
