# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene descriptions as files: what was given to a SceneBuilder, to be rendered again anywhere.

A capture is a .npz: a zip archive with `scene.json` (names, numbers, node graphs, settings) and the
arrays as .npy members, which numpy.load() opens as well. Nothing in it is ever unpickled.
"""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable
from typing import Any

import numpy as np

from . import IoError, RenderSettings, Scene, SceneBuilder, __version__
from ._files import read_array, reading, write

__all__ = ["CapturingBuilder", "load"]

FORMAT = "janus scene"
VERSION = 10  # raised when an older reader could not understand a newer file

_KINDS = (
    "mesh",
    "curves",
    "points",
    "material",
    "image",
    "instance",
    "light",
)  # in the order in which load() sets them
_ARRAYS = {
    "mesh": (
        "positions",
        "triangles",
        "corner_vertices",
        "vertex_normals",
        "corner_normals",
        "material_indices",
        "faces",
        "edges",
    ),
    "curves": ("positions", "radii", "curves", "material_indices"),
    "points": ("positions", "radii"),
    "image": ("pixels",),
}
_SHAPES = ("mesh", "curves", "points")  # one has a key
_TRANSFORMS = "instance_transforms"  # one array for all, as there can be very many
_MOTIONS = ("mesh", "instance", "camera")  # what can move while the shutter is open
_CAMERA = ""  # its key there


class CapturingBuilder:
    """Has the methods of SceneBuilder, passes each call on to `builder`, and can save them all.

    Without `builder` it makes a SceneBuilder of its own. Arrays are copied, so the caller may use
    their memory again. A call that the builder refuses is not recorded.
    """

    def __init__(self, builder: SceneBuilder | None = None) -> None:
        self._builder = SceneBuilder() if builder is None else builder
        self._items: dict[str, dict[str, dict[str, Any]]] = {kind: {} for kind in _KINDS}
        self._world: dict[str, Any] | None = None
        self._camera: dict[str, Any] | None = None
        self._shutter: list[float] | None = None
        self._motion: dict[str, dict[str, dict[str, Any]]] = {kind: {} for kind in _MOTIONS}

    def set_mesh(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_mesh."""
        self._set("mesh", key, arguments)

    def set_curves(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_curves."""
        self._set("curves", key, arguments)

    def set_points(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_points."""
        self._set("points", key, arguments)

    def set_material(self, key: str, **arguments: Any) -> list[str]:
        """As SceneBuilder.set_material."""
        return self._set("material", key, arguments)

    def set_image(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_image."""
        self._set("image", key, arguments)

    def set_instance(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_instance."""
        self._set("instance", key, arguments)

    def set_light(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_light."""
        self._set("light", key, arguments)

    def set_world(self, **arguments: Any) -> None:
        """As SceneBuilder.set_world."""
        self._builder.set_world(**arguments)
        self._world = _own(arguments)

    def set_camera(self, **arguments: Any) -> None:
        """As SceneBuilder.set_camera."""
        self._builder.set_camera(**arguments)
        self._camera = _own(arguments)
        self._motion["camera"], self._shutter = {}, None

    def set_mesh_motion(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_mesh_motion."""
        self._builder.set_mesh_motion(key, **arguments)
        self._motion["mesh"][key] = _own(arguments)

    def set_instance_motion(self, key: str, **arguments: Any) -> None:
        """As SceneBuilder.set_instance_motion."""
        self._builder.set_instance_motion(key, **arguments)
        self._motion["instance"][key] = _own(arguments)

    def set_camera_motion(self, **arguments: Any) -> None:
        """As SceneBuilder.set_camera_motion."""
        self._builder.set_camera_motion(**arguments)
        self._motion["camera"][_CAMERA] = _own(arguments)

    def set_shutter(self, openness: Any) -> None:
        """As SceneBuilder.set_shutter."""
        self._builder.set_shutter(openness)
        self._shutter = [float(x) for x in openness]

    def remove(self, key: str) -> None:
        """As SceneBuilder.remove."""
        self._builder.remove(key)
        for items in (*self._items.values(), *self._motion.values()):
            items.pop(key, None)

    def commit(self, poll: Callable[[], object] | None = None) -> Scene:
        """As SceneBuilder.commit."""
        return self._builder.commit(poll=poll)

    def save(self, path: str | os.PathLike[str], settings: RenderSettings) -> None:
        """Writes the scene as it is now, and how to render it, to a .npz file.

        The file appears when it is complete. Raises IoError, which names it.
        """
        description, arrays = self._describe()
        description["settings"] = settings.to_dict()
        write(path, "scene.json", description, arrays)

    def _set(self, kind: str, key: str, arguments: dict[str, Any]) -> Any:
        result = getattr(self._builder, f"set_{kind}")(key, **arguments)
        self._items[kind][key] = _own(arguments)
        # Of what was there before; curves and points have theirs among meshes.
        for moves in self._motion.values() if kind in _SHAPES else [self._motion.get(kind, {})]:
            moves.pop(key, None)
        return result

    def _describe(self) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
        """(what goes into scene.json, the arrays beside it)."""
        description: dict[str, Any] = {
            "format": FORMAT,
            "version": VERSION,
            "janus_core": __version__,
            "world": self._world,
            "camera": self._camera,
            "shutter": self._shutter,
        }
        arrays: dict[str, np.ndarray] = {}
        for kind, names in _ARRAYS.items():
            description[kind] = {}
            for number, (key, item) in enumerate(self._items[kind].items()):
                members = {name: f"{kind}/{number}/{name}" for name in names if name in item}
                for name, member in members.items():
                    if item[name] is not None:
                        arrays[member] = np.asarray(item[name])
                rest = {name: value for name, value in item.items() if name not in members}
                members = {name: member for name, member in members.items() if member in arrays}
                if "attributes" in rest:
                    rest["attributes"] = [dict(attribute) for attribute in rest["attributes"]]
                    for i, attribute in enumerate(rest["attributes"]):
                        if "values" in attribute:
                            member = f"{kind}/{number}/attributes/{i}"
                            arrays[member] = np.asarray(attribute["values"])
                            attribute["values"] = member
                description[kind][key] = {**rest, "arrays": members}
        for kind in ("material", "light"):
            description[kind] = self._items[kind]
        instances = self._items["instance"]
        description["instance"] = {
            key: {name: value for name, value in item.items() if name != "transform"}
            for key, item in instances.items()
        }
        if instances:
            arrays[_TRANSFORMS] = np.stack(
                [np.asarray(item["transform"], dtype=np.float64) for item in instances.values()]
            )
        description["motion"] = {
            kind: {
                key: {
                    name: self._add(arrays, f"motion/{kind}/{number}/{name}", value)
                    for name, value in item.items()
                    if value is not None
                }
                for number, (key, item) in enumerate(items.items())
            }
            for kind, items in self._motion.items()
        }
        return description, arrays

    @staticmethod
    def _add(arrays: dict[str, np.ndarray], member: str, value: Any) -> str:
        arrays[member] = np.asarray(value)
        return member


def load(path: str | os.PathLike[str]) -> tuple[SceneBuilder, RenderSettings]:
    """The scene and the settings of a capture.

    Raises IoError, which names the file, for what is no capture or a damaged one; SceneError for
    a scene that SceneBuilder refuses.
    """
    name = os.fspath(path)
    with reading(name, "a capture of Janus", "scene.json", FORMAT) as (description, archive):
        if description.get("version") not in range(1, VERSION + 1):
            raise IoError(
                f"cannot read {name}: it has version {description.get('version')} of the "
                f"format, this is janus_core {__version__} for version {VERSION}"
            )
        return _build(description, archive)


def _build(
    description: dict[str, Any], archive: zipfile.ZipFile
) -> tuple[SceneBuilder, RenderSettings]:
    builder = SceneBuilder()
    for kind in _ARRAYS:
        for key, item in description.get(kind, {}).items():
            arrays = {
                name: read_array(archive, member) for name, member in item.pop("arrays").items()
            }
            optional = {name: None for name in _ARRAYS[kind][2:]}
            for attribute in item.get("attributes", ()):
                if "values" in attribute:
                    attribute["values"] = read_array(archive, attribute["values"])
            getattr(builder, f"set_{kind}")(key, **optional | item | arrays)
    for kind in ("material", "light"):
        for key, item in description[kind].items():
            getattr(builder, f"set_{kind}")(key, **item)
    instances = description["instance"]
    transforms = read_array(archive, _TRANSFORMS) if instances else ()
    for (key, item), transform in zip(instances.items(), transforms, strict=True):
        builder.set_instance(key, transform=transform, **item)
    if description["world"] is not None:
        builder.set_world(**description["world"])
    if description["camera"] is not None:
        builder.set_camera(**description["camera"])
    for kind, items in description.get("motion", {}).items():
        for key, members in items.items():
            values = {name: read_array(archive, member) for name, member in members.items()}
            of_key = () if kind == "camera" else (key,)
            getattr(builder, f"set_{kind}_motion")(*of_key, **values)
    if description.get("shutter") is not None:
        builder.set_shutter(description["shutter"])
    settings = dict(description["settings"])
    if settings.get("crop") is not None:
        settings["crop"] = tuple(settings["crop"])
    for name in ("expressions", "aovs"):
        if name in settings:
            settings[name] = [tuple(pair) for pair in settings[name]]
    return builder, RenderSettings(**settings)


def _own(value: Any) -> Any:
    """A deep copy, with arrays as they are and every other sequence as a list."""
    if isinstance(value, np.ndarray):
        return value.copy()
    if isinstance(value, dict):
        return {key: _own(item) for key, item in value.items()}
    if value is None or isinstance(value, str | int | float | np.generic):
        return value
    return [_own(item) for item in value]
