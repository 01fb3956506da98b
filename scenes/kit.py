# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers for the scenes in this folder: materials, meshes, lights and a camera through bpy.

Everything is made from plain objects and Cycles nodes, in metres and watts, so that a scene built
here can be saved, opened by an artist and rendered by any engine that reads Cycles materials.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Sequence

import bpy
from mathutils import Matrix, Vector

Color = tuple[float, float, float]
Point2 = tuple[float, float]
Point3 = tuple[float, float, float]

BOUNCES = ("max", "diffuse", "glossy", "transmission")


# ---------------------------------------------------------------------------------------------
# Scene
# ---------------------------------------------------------------------------------------------


def clear(scene: bpy.types.Scene) -> None:
    """Remove every object of the scene and what nothing else uses."""
    for item in list(scene.objects):
        bpy.data.objects.remove(item, do_unlink=True)
    bpy.data.orphans_purge(do_recursive=True)


def neutral_settings(scene: bpy.types.Scene, width: int, height: int, samples: int = 128) -> None:
    """Render settings that change nothing about the light: no clamps, no denoising, no tricks."""
    render = scene.render
    render.resolution_x, render.resolution_y = width, height
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1.0
    render.use_border = False
    render.film_transparent = False
    render.use_compositing = False
    render.use_sequencer = False
    render.use_motion_blur = False
    if hasattr(scene, "cycles"):
        unbiased_cycles(scene.cycles)
        _set(scene.cycles, samples=samples)
        limit_bounces(scene.cycles, 12)
        _set(scene.cycles, transparent_max_bounces=8)
        _set(scene.cycles, pixel_filter_type="BLACKMAN_HARRIS", filter_width=1.5)
    if hasattr(scene, "janus"):
        _set(scene.janus, samples=samples, time_limit=0.0, transparent_max_bounces=8)
        limit_bounces(scene.janus, 12)
        _set(scene.janus, pixel_filter_type="BLACKMAN_HARRIS", filter_width=1.5)


def limit_bounces(settings: bpy.types.PropertyGroup, most: int) -> None:
    """Of an engine, scene.cycles or scene.janus: of all bounces and of each kind."""
    _set(settings, **{f"{kind}_bounces": most for kind in BOUNCES})


def unbiased_cycles(cycles: bpy.types.PropertyGroup) -> None:
    """Switches off what makes Cycles' picture differ from the light in the scene."""
    _set(
        cycles,
        use_adaptive_sampling=False,
        use_denoising=False,
        time_limit=0.0,
        sample_clamp_direct=0.0,
        sample_clamp_indirect=0.0,
        caustics_reflective=True,
        caustics_refractive=True,
        blur_glossy=0.0,
        light_sampling_threshold=0.0,
        use_guiding=False,
    )


def _set(owner: object, **values: object) -> None:
    """Sets the properties that this version of Blender has."""
    for name, value in values.items():
        with contextlib.suppress(AttributeError, TypeError):
            setattr(owner, name, value)


def view(scene: bpy.types.Scene, transform: str, look: str = "None", exposure: float = 0.0) -> None:
    """How the linear picture becomes a PNG; names that this Blender lacks are passed over."""
    settings = scene.view_settings
    with contextlib.suppress(TypeError):
        settings.view_transform = transform
    with contextlib.suppress(TypeError):
        settings.look = look
    settings.exposure = exposure
    settings.gamma = 1.0


def world(scene: bpy.types.Scene, color: Color = (0.0, 0.0, 0.0), strength: float = 1.0) -> None:
    """A world of one colour. Black means no light from outside at all."""
    data = bpy.data.worlds.new("World")
    tree = _node_tree(data)
    tree.nodes.clear()
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value = (*color, 1.0)
    background.inputs["Strength"].default_value = strength
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs["Background"], output.inputs["Surface"])
    scene.world = data


# ---------------------------------------------------------------------------------------------
# Materials
# ---------------------------------------------------------------------------------------------


def _node_tree(data: bpy.types.ID) -> bpy.types.NodeTree:
    if data.node_tree is None or not data.use_nodes:
        data.use_nodes = True  # always on from Blender 5 on
    return data.node_tree


def _material(name: str, node_type: str, socket: str, **inputs: object) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    tree = _node_tree(material)
    tree.nodes.clear()
    node = tree.nodes.new(node_type)
    for key, value in inputs.items():
        node.inputs[key].default_value = value
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    output.location = (300.0, 0.0)
    tree.links.new(node.outputs[socket], output.inputs["Surface"])
    return material


def diffuse(name: str, color: Color) -> bpy.types.Material:
    material = _material(name, "ShaderNodeBsdfDiffuse", "BSDF", Color=(*color, 1.0), Roughness=0.0)
    material.diffuse_color = (*color, 1.0)
    return material


def glass(name: str, color: Color = (1.0, 1.0, 1.0), ior: float = 1.5) -> bpy.types.Material:
    """Smooth, clear glass. For a solid body the mesh must be closed, with outward normals."""
    return _material(
        name, "ShaderNodeBsdfGlass", "BSDF", Color=(*color, 1.0), Roughness=0.0, IOR=ior
    )


def metal(name: str, color: Color) -> bpy.types.Material:
    """A perfect mirror of the given colour."""
    return _material(name, "ShaderNodeBsdfAnisotropic", "BSDF", Color=(*color, 1.0), Roughness=0.0)


def emission(name: str, color: Color, strength: float) -> bpy.types.Material:
    """Radiance color * strength, to both sides of the surface."""
    return _material(name, "ShaderNodeEmission", "Emission", Color=(*color, 1.0), Strength=strength)


def shader(
    name: str, kind: str, distribution: str | None = None, **inputs: object
) -> bpy.types.Material:
    """Any one shader node: `kind` is its type without "ShaderNode", inputs go by their names."""
    socket = "Emission" if kind == "Emission" else "BSDF"
    material = _material(name, f"ShaderNode{kind}", socket, **inputs)
    if distribution is not None:
        _node_tree(material).nodes[0].distribution = distribution
    return material


def combined(
    name: str, kind: str, first: bpy.types.Material, second: bpy.types.Material
) -> bpy.types.Material:
    """Two materials of one node each under a MixShader (half and half) or an AddShader."""
    material = bpy.data.materials.new(name)
    tree = _node_tree(material)
    tree.nodes.clear()
    top = tree.nodes.new(f"ShaderNode{kind}")
    shaders = [socket for socket in top.inputs if socket.type == "SHADER"]
    for part, socket in zip((first, second), shaders, strict=True):
        source = next(n for n in _node_tree(part).nodes if n.type != "OUTPUT_MATERIAL")
        node = tree.nodes.new(source.bl_idname)
        if hasattr(source, "distribution"):
            node.distribution = source.distribution
        for given, own in zip(source.inputs, node.inputs, strict=True):
            if hasattr(given, "default_value"):
                own.default_value = given.default_value
        tree.links.new(node.outputs[0], socket)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(top.outputs[0], output.inputs["Surface"])
    return material


# ---------------------------------------------------------------------------------------------
# Meshes
# ---------------------------------------------------------------------------------------------


def mesh_object(
    scene: bpy.types.Scene,
    name: str,
    vertices: Sequence[Point3],
    faces: Sequence[Sequence[int]],
    material: bpy.types.Material | None,
    smooth: bool = False,
) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    if material is not None:
        mesh.materials.append(material)
    mesh.validate()
    mesh.update()
    item = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(item)
    return item


def box(
    scene: bpy.types.Scene, name: str, size: Point3, material: bpy.types.Material | None
) -> bpy.types.Object:
    """A box that stands on z = 0 around the origin."""
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    vertices = [(sx * x, sy * y, sz) for sz in (0.0, z) for sy in (-1, 1) for sx in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return mesh_object(scene, name, vertices, faces, material)


def quad(
    scene: bpy.types.Scene,
    name: str,
    corners: Sequence[Point3],
    material: bpy.types.Material | None,
) -> bpy.types.Object:
    """Four corners, counter-clockwise as seen from the front."""
    return mesh_object(scene, name, corners, [(0, 1, 2, 3)], material)


def lathe(
    scene: bpy.types.Scene,
    name: str,
    profile: Sequence[Point2],
    material: bpy.types.Material | None,
    segments: int = 192,
    shape: Callable[[int, float, float, float], float] | None = None,
) -> bpy.types.Object:
    """Turn a profile of (radius, height) about z into a smooth body.

    Normals point outward if the profile runs from the bottom of the outer side upward. Points of
    radius 0 become poles; a profile whose last point is its first makes a torus-like ring.
    `shape(row, radius, height, angle)` gives another radius for point `row` of the profile, for
    flutes and facets.
    """
    ring = profile[0] == profile[-1]
    points = list(profile[:-1] if ring else profile)
    vertices: list[Point3] = []
    rows: list[list[int]] = []
    for row, (radius, height) in enumerate(points):
        if radius <= 0.0:
            rows.append([len(vertices)] * segments)
            vertices.append((0.0, 0.0, height))
            continue
        rows.append([len(vertices) + i for i in range(segments)])
        for i in range(segments):
            angle = 2.0 * math.pi * i / segments
            r = shape(row, radius, height, angle) if shape else radius
            vertices.append((r * math.cos(angle), r * math.sin(angle), height))
    faces = []
    for lower, upper in zip(rows, rows[1:] + ([rows[0]] if ring else []), strict=False):
        for i in range(segments):
            j = (i + 1) % segments
            face = dict.fromkeys((lower[i], lower[j], upper[j], upper[i]))
            faces.append(tuple(face))
    return mesh_object(scene, name, vertices, faces, material, smooth=True)


def spline(points: Sequence[Point2], steps: int) -> list[Point2]:
    """A smooth curve through the points (centripetal Catmull-Rom), `steps` pieces per span."""
    nodes = [Vector(p) for p in points]
    first, last = 2 * nodes[0] - nodes[1], 2 * nodes[-1] - nodes[-2]
    nodes = [first, *nodes, last]
    curve: list[Point2] = []
    for p0, p1, p2, p3 in zip(nodes, nodes[1:], nodes[2:], nodes[3:], strict=False):
        t0 = 0.0
        t1 = t0 + max(math.sqrt((p1 - p0).length), 1e-9)
        t2 = t1 + max(math.sqrt((p2 - p1).length), 1e-9)
        t3 = t2 + max(math.sqrt((p3 - p2).length), 1e-9)
        for i in range(steps):
            t = t1 + (t2 - t1) * i / steps
            a1 = p0 * ((t1 - t) / (t1 - t0)) + p1 * ((t - t0) / (t1 - t0))
            a2 = p1 * ((t2 - t) / (t2 - t1)) + p2 * ((t - t1) / (t2 - t1))
            a3 = p2 * ((t3 - t) / (t3 - t2)) + p3 * ((t - t2) / (t3 - t2))
            b1 = a1 * ((t2 - t) / (t2 - t0)) + a2 * ((t - t0) / (t2 - t0))
            b2 = a2 * ((t3 - t) / (t3 - t1)) + a3 * ((t - t1) / (t3 - t1))
            point = b1 * ((t2 - t) / (t2 - t1)) + b2 * ((t - t1) / (t2 - t1))
            curve.append((point.x, point.y))
    curve.append((points[-1][0], points[-1][1]))
    return curve


def sphere(
    scene: bpy.types.Scene,
    name: str,
    radius: float,
    material: bpy.types.Material | None,
    segments: int = 128,
) -> bpy.types.Object:
    """A smooth sphere about the origin."""
    rings = segments // 2
    profile = [
        (radius * math.sin(math.pi * i / rings), -radius * math.cos(math.pi * i / rings))
        for i in range(rings + 1)
    ]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    return lathe(scene, name, profile, material, segments)


# ---------------------------------------------------------------------------------------------
# Lights and camera
# ---------------------------------------------------------------------------------------------


def aim(eye: Point3, target: Point3) -> Matrix:
    """The transform of a camera or lamp at `eye` that looks (down its -z) at `target`."""
    forward = Vector(target) - Vector(eye)
    return Matrix.Translation(eye) @ forward.to_track_quat("-Z", "Y").to_matrix().to_4x4()


def area_light(
    scene: bpy.types.Scene,
    name: str,
    eye: Point3,
    target: Point3,
    size: Point2,
    watts: float,
    color: Color = (1.0, 1.0, 1.0),
    seen: bool = False,
    spread: float = 180.0,
) -> bpy.types.Object:
    """A rectangular lamp that shines from `eye` to `target`.

    `seen`: the camera sees it; `spread`: full angle of its beam in degrees.
    """
    light = bpy.data.lights.new(name, "AREA")
    light.shape = "RECTANGLE"
    light.size, light.size_y = size
    light.energy = watts
    light.color = color
    light.spread = math.radians(spread)
    item = bpy.data.objects.new(name, light)
    # Rounded angles, because Blender's versions take a matrix apart with other last digits.
    item.location = eye
    item.rotation_euler = [round(angle, 4) for angle in aim(eye, target).to_euler()]
    item.visible_camera = seen
    scene.collection.objects.link(item)
    return item


def camera(
    scene: bpy.types.Scene,
    eye: Point3,
    target: Point3,
    lens: float = 50.0,
    clip: Point2 = (0.01, 100.0),
) -> bpy.types.Object:
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    data.sensor_width = 36.0
    data.clip_start, data.clip_end = clip
    item = bpy.data.objects.new("Camera", data)
    item.matrix_world = aim(eye, target)
    scene.collection.objects.link(item)
    scene.camera = item
    return item
