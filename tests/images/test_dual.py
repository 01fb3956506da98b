# SPDX-License-Identifier: GPL-3.0-or-later
"""Dual photography from the command line: a card is read whose face the camera does not see."""

import ast

import numpy as np
import pytest
from janus_core import dual

from .conftest import ROOT, drive, driven

RESOLUTION = 48


@pytest.fixture(scope="module")
def capture(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dual")

    def run(name, samples, *options):
        arguments = ("--resolution", "64x48", "--dual-resolution", f"{RESOLUTION}x{RESOLUTION}")
        out = folder / name
        driven(
            *("dual_card", "--dual", out, "--samples", samples, "--output", out / "frame.exr"),
            *(*arguments, *options),
        )
        assert {path.name for path in out.iterdir()} == {
            *("transport.npz", "primal.png", "dual.png", "frame.exr")
        }
        return dual.TransportMatrix.load(out / "transport.npz")

    return run


def card() -> tuple[tuple[str, ...], float, float]:
    """FACE, FIELD and LOWEST of the scene, which cannot be imported without bpy."""
    tree = ast.parse((ROOT / "scenes" / "dual_card.py").read_text(encoding="utf-8"))
    values = {
        item.targets[0].id: ast.literal_eval(item.value)
        for item in tree.body
        if isinstance(item, ast.Assign) and isinstance(item.targets[0], ast.Name)
    }
    return values["FACE"], values["FIELD"], values["LOWEST"]


def expected(matrix) -> np.ndarray:
    """1 where the projector's pixels see paper, 0 for ink: from where things are in the scene."""
    face, field, lowest = card()
    transform = np.array(matrix.projector["transform"])
    left, right, bottom, top = matrix.projector["window"]
    width, height = matrix.projector_size
    u = left + (np.arange(width) + 0.5) / width * (right - left)
    v = bottom + (np.arange(height) + 0.5) / height * (top - bottom)
    local = np.stack([*np.meshgrid(u, v), -np.ones((height, width))], axis=-1)
    directions = local @ transform[:3, :3].T
    eye = transform[:3, 3]
    points = eye - directions * (eye[1] / directions[..., 1])[..., None]  # on y = 0
    column = ((0.5 * len(face[0]) * field - points[..., 0]) / field).astype(int)
    row = ((lowest + len(face) * field - points[..., 2]) / field).astype(int)
    assert column.min() >= 0 and column.max() < len(face[0])
    assert row.min() >= 0 and row.max() < len(face)
    paper = np.array([[mark == "." for mark in line] for line in face], dtype=float)
    return paper[row, column]


def test_the_card_is_read(capture):
    matrix = capture("card", 128)
    seen = matrix.dual().mean(axis=2)
    paper = expected(matrix)
    assert 0.1 < paper.mean() < 0.9
    assert np.corrcoef(seen.ravel(), paper.ravel())[0, 1] > 0.9
    assert seen[paper == 1].mean() > 5.0 * seen[paper == 0].mean()


def test_the_camera_does_not_see_the_card(capture):
    """Nothing that the projector lights directly is in view."""
    direct = capture("direct", 16, "--max-bounces", 0)
    assert not direct.relight(np.ones((RESOLUTION, RESOLUTION))).any()


def test_wrong_usage(tmp_path):
    out = tmp_path / "dual"
    result = drive("dual_card", "--dual", out, "--dual-resolution", "300x10")
    assert result.returncode == 1 and "--dual-resolution: at most 256x256" in result.stderr
    result = drive("dual_card", "--dual", out, "--resolution", "1024x768")
    assert result.returncode == 1 and "--resolution: with --dual at most 512x512" in result.stderr
    result = drive("dual_card", "--dual", out, "--dual-light", "Sun")
    assert result.returncode == 1 and "no light 'Sun'" in result.stderr
    result = drive("glass_box", "--dual", out)
    assert result.returncode == 1 and "none of its lights can be a projector" in result.stderr
    result = drive("dual_card", "--dual", out, "--strategies", out)
    assert result.returncode == 2
    assert not out.exists()
