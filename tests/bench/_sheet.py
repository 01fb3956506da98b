# SPDX-License-Identifier: GPL-3.0-or-later
"""A large mesh, for benchmarks of Blender's side."""

from __future__ import annotations

SIDE = 1000  # quads along a side


def sheet(name: str):
    """A wavy square of two million triangles, smooth shaded, so that it has all that a sculpture
    has: an object in the scene, SIDE metres wide."""
    import bpy
    import numpy as np

    x, y = np.meshgrid(np.arange(SIDE + 1), np.arange(SIDE + 1), indexing="ij")
    z = 4.0 * np.sin(0.05 * x) * np.cos(0.03 * y)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(SIDE)[:, None] * (SIDE + 1) + np.arange(SIDE)).reshape(-1)
    quads = np.stack([corner, corner + SIDE + 1, corner + SIDE + 2, corner + 1], axis=-1)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.astype(np.float32).ravel())
    mesh.loops.add(quads.size)
    mesh.loops.foreach_set("vertex_index", quads.astype(np.int32).ravel())
    mesh.polygons.add(len(quads))
    mesh.polygons.foreach_set("loop_start", np.arange(0, quads.size, 4, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.shade_smooth()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    return obj
