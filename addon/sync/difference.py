# SPDX-License-Identifier: GPL-3.0-or-later
"""A builder that passes on only what differs from what it has got before."""

import numpy as np

# Too large to be kept and compared: whoever sends them again has a reason.
LARGE = ("set_mesh", "set_image")


class DifferenceBuilder:
    """Stands in for a SceneBuilder of the core in repeated syncs of a scene.

    `changed` says whether anything was different since it was set to False; it begins as True.
    """

    def __init__(self, builder):
        self._builder = builder
        self._sent = {}  # (method, key) -> arguments, what the core returned
        self.changed = True

    def __getattr__(self, method: str):
        target = getattr(self._builder, method)
        if not method.startswith("set_"):
            return target

        def send(key: str = "", /, **arguments):
            if method in LARGE:
                self.changed = True
                return target(key, **arguments)
            known = self._sent.get((method, key))
            if known is None or not same(known[0], arguments):
                self.changed = True
                result = target(key, **arguments) if key else target(**arguments)
                known = self._sent[method, key] = (arguments, result)
            return known[1]

        setattr(self, method, send)
        return send

    def remove(self, key: str) -> None:
        self.changed = True
        for method in ("set_instance", "set_light", "set_material"):
            self._sent.pop((method, key), None)
        self._builder.remove(key)


def same(a, b) -> bool:
    """Equality of plain data with arrays in it."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(value, b[name]) for name, value in a.items())
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
    return type(a) is type(b) and a == b
