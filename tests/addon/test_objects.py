# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects, instances and meshes as the exporter sends them, by a real F12 with a fake core."""

import bpy
import numpy as np
import pytest
from conftest import add_mesh, add_square, messages, new_material, part


def triangle_positions(mesh):
    """float[T, 3, 3]: the corners of each triangle, whatever the indexing."""
    return mesh["positions"][mesh["corner_vertices"][mesh["triangles"]]]


def with_modifier_group(obj, build):
    """Gives the object a Geometry Nodes modifier; build(tree, in, out) links it."""
    tree = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    build(tree, tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput"))
    obj.modifiers.new("Nodes", "NODES").node_group = tree


def test_square(scene, export):
    obj = add_square()
    obj.location = (1, 2, 3)
    recorder = export()
    assert list(recorder.by_name()) == ["Square"]
    mesh = recorder.mesh_of("Square")
    assert mesh["triangles"].shape == (2, 3) and mesh["triangles"].dtype == np.int32
    assert sorted(map(tuple, mesh["positions"])) == sorted(map(tuple, mesh["positions"].tolist()))
    edges = np.diff(triangle_positions(mesh), axis=1)
    area = 0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()
    assert area == pytest.approx(4.0)
    assert mesh["vertex_normals"] is None and mesh["corner_normals"] is None  # flat
    assert mesh["material_indices"] is None
    transform = recorder.by_name()["Square"]["transform"]
    assert transform.shape == (4, 4) and list(transform[:3, 3]) == [1, 2, 3]
    assert recorder.materials_of("Square") == []


def test_smooth_normals(scene, export):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    bpy.ops.object.shade_smooth()
    recorder = export()
    mesh = recorder.mesh_of("Sphere")
    normals = mesh["vertex_normals"]
    assert normals.shape == mesh["positions"].shape and normals.dtype == np.float32
    assert mesh["corner_normals"] is None
    assert (normals * mesh["positions"]).sum(axis=1).min() > 0.98


def test_sharp_faces_have_their_own_corner_normals(scene, export):
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    cube.data.polygons.foreach_set("use_smooth", [True] * 6)
    cube.data.polygons[0].use_smooth = False
    mesh = export().mesh_of("Cube")
    expected = cube.data.polygons[0].normal
    corners = list(cube.data.polygons[0].loop_indices)
    assert mesh["corner_normals"][corners] == pytest.approx(np.array([expected] * 4), abs=1e-6)


def test_pointer_to_triangles_equals_rna(scene):
    bpy.ops.mesh.primitive_monkey_add()
    mesh = bpy.context.object.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    mesh.calc_loop_triangles()
    code, count = part("sync.mesh"), len(mesh.loop_triangles)
    assert np.array_equal(code.triangles(mesh, count), code.triangles_by_rna(mesh, count))


def test_unexpected_memory_falls_back_to_rna(scene):
    """If a future Blender lays out its triangles differently, RNA is asked."""

    class Triangle:
        def __init__(self, address, loops):
            self.address, self.loops = address, loops

        def as_pointer(self):
            return self.address

    class Triangles(list):
        def foreach_get(self, name, values):
            values[:] = np.ravel([t.loops for t in self])

    class Mesh:
        pass

    memory = np.arange(6, dtype=np.int32)
    for stride in (12, 16):
        mesh = Mesh()
        address = memory.ctypes.data
        mesh.loop_triangles = Triangles(
            [Triangle(address, (7, 8, 9)), Triangle(address + stride, (3, 4, 5))]
        )
        found = part("sync.mesh").triangles(mesh, 2)
        assert found.tolist() == [[7, 8, 9], [3, 4, 5]]


def test_modifiers_are_evaluated_and_shared_data_is_shared(scene, export):
    first = add_square("First")
    twin = bpy.data.objects.new("Twin", first.data)
    changed = bpy.data.objects.new("Changed", first.data)
    for obj in (twin, changed):
        scene.collection.objects.link(obj)
    changed.modifiers.new("Array", "ARRAY").count = 3
    recorder = export()
    instances = recorder.by_name()
    assert instances["First"]["mesh"] == instances["Twin"]["mesh"]
    assert instances["First"]["mesh"] != instances["Changed"]["mesh"]
    assert len(recorder.mesh_of("Changed")["triangles"]) == 6
    assert len(recorder.meshes) == 2


def test_every_surface_type(scene, export):
    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.data.bevel_depth = 0.1
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    bpy.ops.object.text_add()
    bpy.ops.object.metaball_add()
    recorder = export()
    assert len(recorder.instances) == 5, sorted(recorder.by_name())
    assert len(recorder.meshes) == 5
    assert all(len(mesh["triangles"]) for mesh in recorder.meshes.values())


def test_texts_that_share_data_but_not_modifiers(scene, export):
    bpy.ops.object.text_add()
    plain = bpy.context.object
    bevelled = bpy.data.objects.new("Subdivided", plain.data)
    scene.collection.objects.link(bevelled)
    bevelled.modifiers.new("Subdivision", "SUBSURF").render_levels = 2
    recorder = export()
    counts = {name: len(recorder.mesh_of(name)["triangles"]) for name in recorder.by_name()}
    assert counts["Subdivided"] > counts["Text"] > 0


def test_things_without_surface_are_ignored(scene, export):
    for kind in ("EMPTY", "ARMATURE", "LATTICE", "SPEAKER"):
        if kind == "EMPTY":
            bpy.ops.object.empty_add()
        elif kind == "ARMATURE":
            bpy.ops.object.armature_add()
        else:
            bpy.ops.object.add(type=kind)
    add_mesh("Nothing", [], [])
    add_mesh("Points", [(0, 0, 0)], [])
    bpy.ops.curve.primitive_bezier_curve_add()  # a curve without thickness
    assert export().instances == {}
    assert messages() == []


def test_hidden_things_stay_out(scene, export):
    for name in ("Shown", "No render", "In hidden collection", "Excluded"):
        add_square(name)
    bpy.data.objects["No render"].hide_render = True
    for name, attribute in (("In hidden collection", "hide_render"), ("Excluded", None)):
        collection = bpy.data.collections.new(name)
        scene.collection.children.link(collection)
        collection.objects.link(bpy.data.objects[name])
        scene.collection.objects.unlink(bpy.data.objects[name])
        if attribute:
            setattr(collection, attribute, True)
        else:
            scene.view_layers[0].layer_collection.children[name].exclude = True
    bpy.data.objects["Shown"].hide_viewport = False
    assert list(export().by_name()) == ["Shown"]


def test_collection_instances(scene, export):
    hidden = bpy.data.collections.new("Prototypes")
    square = add_square()
    scene.collection.objects.unlink(square)
    hidden.objects.link(square)
    for x in (1.0, 2.0, 3.0):
        empty = bpy.data.objects.new(f"Empty {x}", None)
        empty.instance_type = "COLLECTION"
        empty.instance_collection = hidden
        empty.location.x = x
        scene.collection.objects.link(empty)
    recorder = export()
    places = sorted(item["transform"][0, 3] for item in recorder.instances.values())
    assert places == [1.0, 2.0, 3.0]
    assert len(recorder.meshes) == 1


def test_vertex_instancer_hides_itself(scene, export):
    parent, child = (
        add_square("Parent"),
        add_mesh("Child", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]),
    )
    child.parent = parent
    parent.instance_type = "VERTS"
    parent.show_instancer_for_render = False
    names = [item["name"] for item in export().instances.values()]
    assert names.count("Child") >= 4 and "Parent" not in names
    parent.show_instancer_for_render = True
    assert "Parent" in export().by_name()


def test_particles_are_instances_of_one_mesh(scene, export):
    grain = add_square("Grain")
    grain.hide_render = True  # the particles show it all the same
    emitter = add_square("Emitter")
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end = 7, 1.0, 1.0
    settings.physics_type = "NO"
    settings.render_type, settings.instance_object = "OBJECT", grain
    emitter.show_instancer_for_render = False
    scene.frame_set(10)
    recorder = export()
    assert [item["name"] for item in recorder.instances.values()] == ["Grain"] * 7
    assert len(recorder.meshes) == 1
    places = {tuple(item["transform"][:3, 3]) for item in recorder.instances.values()}
    assert len(places) == 7


def test_geometry_nodes_instances_carry_other_data(scene, export):
    """Instances made by nodes bear the maker's name: geometry must go by data."""

    def build(tree, group_in, group_out):
        join = tree.nodes.new("GeometryNodeJoinGeometry")
        for kind in ("GeometryNodeMeshCube", "GeometryNodeMeshUVSphere"):
            made = tree.nodes.new(kind)
            instances = tree.nodes.new("GeometryNodeInstanceOnPoints")
            tree.links.new(group_in.outputs[0], instances.inputs["Points"])
            tree.links.new(made.outputs["Mesh"], instances.inputs["Instance"])
            tree.links.new(instances.outputs[0], join.inputs[0])
        tree.links.new(group_in.outputs[0], join.inputs[0])
        tree.links.new(join.outputs[0], group_out.inputs[0])

    with_modifier_group(add_square("Maker"), build)
    recorder = export()
    used = [item["mesh"] for item in recorder.instances.values()]
    assert len(used) == 9 and len(recorder.meshes) == 3
    assert sorted(used.count(key) for key in recorder.meshes) == [1, 4, 4]
    sizes = sorted(len(mesh["triangles"]) for mesh in recorder.meshes.values())
    assert sizes[:2] == [2, 12] and sizes[2] > 100


def test_geometry_nodes_material_without_slot(scene, export):
    def build(tree, group_in, group_out):
        node = tree.nodes.new("GeometryNodeSetMaterial")
        node.inputs["Material"].default_value = new_material("From nodes")
        tree.links.new(group_in.outputs[0], node.inputs["Geometry"])
        tree.links.new(node.outputs[0], group_out.inputs[0])

    with_modifier_group(add_square(), build)
    assert export().materials_of("Square")[-1] == "From nodes"


def test_materials_by_slot(scene, export):
    obj = add_mesh(
        "Strip",
        [(x, y, 0) for x in range(5) for y in (0, 1)],
        [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(4)],
    )
    of_data, of_object = new_material("Of data"), new_material("Of object")
    for material in (of_data, None, of_data):
        obj.data.materials.append(material)
    obj.material_slots[2].link = "OBJECT"
    obj.material_slots[2].material = of_object
    # from Blender's point of view 7 is out of range: it uses the last slot
    obj.data.polygons.foreach_set("material_index", [0, 1, 2, 7])
    recorder = export()
    assert recorder.materials_of("Strip") == ["Of data", None, "Of object"]
    assert list(recorder.mesh_of("Strip")["material_indices"]) == [0, 0, 1, 1, 2, 2, 2, 2]
    assert len(recorder.materials) == 2


def test_material_override(scene, export):
    add_square("Bare")
    add_square("Dressed").data.materials.append(new_material("Dress"))
    scene.view_layers[0].material_override = new_material("Clay")
    recorder = export()
    assert recorder.materials_of("Bare") == recorder.materials_of("Dressed") == ["Clay"]
