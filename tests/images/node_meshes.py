# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tiles of node_scenes.py are made of: meshes with all that nodes read, and instancers."""

from __future__ import annotations

import numpy as np

SUBDIVISIONS = 6


def tile_mesh():
    """A square from -1 to 1, wavy and smooth, with maps and attributes of every kind."""
    import bpy

    n = SUBDIVISIONS
    x, y = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij")
    z = 0.25 * np.sin(2.0 * x + 0.4) * np.cos(1.7 * y)
    points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).reshape(-1)
    faces = np.stack([corner, corner + n + 1, corner + n + 2, corner + 1], axis=-1)
    mesh = bpy.data.meshes.new("Tile")
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    mesh.shade_smooth()
    loops = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("vertex_index", loops)
    flat = 0.5 + 0.5 * points[loops, :2]
    turned = 0.5 + 0.35 * (flat - 0.5) @ np.array([[0.8, 0.6], [-0.6, 0.8]])
    mesh.uv_layers.new(name="UVMap").uv.foreach_set("vector", flat.astype(np.float32).ravel())
    mesh.uv_layers.new(name="Spare UV").uv.foreach_set("vector", turned.astype(np.float32).ravel())
    mesh.uv_layers["UVMap"].active_render = True
    random = np.random.default_rng(3)

    def attribute(name, kind, domain, field, channels, values=None):
        data = mesh.attributes.new(name, kind, domain).data
        if values is None:
            values = random.uniform(0.0, 1.0, len(data) * channels).astype(np.float32)
        data.foreach_set(field, values)

    vertices, polygons = len(mesh.vertices), len(mesh.polygons)
    attribute("Float", "FLOAT", "POINT", "value", 1)
    attribute("Int", "INT", "POINT", "value", 1, np.arange(vertices, dtype=np.int32) % 5)
    attribute("Bool", "BOOLEAN", "FACE", "value", 1, np.arange(polygons) % 2 == 0)
    attribute("Vector", "FLOAT_VECTOR", "POINT", "vector", 3)
    attribute("Color", "FLOAT_COLOR", "POINT", "color", 4)
    attribute("Byte", "BYTE_COLOR", "CORNER", "color", 4)
    attribute("Face", "FLOAT", "FACE", "value", 1)
    attribute("Corner", "FLOAT_VECTOR", "CORNER", "vector", 3)
    edges = len(mesh.edges)
    attribute("Edge", "FLOAT", "EDGE", "value", 1)
    attribute("Edge Int", "INT", "EDGE", "value", 1, np.arange(edges, dtype=np.int32) % 7 - 3)
    attribute("Edge Bool", "BOOLEAN", "EDGE", "value", 1, np.arange(edges) % 5 == 0)
    attribute("Edge Byte", "BYTE_COLOR", "EDGE", "color", 4)
    attribute("Pair", "FLOAT2", "POINT", "vector", 2)
    attribute("Int8", "INT8", "POINT", "value", 1, np.arange(vertices, dtype=np.int32) % 9)
    attribute("Turn", "QUATERNION", "POINT", "value", 4)
    attribute("Ints", "INT32_2D", "POINT", "value", 2, np.ones(2 * vertices, dtype=np.int32))
    mesh.materials.append(None)  # the slot that objects fill
    mesh.color_attributes.render_color_index = mesh.color_attributes.find("Byte")
    return mesh


def pieces_mesh(mesh):
    """The same in pieces: sharp edges, faces of many corners, islands."""
    import bmesh

    mesh = mesh.copy()
    mesh.name = "Pieces"
    work = bmesh.new()
    work.from_mesh(mesh)
    work.faces.ensure_lookup_table()
    first = work.faces[0]
    bmesh.ops.dissolve_faces(work, faces=[first, work.faces[1], work.faces[2]])
    work.faces.ensure_lookup_table()
    bmesh.ops.split(work, geom=[f for f in work.faces if f.calc_center_median().y > 0.4])
    for edge in work.edges:
        edge.smooth = abs(edge.verts[0].co.x) > 0.01 or abs(edge.verts[1].co.x) > 0.01
    work.to_mesh(mesh)
    work.free()
    mesh.uv_layers["UVMap"].active_render = True
    return mesh


def add_properties(scene, obj, number):
    """What Attribute nodes find elsewhere than on meshes."""
    obj["Number"], obj["Whole"], obj["Yes"] = 0.1 + 0.01 * (number % 7), 3, True
    obj["Two"], obj["Four"], obj["Five"] = [0.1, 0.2], [0.9, 0.2, 0.3, 0.4], [0.1] * 5
    obj["Text"] = obj["Both"] = "text"
    obj.data["Both"] = 0.7
    layer = scene.view_layers[0]
    layer["Layer"], scene["Scene"], scene.world["World"] = 0.25, [0.1, 0.6, 0.2], 0.75
    layer["Both"], scene["Both"] = 0.4, 0.6


def instances_by_nodes(obj):
    """A mesh whose Geometry Nodes show the object twice, the second time where the mesh is, and
    store a number on each instance.
    """
    import bpy

    mesh = bpy.data.meshes.new("Points")
    mesh.from_pydata([(0, 0, -50), (0, 0, 0)], [], [])
    maker = bpy.data.objects.new(f"Maker of {obj.name}", mesh)
    tree = bpy.data.node_groups.new("Instances", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    start, end, show, source, store, index, scaled = (
        tree.nodes.new(kind)
        for kind in (
            *("NodeGroupInput", "NodeGroupOutput", "GeometryNodeInstanceOnPoints"),
            *("GeometryNodeObjectInfo", "GeometryNodeStoreNamedAttribute"),
            *("GeometryNodeInputIndex", "ShaderNodeMath"),
        )
    )
    source.inputs["Object"].default_value = obj
    source.inputs["As Instance"].default_value = True
    store.domain, store.inputs["Name"].default_value = "INSTANCE", "Stored"
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value, scaled.inputs[2].default_value = 0.4, 0.3
    value = next(s for s in store.inputs if s.name == "Value" and s.enabled)
    for output, socket in (
        (start.outputs[0], show.inputs["Points"]),
        (source.outputs["Geometry"], show.inputs["Instance"]),
        (show.outputs[0], store.inputs["Geometry"]),
        (index.outputs[0], scaled.inputs[0]),
        (scaled.outputs[0], value),
        (store.outputs[0], end.inputs[0]),
    ):
        tree.links.new(output, socket)
    maker.modifiers.new("Instances", "NODES").node_group = tree
    return maker


def instanced(scene, obj, kind):
    """Shows the object by way of an instancer only; the instancer has properties, too."""
    import bpy

    if kind == "collection":
        maker = bpy.data.objects.new(f"Maker of {obj.name}", None)
        collection = bpy.data.collections.new(obj.name)
        collection.objects.link(obj)
        maker.instance_type, maker.instance_collection = "COLLECTION", collection
    elif kind == "nodes":
        maker = instances_by_nodes(obj)
        maker.location, obj.location = obj.location.copy(), (0, 0, 0)
        obj.hide_render = True
        scene.collection.objects.link(obj)
    else:
        mesh = bpy.data.meshes.new("Face")
        corners = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]
        mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
        mesh.uv_layers.new(name="UVMap").uv.foreach_set(
            "vector", [0.1, 0.2, 0.6, 0.3, 0.7, 0.9, 0.2, 0.8]
        )
        maker = bpy.data.objects.new(f"Maker of {obj.name}", mesh)
        maker.location, obj.location = obj.location.copy(), (0, 0, 0)
        maker.instance_type = "FACES"
        maker.show_instancer_for_render = False
        obj.parent = maker
        scene.collection.objects.link(obj)
    maker["Number"], maker["Maker"] = 0.8, 0.35
    scene.collection.objects.link(maker)
