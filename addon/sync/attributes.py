# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh attributes that shaders read: UV maps, colours, generated coordinates and the like."""

import numpy as np

from .tangents import add_tangents

# Blender's data types that Cycles reads: the field of an element, and its numbers.
FIELDS = {
    "FLOAT": ("value", 1),
    "INT": ("value", 1),
    "INT8": ("value", 1),
    "BOOLEAN": ("value", 1),
    "FLOAT2": ("vector", 2),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT_COLOR": ("color", 4),
    "BYTE_COLOR": ("color", 4),
    "QUATERNION": ("value", 4),
}
TYPES = {"INT": np.int32, "INT8": np.int32, "BOOLEAN": bool}  # the others are float
# What the core computes from edges: see set_mesh().
DERIVED = {"pointiness": ("normal",), "random_per_island": ()}


def mesh_attributes(mesh, keys, log) -> list[dict]:
    """The attributes with these keys, as SceneBuilder.set_mesh takes them.

    What the mesh does not have is left out, and reads as 0, as in Cycles. The mesh may lose its
    geometry: nothing can be read from it afterwards.
    """
    found = []
    keys = set(keys)
    for key in sorted(keys.union(*(DERIVED[key] for key in keys & DERIVED.keys()))):
        kind, _, name = key.partition(":")
        if kind in DERIVED:
            found.append({"key": key})
        elif kind in READERS:
            attribute = READERS[kind](mesh, name, log)
            if attribute is not None:
                found.append({"key": key, **attribute})
    add_tangents(mesh, {key for key in keys if key.startswith("tangent")}, found, log)
    return found


def edges_of(mesh) -> np.ndarray:
    """Pairs of vertices, int32[E, 2]."""
    edges = np.empty(2 * len(mesh.edges), dtype=np.int32)
    mesh.edges.foreach_get("vertices", edges)
    return edges.reshape(-1, 2)


def triangle_faces(mesh, count: int) -> np.ndarray:
    """The face of each triangle."""
    faces = np.empty(count, dtype=np.int32)
    mesh.loop_triangle_polygons.foreach_get("value", faces)
    return faces


def named_attribute(mesh, name: str, log) -> dict | None:
    """Its domain and values, of a mesh, curves or a point cloud; None: there is none of that name,
    or of no kind that Cycles reads.
    """
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.data_type not in FIELDS:
        return None
    field, channels = FIELDS[attribute.data_type]
    domain = attribute.domain
    if domain == "EDGE" and attribute.data_type == "BYTE_COLOR":
        field = "color_srgb"
    kind = TYPES.get(attribute.data_type, np.float32)
    values = np.empty(len(attribute.data) * channels, dtype=kind)
    attribute.data.foreach_get(field, values)
    values = values.reshape(-1, channels)
    if domain == "EDGE":
        if attribute.data_type == "QUATERNION":
            log.warning(
                f"its attribute '{name}' (rotations on edges) is not supported, shaders read 0",
                object=mesh.name,
            )
            return None
        domain, values = "POINT", _of_points(mesh, values, attribute.data_type)
    return {"domain": domain, "values": values.astype(np.float32)}


def _of_points(mesh, values: np.ndarray, kind: str) -> np.ndarray:
    """From values of edges to those of vertices, as Blender does: the mean, or for booleans any."""
    ends, count = edges_of(mesh), len(mesh.vertices)
    sums = np.zeros((count, values.shape[1]))
    for column in range(values.shape[1]):
        for end in range(2):
            weights = values[:, column].astype(float)
            if kind == "BYTE_COLOR":
                weights = np.rint(255.0 * weights)
            sums[:, column] += np.bincount(ends[:, end], weights, minlength=count)
    if kind == "BOOLEAN":
        return sums > 0
    means = sums / np.maximum(np.bincount(ends.ravel(), minlength=count), 1)[:, None]
    if kind in TYPES:
        return np.copysign(np.floor(np.abs(means) + 0.5), means)
    if kind == "BYTE_COLOR":  # the mean of bytes is one
        means = np.floor(means) / 255.0
        linear = np.where(means > 0.04045, ((means + 0.055) / 1.055) ** 2.4, means / 12.92)
        means[:, :3] = linear[:, :3]
    return means


def _uv(mesh, name: str, log) -> dict | None:
    return named_attribute(mesh, name or active_uv(mesh), log)


def active_uv(mesh) -> str:
    """The map with the camera symbol, which renders use."""
    return next((layer.name for layer in mesh.uv_layers if layer.active_render), "")


def _color(mesh, _name: str, log) -> dict | None:
    index = mesh.color_attributes.render_color_index
    if not 0 <= index < len(mesh.color_attributes):
        return None
    return named_attribute(mesh, mesh.color_attributes[index].name, log)


def _generated(mesh, _name: str, _log) -> dict:
    """Where a point lies in the texture space, from 0 to 1, before modifiers moved it."""
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("undeformed_co", values)
    return {"domain": "POINT", "values": in_texture_space(mesh, values.reshape(-1, 3))}


def in_texture_space(mesh, positions: np.ndarray) -> np.ndarray:
    location = np.array(mesh.texspace_location, dtype=np.float32)
    size = np.array(mesh.texspace_size, dtype=np.float32)
    half = np.where(size != 0.0, 0.5 / np.where(size != 0.0, size, 1.0), 0.0)
    return ((positions - location) * half + 0.5).astype(np.float32)


def _normal(mesh, _name: str, _log) -> dict:
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertex_normals.foreach_get("vector", values)
    return {"domain": "POINT", "values": values.reshape(-1, 3)}


READERS = {
    "attribute": named_attribute,
    "uv": _uv,
    "color": _color,
    "generated": _generated,
    "normal": _normal,
}
