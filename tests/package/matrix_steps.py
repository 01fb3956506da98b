# SPDX-License-Identifier: GPL-3.0-or-later
"""What test_matrix.py does in each Blender: matrix_steps.py -- FOLDER STEP [ARGUMENT...].

Runs in `blender -b -P` or in a Python with bpy; one process for a step, whose findings are written
to FOLDER/STEP.json. A process ends as any script does: how it ends is part of the test.
"""

import glob
import importlib
import json
import os
import signal
import sys
import threading
from pathlib import Path

import bpy
import numpy as np

addon_utils = importlib.import_module("addon_utils")  # there as soon as bpy is

MODULE = "bl_ext.user_default.janus"
IS_MODULE = not bpy.app.binary_path
WIDTH, HEIGHT, SAMPLES = 96, 64, 16
SCENES = ("hero", "glass_box", "textured", "studio")
FRAMES = 3
FOREVER = 1 << 24  # samples

folder, step, *rest = sys.argv[sys.argv.index("--") + 1 :]
folder = Path(folder)


def enabled() -> bool:
    return addon_utils.check(MODULE)[1]


def enable() -> None:
    """bpy reads no preferences; Blender has done this before it runs the script."""
    if IS_MODULE:
        addon_utils.enable(MODULE, default_set=True)
    assert enabled(), "Janus is not enabled"


def part(name: str):
    return importlib.import_module(f"{MODULE}.{name}")


def install_from_disk(archive: str) -> None:
    done = bpy.ops.extensions.package_install_files(
        filepath=archive, repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"}
    assert enabled()
    bpy.ops.wm.save_userpref()


def identity() -> dict:
    """Which Janus this is: its Python, its core, and what lies in Blender's site-packages."""
    core = importlib.import_module("janus_core")
    places = bpy.utils.user_resource("EXTENSIONS") + "/.local/lib/*/site-packages/janus_core-*"
    return {
        "label": part("engine").JanusRenderEngine.bl_label,
        "core_says": core._core.__doc__,
        "build_info": core.build_info(),
        "core": core.__file__,
        "wheels": [Path(path).name for path in glob.glob(places)],
        "blender": bpy.app.version_string,
        "python": sys.version,
    }


# --- Rendering ------------------------------------------------------------------------------------


def ready(width: int = WIDTH, height: int = HEIGHT, samples: int = SAMPLES):
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.engine = "JANUS"
    scene.janus.samples = scene.cycles.samples = samples
    scene.cycles.device = "CPU"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    return scene


def render(engine: str, name: str) -> dict:
    """Writes FOLDER/NAME, an EXR, and measures it."""
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.filepath = str(folder / name)
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    rgb = pixels.reshape(-1, image.channels)[:, :3]
    size = list(image.size)
    bpy.data.images.remove(image)
    return {
        "size": size,
        "mean": float(rgb.mean()),
        "deviation": float(rgb.std()),
        "finite": bool(np.isfinite(rgb).all()),
        "digest": float(rgb.astype(np.float64) @ [1.0, 2.0, 3.0] @ np.arange(len(rgb))),
    }


def build(name: str) -> None:
    importlib.import_module(f"scenes.{name}").build(bpy.context.scene)
    ready().render.use_stamp = False


def small() -> None:
    """The scene of the factory settings, in few pixels."""
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True, load_ui=False)
    if IS_MODULE and not enabled():
        enable()
    ready(32, 24, 4)


def pictures() -> dict:
    """The scenes, and Cycles between two pictures of the hero: neither may disturb the other."""
    sys.path.insert(0, str(folder))  # the test puts the scenes there
    found = {}
    for name in reversed(SCENES):
        build(name)
        found[name] = render("JANUS", f"{name}.exr")
    found["cycles"] = render("CYCLES", "cycles.exr")
    found["again"] = render("JANUS", "again.exr")
    return found


def disabled_and_enabled() -> dict:
    """While Janus is the engine of the scene, as it is for whoever does that."""
    addon_utils.disable(MODULE, default_set=True)
    gone = {"enabled": enabled(), "settings": hasattr(bpy.context.scene, "janus")}
    try:
        bpy.context.scene.render.engine = "JANUS"
    except TypeError:
        gone["engine"] = False
    else:
        gone["engine"] = True
    addon_utils.enable(MODULE, default_set=True)
    ready()
    return {"gone": gone, "again": render("JANUS", "enabled_again.exr")}


def animation() -> dict:
    """The cube moves; frames 1 to 3."""
    scene = bpy.context.scene
    cube = bpy.data.objects["Cube"]
    for frame in (1, FRAMES):
        cube.location.z = 0.3 * frame
        cube.keyframe_insert("location", frame=frame)
    scene.frame_start, scene.frame_end = 1, FRAMES
    scene.render.filepath = str(folder / "frame_")
    return {"returned": list(bpy.ops.render.render(animation=True))}


def cancelled() -> dict:
    """A render without end, and Ctrl-C."""
    events = []

    def note(name):
        return lambda *_: events.append(name)

    listeners = [
        (getattr(bpy.app.handlers, name), note(name))
        for name in ("render_complete", "render_cancel")
    ]
    for handlers, listener in listeners:
        handlers.append(listener)
    pressed = []

    def press():
        pressed.append(True)
        os.kill(os.getpid(), signal.SIGINT)

    bpy.context.scene.janus.samples = FOREVER
    bpy.context.scene.janus.use_adaptive_sampling = False
    bpy.context.scene.render.filepath = str(folder / "cancelled.png")
    timer = threading.Timer(1.0, press)
    timer.start()
    result = {"error": ""}
    try:
        result["returned"] = list(bpy.ops.render.render())
    except RuntimeError as error:
        result["error"] = str(error)
    finally:
        for handlers, listener in listeners:  # bpy 4.2 and 4.5 end badly with one of anybody's
            handlers.remove(listener)
    timer.cancel()
    result["pressed"] = bool(pressed)
    result["events"] = list(events)
    result["last"] = {k: part("render.final").last_render.get(k) for k in ("cancelled", "samples")}
    bpy.context.scene.janus.samples = 4
    result["after"] = list(bpy.ops.render.render())
    result["samples_after"] = part("render.final").last_render["samples"]
    return result


def save_broken() -> None:
    """A file that Janus refuses to render."""
    item = bpy.context.view_layer.janus.expressions.add()
    item.name, item.expression = "Broken", "L(D"
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "broken.blend"), copy=True)
    bpy.context.view_layer.janus.expressions.clear()


# --- The steps ------------------------------------------------------------------------------------


def first() -> dict:
    """After the first installation."""
    enable()
    small()
    return {"picture": render("JANUS", "first.exr")} | identity()


def install(archive: str) -> dict:
    install_from_disk(archive)
    return {}


def upgrade(archive: str) -> dict:
    """Over one that has rendered in this process."""
    enable()
    small()
    render("JANUS", "before.exr")
    before = identity()
    install_from_disk(archive)
    result = {"before": before, "after": identity(), "error": ""}
    try:
        render("JANUS", "after.exr")
    except RuntimeError as error:
        result["error"] = str(error)
    return result


def story() -> dict:
    enable()
    result = {"identity": identity(), "pictures": pictures(), "toggle": disabled_and_enabled()}
    small()
    result["animation"] = animation()
    result["cancel"] = cancelled()
    save_broken()
    return result


def render_file(blend: str, picture: str) -> dict:
    enable()
    bpy.ops.wm.open_mainfile(filepath=blend)
    scene = bpy.context.scene
    scene.render.filepath, scene.render.image_settings.file_format = picture, "PNG"
    bpy.ops.render.render(write_still=True)
    return {}


def which() -> dict:
    enable()
    small()
    return {"picture": render("JANUS", "which.exr")} | identity()


STEPS = {
    "first": first,
    "install": install,
    "upgrade": upgrade,
    "story": story,
    "render": render_file,
    "which": which,
}
found = STEPS[step](*rest)
(folder / f"{step}.json").write_text(json.dumps(found))
