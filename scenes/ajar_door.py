# SPDX-License-Identifier: GPL-3.0-or-later
"""Three pots in a dark room, lit through a door that stands ajar from the room behind it.

After Veach (1997, fig. 11.5). Nothing that the camera sees also sees the lamp: what comes in is
light that the walls of the other room reflect, through a gap of two hands' width.
"""

from __future__ import annotations

import math

import bpy

from scenes import kit, props

WIDTH, HEIGHT, SAMPLES = 640, 400, 512

# (radius, height) in metres, from the foot to the rim.
POT = [(0.10, 0.0), (0.17, 0.05), (0.205, 0.13), (0.185, 0.22), (0.125, 0.285), (0.115, 0.30)]
LID = [(0.115, 0.30), (0.105, 0.318), (0.05, 0.338), (0.018, 0.346), (0.026, 0.362), (0.0, 0.376)]


def tube(scene, name, spine, radii, material, location, degrees) -> None:
    """A round tube along a curve in the plane of x and z."""
    points = kit.spline(spine, 8)
    sides, vertices, faces = 20, [], []
    for i, (x, z) in enumerate(points):
        before, after = points[max(i - 1, 0)], points[min(i + 1, len(points) - 1)]
        dx, dz = after[0] - before[0], after[1] - before[1]
        length = math.hypot(dx, dz)
        part = i / (len(points) - 1)
        radius = radii[0] + (radii[1] - radii[0]) * part
        for k in range(sides):
            angle = 2 * math.pi * k / sides
            out, side = radius * math.cos(angle), radius * math.sin(angle)
            vertices.append((x - out * dz / length, side, z + out * dx / length))
    for i in range(len(points) - 1):
        for k in range(sides):
            j = (k + 1) % sides
            a, b = i * sides, (i + 1) * sides
            faces.append((a + k, b + k, b + j, a + j))
    item = kit.mesh_object(scene, name, vertices, faces, material, smooth=True)
    props.place(item, location, degrees)


def teapot(scene, name: str, material, location: kit.Point3, degrees: float) -> None:
    profile = [(0.0, 0.0), *kit.spline(POT, 8), *kit.spline(LID, 6)[1:]]
    props.place(kit.lathe(scene, name, profile, material, 128), location, degrees)
    spout = [(0.17, 0.09), (0.25, 0.13), (0.28, 0.20), (0.33, 0.27)]
    handle = [(-0.15, 0.24), (-0.24, 0.27), (-0.30, 0.20), (-0.27, 0.11), (-0.18, 0.08)]
    tube(scene, f"{name} spout", spout, (0.042, 0.018), material, location, degrees)
    tube(scene, f"{name} handle", handle, (0.016, 0.016), material, location, degrees)


def build(scene: bpy.types.Scene) -> None:
    kit.clear(scene)
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    kit.view(scene, "AgX")
    kit.world(scene)

    plaster = kit.diffuse("Plaster", (0.62, 0.60, 0.56))
    bright = kit.diffuse("Bright", (0.82, 0.78, 0.70))
    boards = props.principled("Boards", (0.30, 0.18, 0.10), 0.3)
    paint = props.principled("Paint", (0.12, 0.26, 0.30), 0.35)

    # Both rooms are 5 m wide and 2.6 m high; the wall between them stands on y = 1.6.
    for name, front, back, walls in (("Room", -3.2, 1.6, plaster), ("Next room", 1.7, 5.0, bright)):
        a, b, c, d = (-2.5, front, 0), (2.5, front, 0), (2.5, back, 0), (-2.5, back, 0)
        e, f, g, h = ((x, y, 2.6) for x, y, _ in (a, b, c, d))
        kit.quad(scene, f"{name} floor", [a, b, c, d], boards)
        kit.quad(scene, f"{name} ceiling", [e, h, g, f], bright)
        kit.quad(scene, f"{name} left", [a, d, h, e], walls)
        kit.quad(scene, f"{name} right", [c, b, f, g], walls)
        if name == "Room":
            kit.quad(scene, f"{name} front", [b, a, e, f], walls)
        else:
            kit.quad(scene, f"{name} back", [d, c, g, h], walls)
    door = (3.0, 3.95, 0.0, 2.05)
    between = props.wall(scene, "Wall", (5.0, 0.1, 2.6), plaster, [door])
    between.location = (-2.5, 1.6, 0.0)
    # The frame stands a little into the opening: faces that share a plane would fight for the ray.
    for name, size, x, z in (
        ("Post left", (0.08, 0.13, 2.05), 0.47, 0.0),
        ("Post right", (0.08, 0.13, 2.05), 1.48, 0.0),
        ("Lintel", (1.11, 0.13, 0.08), 0.975, 2.04),
    ):
        props.block(scene, name, size, paint, (x, 1.65, z), 0.0, 0.006)
    # The leaf hangs on the left post and opens into the other room.
    angle = 25.0
    turn = math.radians(angle)
    middle = (0.515 + 0.465 * math.cos(turn), 1.68 + 0.465 * math.sin(turn), 0.01)
    props.block(scene, "Door", (0.93, 0.04, 2.02), paint, middle, angle, 0.006)
    knob = kit.sphere(
        scene, "Knob", 0.03, props.principled("Brass", (0.9, 0.66, 0.3), 0.2, 1.0), 32
    )
    knob.location = (0.515 + 0.88 * math.cos(turn), 1.68 + 0.88 * math.sin(turn) - 0.06, 1.0)

    cloth = props.principled("Oak", (0.42, 0.27, 0.15), 0.45)
    props.block(scene, "Table", (2.3, 0.85, 0.05), cloth, (0.0, -0.25, 0.70), 0.0, 0.012)
    for i, (x, y) in enumerate(((-1.05, -0.58), (1.05, -0.58), (-1.05, 0.08), (1.05, 0.08))):
        props.block(scene, f"Leg {i}", (0.07, 0.07, 0.70), cloth, (x, y, 0.0))
    ceramic = props.principled("Ceramic", (0.55, 0.13, 0.07), 0.6)
    teapot(scene, "Ceramic pot", ceramic, (-0.72, -0.22, 0.7502), 200)
    silver = props.principled("Silver", (0.92, 0.90, 0.86), 0.12, 1.0)
    teapot(scene, "Silver pot", silver, (0.0, -0.30, 0.7502), -20)
    glaze = props.principled("Glaze", (0.10, 0.24, 0.42), 0.08)
    teapot(scene, "Glazed pot", glaze, (0.74, -0.22, 0.7502), 15)

    kit.area_light(
        scene, "Lamp", (0.35, 4.3, 2.5), (0.35, 4.3, 0.0), (0.9, 0.9), 9000.0, (1.0, 0.86, 0.68)
    )
    kit.camera(scene, (-0.35, -2.9, 1.55), (0.12, 0.0, 0.98), lens=32.0)
