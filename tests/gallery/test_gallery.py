# SPDX-License-Identifier: GPL-3.0-or-later
"""What `./dev gallery` refuses, measures and says."""

import ast
import json
import os
import re

import numpy as np
import pytest
from janus_core.errors import relative_error, root_mean_square, trimmed_error

from scenes.gallery import arguments, curve, measure, page
from scenes.gallery.figures import FIGURES, Comparison
from scenes.gallery.stage import fit

from .conftest import ROOT, run_gallery


@pytest.mark.parametrize(
    ("words", "option"),
    [
        (["--only", "nothing"], "--only"),
        (["--only"], "--only"),
        (["--resolution", "0x0"], "--resolution"),
        (["--resolution", "15x64"], "--resolution"),
        (["--resolution", "1025x16"], "--resolution"),
        (["--resolution", "large"], "--resolution"),
        (["--quality", "best"], "--quality"),
        (["--seconds", "-1"], "--seconds"),
        (["--seconds", "0"], "--seconds"),
        (["--seconds", "nan"], "--seconds"),
        (["--seconds", "1e9"], "--seconds"),
        (["--reference-seconds", "-2"], "--reference-seconds"),
        (["--clock", "sun"], "--clock"),
        (["--seeds", "0"], "--seeds"),
        (["--seeds", "1000"], "--seeds"),
        (["--threads", "-1"], "--threads"),
        (["--output", "/dev/null/gallery"], "--output"),
        (["--output", "/proc/gallery"], "--output"),
    ],
)
def test_wrong_usage_names_the_option(words, option, capsys, tmp_path):
    if "--output" not in words:
        words = [*words, "--output", str(tmp_path)]
    with pytest.raises(SystemExit) as stopped:
        arguments.parse(words)
    assert stopped.value.code == 2
    error = capsys.readouterr().err.splitlines()[-1]
    assert re.search(rf"argument (-o/)?{option}\b", error), error


def test_qualities(tmp_path):
    quick = arguments.parse(["--output", str(tmp_path)])
    full = arguments.parse(["--output", str(tmp_path), "--quality", "full", "--seeds", "2"])
    assert quick.only == list(FIGURES)
    assert quick.seconds < full.seconds and full.seeds == 2
    assert arguments.parse(["--resolution", "64x40", "-o", str(tmp_path)]).resolution == (64, 40)


def test_wrong_usage_of_the_command(tmp_path):
    done = run_gallery("--resolution", "9999x9999", "--output", tmp_path)
    assert done.returncode == 2
    assert "argument --resolution: must be from 16x16 to 1024x1024" in done.stderr
    assert "Traceback" not in done.stderr


def test_pictures_keep_their_proportions():
    assert fit((640, 400), (320, 320)) == (320, 200)
    assert fit((400, 400), (64, 32)) == (32, 32)
    assert fit((4000, 10), (16, 16)) == (16, 1)


def test_measures_of_error():
    reference = np.full((20, 50, 3), 2.0)
    picture = reference.copy()
    picture[0, 0] = 5.0
    assert root_mean_square(picture, reference) == pytest.approx(np.sqrt(9.0 / 1000))
    assert relative_error(picture, reference) == pytest.approx(9.0 / (4.0 + 0.04) / 1000)
    assert trimmed_error(picture, reference) == 0.0  # one pixel of a thousand


def test_the_error_of_a_reference_is_estimated():
    """Of the mean of four pictures of known noise, and of one with a firefly in it."""
    noise = np.random.default_rng(1).normal(0.0, 0.2, (4, 64, 64, 3))
    expected = 0.2**2 / 4 / (1.0 + 0.01)
    assert measure.own_error(1.0 + noise) == pytest.approx(expected, rel=0.1)
    lucky = np.ones((4, 8, 8, 3))
    lucky[2, 3, 3] = 1001.0
    mean_error = relative_error(lucky.mean(axis=0), np.ones((8, 8, 3)))
    assert measure.own_error(lucky) == pytest.approx(mean_error)


def test_it_says_what_it_does(gallery):
    assert "glass (1 of 3): reference ..." in gallery.said
    assert "round 2 of 2" in gallery.said
    assert str(gallery.folder / "index.html") in gallery.said


def test_costs_are_said(gallery):
    made = gallery.numbers["made"]
    assert made["seconds"] > 1.0 and 50 < made["peak_memory_mb"] < 20000
    text = (gallery.folder / "index.html").read_text(encoding="utf-8")
    assert f"{made['peak_memory_mb']:.0f} MB of memory" in text


def test_samples_and_times_are_equal(gallery):
    for figure in (gallery.figure("glass"), gallery.figure("mirror")):
        for picture in figure["pictures"]:
            if picture["group"] == "samples":
                assert picture["samples"] == 10
            elif picture["group"] == "time":
                assert picture["samples"] >= 1
                # Whole passes end a little early or late, on a machine in use later still.
                assert 0.5 * figure["seconds"] < picture["seconds"] < figure["seconds"] + 1.0
                assert picture["time"] == picture["seconds"]


def test_light_tracing_sees_no_glass(gallery):
    """At any number of samples light tracing lacks what is seen in glass and mirror."""
    seen = {key: gallery.picture("glass", f"time-{key}") for key in ("pt", "lt", "bdpt")}
    assert seen["lt"]["brightness"] < 0.95 < seen["bdpt"]["brightness"]
    assert seen["bdpt"]["trimmed"] < seen["pt"]["trimmed"]


def test_errors_fall_with_time(gallery):
    for label, points in gallery.figure("glass")["curves"].items():
        assert [point["samples"] for point in points] == [1 << i for i in range(len(points))]
        assert min(min(point.values()) for point in points) > 0.0
        # With a machine in use, there may be few. A path tracer's first dots raise its error.
        if len(points) > 3 and label.startswith("bidirectional"):
            assert points[-1]["trimmed"] < points[0]["trimmed"], label
    assert len(gallery.figure("glass")["curves"]) == 4


def test_classes_of_paths_add_up(gallery):
    shares = {p["expression"]: p["share"] for p in gallery.figure("classes")["pictures"][1:]}
    assert 0.0 <= shares["LS+DS+E"] < shares["L.*SE"] < 1.0
    assert min(shares[text] for text in ("L(D|S)E", "LDD+E", "LS+DE")) > 0.01
    assert shares["L(D|S)E"] + shares["LDD+E"] + shares["LS+DE"] < 1.0


def test_references_are_kept(gallery):
    [path] = (gallery.folder / "references").glob("caustic_mirror-*.npz")
    before = path.stat().st_mtime_ns
    other = ("--output", gallery.folder.parent / "other", "--only", "mirror", "--clock", "cpu")
    other += ("--resolution", "48x48", "--seconds", "0.1", "--seeds", "1")
    other += ("--reference-seconds", "0.4")
    done = run_gallery(*other)
    assert done.returncode == 0 and ": reference ..." in done.stderr
    [copy] = (gallery.folder.parent / "other" / "references").iterdir()
    assert copy.name != path.name  # of another clock: the name says what it depends on
    kept = copy.stat().st_mtime_ns
    done = run_gallery(*other)
    assert done.returncode == 0 and ": reference ..." not in done.stderr
    assert copy.stat().st_mtime_ns == kept and path.stat().st_mtime_ns == before
    # Equal time was that of the processors: the threads are as many.
    [figure] = json.loads((copy.parents[1] / "figures.json").read_text(encoding="utf-8"))["figures"]
    for picture in figure["pictures"][:-1]:
        assert picture["time"] == pytest.approx(picture["cpu"] / (os.cpu_count() or 1))


def test_code_that_texts_name_is_there():
    links = 0
    for figure in FIGURES.values():
        for text in figure.text:
            for name, path in re.findall(r"\[([^]]+)\]\(([^)]+)\)", text):
                assert (ROOT / path).is_file(), path
                if name.startswith("`"):
                    word = name.strip("`").rpartition("::")[2]
                    assert re.search(rf"\b{word}\b", (ROOT / path).read_text(encoding="utf-8")), (
                        name
                    )
                links += 1
    assert links > 10
    scenes = {figure.scene for figure in FIGURES.values()}
    for scene in scenes:
        body = ast.parse((ROOT / "scenes" / f"{scene}.py").read_text(encoding="utf-8")).body
        assert any(getattr(node, "name", None) == "build" for node in body)
    assert any(isinstance(figure, Comparison) for figure in FIGURES.values())


def test_markdown_of_texts():
    text = page.marked("`LS+DE` and `L.*SE` *Look at* [`f`](core/f.h) & **all**", "../..")
    assert text == (
        "<code>LS+DE</code> and <code>L.*SE</code> <em>Look at</em> "
        '<a href="../../core/f.h"><code>f</code></a> &amp; <strong>all</strong>'
    )


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (0.0123456, "0.0123"), (0.00123456, "1.2e-3"), (1.0, "1.00"), (248.2, "248"),
     (12345.0, "1.2e+4")],
)  # fmt: skip
def test_numbers(value, text):
    assert page.number(value) == text


def test_curves_of_one_point_and_of_none():
    assert curve.draw({"a": [(0.0, 0.0)]}) == ""
    one = curve.draw({"a <b>": [(0.5, 0.02)]})
    assert "a &lt;b&gt;" in one and "nan" not in one
