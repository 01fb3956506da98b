# SPDX-License-Identifier: GPL-3.0-or-later
"""A reading corner lit through two windows by an image of the sky with a sun of few pixels in it.

Of all the light that the image sends towards the house, only a little comes through the windows:
whoever samples the sky without knowing about them wastes most of it.
"""

from __future__ import annotations

import bpy
import numpy as np

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 512

SUN_DIRECTION = np.array([-0.72, -0.30, 0.52]) / np.linalg.norm([-0.72, -0.30, 0.52])


def sky(d: np.ndarray) -> np.ndarray:
    """Blue above, hazy at the horizon, green below, and a sun of about two degrees."""
    up = d[..., 2:3]
    haze = np.exp(-6.0 * np.maximum(up, 0.0))
    radiance = (1 - haze) * np.array([0.32, 0.60, 1.15]) + haze * np.array([1.15, 1.10, 1.0])
    radiance = np.where(up < 0.0, np.array([0.10, 0.14, 0.05]), radiance)
    cosine = (d @ SUN_DIRECTION)[..., None]
    glow = np.exp(-60.0 * (1.0 - cosine)) * np.array([1.6, 1.2, 0.7])
    disc = np.exp(-((1.0 - cosine) / 2.0e-4)) * np.array([1.0, 0.82, 0.56])
    return radiance + glow + 6500.0 * disc


def room(scene: bpy.types.Scene) -> None:
    """x from -2 to 2.6, y from -3 to 2, 2.7 m high; the windows are in the left wall."""
    plaster = kit.diffuse("Plaster", (0.74, 0.71, 0.66))
    ochre = kit.diffuse("Ochre", (0.66, 0.55, 0.40))
    oak = props.principled("Oak", (0.40, 0.25, 0.14), 0.28)
    white = props.principled("Lacquer", (0.78, 0.77, 0.74), 0.35)
    height = 2.7
    openings = [(0.55, 1.85, 0.65, 2.35), (2.85, 4.15, 0.65, 2.35)]
    left = props.wall(scene, "Left", (5.4, 0.3, height), plaster, openings)
    props.place(left, (-2.0, -3.2, 0.0), 90.0)
    back = props.wall(scene, "Back", (5.2, 0.2, height), ochre)
    back.location = (-2.3, 2.0, 0.0)
    right = props.wall(scene, "Right", (5.4, 0.2, height), plaster)
    props.place(right, (2.8, -3.2, 0.0), 90.0)
    front = props.wall(scene, "Front", (5.2, 0.2, height), plaster)
    front.location = (-2.3, -3.2, 0.0)
    props.block(scene, "Roof", (5.6, 6.0, 0.2), plaster, (0.25, -0.6, height), 0.0, 0.02)
    boards = 23
    for i in range(boards):
        y = -3.0 + 5.0 * (i + 0.5) / boards
        props.block(
            *(scene, f"Board {i}", (4.8, 5.0 / boards - 0.004, 0.03), oak, (0.3, y, -0.03)),
            *(0.0, 0.003),
        )
    under = kit.diffuse("Joints", (0.08, 0.05, 0.03))
    kit.quad(
        scene,
        "Floor",
        [(-2.3, -3.2, -0.01), (2.8, -3.2, -0.01), (2.8, 2.2, -0.01), (-2.3, 2.2, -0.01)],
        under,
    )
    props.block(scene, "Skirting", (4.6, 0.02, 0.10), white, (0.3, 1.99, 0.0), 0.0, 0.004)
    for x0, x1, z0, z1 in openings:  # frames with a cross each
        y, z = -3.2 + (x0 + x1) / 2, z0
        width, tall = x1 - x0, z1 - z0
        props.block(scene, "Sill", (0.42, width + 0.1, 0.04), white, (-2.12, y, z - 0.02))
        for offset in (-width / 2 + 0.03, 0.0, width / 2 - 0.03):
            props.block(scene, "Stile", (0.05, 0.06, tall), white, (-2.15, y + offset, z))
        for level in (0.0, 0.62 * tall, tall - 0.06):
            props.block(scene, "Rail", (0.045, width, 0.055), white, (-2.15, y, z + level))


def furniture(scene: bpy.types.Scene) -> None:
    leather = props.principled("Leather", (0.13, 0.21, 0.17), 0.45)
    walnut = props.principled("Walnut", (0.16, 0.085, 0.05), 0.35)
    for name, size, location in (
        ("Seat", (0.62, 0.66, 0.18), (1.25, 0.85, 0.26)),
        ("Back rest", (0.62, 0.16, 0.62), (1.25, 1.24, 0.34)),
        ("Arm left", (0.13, 0.80, 0.36), (0.87, 0.88, 0.22)),
        ("Arm right", (0.13, 0.80, 0.36), (1.63, 0.88, 0.22)),
    ):
        # The chair is turned to the window about its middle.
        item = props.block(scene, name, size, leather, (0.0, 0.0, 0.0), 0.0, 0.05)
        turn = kit.Matrix.Rotation(-0.55, 3, "Z")
        x, y, _ = turn @ kit.Vector((location[0] - 1.25, location[1] - 0.9, 0.0))
        item.location = (round(1.25 + x, 4), round(0.9 + y, 4), location[2])
        item.rotation_euler.z = -0.55
    for i, (x, y) in enumerate(((0.95, 0.45), (1.62, 0.72), (0.75, 1.10), (1.40, 1.38))):
        kit.lathe(
            scene, f"Foot {i}", [(0.0, 0.0), (0.018, 0.0), (0.03, 0.24), (0.0, 0.24)], walnut, 24
        ).location = (x, y, 0.0)
    top = [(0.0, 0.50), (0.29, 0.50), (0.30, 0.51), (0.30, 0.525), (0.29, 0.535), (0.0, 0.535)]
    kit.lathe(scene, "Table", top, walnut, 96).location = (0.05, 0.75, 0.0)
    leg = [(0.0, 0.0), (0.20, 0.0), (0.20, 0.012), (0.03, 0.03), (0.022, 0.10), (0.022, 0.50)]
    kit.lathe(scene, "Leg", leg, walnut, 64).location = (0.05, 0.75, 0.0)
    glaze = props.principled("Glaze", (0.10, 0.28, 0.42), 0.10)
    vase = kit.spline([(0.05, 0.0), (0.085, 0.08), (0.06, 0.19), (0.03, 0.25), (0.042, 0.28)], 8)
    inside = [(0.036, 0.28), (0.024, 0.25), (0.0, 0.20)]
    vase = kit.lathe(scene, "Vase", [(0.0, 0.0), *vase, *inside], glaze, 96)
    vase.location = (-0.03, 0.80, 0.5353)
    chrome = props.principled("Chrome", (0.80, 0.80, 0.82), 0.08, 1.0)
    kit.sphere(scene, "Sphere", 0.05, chrome, 64).location = (0.17, 0.66, 0.5855)
    rug = kit.diffuse("Rug", (0.52, 0.22, 0.14))
    props.block(scene, "Rug", (2.1, 1.5, 0.012), rug, (0.65, 0.55, 0.001), 0.0, 0.004)
    frame = props.principled("Frame", (0.05, 0.04, 0.03), 0.4)
    paper = kit.diffuse("Paper", (0.80, 0.78, 0.72))
    for x, tone in ((0.25, (0.12, 0.24, 0.36)), (1.15, (0.50, 0.16, 0.08))):
        props.block(scene, "Frame", (0.62, 0.03, 0.82), frame, (x, 1.98, 1.25), 0.0, 0.005)
        props.block(scene, "Sheet", (0.56, 0.02, 0.76), paper, (x, 1.97, 1.28), 0.0, 0.001)
        ink = kit.diffuse("Ink", tone)
        props.block(scene, "Print", (0.34, 0.02, 0.34), ink, (x, 1.965, 1.52), 0.0, 0.001)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX", exposure=1.2)
    props.environment(scene, sky, 1.0, 256)
    room(scene)
    furniture(scene)
    kit.camera(scene, (1.35, -2.75, 1.35), (0.12, 1.0, 1.0), lens=26.0)
