# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh attributes that shaders read: UV maps, colours, generated coordinates, tangents."""

import numpy as np

# Blender's data types: the field of an element, and its numbers.
FIELDS = {
    "FLOAT": ("value", 1),
    "INT": ("value", 1),
    "INT8": ("value", 1),
    "BOOLEAN": ("value", 1),
    "FLOAT2": ("vector", 2),
    "INT16_2D": ("value", 2),
    "INT32_2D": ("value", 2),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT_COLOR": ("color", 4),
    "BYTE_COLOR": ("color", 4),
    "QUATERNION": ("value", 4),
}
DOMAINS = ("POINT", "CORNER", "FACE")


def mesh_attributes(mesh, keys, log) -> list[dict]:
    """The attributes with these keys, as SceneBuilder.set_mesh takes them.

    What the mesh does not have is left out, and reads as 0, as in Cycles.
    """
    found = []
    for key in sorted(keys):
        kind, _, name = key.partition(":")
        attribute = READERS[kind](mesh, name, log)
        if attribute is not None:
            found.append({"key": key, **attribute})
    return found


def triangle_faces(mesh, count: int) -> np.ndarray:
    """The face of each triangle."""
    faces = np.empty(count, dtype=np.int32)
    mesh.loop_triangle_polygons.foreach_get("value", faces)
    return faces


def _named(mesh, name: str, log) -> dict | None:
    attribute = mesh.attributes.get(name)
    if attribute is None:
        return None
    if attribute.data_type not in FIELDS or attribute.domain not in DOMAINS:
        log.warning(
            f"its attribute '{name}' ({attribute.data_type}, {attribute.domain}) is not supported "
            "yet, shaders read 0",
            object=mesh.name,
        )
        return None
    field, channels = FIELDS[attribute.data_type]
    kind = np.int32 if attribute.data_type.startswith("INT") else np.float32
    kind = bool if attribute.data_type == "BOOLEAN" else kind
    values = np.empty(len(attribute.data) * channels, dtype=kind)
    attribute.data.foreach_get(field, values)
    return {
        "domain": attribute.domain,
        "values": values.astype(np.float32).reshape(-1, channels),
    }


def _uv(mesh, name: str, log) -> dict | None:
    name = name or _active_uv(mesh)
    return _named(mesh, name, log) if name in mesh.uv_layers else None


def _active_uv(mesh) -> str:
    """The map with the camera symbol, which renders use."""
    return next((layer.name for layer in mesh.uv_layers if layer.active_render), "")


def _color(mesh, _name: str, log) -> dict | None:
    index = mesh.color_attributes.render_color_index
    if not 0 <= index < len(mesh.color_attributes):
        return None
    return _named(mesh, mesh.color_attributes[index].name, log)


def _generated(mesh, _name: str, _log) -> dict:
    """Where a point lies in the texture space, from 0 to 1, before modifiers moved it."""
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("undeformed_co", values)
    location = np.array(mesh.texspace_location, dtype=np.float32)
    size = np.array(mesh.texspace_size, dtype=np.float32)
    half = np.where(size != 0.0, 0.5 / np.where(size != 0.0, size, 1.0), 0.0)
    generated = (values.reshape(-1, 3) - location) * half + 0.5
    return {"domain": "POINT", "values": generated.astype(np.float32)}


def _tangent(mesh, name: str, log) -> dict | None:
    """MikkTSpace's tangents, with the handedness as the fourth number."""
    name = name or _active_uv(mesh)
    if name not in mesh.uv_layers:
        return None
    try:
        mesh.calc_tangents(uvmap=name)
    except RuntimeError as error:
        log.warning(f"its tangents are not known ({error}), normal maps are flat", object=mesh.name)
        return None
    count = len(mesh.loops)
    tangents, signs = np.empty(3 * count, np.float32), np.empty(count, np.float32)
    mesh.loops.foreach_get("tangent", tangents)
    mesh.loops.foreach_get("bitangent_sign", signs)
    mesh.free_tangents()
    values = np.concatenate([tangents.reshape(-1, 3), signs[:, None]], axis=1)
    return {"domain": "CORNER", "values": values}


READERS = {
    "attribute": _named,
    "uv": _uv,
    "color": _color,
    "generated": _generated,
    "tangent": _tangent,
}
