# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangents of UV maps, by MikkTSpace over the triangles, as Cycles has them.

Blender computes them for triangles and quads; so a mesh becomes the mesh of its triangles first.
"""

import numpy as np


def add_tangents(mesh, keys, found: list, log) -> None:
    """Adds the attributes "tangent:NAME" and "tangent_sign:NAME" of UV maps (without a name, of the
    active one), if any. Then the mesh loses its geometry.
    """
    active = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
    corners = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", corners)
    count = len(mesh.loops)
    names = {key: key.partition(":")[2] or active for key in keys}
    names = {key: name for key, name in names.items() if name in mesh.uv_layers}
    if not names:
        return
    _become_triangles(mesh, corners, set(names.values()))
    for key, name in sorted(names.items()):
        try:
            mesh.calc_tangents(uvmap=name)
        except RuntimeError as error:
            log.warning(f"its tangents are not known ({error}), shaders read 0", object=mesh.name)
            return
        tangents, signs = np.empty(3 * corners.size, np.float32), np.empty(corners.size, np.float32)
        mesh.loops.foreach_get("tangent", tangents)
        mesh.loops.foreach_get("bitangent_sign", signs)
        mesh.free_tangents()
        values = signs[:, None]
        if key.startswith("tangent:"):
            values = np.concatenate([tangents.reshape(-1, 3), values], axis=1)
        # A corner of several triangles has one tangent: they are alike there.
        of_corners = np.zeros((count, values.shape[1]), np.float32)
        of_corners[corners] = values
        found.append({"key": key, "domain": "CORNER", "values": of_corners})


def _become_triangles(mesh, corners: np.ndarray, maps: set[str]) -> None:
    """Replaces the mesh by its triangles, with their normals and these UV maps."""
    vertices = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", vertices)
    positions = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", positions)
    normals = None
    if mesh.normals_domain != "FACE":
        normals = np.empty(3 * len(mesh.loops), dtype=np.float32)
        mesh.corner_normals.foreach_get("vector", normals)
        normals = normals.reshape(-1, 3)[corners]
    uvs = {}
    for name in maps:
        uv = np.empty(2 * len(mesh.loops), dtype=np.float32)
        mesh.uv_layers[name].uv.foreach_get("vector", uv)
        uvs[name] = uv.reshape(-1, 2)[corners]

    mesh.clear_geometry()
    mesh.vertices.add(positions.size // 3)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(corners.size)
    mesh.loops.foreach_set("vertex_index", vertices[corners])
    mesh.polygons.add(corners.size // 3)
    mesh.polygons.foreach_set("loop_start", np.arange(0, corners.size, 3, dtype=np.int32))
    for name, uv in uvs.items():
        mesh.uv_layers.new(name=name, do_init=False).uv.foreach_set("vector", uv.ravel())
    mesh.update(calc_edges=True)
    if normals is None:
        mesh.shade_flat()
    else:
        mesh.shade_smooth()
        mesh.normals_split_custom_set(normals)
