# SPDX-License-Identifier: GPL-3.0-or-later
"""A file made for Cycles: its bounces, filter and samples hold in Janus until it says otherwise."""

import bpy
import pytest
from conftest import messages, part

OWN = {
    "max_bounces": 7,
    "diffuse_bounces": 3,
    "glossy_bounces": 2,
    "transmission_bounces": 5,
    "transparent_max_bounces": 11,
    "pixel_filter_type": "GAUSSIAN",
    "filter_width": 2.5,
    "film_exposure": 1.5,
    "film_transparent_glass": True,
    "film_transparent_roughness": 0.25,
    "samples": 3,
    "use_adaptive_sampling": True,
    "adaptive_threshold": 0.25,
    "adaptive_min_samples": 9,
    "time_limit": 60.0,
    "use_animated_seed": True,
    "use_denoising": True,
    "denoising_quality": "FAST",
    "denoising_input_passes": "RGB_ALBEDO",
    "denoising_prefilter": "FAST",
}
OF_VIEWPORTS = {
    "preview_samples": 77,
    "use_preview_adaptive_sampling": True,
    "preview_adaptive_threshold": 0.5,
    "preview_adaptive_min_samples": 21,
    "use_preview_denoising": True,
    "preview_denoising_start_sample": 3,
    "preview_denoising_input_passes": "RGB_ALBEDO_NORMAL",
    "preview_denoising_prefilter": "ACCURATE",
    "preview_denoising_quality": "FAST",
}
# See test_denoised_render.py, test_adaptive.py and test_final.py.
NOT_FOR_THE_CORE = {name for name in OWN if "denoising" in name}
NOT_FOR_THE_CORE |= {"use_adaptive_sampling", "use_animated_seed"}
CORE_NAMES = {
    "diffuse_bounces": "max_diffuse_bounces",
    "glossy_bounces": "max_glossy_bounces",
    "transmission_bounces": "max_transmission_bounces",
    "pixel_filter_type": "filter",
    "adaptive_threshold": "noise_threshold",
    "adaptive_min_samples": "min_samples",
    "time_limit": "seconds",
}


@pytest.fixture
def cycles(scene):
    """The settings of an artist who works with Cycles."""
    for name, value in (OWN | OF_VIEWPORTS).items():
        setattr(scene.cycles, name, value)
    return scene.cycles


def rendered(fake_core):
    """What the core was told, by the names of scene.janus, and what it need not know."""
    bpy.ops.render.render()
    scene, value = bpy.context.scene, part("sync.cycles_settings").value
    told = {
        name: getattr(fake_core.settings, CORE_NAMES.get(name, name))
        for name in OWN.keys() - NOT_FOR_THE_CORE
    }
    return told | {name: value(scene, name) for name in NOT_FOR_THE_CORE}


def values(scene):
    return {name: getattr(scene.janus, name) for name in OWN}


def test_every_shared_setting_is_tested_here():
    assert set(part("sync.cycles_settings").SHARED) == set(OWN | OF_VIEWPORTS)


def test_a_render_takes_what_the_file_says_for_cycles(scene, cycles, fake_core):
    assert rendered(fake_core) == OWN
    assert not part("sync.cycles_settings").adopted(scene)  # a render writes nothing
    assert fake_core.settings.clamp_indirect == 0.0
    assert any("copied from Cycles" in text for text in messages("INFO"))


def test_so_does_a_viewport(scene, cycles):
    settings = part("sync.settings")
    assert settings.view_settings(scene)["samples"] == 77
    guides = ("Denoising Albedo", "Denoising Normal")
    assert settings.view_settings(scene)["data_passes"] == list(guides)
    assert settings.view_denoising(scene) == {
        "start_sample": 3,
        "guides": guides,
        "prefilter": "ACCURATE",
        "quality": "FAST",
    }
    part("sync.cycles_settings").adopt(scene)
    assert scene.janus.preview_samples == 77
    scene.janus.preview_samples = 0
    assert part("sync.settings").view_settings(scene)["samples"] > 1_000_000  # unlimited


def test_what_the_file_says_for_janus_goes_first(scene, cycles, fake_core):
    scene.janus.max_bounces, scene.janus.samples = 9, 2
    assert rendered(fake_core) == OWN | {"max_bounces": 9, "samples": 2}


def test_cycles_default_of_samples_is_nobodys_choice(scene, fake_core):
    assert scene.cycles.samples == 4096
    assert rendered(fake_core)["samples"] == 64


def test_adopted_settings_are_the_files_own(scene, cycles, fake_core):
    scene.janus.samples = 2
    part("operators.cycles_settings").adopt_where_used()
    assert values(scene) == OWN | {"samples": 2}
    cycles.max_bounces = 1
    assert rendered(fake_core) == OWN | {"samples": 2}
    part("operators.cycles_settings").adopt_where_used()  # once only
    assert scene.janus.max_bounces == 7


def test_scenes_of_other_engines_are_left_alone(scene, cycles):
    scene.render.engine = "CYCLES"
    part("operators.cycles_settings").adopt_where_used()
    assert not part("sync.cycles_settings").adopted(scene)


def test_loading_a_file_adopts(scene, cycles, tmp_path):
    path = str(tmp_path / "made_for_cycles.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    scene = bpy.context.scene
    assert part("sync.cycles_settings").adopted(scene)
    assert values(scene) == OWN
    scene.cycles.max_bounces = 1
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert values(bpy.context.scene) == OWN  # remembered


def test_the_operator_copies_again(scene, cycles):
    part("operators.cycles_settings").adopt_where_used()
    scene.janus.max_bounces = 1
    scene.janus.sample_clamp_indirect = 10.0
    cycles.glossy_bounces = 6
    assert bpy.ops.janus.copy_settings_from_cycles() == {"FINISHED"}
    assert values(scene) == OWN | {"glossy_bounces": 6}
    assert scene.janus.sample_clamp_indirect == 10.0  # Janus' own


def test_the_notice_names_what_is_left_out_until_it_is_dismissed(scene, fake_core):
    notice = part("sync.cycles_settings").notice
    scene.cycles.sample_clamp_indirect, scene.cycles.blur_glossy = 8.0, 0.5
    scene.cycles.caustics_refractive = False
    part("operators.cycles_settings").adopt_where_used()
    for words in ("Indirect Light 8", "Filter Glossy 0.5", "Refractive Caustics off"):
        assert words in notice(scene)
    bpy.ops.render.render()
    assert notice(scene) in messages("INFO")
    bpy.ops.janus.dismiss_notice()
    assert notice(scene) == ""
    bpy.ops.render.render()
    assert not any("Cycles" in text for text in messages("INFO"))
    bpy.ops.janus.copy_settings_from_cycles()
    assert notice(scene) != ""


def test_without_the_cycles_addon_there_are_janus_defaults(scene, fake_core, monkeypatch):
    import addon_utils

    addon_utils.disable("cycles")
    try:
        assert not hasattr(bpy.types.Scene, "cycles")
        settings = rendered(fake_core)
        assert settings["diffuse_bounces"] == 4 and settings["samples"] == 64
        assert part("sync.cycles_settings").notice(scene) == ""
        part("operators.cycles_settings").adopt_where_used()
        with pytest.raises(RuntimeError, match="Cycles add-on is disabled"):
            bpy.ops.janus.copy_settings_from_cycles()
    finally:
        addon_utils.enable("cycles")
