# SPDX-License-Identifier: GPL-3.0-or-later
"""SceneBuilder: what it takes, what it refuses and how it says so."""

import threading
import time

import janus_core
import numpy as np
import pytest

from .conftest import IDENTITY, PLANE, fill, render, shader, sky, translation


def error_of(builder, method, *args, **arguments):
    with pytest.raises(janus_core.SceneError) as caught:
        getattr(builder, method)(*args, **arguments)
        builder.commit()
    return caught.value


def test_exceptions():
    for kind in (janus_core.SceneError, janus_core.IoError, janus_core.Cancelled):
        assert issubclass(kind, janus_core.Error)
    assert issubclass(janus_core.Error, Exception)


def test_counts(builder):
    builder.set_instance("second", name="Second", mesh="mesh", transform=translation(0, 0, -1))
    counts = builder.commit().counts
    assert counts == {
        "meshes": 1,
        "instances": 2,
        "triangles": 4,
        "round": 0,
        "materials": 1,
        "lights": 1,
        "meshes_built": 1,
        "shadow_catchers": 0,
    }


@pytest.mark.parametrize(
    ("part", "value"),
    [
        ("positions", np.zeros((4, 2))),
        ("positions", np.array([["a"] * 3])),
        ("triangles", np.zeros((2, 3), dtype=np.float32)),
        ("triangles", np.zeros(6, dtype=np.int32)),
        ("triangles", [[0, 1, 4]]),
        ("triangles", [[0, 1, -1]]),
        ("corner_vertices", [0, 1, 2, 9]),
        ("vertex_normals", np.zeros((3, 3))),
        ("corner_normals", np.zeros((3, 3))),
        ("material_indices", [0, 0, 0]),
    ],
)
def test_wrong_mesh_names_key_and_part(builder, part, value):
    error = error_of(builder, "set_mesh", "mesh", name="Floor", **{**PLANE, part: value})
    assert error.key == "mesh"
    assert error.path.startswith(part)
    assert error.message in str(error) and "mesh" in str(error)


def test_arrays_of_any_layout_give_the_same_scene(builder):
    expected = render(builder.commit()).snapshot()
    wide = np.zeros((4, 6), dtype=np.float64)
    wide[:, ::2] = PLANE["positions"]
    builder.set_mesh(
        "mesh",
        name="Floor",
        positions=wide[:, ::2],
        triangles=np.asfortranarray(PLANE["triangles"].astype(np.uint64)),
    )
    assert np.array_equal(render(builder.commit()).snapshot(), expected)
    builder.set_mesh("mesh", name="Floor", **{k: v.tolist() for k, v in PLANE.items()})
    assert np.array_equal(render(builder.commit()).snapshot(), expected)


def test_normals_of_vertices_and_of_corners_give_the_same_scene(builder):
    normals = np.array([[0.3, 0, 1], [0, 0.2, 1], [-0.3, 0, 1], [0, -0.2, 1]], dtype=np.float32)
    corners = np.array([2, 0, 1, 3, 2, 0], dtype=np.int32)
    common = {"name": "Floor", "positions": PLANE["positions"], "corner_vertices": corners}
    common["triangles"] = np.array([[1, 2, 0], [5, 4, 3]])
    flat = render(builder.commit()).snapshot()
    builder.set_mesh("mesh", **common, corner_normals=normals[corners])
    expected = render(builder.commit()).snapshot()
    assert not np.array_equal(expected, flat)
    builder.set_mesh("mesh", **common, vertex_normals=normals)
    assert np.array_equal(render(builder.commit()).snapshot(), expected)
    both = {"vertex_normals": normals, "corner_normals": normals[corners]}
    assert error_of(builder, "set_mesh", "mesh", **common, **both).path == "vertex_normals"


def test_arrays_are_copied(builder):
    positions = PLANE["positions"].copy()
    builder.set_mesh("mesh", name="Floor", positions=positions, triangles=PLANE["triangles"])
    expected = render(builder.commit()).snapshot()
    positions[:] = np.nan
    assert np.array_equal(render(builder.commit()).snapshot(), expected)


def test_triangles_that_are_not_finite_are_named(builder):
    positions = PLANE["positions"].copy()
    positions[3] = np.nan
    builder.set_mesh("mesh", name="Floor", positions=positions, triangles=PLANE["triangles"])
    scene = builder.commit()
    assert scene.counts["triangles"] == 1
    (found,) = scene.diagnostics
    assert (found.severity, found.object) == ("WARNING", "Floor")


def test_broken_references(builder):
    instance = {"name": "I", "transform": IDENTITY}
    assert error_of(builder, "set_instance", "i", mesh="none", **instance).path == "mesh"
    error = error_of(builder, "set_instance", "i", mesh="mesh", materials=["none"], **instance)
    assert (error.key, error.path) == ("i", "materials")


def test_matrices(builder):
    error = error_of(builder, "set_instance", "i", name="I", mesh="mesh", transform=np.eye(3))
    assert (error.key, error.path) == ("i", "transform")
    builder.set_instance("i", name="Flat", mesh="mesh", transform=np.diag([1.0, 0, 1, 1]))
    assert [d.object for d in builder.commit().diagnostics] == ["Flat"]


def test_no_camera():
    with pytest.raises(janus_core.SceneError) as caught:
        janus_core.SceneBuilder().commit()
    assert caught.value.key == "camera"


@pytest.mark.parametrize("window", [(0, 0, -1, 1), (-1, 1, np.nan, 1)])
def test_camera_without_a_window(builder, window):
    error = error_of(builder, "set_camera", name="Cam", transform=IDENTITY, window=window)
    assert error.key == "Cam"


def test_camera_type(builder):
    arguments = {"name": "Cam", "transform": IDENTITY, "window": (-1, 1, -1, 1)}
    with pytest.raises(ValueError, match="PERSP, ORTHO, EQUIRECTANGULAR"):
        builder.set_camera(type="PANO", **arguments)
    for kind in (
        "PERSP",
        "ORTHO",
        "EQUIRECTANGULAR",
        "FISHEYE_EQUIDISTANT",
        "FISHEYE_EQUISOLID",
        "FISHEYE_LENS_POLYNOMIAL",
        "MIRRORBALL",
        "EQUIANGULAR_CUBEMAP_FACE",
        "CENTRAL_CYLINDRICAL",
    ):
        builder.set_camera(type=kind, aperture_radius=0.1, aperture_blades=5, **arguments)
        builder.commit()


@pytest.mark.parametrize("fisheye", [{"fisheye_fov": 0.0}, {"fisheye_polynomial": (1, 0, 0, 0, 0)}])
def test_camera_with_an_impossible_fisheye(builder, fisheye):
    arguments = {"name": "Cam", "transform": IDENTITY, "window": (-1, 1, -1, 1)}
    arguments["type"] = "FISHEYE_LENS_POLYNOMIAL"
    assert error_of(builder, "set_camera", **arguments, **fisheye).path == "camera"


@pytest.mark.parametrize("lens", [{"aperture_radius": -1.0}, {"aperture_ratio": 0.0}])
def test_camera_with_an_impossible_lens(builder, lens):
    arguments = {"name": "Cam", "transform": IDENTITY, "window": (-1, 1, -1, 1)}
    assert error_of(builder, "set_camera", **arguments, **lens).path == "camera"


def test_wrong_words(builder):
    with pytest.raises(ValueError, match="POINT, SPOT, SUN, AREA"):
        builder.set_light("l", name="L", type="LASER", transform=IDENTITY)
    with pytest.raises(ValueError, match="ELLIPSE"):
        builder.set_light("l", name="L", type="AREA", transform=IDENTITY, shape="STAR")


@pytest.mark.parametrize(
    ("graph", "path"),
    [
        ({}, "graph"),
        ({"nodes": [3]}, "nodes[0]"),
        ({"nodes": [{"name": "A"}]}, "nodes[0]"),
        ({"nodes": [], "surface": {"link": ["A"]}}, "surface"),
        ({"nodes": [], "displacement": {"link": [1, "A"]}}, "displacement"),
        ({"nodes": [], "displacement": 3}, "displacement"),
        (shader("BSDF_DIFFUSE", Color=[1, 2]), "nodes[Shader].inputs[Color]"),
        (shader("BSDF_DIFFUSE", Roughness=10**400), "nodes[Shader].inputs[Roughness]"),
        (shader("BSDF_DIFFUSE", Color={"link": 3}), "nodes[Shader].inputs[Color]"),
        (shader("BSDF_DIFFUSE", Color=["a", "b", "c"]), "nodes[Shader].inputs[Color]"),
    ],
)
def test_wrong_graphs(builder, graph, path):
    error = error_of(builder, "set_material", "m", name="Paint", graph=graph)
    assert (error.key, error.path) == ("m", path)


def test_numbers_of_numpy(builder):
    expected = render(builder.commit()).snapshot()
    color = np.array([0.8, 0.5, 0.2, 1], dtype=np.float32)
    graph = shader("BSDF_DIFFUSE", Color=color, Roughness=np.float32(0))
    builder.set_material("m", name="Paint", graph=graph)
    assert np.array_equal(render(builder.commit()).snapshot(), expected)


def test_unsupported_is_named_not_fatal(builder):
    builder.set_material("m", name="Paint", graph=shader("BSDF_RAY_PORTAL"))
    builder.set_light("sun", name="Sun", type="SUN", transform=IDENTITY, energy=-1)
    found = builder.commit().diagnostics
    assert ("Paint", "Shader") in [(d.material, d.node) for d in found]
    assert "Sun" in [d.object for d in found]
    assert all(d.severity == "WARNING" and d.message for d in found)
    assert "Paint" in repr(found[0]) + repr(found[1])


@pytest.mark.parametrize("kind", [np.float32, np.float64, np.uint8])
def test_world_image(builder, kind):
    builder.remove("lamp")
    sky(builder, np.ones((2, 4, 4), dtype=kind))
    scene = builder.commit()
    assert scene.counts["lights"] == 1 and not scene.diagnostics
    # An open floor under a sky of 2 reflects its albedo.
    image = render(scene, samples=64).snapshot()
    assert image[8, 16, :3] == pytest.approx([1.6, 1.0, 0.4], rel=0.05)
    sky(builder, np.full((2, 4, 3), 0.5), srgb=True)
    darker = render(builder.commit(), samples=64).snapshot()
    assert darker[8, 16, 0] / image[8, 16, 0] == pytest.approx(0.2140, rel=0.01)


@pytest.mark.parametrize(
    "pixels",
    [np.zeros((2, 4)), np.zeros((2, 4, 2)), np.zeros((0, 4, 3)), np.zeros((2, 2, 3), "U1")],
)
def test_wrong_images(builder, pixels):
    error = error_of(builder, "set_image", "sky", name="Sky", pixels=pixels)
    assert (error.key, error.path) == ("sky", "pixels")


def test_cycle_in_a_graph_ends(builder):
    def add(name, a, b):
        inputs = {"Shader": {"link": [a, "Shader"]}, "Shader_001": {"link": [b, "Shader"]}}
        return {"name": name, "type": "ADD_SHADER", "inputs": inputs, "properties": {}}

    loop = {"nodes": [add("A", "A", "A")], "surface": {"link": ["A", "Shader"]}}
    wide = [add(str(i), str(i + 1), str(i + 1)) for i in range(60)]
    ladder = {"nodes": wide, "surface": {"link": ["0", "Shader"]}}
    for graph in (loop, ladder):
        builder.set_material("m", name="Paint", graph=graph)
        assert [d.material for d in builder.commit().diagnostics] == ["Paint"]


def test_remove_and_replace(builder):
    lit = render(builder.commit()).snapshot()
    assert lit[..., :3].max() > 0
    builder.remove("lamp")
    builder.remove("never there")
    assert render(builder.commit()).snapshot()[..., :3].max() == 0
    fill(builder)
    assert np.array_equal(render(builder.commit()).snapshot(), lit)


def large(builder, count=1_500_000):
    """A mesh that takes long enough to build for polling to be seen."""
    rng = np.random.default_rng(1)
    positions = rng.random((count, 3), dtype=np.float32)
    triangles = rng.integers(0, count, (count, 3), dtype=np.int32)
    builder.set_mesh("mesh", name="Large", positions=positions, triangles=triangles)


def test_poll_cancels_commit(builder):
    large(builder)
    with pytest.raises(janus_core.Cancelled):
        builder.commit(poll=lambda: True)


def test_error_in_poll_comes_through(builder):
    large(builder)

    def poll():
        raise RuntimeError("from poll")

    with pytest.raises(RuntimeError, match="from poll"):
        builder.commit(poll=poll)


def test_commit_lets_others_run(builder):
    large(builder, 400_000)
    calls, stop = [], threading.Event()

    def count():
        while not stop.is_set():
            calls.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.monotonic()
    builder.commit()
    end = time.monotonic()
    stop.set()
    thread.join()
    during = [c for c in calls if begin < c < end]
    assert len(during) > 20 * (end - begin)


def test_commit_on_a_thread_of_its_own(builder):
    fill(builder)
    first = builder.commit()
    task = builder.start_commit()
    builder.remove("lamp")  # has no say in it
    second = task.scene()
    assert task.wait(0.0)
    assert second.counts["meshes_built"] == 0 < first.counts["meshes_built"]
    assert np.array_equal(render(second).snapshot(), render(first).snapshot())


def test_a_commit_can_be_given_up(builder):
    large(builder)
    task = builder.start_commit()
    assert not task.wait(0.001)
    task.cancel()
    with pytest.raises(janus_core.Cancelled):
        task.scene()
    builder.start_commit()  # dropped at once


def test_everything_is_documented():
    for name in janus_core.__all__:
        item = getattr(janus_core, name)
        if name != "__version__":
            assert item.__doc__, name
        for member, value in vars(item).items() if isinstance(item, type) else ():
            if not member.startswith("_") and callable(value):
                assert value.__doc__, f"{name}.{member}"


def test_node_types_are_listed():
    types = {node["type"]: node for node in janus_core.node_types()}
    assert {"BSDF_DIFFUSE", "BSDF_GLASS", "BSDF_GLOSSY", "EMISSION", "MIX_SHADER"} <= set(types)
    inputs = {i["identifier"]: i for i in types["BSDF_GLASS"]["inputs"]}
    ior = {"identifier": "IOR", "type": "FLOAT", "default": (1.5, 1.5, 1.5)}
    assert inputs["IOR"] == ior
    assert types["BSDF_GLASS"]["outputs"] == ["BSDF"]
    assert types["CLAMP"]["settings"] == {"clamp_type": (["MINMAX", "RANGE"], [])}


def test_settings_that_are_not_known_are_named(builder):
    inputs = {"Value": 0.25, "Value_001": 0.5}
    math = {"name": "Sum", "type": "MATH", "inputs": inputs, "properties": {"operation": "NEW"}}
    lamp = {"Color": [1, 1, 1, 1], "Strength": {"link": ["Sum", "Value"]}}
    emission = {"name": "Lamp", "type": "EMISSION", "inputs": lamp, "properties": {}}
    graph = {"nodes": [math, emission], "surface": {"link": ["Lamp", "Emission"]}}
    builder.set_material("m", name="Paint", graph=graph)
    (found,) = builder.commit().diagnostics
    assert (found.material, found.node) == ("Paint", "Sum")
    assert "operation NEW" in found.message and "ADD is used" in found.message


def test_derived_attributes(builder):
    """What is computed from edges; the core says what is missing."""
    attributes = [{"key": "pointiness"}]
    error = error_of(builder, "set_mesh", "mesh", name="M", **PLANE, attributes=attributes)
    assert error.path == "attributes[pointiness]"
    normals = {"key": "normal", "domain": "POINT", "values": np.tile([0.0, 0.0, 1.0], (4, 1))}
    attributes += [normals, {"key": "random_per_island"}]
    error = error_of(
        builder, "set_mesh", "mesh", name="M", **PLANE, attributes=attributes, edges=[[0, 9]]
    )
    assert error.path == "edges[0]"
    builder.set_mesh("mesh", name="M", **PLANE, attributes=attributes, edges=[[0, 1], [1, 2]])
    assert builder.commit().diagnostics == []


def test_instances_have_attributes_of_their_own(builder):
    """A material that emits what each instance says."""
    attribute = {
        "name": "Own",
        "type": "ATTRIBUTE",
        "inputs": {},
        "properties": {"attribute_type": "OBJECT", "attribute_name": "glow"},
    }
    lamp = {"Color": {"link": ["Own", "Color"]}, "Strength": 1.0}
    emission = {"name": "Lamp", "type": "EMISSION", "inputs": lamp, "properties": {}}
    graph = {"nodes": [attribute, emission], "surface": {"link": ["Lamp", "Emission"]}}
    assert builder.set_material("m", name="Paint", graph=graph) == ["object:glow"]
    builder.set_world(name="", graph=None)
    for glow in (0.25, 0.75):
        builder.set_instance(
            "floor",
            name="Floor",
            mesh="mesh",
            transform=IDENTITY,
            materials=["m"],
            attributes={"object:glow": (glow, 0.0, 0.0, 1.0)},
        )
        picture = render(builder.commit()).snapshot()
        middle = picture[picture.shape[0] // 2, picture.shape[1] // 2, :3]
        assert middle == pytest.approx([glow, 0.0, 0.0], abs=1e-6)


def test_build_info():
    info = janus_core.build_info()
    assert info["version"] == janus_core.__version__
    assert info["embree"].split(".")[0] in "34"
