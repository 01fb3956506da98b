# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that a node keeps behind pointers: ramps, curves, a direction, an object."""

import bpy

from .ies import IesError, parse_ies

TABLE_SIZE = 256  # as many as Cycles samples


def drawn_properties(node) -> dict:
    """The node's drawn settings as plain data; empty for most nodes."""
    reader = READERS.get(node.type)
    return reader(node) if reader else {}


def _ramp(node) -> dict:
    ramp = node.color_ramp
    table = [c for i in range(TABLE_SIZE) for c in ramp.evaluate(i / (TABLE_SIZE - 1))]
    return {"table": table, "interpolation": ramp.interpolation}


def _curves(node) -> dict:
    mapping = node.mapping
    mapping.initialize()
    curves = list(mapping.curves)
    first = min(curve.points[0].location[0] for curve in curves)
    last = max(curve.points[-1].location[0] for curve in curves)

    def evaluate(curve, x):
        return mapping.evaluate(curve, x)

    table = []
    for i in range(TABLE_SIZE):
        x = first + i / (TABLE_SIZE - 1) * (last - first)
        if node.type == "CURVE_RGB":  # the combined curve comes first
            x = evaluate(curves[3], x)
        table += [evaluate(curve, x) for curve in curves[:3]]
    return {"table": table, "range": [first, last], "extend": mapping.extend}


def constant_curves(node, value) -> dict:
    """The table of a node of curves, all of it what they exactly make of this value."""
    mapping = node.mapping
    mapping.initialize()
    numbers = value[:3] if isinstance(value, list) else [value]
    if node.type == "CURVE_RGB":  # the combined curve comes first
        numbers = [mapping.evaluate(mapping.curves[3], x) for x in numbers]
    found = [mapping.evaluate(c, x) for c, x in zip(mapping.curves, numbers, strict=False)]
    if node.type == "CURVE_FLOAT" and mapping.use_clip:  # which Cycles does not know
        found = [min(max(y, mapping.clip_min_y), mapping.clip_max_y) for y in found]
    return {"table": found * TABLE_SIZE}


def _direction(node) -> dict:
    return {"direction": list(node.outputs["Normal"].default_value)}


def _other_object(node) -> dict:
    if node.object is None:
        return {}
    matrix = node.object.matrix_world.inverted_safe()
    return {"object_matrix": [x for row in matrix for x in row]}


def _filter_width(node) -> dict:
    """What counts where the link of the socket gives no constant."""
    socket = node.inputs.get("Filter Width")  # since Blender 4.5
    return {} if socket is None else {"filter_width": socket.default_value}


def _space_of_normals(_node) -> dict:
    """Of the attribute N."""
    return {"world_normals": True} if bpy.app.version >= (5, 1, 0) else {}


def _beam(node) -> dict:
    """The table of an IES file, or why there is none."""
    try:
        return {"ies": parse_ies(_ies_text(node))}
    except IesError as error:
        return {"ies_error": str(error)}


def _ies_text(node) -> str:
    if node.mode == "INTERNAL":
        if node.ies is None:
            raise IesError("no text is chosen")
        return "".join(f"{line.body}\n" for line in node.ies.lines)
    path = bpy.path.abspath(node.filepath, library=node.id_data.library)
    try:
        with open(path, encoding="latin-1") as file:
            return file.read()
    except OSError as error:
        raise IesError(f"'{node.filepath}' cannot be read ({error.strerror})") from error


def _image_user(node) -> dict:
    if node.image is None or node.image.source not in ("SEQUENCE", "MOVIE"):
        return {}
    user = node.image_user
    cyclic = int(user.use_cyclic)
    return {"image_user": [user.frame_duration, user.frame_start, user.frame_offset, cyclic]}


READERS = {
    **dict.fromkeys(("ATTRIBUTE", "VERTEX_COLOR"), _space_of_normals),
    "BUMP": _filter_width,
    "VALTORGB": _ramp,
    "CURVE_RGB": _curves,
    "CURVE_VEC": _curves,
    "CURVE_FLOAT": _curves,
    "NORMAL": _direction,
    "TEX_COORD": _other_object,
    "TEX_IES": _beam,
    "TEX_IMAGE": _image_user,
    "TEX_ENVIRONMENT": _image_user,
}
