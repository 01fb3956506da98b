# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract with Blender when something goes wrong: DESIGN.md section 8, point by point."""

import platform
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest
from conftest import CRASHES_AT_EXIT, add_square, messages, part
from test_final import load_pixels, result_pixels


def fail_after(samples):
    def script(session):
        if session.samples == samples:
            raise RuntimeError("the core broke")

    return script


def test_only_an_error_report_fails_a_render(scene, fake_core):
    add_square().cycles.shadow_terminator_offset = 0.2  # a warning
    assert bpy.ops.render.render() == {"FINISHED"}
    fake_core.script = fail_after(2)
    with pytest.raises(RuntimeError, match="the core broke"):
        bpy.ops.render.render()
    assert messages("ERROR") == ["RuntimeError: the core broke"]


def test_pixels_before_an_error_are_saved_linear(scene, fake_core, tmp_path):
    fake_core.script = fail_after(2)
    fake_core.color = (0.001, 0.5, 1234.5, 0.25)
    with pytest.raises(RuntimeError):
        bpy.ops.render.render(write_still=True)
    pixels = load_pixels(tmp_path / "out_partial.exr")
    assert pixels.shape == (12, 16, 4)
    assert np.array_equal(pixels[5, 5], np.float32(fake_core.color))  # 32-bit, untouched
    assert not (tmp_path / "out.png").exists()
    assert "Janus partial" not in bpy.data.images
    assert result_pixels()[0, 0] == pytest.approx(fake_core.color)


def test_ctrl_c_in_the_module_fails_the_render(scene, fake_core, tmp_path):
    """Blender would swallow the exception, write a black picture and go on."""

    def press(session):
        if session.samples == 2:
            raise KeyboardInterrupt

    fake_core.script = press
    with pytest.raises(RuntimeError, match="Stopped by Ctrl-C"):
        bpy.ops.render.render(write_still=True)
    assert [path.name for path in tmp_path.iterdir()] == ["out_partial.exr"]


def test_no_partial_file_without_pixels(scene, fake_core, tmp_path):
    fake_core.script = fail_after(0)
    with pytest.raises(RuntimeError, match="the core broke"):
        bpy.ops.render.render()
    assert list(tmp_path.iterdir()) == []


def test_partial_file_has_the_size_of_the_border(scene, fake_core, tmp_path):
    scene.render.use_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75
    fake_core.script = fail_after(1)
    with pytest.raises(RuntimeError):
        bpy.ops.render.render()
    assert load_pixels(tmp_path / "out_partial.exr").shape == (12, 8, 4)


def test_a_failing_save_does_not_hide_the_error(scene, fake_core, tmp_path):
    (tmp_path / "file").write_text("no folder")
    scene.render.filepath = str(tmp_path / "file" / "out.png")
    fake_core.script = fail_after(1)
    with pytest.raises(RuntimeError, match="the core broke"):
        bpy.ops.render.render()
    assert any("could not be saved" in line for line in messages())


def test_an_error_stops_an_animation(scene, fake_core, tmp_path):
    scene.frame_start, scene.frame_end = 1, 4
    scene.render.filepath = str(tmp_path / "frame_")
    scene.janus.samples = 2

    def script(session):
        if scene.frame_current == 2 and session.samples == 1:
            raise MemoryError("too big")

    fake_core.script = script
    with pytest.raises(RuntimeError, match="too big"):
        bpy.ops.render.render(animation=True)
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["frame_0001.png", "frame_0002_partial.exr"]


@pytest.mark.parametrize(
    "path, animation, expected",
    [
        ("/r/a.png", False, "/r/a_partial.exr"),
        ("/r/a.0001", False, "/r/a.0001_partial.exr"),
        ("/r/", False, "/r/janus_partial.exr"),
        ("/r/a_", True, "/r/a_0007_partial.exr"),
        ("/r/", True, "/r/0007_partial.exr"),
    ],
)
def test_partial_path(scene, path, animation, expected):
    scene.render.filepath = path
    scene.frame_set(7)
    assert part("sync.settings").partial_path(scene, animation) == expected


@pytest.mark.parametrize("where", ["SceneBuilder", "RenderSettings", "RenderSession"])
def test_a_full_size_result_is_always_ended(scene, fake_core, monkeypatch, where):
    """Without it Blender may crash when it writes."""

    def broken(*args, **kwargs):
        raise ValueError(f"no {where}")

    monkeypatch.setattr(fake_core, where, broken)
    with pytest.raises(RuntimeError, match=f"no {where}"):
        bpy.ops.render.render(write_still=True)
    assert result_pixels().shape == (12, 16, 4)


def test_wrong_picture_size_is_an_error_not_a_crash(scene, fake_core, monkeypatch):
    monkeypatch.setattr(
        "fake_core.FakeSession.snapshot", lambda self, name: np.zeros((3, 3, 4), np.float32)
    )
    with pytest.raises(RuntimeError, match="Blender wants"):
        bpy.ops.render.render()


def test_missing_core_is_explained(scene, monkeypatch):
    bridge = part("bridge")
    monkeypatch.setitem(sys.modules, "janus_core", None)  # import raises ModuleNotFoundError
    with pytest.raises(RuntimeError, match="Install the extension zip"):
        bpy.ops.render.render()
    assert "cannot render in Blender" in bridge.failure()
    assert result_pixels().shape == (12, 16, 4)


def test_old_system_is_explained(addon, monkeypatch):
    bridge = part("bridge")

    def too_old(name):
        raise ImportError("/lib/libm.so.6: version `GLIBC_2.27' not found (required by _core.so)")

    monkeypatch.setattr(bridge.importlib, "import_module", too_old)
    with pytest.raises(bridge.CoreUnavailable, match="needs glibc 2.28 or newer") as error:
        bridge.core()
    assert " ".join(platform.libc_ver()) in str(error.value)


def test_broken_core_is_explained(addon, monkeypatch):
    bridge = part("bridge")

    def broken(name):
        raise OSError("undefined symbol: rtcNewDevice")

    monkeypatch.setattr(bridge.importlib, "import_module", broken)
    with pytest.raises(bridge.CoreUnavailable, match="undefined symbol: rtcNewDevice"):
        bridge.core()


def test_other_core_version_is_refused(addon, monkeypatch):
    from types import SimpleNamespace

    bridge = part("bridge")

    def found(version):
        return SimpleNamespace(__version__=version, __file__="/janus_core/__init__.py")

    monkeypatch.setitem(sys.modules, "janus_core", found("0.2.0"))
    with pytest.raises(bridge.CoreUnavailable, match="found 0.2.0"):
        bridge.core()
    monkeypatch.setitem(sys.modules, "janus_core", found("0.1.7"))
    assert bridge.core().__version__ == "0.1.7"
    assert bridge.failure() is None


def test_a_core_that_was_replaced_while_loaded_is_refused(addon, monkeypatch, tmp_path):
    """Blender swaps the wheel, but the native module stays; the add-on's Python is loaded anew."""
    from types import ModuleType

    bridge = part("bridge")
    wheel = tmp_path / "janus_core-0.1.0+aaaaaaaa.dist-info"
    wheel.mkdir()
    module = ModuleType("janus_core")
    module.__version__ = "0.1.0"
    module.__file__ = str(tmp_path / "janus_core" / "__init__.py")
    monkeypatch.setitem(sys.modules, "janus_core", module)
    monkeypatch.setattr(bridge, "_checked", None)
    assert bridge.core() is module
    wheel.rename(tmp_path / "janus_core-0.1.0+bbbbbbbb.dist-info")
    assert bridge.core() is module, "Python and core still fit"
    bridge._checked = None  # as in a module that was just loaded
    with pytest.raises(bridge.CoreUnavailable, match="Restart Blender"):
        bridge.core()


def test_no_camera_object(scene, fake_core):
    scene.camera = add_square("Not a camera")
    with pytest.raises(RuntimeError):
        bpy.ops.render.render()


def test_many_warnings_are_summed_up(addon):
    report = part("report")
    said = []

    class Engine:
        def report(self, kind, message):
            said.append((next(iter(kind)), message))

    log = report.DiagnosticsLog()
    for index in range(30):
        log.warning("twice", object=f"O{index}")
        log.warning("twice", object=f"O{index}")
    log.info("not for the status bar")
    log.error("bad")
    log.flush(Engine())
    assert said[0] == ("WARNING", "Object 'O0': twice (2 times)")
    assert said[20][1].startswith("10 more warnings")
    assert said[21:] == [("ERROR", "bad")]
    log.flush(Engine())
    assert len(said) == 22  # nothing is said twice


SCRIPT = """
import importlib.util, sys, types
import bpy
for parent in ("other", "other.name"):
    sys.modules[parent] = types.ModuleType(parent)
spec = importlib.util.spec_from_file_location(
    "other.name.janus", {init!r}, submodule_search_locations=[{folder!r}])
sys.modules[spec.name] = package = importlib.util.module_from_spec(spec)
spec.loader.exec_module(package)
for _ in range(2):
    package.register()
    bpy.context.scene.render.engine = "JANUS"
    assert bpy.context.scene.janus.samples == 64
    bpy.context.scene.render.engine = "CYCLES"
    package.unregister()
    assert not hasattr(bpy.types.Scene, "janus")
    assert not [p for p in bpy.types.Panel.__subclasses__()
                if "JANUS" in getattr(p, "COMPAT_ENGINES", ()) and "JANUS" not in p.__name__
                and not p.__module__.startswith("other")]
assert "janus_core" not in sys.modules
print("all well")
"""


def test_registers_twice_under_another_name_without_a_core():
    folder = Path(__file__).resolve().parents[2] / "addon"
    code = SCRIPT.format(init=str(folder / "__init__.py"), folder=str(folder))
    command = [sys.executable, "-c", code]
    if bpy.app.binary_path:  # no module
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-expr", code]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert "all well" in done.stdout, done.stderr
    assert done.returncode == 0 or CRASHES_AT_EXIT
