# SPDX-License-Identifier: GPL-3.0-or-later
"""Captured scenes that are so plain that any renderer can be given exactly the same.

Diffuse, smooth glass, closed bodies that glow, a world of one colour and a pinhole: they mean the
same everywhere. Anything else is refused (NotPlain). Needs NumPy alone, as it runs in the
processes of other renderers.
"""

from __future__ import annotations

import json
import math
import zipfile
from dataclasses import dataclass

import numpy as np

Color = tuple[float, float, float]


class NotPlain(Exception):
    """What another renderer would not understand as Cycles does."""


@dataclass
class Surface:
    kind: str  # "diffuse", "glass" or "emission"
    color: Color  # reflectance, or radiance
    ior: float = 1.5


@dataclass
class Body:
    """Triangles in world space, with a surface; normals are None where they are flat."""

    positions: np.ndarray  # [V, 3] float32, one for each corner
    triangles: np.ndarray  # [T, 3] int32, counter-clockwise from the front
    normals: np.ndarray | None
    surface: Surface


@dataclass
class PlainScene:
    bodies: list[Body]
    world: Color
    eye: np.ndarray
    forward: np.ndarray
    up: np.ndarray
    field_of_view: float  # of the width and the height, degrees
    size: int  # pixels of a side
    max_bounces: int


def load(path: str) -> PlainScene:
    with zipfile.ZipFile(path) as file:
        scene = json.loads(file.read("scene.json"))
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files if name != "scene.json"}
    if scene["light"]:
        raise NotPlain("a lamp: what arrives at one passes in Cycles and is absorbed elsewhere")
    surfaces = {key: _surface(item) for key, item in scene["material"].items()}
    bodies = []
    for number, instance in enumerate(scene["instance"].values()):
        mesh = scene["mesh"][instance["mesh"]]["arrays"]
        mesh = {name: arrays[member] for name, member in mesh.items()}
        transform = arrays["instance_transforms"][number]
        bodies += _bodies(mesh, transform, [surfaces[key] for key in instance["materials"]])
    camera, settings = scene["camera"], scene["settings"]
    window = camera["window"]
    if camera["type"] != "PERSP" or camera.get("aperture_radius") or -window[0] != window[1]:
        raise NotPlain("a camera that is no pinhole, or shifted")
    matrix = np.array(camera["transform"])
    return PlainScene(
        *(bodies, _world(scene["world"]), matrix[:3, 3], -matrix[:3, 2], matrix[:3, 1]),
        *(math.degrees(2 * math.atan(window[1])), settings["width"], settings["max_bounces"]),
    )


def _surface(material: dict) -> Surface:
    nodes = material["graph"]["nodes"]
    node = nodes[0]
    inputs = node["inputs"]
    if len(nodes) != 1 or inputs.get("Roughness", 0.0) != 0.0:
        raise NotPlain(f"material '{material['name']}'")
    kinds = {"BSDF_DIFFUSE": "diffuse", "BSDF_GLASS": "glass"}
    color = tuple(inputs["Color"][:3]) if "Color" in inputs else ()
    if node["type"] == "EMISSION":
        return Surface("emission", tuple(c * inputs["Strength"] for c in color))
    if node["type"] not in kinds:
        raise NotPlain(f"material '{material['name']}': {node['type']}")
    return Surface(kinds[node["type"]], color, inputs.get("IOR", 1.5))


def _bodies(mesh: dict, transform: np.ndarray, surfaces: list[Surface]) -> list[Body]:
    matrix = np.vstack([np.asarray(transform, dtype=float).reshape(-1, 4)[:3], (0, 0, 0, 1)])
    corners = mesh["corner_vertices"]
    positions = mesh["positions"][corners] @ matrix[:3, :3].T + matrix[:3, 3]
    normals = mesh.get("corner_normals")
    if normals is None and "vertex_normals" in mesh:
        normals = mesh["vertex_normals"][corners]
    if normals is not None:
        normals = normals @ np.linalg.inv(matrix[:3, :3])
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        normals = np.ascontiguousarray(normals, dtype=np.float32)
    triangles = mesh["triangles"].astype(np.int32)
    which = mesh.get("material_indices", np.zeros(len(triangles), dtype=int))
    bodies = []
    for number, surface in enumerate(surfaces):
        chosen = triangles[which == number]
        if len(chosen) == 0:
            continue
        if surface.kind == "emission" and not _closed(corners[chosen]):
            raise NotPlain("an open mesh that glows on both sides")
        shading = None if surface.kind == "emission" else normals  # Mitsuba's light would see them
        bodies.append(Body(positions.astype(np.float32), chosen, shading, surface))
    return bodies


def _closed(triangles: np.ndarray) -> bool:
    edges = {tuple(edge) for t in triangles for edge in (t[[0, 1]], t[[1, 2]], t[[2, 0]])}
    return all((b, a) in edges for a, b in edges)


def _world(world: dict | None) -> Color:
    if world is None:
        return (0.0, 0.0, 0.0)
    nodes = world["graph"]["nodes"]
    if len(nodes) != 1 or nodes[0]["type"] != "BACKGROUND":
        raise NotPlain("a world that is not of one colour")
    inputs = nodes[0]["inputs"]
    return tuple(c * inputs["Strength"] for c in inputs["Color"][:3])
