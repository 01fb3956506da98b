# SPDX-License-Identifier: GPL-3.0-or-later
"""Light transport matrices: relighting is rendering, and the transpose is the swapped pair."""

import json
import zipfile

import janus_core
import numpy as np
import pytest
from janus_core import RenderSession, RenderSettings, SceneBuilder, dual

from .conftest import shader

SIZE, PROJECTOR = 24, 16
LEFT = {"eye": (-0.6, -3.2, 0.5), "target": (0, 0, -0.1), "half": 0.38}
RIGHT = {"eye": (0.9, -2.6, -0.3), "target": (-0.1, 0, 0.1), "half": 0.5}
# Of each channel and pixel of a small picture of independent samples.
MOST_Z, LEAST_SPREAD, MOST_SPREAD = 5.5, 0.4, 1.15


def look_at(eye, target):
    eye, target = np.array(eye, dtype=float), np.array(target, dtype=float)
    z = (eye - target) / np.linalg.norm(eye - target)
    x = np.cross((0, 0, 1), z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3] = np.stack([x, np.cross(z, x), z, eye], axis=1)
    return matrix


def box(builder):
    """Open to the front, coloured, with a glossy floor and a card that throws shadows."""
    paints = {
        "white": shader("BSDF_DIFFUSE", Color=[0.7, 0.7, 0.7, 1]),
        "red": shader("BSDF_DIFFUSE", Color=[0.7, 0.2, 0.1, 1]),
        "gloss": shader("BSDF_GLOSSY", Color=[0.8, 0.8, 0.6, 1], Roughness=0.4),
    }
    for name, graph in paints.items():
        builder.set_material(name, name=name, graph=graph)
    quads = {
        "floor": ("gloss", [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]),
        "ceiling": ("white", [(-1, -1, 1), (-1, 1, 1), (1, 1, 1), (1, -1, 1)]),
        "back": ("white", [(-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, 1, 1)]),
        "left": ("red", [(-1, -1, -1), (-1, 1, -1), (-1, 1, 1), (-1, -1, 1)]),
        "right": ("white", [(1, -1, -1), (1, -1, 1), (1, 1, 1), (1, 1, -1)]),
        "card": (
            "white",
            [(-0.3, -0.2, -0.9), (0.3, 0.1, -0.9), (0.3, 0.1, 0.2), (-0.3, -0.2, 0.2)],
        ),
    }
    for name, (paint, corners) in quads.items():
        triangles = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.int32)
        positions = np.array(corners, dtype=np.float32)
        builder.set_mesh(name, name=name, positions=positions, triangles=triangles)
        builder.set_instance(name, name=name, mesh=name, transform=np.eye(4), materials=[paint])


def pane(builder):
    """Of smooth glass before LEFT; what a walk from the other side meets is a delta."""
    place = look_at(LEFT["eye"], LEFT["target"])
    corners = np.array([(x, y, z) for x in (-0.6, 0.6) for y in (-0.6, 0.6) for z in (-0.1, 0.1)])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    builder.set_mesh(
        "pane",
        name="pane",
        positions=(corners + (0, 0, -0.5)).astype(np.float32),
        triangles=np.array(triangles, dtype=np.int32),
    )
    glass = shader("BSDF_GLASS", Color=[1, 1, 0.9, 1], Roughness=0.0, IOR=1.5)
    builder.set_material("glass", name="glass", graph=glass)
    builder.set_instance("pane", name="pane", mesh="pane", transform=place, materials=["glass"])


def with_slide(builder, slide) -> dict:
    """A node tree that shows the slide, pixel by pixel."""
    builder.set_image("slide", name="Slide", pixels=slide)
    properties = {"image": "slide", "interpolation": "Closest", "extension": "CLIP"}
    where = {"name": "Where", "type": "TEX_COORD", "inputs": {}, "properties": {}}
    link = {"link": ["Where", "UV"]}
    picture = {"name": "Slide", "type": "TEX_IMAGE", "inputs": {"Vector": link}}
    picture["properties"] = properties
    lamp = {"name": "Lamp", "type": "EMISSION", "properties": {}}
    lamp["inputs"] = {"Color": {"link": ["Slide", "Color"]}, "Strength": 1.0}
    return {"nodes": [where, picture, lamp], "surface": {"link": ["Lamp", "Emission"]}}


def scene(camera, projector, slide=None, parallel=False, add=lambda builder: None, **light):
    builder = SceneBuilder()
    box(builder)
    add(builder)
    half = camera["half"]
    builder.set_camera(
        name="Camera",
        type="ORTHO" if parallel else "PERSP",
        transform=look_at(camera["eye"], camera["target"]),
        window=(-half, half, -half, half),
        clip_start=1e-3,
    )
    half = projector["half"]
    kind = (
        {"type": "AREA", "shape": "SQUARE", "size": 2 * half, "spread": 0.0}
        if parallel
        else {"type": "SPOT", "radius": 0.0, "spot_size": 2 * np.arctan(half), "spot_blend": 0.0}
    )
    builder.set_light(
        "lamp",
        name="Lamp",
        transform=look_at(projector["eye"], projector["target"]),
        graph=None if slide is None else with_slide(builder, slide),
        **{"energy": 1000.0, **kind, **light},
    )
    return builder.commit()


def settings(**changes):
    return RenderSettings(
        **{"width": SIZE, "height": SIZE, "samples": 64, "max_bounces": 4} | changes
    )


def taken(built, size=SIZE, projector=PROJECTOR, samples=64, memory=64 << 20, **changes):
    chosen = settings(width=size, height=size, samples=samples, **changes)
    return dual.capture(built, chosen, "Lamp", resolution=(projector, projector), memory=memory)


def rendered(built, size, samples, seeds=8):
    """Mean and variance of pictures with boxes for pixels."""
    pictures = []
    for seed in range(seeds):
        chosen = settings(
            width=size, height=size, samples=samples, seed=77 + seed, filter="BOX", filter_width=1.0
        )
        session = RenderSession(built, chosen)
        session.start()
        session.finish()
        pictures.append(session.snapshot()[..., :3])
    return np.mean(pictures, axis=0), np.var(pictures, axis=0, ddof=1) / seeds


def watts_of(built, size):
    session = janus_core.TransportSession(
        built, settings(), projector="Lamp", projector_width=size, projector_height=size
    )
    return session.projector["own_watts"]


def assert_alike(mean, variance, other, other_variance, tolerance=0.01):
    # Few seeds may agree by chance: no pixel has much less noise than those of its brightness.
    usual = np.mean(other_variance / np.maximum(other, 1e-9) ** 2) * other**2
    z = (mean - other) / np.sqrt(variance + np.maximum(other_variance, usual) + 1e-30)
    z = z[(mean > 0) | (other > 0)]
    assert z.size > 0.5 * mean.size
    assert np.abs(z).max() < MOST_Z
    assert LEAST_SPREAD < z.std() < MOST_SPREAD
    sums, others = mean.sum(axis=(0, 1)), other.sum(axis=(0, 1))
    assert np.allclose(sums, others, rtol=tolerance)


@pytest.fixture(scope="module")
def matrix():
    return taken(scene(LEFT, RIGHT), samples=256)


@pytest.fixture(scope="module")
def coarse():
    """Hardly any memory: blocks and shares are larger than pixels."""
    found = taken(scene(LEFT, RIGHT), size=96, projector=64, samples=16, memory=1 << 20)
    assert found.shares_size > 1
    assert found.blocks[:, 3].max() > found.shares_size
    return found


def test_relighting_is_rendering(matrix):
    rng = np.random.default_rng(4)
    inside = np.hypot(*np.mgrid[-7.5:8, -7.5:8]) < 6.5  # of the spot's round beam
    slide = (rng.random((PROJECTOR, PROJECTOR, 3)) * inside[..., None]).astype(np.float32)
    built = scene(LEFT, RIGHT, slide)
    shown = matrix.shown(slide)
    assert np.allclose(shown, watts_of(built, PROJECTOR), rtol=1e-4, atol=1e-5)
    picture, variance = rendered(built, SIZE, 256)
    assert_alike(matrix.relight(shown), matrix.relight_variance(shown), picture, variance)


def test_relighting_as_captured(matrix):
    picture, _ = rendered(scene(LEFT, RIGHT), SIZE, 256)
    # The rim of the round beam goes through pixels.
    assert np.allclose(matrix.relight().mean(axis=(0, 1)), picture.mean(axis=(0, 1)), rtol=0.01)


def test_the_transpose_is_the_swapped_pair(matrix):
    """The projector as camera, the camera as a lamp with a slide: one plain render."""
    slide = np.random.default_rng(5).random((SIZE, SIZE, 3)).astype(np.float32)
    slide *= (np.hypot(*np.mgrid[-11.5:12, -11.5:12]) < 10.5)[..., None]
    swapped = scene(RIGHT, LEFT, slide)
    watts = watts_of(swapped, SIZE)
    assert np.all(watts[slide > 0] > 0) and np.all(watts[slide == 0] == 0)
    picture, variance = rendered(swapped, PROJECTOR, 512)
    assert_alike(matrix.dual(watts), matrix.dual_variance(watts), picture, variance)


def test_the_transpose_is_the_matrix_of_the_swapped_pair(matrix):
    other = taken(scene(RIGHT, LEFT), PROJECTOR, SIZE, samples=512)
    c = np.random.default_rng(6).random((SIZE, SIZE, 3))
    assert_alike(
        matrix.dual(c), matrix.dual_variance(c), other.relight(c), other.relight_variance(c)
    )
    p = np.random.default_rng(7).random((PROJECTOR, PROJECTOR, 3))
    assert_alike(
        matrix.relight(p), matrix.relight_variance(p), other.dual(p), other.dual_variance(p)
    )


def test_the_transpose_through_glass():
    """Cycles' transmission is not reciprocal, but a path from air to air is. One way, camera paths
    go through the glass, the other way light paths."""
    one = taken(scene(LEFT, RIGHT, add=pane), samples=256)
    other = taken(scene(RIGHT, LEFT, add=pane), PROJECTOR, SIZE, samples=512)
    c = np.random.default_rng(3).random((SIZE, SIZE, 3))
    assert_alike(one.dual(c), one.dual_variance(c), other.relight(c), other.relight_variance(c))
    bare = taken(scene(LEFT, RIGHT), samples=64)
    assert one.dual(c).mean() < 0.97 * bare.dual(c).mean()  # the pane is in the way


def test_parallel_projectors_are_orthographic_cameras():
    left, right = {**LEFT, "half": 1.1}, {**RIGHT, "half": 0.9}
    slide = np.random.default_rng(8).random((PROJECTOR, PROJECTOR, 3)).astype(np.float32)
    built = scene(left, right, slide, parallel=True)
    found = taken(built, samples=256)
    picture, _ = rendered(built, SIZE, 256)
    # Blender's narrowest spread is not quite parallel.
    assert np.allclose(found.relight().mean(axis=(0, 1)), picture.mean(axis=(0, 1)), rtol=0.01)
    other = taken(scene(right, left, parallel=True), PROJECTOR, SIZE, samples=512)
    c = np.random.default_rng(9).random((SIZE, SIZE, 3))
    assert_alike(found.dual(c), found.dual_variance(c), other.relight(c), other.relight_variance(c))


@pytest.mark.parametrize("which", ["matrix", "coarse"])
def test_both_products_are_of_one_matrix(which, request):
    m = request.getfixturevalue(which)
    rng = np.random.default_rng(1)
    c = rng.random((*reversed(m.camera_size), 3))
    p = rng.random((*reversed(m.projector_size), 3))
    forth = (m.relight(p) * c).sum(axis=(0, 1), dtype=float)
    back = (m.dual(c) * p).sum(axis=(0, 1), dtype=float)
    assert np.allclose(forth, back, rtol=1e-5)
    assert np.allclose(m.relight(3 * p), 3 * m.relight(p), rtol=1e-4)
    column, row = m.column(5, 3), m.row(7, 2)
    assert np.allclose(column[2, 7], row[3, 5], rtol=1e-4, atol=1e-12)


@pytest.mark.parametrize("which", ["matrix", "coarse"])
def test_no_light_is_lost_in_blocks(which, request):
    """Even light from either side: sums over rows and columns do not depend on the blocks."""
    m = request.getfixturevalue(which)
    width, height = m.camera_size
    rows = np.zeros((width * height, 3))
    np.add.at(rows, m.entry_pixel, m.entry_value.astype(float))
    even = m.relight(np.ones(m.projector_size[::-1]))
    assert np.allclose(even.reshape(-1, 3), rows, rtol=1e-4, atol=1e-9)
    columns = m.dual(np.ones((height, width)))
    squares = m.share_value.sum(axis=0, dtype=float)
    size = m.shares_size
    sums = columns.reshape(squares.shape[0], size, squares.shape[1], size, 3).sum(axis=(1, 3))
    assert np.allclose(sums, squares, rtol=1e-3)
    assert np.allclose(columns.sum(axis=(0, 1)), rows.sum(axis=0), rtol=1e-4)


def test_little_memory_loses_little():
    """The same samples in fewer blocks: what differs is lost in them. It is less than the noise."""
    built, side = scene(LEFT, RIGHT), 32
    fine = taken(built, 48, side, 64)
    small = taken(built, 48, side, 64, memory=8 << 20)
    assert len(small.blocks) < 0.5 * len(fine.blocks)
    slide = (np.add(*np.mgrid[:side, :side] // 4) % 2).astype(float)
    picture = fine.relight(slide)
    lost = np.abs(small.relight(slide) - picture).mean() / picture.mean()
    noise = np.sqrt(fine.relight_variance(slide)).mean() / picture.mean()
    assert 0.0 < lost < 0.4 * noise
    ramp = np.linspace(0.0, 1.0, 48)[:, None].repeat(48, axis=1)  # even light is kept exactly
    seen = fine.dual(ramp)
    assert 0.0 < np.abs(small.dual(ramp) - seen).mean() < 0.01 * seen.mean()


def test_light_that_nobody_sees(tmp_path):
    away = {**RIGHT, "target": (0.9, -9.0, 0.0)}
    taken(scene(LEFT, away), samples=4).save(tmp_path / "dark.npz")
    dark = dual.TransportMatrix.load(tmp_path / "dark.npz")
    assert len(dark.entry_pixel) == 0
    for picture in (dark.relight(), dark.dual(), dark.relight_variance(), dark.dual_variance()):
        assert not picture.any()
    assert dark.dual().shape == (PROJECTOR, PROJECTOR, 3)


def test_files(matrix, tmp_path):
    path = tmp_path / "matrix.npz"
    matrix.save(path)
    again = dual.TransportMatrix.load(path)
    assert again.projector["name"] == "Lamp"
    assert np.allclose(again.camera["transform"], matrix.camera["transform"])
    assert again.samples == matrix.samples == 256
    assert np.array_equal(again.relight(), matrix.relight())
    assert np.array_equal(again.dual(), matrix.dual())
    assert set(np.load(path).files) >= {"entry_value", "entry_variance", "blocks", "share_value"}
    assert [p.name for p in tmp_path.iterdir()] == ["matrix.npz"]
    with pytest.raises(janus_core.IoError, match="no_folder"):
        matrix.save(tmp_path / "no_folder" / "matrix.npz")


def damaged(source, target, member, content):
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            new.writestr(name, content(old.read(name)) if name == member else old.read(name))


def test_files_that_are_none(matrix, tmp_path):
    path, bad = tmp_path / "matrix.npz", tmp_path / "bad.npz"
    matrix.save(path)
    with pytest.raises(janus_core.IoError, match=r"bad\.npz"):
        dual.TransportMatrix.load(bad)
    bad.write_text("no zip")
    with pytest.raises(janus_core.IoError, match="not a light transport matrix"):
        dual.TransportMatrix.load(bad)
    np.savez(bad, a=np.zeros(3))
    with pytest.raises(janus_core.IoError, match="not a light transport matrix"):
        dual.TransportMatrix.load(bad)
    path.with_name("cut.npz").write_bytes(path.read_bytes()[:20000])
    with pytest.raises(janus_core.IoError, match=r"cut\.npz"):
        dual.TransportMatrix.load(path.with_name("cut.npz"))

    def newer(text):
        return json.dumps(json.loads(text) | {"version": 99})

    damaged(path, bad, "transport.json", newer)
    with pytest.raises(janus_core.IoError, match="version 99"):
        dual.TransportMatrix.load(bad)

    def huge(array):
        import io

        values = np.load(io.BytesIO(array)) + np.uint32(1 << 20)
        out = io.BytesIO()
        np.save(out, values)
        return out.getvalue()

    for member in ("blocks.npy", "entry_pixel.npy", "entry_block.npy"):
        damaged(path, bad, member, huge)
        with pytest.raises(janus_core.IoError, match="damaged"):
            dual.TransportMatrix.load(bad)
    damaged(path, bad, "entry_value.npy", lambda a: a[:200])
    with pytest.raises(janus_core.IoError, match="damaged"):
        dual.TransportMatrix.load(bad)


def test_slides_of_any_size(matrix):
    assert np.allclose(matrix.shown(np.ones((3, 5))), matrix.plain_watts, rtol=1e-5)
    large = np.zeros((4 * PROJECTOR, 2 * PROJECTOR, 4))
    large[: 2 * PROJECTOR, :PROJECTOR, 1] = 1.0
    shown = matrix.shown(large)
    half = PROJECTOR // 2
    assert np.allclose(shown[:half, :half, 1], matrix.plain_watts[:half, :half, 1], rtol=1e-5)
    assert not shown[half:].any() and not shown[:, half:].any() and not shown[..., 0].any()
    odd = np.random.default_rng(2).random((7, 11, 3))
    even = matrix.shown(odd) / np.maximum(matrix.plain_watts, 1e-9)
    lit = matrix.plain_watts[..., 0] > 0
    assert even[lit].min() >= odd.min() and even[lit].max() <= odd.max()
    for wrong in (np.ones(4), np.ones((2, 2, 2)), np.ones((0, 4, 3))):
        with pytest.raises(ValueError, match="slide"):
            matrix.shown(wrong)


def test_wrong_pictures(matrix):
    for wrong in (np.ones((SIZE, SIZE)), np.ones((PROJECTOR, PROJECTOR, 4)), 1.0):
        with pytest.raises(ValueError, match="must be"):
            matrix.relight(wrong)
    with pytest.raises(ValueError, match="must be"):
        matrix.dual(np.ones((PROJECTOR, PROJECTOR)))
    with pytest.raises(ValueError, match=r"\(99, 0\)"):
        matrix.row(99, 0)


def refused(built, chosen=None, **arguments):
    with pytest.raises(janus_core.SceneError) as caught:
        dual.capture(built, chosen or settings(), **{"projector": "Lamp", **arguments})
    return caught.value.key, caught.value.path


def test_refused_by_name():
    built = scene(LEFT, RIGHT)
    assert refused(built, projector="Nobody") == ("Nobody", "projector")
    assert refused(built, resolution=(257, 4)) == ("settings", "projector_width")
    assert refused(built, resolution=(4, 0)) == ("settings", "projector_height")
    assert refused(built, settings(width=600)) == ("settings", "width")
    assert refused(built, settings(integrator="pt")) == ("settings", "integrator")
    assert refused(built, memory=1 << 50) == ("settings", "memory")
    assert refused(scene(LEFT, RIGHT, radius=0.1)) == ("Lamp", "radius")
    assert refused(scene(LEFT, RIGHT, type="POINT")) == ("Lamp", "type")
    assert refused(scene(LEFT, RIGHT, parallel=True, spread=1.0)) == ("Lamp", "spread")


def test_poll_ends_a_capture():
    built = scene(LEFT, RIGHT)
    chosen = settings(samples=1 << 20)
    found = dual.capture(built, chosen, "Lamp", poll=lambda s: s.stats()["samples"] >= 2)
    assert 2 <= found.samples < 1 << 20
    with pytest.raises(janus_core.Cancelled):
        dual.capture(built, settings(width=512, height=512), "Lamp", poll=lambda s: True)
