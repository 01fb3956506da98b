# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: those that come along, and the user's."""

from pathlib import Path
from unittest.mock import MagicMock

import bpy
import pytest
from conftest import part


def shipped(kind: str = "light_paths") -> list[str]:
    presets = part("ui.presets")
    folders = [presets.FOLDER / "presets/janus" / kind]
    if presets.folders_can_be_named():
        folders = bpy.utils.preset_paths(f"janus/{kind}")
    return sorted(str(file) for folder in folders for file in Path(folder).glob("*.py"))


def run(file: str) -> None:
    assert bpy.ops.script.execute_preset(
        filepath=file, menu_idname="JANUS_PT_light_paths_presets"
    ) == {"FINISHED"}


@pytest.mark.parametrize(
    ("name", "bounces", "diffuse"),
    [("Default", 12, 4), ("Direct_Light", 0, 0), ("Full_Global_Illumination", 32, 32)],
)
def test_those_that_come_along(scene, name, bounces, diffuse):
    scene.janus.sample_clamp_indirect = 10.0
    run(next(file for file in shipped() if Path(file).stem == name))
    janus = scene.janus
    assert (janus.max_bounces, janus.diffuse_bounces) == (bounces, diffuse)
    assert janus.sample_clamp_indirect == 0.0


def test_the_default_is_the_default(scene):
    run(next(file for file in shipped() if file.endswith("Default.py")))
    for name in part("ui.presets").LIGHT_PATHS:
        assert getattr(scene.janus, name) == scene.janus.bl_rna.properties[name].default


@pytest.mark.parametrize("kind", ["sampling", "viewport_sampling"])
@pytest.mark.parametrize("name", ["Preview", "Final"])
def test_sampling_is_as_in_cycles(scene, kind, name):
    """Their presets of the same names, as far as Janus has the settings."""
    (theirs,) = bpy.utils.preset_paths(f"cycles/{kind}")
    for file in (Path(theirs) / f"{name}.py", *shipped(kind)):
        if Path(file).stem == name:
            exec(compile(Path(file).read_text(), file, "exec"), {"bpy": bpy})
    for name in getattr(part("ui.presets"), kind.upper()):
        if hasattr(scene.cycles, name) and "quality" not in name and "start" not in name:
            assert getattr(scene.janus, name) == getattr(scene.cycles, name), name


@pytest.mark.parametrize("kind", ["sampling", "viewport_sampling", "light_paths"])
def test_a_preset_of_ones_own_comes_back(scene, kind, tmp_path, monkeypatch):
    names = getattr(part("ui.presets"), kind.upper())

    def user_resource(*_, path="", **__):
        (tmp_path / path).mkdir(parents=True, exist_ok=True)
        return str(tmp_path / path)

    monkeypatch.setattr(bpy.utils, "user_resource", user_resource)
    janus = scene.janus
    changed = {}
    for name in names:
        prop = janus.bl_rna.properties[name]
        if prop.type == "ENUM":
            changed[name] = prop.enum_items[0].identifier
        else:
            changed[name] = not prop.default if prop.type == "BOOLEAN" else 1
        setattr(janus, name, changed[name])
    add = getattr(bpy.ops.janus, f"{kind}_preset_add")
    assert add(name="Mine") == {"FINISHED"}
    (file,) = tmp_path.rglob("*.py")
    for name in names:
        janus.property_unset(name)
    exec(compile(file.read_text(), str(file), "exec"), {"bpy": bpy})
    assert {name: getattr(janus, name) for name in names} == changed


@pytest.fixture
def first_of_4_2(scene, monkeypatch):
    """A Blender to which no folder of presets can be named, such as 4.2.0."""
    presets = part("ui.presets")
    presets.unregister()
    with monkeypatch.context() as patch:
        for name in ("register_preset_path", "unregister_preset_path"):
            patch.delattr(bpy.utils, name, raising=False)
        presets.register()
        yield presets
        presets.unregister()
    presets.register()


def test_the_first_4_2_offers_those_that_come_along(first_of_4_2):
    panel = MagicMock(preset_subdir="janus/light_paths")
    names = {"display_name": lambda name: Path(name).stem}
    first_of_4_2.Presets.path_menu(panel, [], "script.execute_preset", **names)
    row = panel.layout.column.return_value.row.return_value
    offered = {call.kwargs["text"] for call in row.operator.call_args_list}
    assert {"Default", "Direct_Light", "Full_Global_Illumination"} <= offered
