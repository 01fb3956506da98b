# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes and strategies of `./dev render`, with the fake core."""

import sys

import bpy
import numpy as np
import pytest
from conftest import ROOT, part
from test_final import load_pixels

sys.path.insert(0, str(ROOT))
from scenes.driver import arguments, passes, run, setup  # noqa: E402


class Addon:
    """The add-on as the tests loaded it, for the driver."""

    part = staticmethod(part)


def render(scene, output, *words):
    """What `./dev render` does with the words, up to the picture itself: the files beside it."""
    options = arguments.parse(["hero", "-o", str(output), *map(str, words)])
    setup.apply(scene, options)
    passes.prepare(scene, options, Addon)
    bpy.ops.render.render()
    try:
        return passes.save(scene, options, Addon)
    finally:
        part("render.strategies").withdraw(scene)


def test_settings(scene, fake_core, tmp_path):
    words = ("--no-next-event", "--connection-mode", "classic", "--strategy", "0,* 1,2")
    assert render(scene, tmp_path / "a.png", *words) == []
    settings = fake_core.settings
    assert (settings.next_event, settings.connection_mode) == (False, "CLASSIC")
    assert (settings.heuristic, settings.strategies) == ("NONE", "0,* 1,2")
    render(scene, tmp_path / "a.png", "--heuristic", "power")
    assert fake_core.settings.heuristic == "POWER"


def test_what_is_not_given_is_the_scene_s(scene, fake_core, tmp_path):
    scene.janus.next_event, scene.janus.connection_mode = False, "CLASSIC"
    scene.janus.heuristic, scene.janus.strategies = "NONE", "*,1"
    render(scene, tmp_path / "a.png")
    settings = fake_core.settings
    assert (settings.next_event, settings.connection_mode) == (False, "CLASSIC")
    assert (settings.heuristic, settings.strategies) == ("NONE", "*,1")


def test_passes_beside_a_png(scene, fake_core, tmp_path):
    scene.view_settings.view_transform = "Standard"
    fake_core.color = (0.0, 0.0, 0.0, 1.0)
    words = ("--pass", "Sharp=LS+DE", "--pass", "a/b=LDE")
    files = render(scene, tmp_path / "a.png", *words)
    assert files == [tmp_path / "a_Sharp.png", tmp_path / "a_a_b.png"]
    assert fake_core.settings.expressions == [("Sharp", "LS+DE"), ("a/b", "LDE")]
    assert np.all(
        load_pixels(files[0]) == 1.0
    )  # as bright as the number of the pass, see fake_core


def test_passes_beside_an_exr(scene, fake_core, tmp_path):
    exr = pytest.importorskip("janus_core.exr")
    scene.view_layers[0].janus.use_pass_direct = True
    [path] = render(scene, tmp_path / "a.exr", "--pass", "Sharp=LS+DE")
    assert path == tmp_path / "a_passes.exr"
    layers, _ = exr.read_layers(path)
    assert {name.partition(".")[2] for name in layers} == {"Combined", "Direct", "Sharp"}


def test_a_pass_of_the_scene_gets_the_expression(scene, fake_core, tmp_path):
    item = scene.view_layers[0].janus.expressions.add()
    item.name, item.expression, item.enabled = "Sharp", "LE", False
    render(scene, tmp_path / "a.png", "--pass", "Sharp=LS+DE")
    assert fake_core.settings.expressions == [("Sharp", "LS+DE")]


def test_strategies(scene, fake_core, tmp_path):
    folder = tmp_path / "pyramid"
    files = render(
        scene,
        tmp_path / "a.png",
        "--strategies",
        folder,
        "--strategies-length",
        2,
        "--pass",
        "P=LE",
    )
    assert fake_core.settings.strategy_images == 2
    names = ["a_P.png", "pyramid/strategies.png", "pyramid/strategies.exr"]
    assert files == [tmp_path / name for name in names] and all(path.is_file() for path in files)


def test_strategies_need_the_bidirectional_integrator(scene, fake_core, tmp_path):
    with pytest.raises(run.Problem, match="only the integrator bdpt has strategies"):
        render(scene, tmp_path / "a.png", "--integrator", "pt", "--strategies", tmp_path)


@pytest.mark.parametrize(
    "words",
    [
        ["--pass", "LS+DE"],
        ["--pass", "=LDE"],
        ["--strategies", "x", "--strategies-length", "17"],
        ["--strategy", "0,*", "--heuristic", "power"],
        ["--connection-mode", "magic"],
        ["--engine", "cycles", "--pass", "P=LE"],
        ["--engine", "cycles", "--no-next-event"],
    ],
)
def test_wrong_usage(words, capsys):
    with pytest.raises(SystemExit) as stopped:
        arguments.parse(["hero", *words])
    assert stopped.value.code == 2
    assert "error:" in capsys.readouterr().err
