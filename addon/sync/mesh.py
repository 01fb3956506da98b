# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh arrays, by the accessors of Blender that copy memory instead of calling RNA per element."""

import ctypes

import bpy
import numpy as np

from .attributes import DERIVED, edges_of, mesh_attributes, triangle_faces


def mesh_arrays(mesh, slots: int, attributes, log) -> dict | None:
    """The array arguments of SceneBuilder.set_mesh, or None for a mesh without faces.

    `slots` is the number of material slots of the object that shows the mesh, `attributes` the
    keys of what its materials read.
    """
    derived = _take_apart(mesh, attributes)
    mesh.calc_loop_triangles()
    triangle_count, corner_count = len(mesh.loop_triangles), len(mesh.loops)
    if triangle_count == 0:
        return None
    return {
        "positions": _positions(mesh),
        "triangles": triangles(mesh, triangle_count),
        "corner_vertices": _corner_vertices(mesh, corner_count),
        "vertex_normals": _vertex_normals(mesh),
        "corner_normals": _corner_normals(mesh, corner_count),
        "material_indices": _material_indices(mesh, triangle_count, slots),
        **({"edges": edges_of(mesh)} if derived else {}),
        **_attributes(mesh, triangle_count, attributes, log),
    }


def mesh_form(mesh, attributes) -> tuple[np.ndarray, np.ndarray | None]:
    """Positions and normals, of vertices or corners, as mesh_arrays() gives them."""
    _take_apart(mesh, attributes)
    normals = _vertex_normals(mesh)
    if normals is None:
        normals = _corner_normals(mesh, len(mesh.loops))
    return _positions(mesh), normals


def _take_apart(mesh, attributes) -> bool:
    """As Cycles did before 5.1, so that islands end at sharp edges. Whether the core is to compute
    attributes."""
    derived = not DERIVED.keys().isdisjoint(attributes)
    if derived and bpy.app.version < (5, 1, 0) and mesh.normals_domain == "CORNER":
        mesh.split_faces()
    return derived


def _attributes(mesh, triangle_count: int, keys, log) -> dict:
    if not keys:
        return {}
    faces = triangle_faces(mesh, triangle_count)  # first: tangents take the mesh apart
    found = mesh_attributes(mesh, keys, log)
    by_face = any(attribute.get("domain", "FACE") == "FACE" for attribute in found)
    return {"attributes": found, "faces": faces if by_face else None} if found else {}


def triangles(mesh, count: int) -> np.ndarray:
    """Corner indices, int32[count, 3].

    The array behind loop_triangles is read through the address of its first element. That is not
    part of Blender's API, so a sample is compared with RNA first, and RNA is used if it differs.
    """
    elements = mesh.loop_triangles
    first = elements[0].as_pointer()
    if count < 2 or elements[1].as_pointer() - first == 3 * ctypes.sizeof(ctypes.c_int32):
        raw = (ctypes.c_int32 * (3 * count)).from_address(first)
        view = np.frombuffer(raw, dtype=np.int32).reshape(count, 3)
        sample = {0, min(1, count - 1), count // 3, count // 2, count - 1}
        if all(tuple(view[i]) == tuple(elements[i].loops) for i in sample):
            return view.copy()
    return triangles_by_rna(mesh, count)


def triangles_by_rna(mesh, count: int) -> np.ndarray:
    """The same by the slow, documented way."""
    result = np.empty(3 * count, dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", result)
    return result.reshape(count, 3)


def _positions(mesh) -> np.ndarray:
    result = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.attributes["position"].data.foreach_get("vector", result)
    return result.reshape(-1, 3)


def _corner_vertices(mesh, count: int) -> np.ndarray:
    result = np.empty(count, dtype=np.int32)
    attribute = mesh.attributes.get(".corner_vert")
    if attribute is not None:
        attribute.data.foreach_get("value", result)
    else:
        mesh.loops.foreach_get("vertex_index", result)
    return result


def _vertex_normals(mesh) -> np.ndarray | None:
    """Where a vertex has one normal for all of its corners, a quarter of the numbers will do."""
    if mesh.normals_domain != "POINT":
        return None
    result = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertex_normals.foreach_get("vector", result)
    return result.reshape(-1, 3)


def _corner_normals(mesh, count: int) -> np.ndarray | None:
    if mesh.normals_domain != "CORNER":
        return None  # flat shading, or normals of vertices
    result = np.empty(3 * count, dtype=np.float32)
    mesh.corner_normals.foreach_get("vector", result)
    return result.reshape(-1, 3)


def _material_indices(mesh, triangle_count: int, slots: int) -> np.ndarray | None:
    attribute = mesh.attributes.get("material_index")
    if slots < 2 or attribute is None or attribute.domain != "FACE":
        return None  # slot 0 everywhere
    of_face = np.empty(len(mesh.polygons), dtype=np.int32)
    attribute.data.foreach_get("value", of_face)
    return np.clip(of_face, 0, slots - 1)[triangle_faces(mesh, triangle_count)]
