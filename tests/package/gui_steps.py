# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs in a Blender with windows (--python gui_steps.py -- FOLDER ZIP): what an artist does.

Writes FOLDER/gui.json; test_gui.py takes the pictures and reads it.

A step waits with `yield seconds`, asks for a picture of the screen with `yield "name"`, and for a
key to be pressed, by hand as it were, with `yield "key Escape"`.
"""

import json
import os
import sys
import time
import traceback
from pathlib import Path

import bpy
from mathutils import Quaternion

folder, archive = map(Path, sys.argv[sys.argv.index("--") + 1 :])
sys.path.insert(0, str(folder))
request = folder / "request.txt"
result: dict = {"events": [], "areas": {}}
LIMIT = 60.0  # seconds that anything may take


def window():
    return bpy.context.window_manager.windows[0]


def areas(kind: str) -> list:
    return [area for area in window().screen.areas if area.type == kind]


def view_3d():
    """The largest 3D viewport."""
    return max(areas("VIEW_3D"), key=lambda area: area.width * area.height)


def box(area) -> list[int]:
    """x, y, width, height on the screen, from the top left."""
    height = window().height
    return [area.x, height - area.y - area.height, area.width, area.height]


def shot(name: str) -> str:
    result["areas"][name] = box(view_3d())
    return name


def heard(event: str) -> int:
    return result["events"].count(event)


def until(true, what: str):
    end = time.monotonic() + LIMIT
    while not true():
        if time.monotonic() > end:
            raise TimeoutError(what)
        yield 0.1


def listen() -> None:
    """Notes what Blender says of renders, also after another file was loaded."""
    for name in ("render_complete", "render_cancel", "load_post"):

        def note(*_, name=name):
            result["events"].append(name)

        getattr(bpy.app.handlers, name).append(bpy.app.handlers.persistent(note))


def install():
    bpy.ops.extensions.package_install_files(
        filepath=str(archive), repo="user_default", enable_on_install=True
    )
    result["operators"] = hasattr(bpy.ops.janus, "render_strategies")
    yield 0.5


def build_scene():
    from scenes import glass_box

    glass_box.build(bpy.context.scene)
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = 160
    scene.render.engine = "JANUS"
    scene.render.preview_pixel_size = "4"  # there may be no graphics card
    scene.janus.preview_samples = 64
    for area in areas("PROPERTIES"):
        area.spaces[0].context = "RENDER"
    yield 0.5


def rendered_viewport():
    space = view_3d().spaces[0]
    space.overlay.show_overlays = False
    yield shot("solid")
    space.region_3d.view_perspective = "CAMERA"
    space.shading.type = "RENDERED"
    yield 6.0
    yield shot("rendered")


def orbit():
    region = view_3d().spaces[0].region_3d
    region.view_perspective = "PERSP"
    yield 1.0
    region.view_rotation.rotate(Quaternion((0.98, 0.0, 0.0, 0.2)))
    yield 5.0
    yield shot("orbit")
    region.view_perspective = "CAMERA"
    yield 5.0
    yield shot("back")


def edit_and_undo():
    bpy.ops.ed.undo_push(message="before")
    bpy.data.objects["Mirror"].location.z += 0.8
    bpy.ops.ed.undo_push(message="moved")
    yield 5.0
    yield shot("moved")
    red = bpy.data.materials["White"].node_tree
    color = next(node for node in red.nodes if node.type == "BSDF_DIFFUSE").inputs["Color"]
    color.default_value = (0.8, 0.02, 0.02, 1.0)
    bpy.ops.ed.undo_push(message="red")
    yield 5.0
    yield shot("red")
    with bpy.context.temp_override(window=window(), area=view_3d()):
        bpy.ops.ed.undo()
        bpy.ops.ed.undo()
    yield 5.0
    yield shot("undone")


def start_render():
    with bpy.context.temp_override(window=window(), scene=window().scene):
        bpy.ops.render.render("INVOKE_DEFAULT")


def render_and_escape():
    bpy.context.scene.janus.samples = 100000
    start_render()
    yield 4.0
    yield "f12_at_work"
    began = time.monotonic()
    yield "key Escape"  # a real one: Blender looks for it where events come in
    yield from until(lambda: heard("render_cancel"), "ESC did not end the render")
    result["escaped_after"] = time.monotonic() - began


def render_to_the_end():
    scene = bpy.context.scene
    scene.janus.samples = 16
    scene.janus.use_denoising = True
    start_render()
    yield from until(lambda: heard("render_complete"), "the render did not end")
    yield 1.0
    yield "f12"
    bpy.data.images["Render Result"].save_render(str(folder / "f12.png"))
    scene.janus.use_denoising = False


def report_panel():
    """A volume is not there yet: the report says so, with the material."""
    tree = bpy.data.materials["Blue"].node_tree
    volume = tree.nodes.new("ShaderNodeVolumePrincipled")
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(volume.outputs[0], output.inputs["Volume"])
    yield 5.0
    from bl_ext.user_default.janus import report

    kept = report.kept(bpy.context.scene.name_full)
    result["report"] = [[entry.material, entry.message] for entry, _ in kept]
    yield "report"
    tree.nodes.remove(volume)


def dual_photography():
    """A lamp that can project has a panel for it."""
    lamp = next(thing for thing in bpy.data.objects if thing.type == "LIGHT")
    spread, lamp.data.spread = lamp.data.spread, 0.0
    lamp.select_set(True)
    bpy.context.view_layer.objects.active = lamp
    yield 1.0  # the editor sees what is active when it is drawn
    (area,) = areas("PROPERTIES")
    area.spaces[0].context = "DATA"
    yield 1.0
    yield "dual_photography"
    area.spaces[0].context = "RENDER"
    lamp.data.spread = spread


def second_viewport():
    area = view_3d()
    before = len(areas("VIEW_3D"))
    with bpy.context.temp_override(window=window(), area=area, region=area.regions[-1]):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    yield 0.5
    result["viewports"] = [before, len(areas("VIEW_3D"))]
    for number, other in enumerate(areas("VIEW_3D")):
        other.spaces[0].shading.type = "RENDERED"
        other.spaces[0].region_3d.view_perspective = "CAMERA" if number else "PERSP"
    yield 6.0
    yield "two_viewports"


def load_while_rendering():
    path = str(folder / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.context.scene.janus.samples = 100000
    start_render()
    yield 3.0
    bpy.ops.wm.open_mainfile(filepath=path)
    yield from until(lambda: heard("load_post"), "the file was not loaded")
    yield 6.0
    result["engine_after_load"] = bpy.context.scene.render.engine
    yield shot("loaded")


STEPS = (
    *(install, build_scene, rendered_viewport, orbit, edit_and_undo, render_and_escape),
    *(render_to_the_end, report_panel, dual_photography, second_viewport, load_while_rendering),
)


def story():
    for step in STEPS:
        result["step"] = step.__name__
        yield from step()
    result["step"] = "done"


_story = story()


def go_on():
    if request.exists():  # until it has been granted
        return 0.1
    try:
        wanted = next(_story)
    except StopIteration:
        wanted = None
    except Exception:
        result["error"] = traceback.format_exc()
        wanted = None
    if isinstance(wanted, float):
        return wanted
    if isinstance(wanted, str):
        request.write_text(wanted)
        return 0.1
    (folder / "gui.json").write_text(json.dumps(result, indent=1))
    if "error" in result:
        os._exit(1)
    bpy.ops.wm.save_mainfile()  # else Blender asks whether to
    bpy.ops.wm.quit_blender()
    return None


bpy.context.preferences.view.show_splash = False
listen()
bpy.app.timers.register(go_on, first_interval=2.0, persistent=True)
