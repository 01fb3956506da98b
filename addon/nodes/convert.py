# SPDX-License-Identifier: GPL-3.0-or-later
"""Socket values as plain Python, and Blender's implicit conversions between their types."""

import bpy

# Luminance weights of linear Rec.709, which Blender uses where a colour feeds a number.
LUMINANCE = (0.2126, 0.7152, 0.0722)

# Before, Cycles took them for integers.
HAS_BOOLEANS = bpy.app.version >= (5, 0, 0)

NUMBERS = ("VALUE", "INT", "BOOLEAN")
TRIPLES = ("VECTOR", "ROTATION")


def plain(value):
    """A property or default value as str, bool, number or list of them; None for anything else."""
    if value is None or isinstance(value, str | bool | int | float):
        return value
    if isinstance(value, set | frozenset):
        return sorted(value)
    try:
        return [plain(component) for component in value]
    except TypeError:
        return None


def socket_value(socket):
    """The value of an unlinked socket.

    None stands for what Blender fills in itself: no closure, or the implicit normal, tangent or
    texture coordinate of a vector without a field in the UI.
    """
    if socket.type == "SHADER" or (socket.type in TRIPLES and socket.hide_value):
        return None
    value = plain(getattr(socket, "default_value", None))
    return triple(value) if socket.type in TRIPLES and value is not None else value


def convert(value, source: str, target: str):
    """Converts a constant from one socket type to another as Cycles does; None if impossible."""
    if value is None or source == target:
        return value
    target = "INT" if target == "BOOLEAN" and not HAS_BOOLEANS else target
    if target in ("INT", "BOOLEAN", "VALUE"):
        if target == "BOOLEAN" and source in TRIPLES:
            return any(value)
        number = _to_number(value, source)
        if number is None or target == "VALUE":
            return number
        return number > 0 if target == "BOOLEAN" else int(number)
    if target == "RGBA":
        if source in NUMBERS:
            return [float(value)] * 3 + [1.0]
        return [*triple(value), 1.0] if source in TRIPLES else None
    if target in TRIPLES:
        if source in NUMBERS:
            return [float(value)] * 3
        return triple(value) if source in ("RGBA", *TRIPLES) else None
    return None


def conversion_node(source: str, target: str, link) -> tuple[str, dict, dict, str] | None:
    """A node of values that does what convert() does: its type, inputs, properties and output; None
    where no conversion can be seen. From a vector to a boolean it is the first of two: its length.
    """
    target = "INT" if target == "BOOLEAN" and not HAS_BOOLEANS else target
    if {source, target} - {"RGBA", *NUMBERS, *TRIPLES} or source == target:
        return None
    if source in NUMBERS and target not in ("INT", "BOOLEAN"):
        return None
    if target == "RGBA" and source in TRIPLES:
        return "GAMMA", {"Color": link, "Gamma": 1.0}, {}, "Color"
    if target in TRIPLES and source == "RGBA":
        inputs = {"Vector": link, "Vector_001": [0.0, 0.0, 0.0]}
        return "VECT_MATH", inputs, {"operation": "ADD"}, "Vector"
    if target in NUMBERS:
        if target == "BOOLEAN" and source in TRIPLES:
            inputs = {"Vector": link, "Vector_001": [0.0, 0.0, 0.0]}
            return "VECT_MATH", inputs, {"operation": "LENGTH"}, "Value"
        operation = {"INT": "TRUNC", "BOOLEAN": "GREATER_THAN", "VALUE": "ADD"}[target]
        return "MATH", {"Value": link, "Value_001": 0.0}, {"operation": operation}, "Value"
    return None


def triple(value) -> list:
    """Vectors may have two numbers, or four."""
    return [*value[:3], *[0.0] * (3 - len(value))]


def _to_number(value, source: str) -> float | None:
    if source in NUMBERS:
        return float(value)
    if source == "RGBA":
        return sum(w * c for w, c in zip(LUMINANCE, value, strict=False))
    if source in TRIPLES:
        return sum(triple(value)) / 3.0
    return None
