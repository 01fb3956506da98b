# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair and points from Python, and in captures."""

import janus_core
import numpy as np
import pytest
from janus_core import capture

from .conftest import IDENTITY, SETTINGS, fill, render

HAIR = {
    "positions": np.float32(
        [(-1, 0, 0.1), (0, 0, 0.6), (1, 0, 0.1), (-1, 0.4, 0.2), (1, 0.4, 0.5)]
    ),
    "radii": np.float32([0.1, 0.1, 0.1, 0.2, 0.1]),
    "curves": np.int32([0, 3, 5]),
}
POINTS = {"positions": [(0, -0.5, 0.5), (1, -0.5, 0.5)], "radii": [0.2, 0.3]}


def place(builder, kind, **arguments):
    getattr(builder, f"set_{kind}")("hair", name="Hair", **arguments)
    builder.set_instance("hair", name="Hair", mesh="hair", transform=IDENTITY, materials=["m"])


@pytest.mark.parametrize("kind, arrays, pieces", [("curves", HAIR, 3 + 4), ("points", POINTS, 2)])
def test_are_seen_and_counted(builder, kind, arrays, pieces):
    """Pieces of curves, and a disk at each of their ends."""
    before = render(builder.commit()).snapshot()
    place(builder, kind, **arrays)
    scene = builder.commit()
    assert scene.counts["round"] == pieces and scene.counts["triangles"] == 2
    assert not np.array_equal(render(scene).snapshot(), before)


@pytest.mark.parametrize(
    "kind, arrays, part, value",
    [
        ("curves", HAIR, "radii", [0.1]),
        ("curves", HAIR, "curves", [0, 9]),
        ("curves", HAIR, "curves", []),
        ("curves", HAIR, "material_indices", [0]),
        ("points", POINTS, "radii", ["thick"]),
        ("points", POINTS, "positions", [1.0, 2.0]),
    ],
)
def test_what_is_wrong_is_named(builder, kind, arrays, part, value):
    with pytest.raises(janus_core.SceneError) as error:
        place(builder, kind, **{**arrays, part: value})
        builder.commit()
    assert error.value.key == "hair" and error.value.path == part


def test_captures_hold_them(tmp_path):
    builder = capture.CapturingBuilder()
    fill(builder)
    attributes = [{"key": "attribute:tint", "domain": "FACE", "values": np.float32([1, 2])}]
    place(builder, "curves", **HAIR, straight=True, attributes=attributes)
    builder.set_points("points", name="Points", **POINTS)
    builder.set_instance("points", name="Points", mesh="points", transform=IDENTITY, materials=[])
    moved = HAIR["positions"] + np.float32([0, 0, 0.3])
    builder.set_mesh_motion("hair", positions=[HAIR["positions"], moved])
    builder.save(tmp_path / "hair.npz", janus_core.RenderSettings(**SETTINGS))
    pixels = render(builder.commit()).snapshot()
    again, _ = capture.load(tmp_path / "hair.npz")
    assert np.array_equal(render(again.commit()).snapshot(), pixels)
    place(builder, "curves", **HAIR, straight=True)  # stands still now
    builder.save(tmp_path / "still.npz", janus_core.RenderSettings(**SETTINGS))
    again, _ = capture.load(tmp_path / "still.npz")
    still = render(again.commit()).snapshot()
    assert not np.array_equal(still, pixels)
    assert np.array_equal(still, render(builder.commit()).snapshot())
