# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees become plain graphs: only bpy, no core."""

import bpy
import pytest
from conftest import new_material, part


@pytest.fixture
def tree(scene):
    """An empty material tree with one output."""
    tree = new_material().node_tree
    tree.nodes.new("ShaderNodeOutputMaterial").name = "Output"
    return tree


def add(tree, kind, name=None, **inputs):
    node = tree.nodes.new(f"ShaderNode{kind}")
    node.name = name or node.name
    for socket, value in inputs.items():
        node.inputs[socket].default_value = value
    return node


def to_output(tree, socket, name="Surface"):
    tree.links.new(socket, tree.nodes["Output"].inputs[name])


def flatten(tree):
    graph = part("nodes").flatten_tree(tree, bpy.context.scene)
    return graph, {node["name"]: node for node in graph["nodes"]}


def make_group(name="Inner", inputs=(), outputs=()):
    """A group with sockets (name, socket type) and its two interface nodes."""
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    for in_out, sockets in (("INPUT", inputs), ("OUTPUT", outputs)):
        for socket, kind in sockets:
            group.interface.new_socket(socket, in_out=in_out, socket_type=f"NodeSocket{kind}")
    group.nodes.new("NodeGroupInput").name = "In"
    group.nodes.new("NodeGroupOutput").name = "Out"
    return group


def use_group(tree, group, name="Group"):
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    node.name = name
    return node


def test_values_and_properties(tree):
    glass = add(tree, "BsdfGlass", Roughness=0.0, IOR=1.33)
    glass.distribution = "BECKMANN"
    to_output(tree, glass.outputs["BSDF"])
    graph, nodes = flatten(tree)
    assert graph["surface"] == {"link": ["Glass BSDF", "BSDF"]}
    node = nodes["Glass BSDF"]
    assert node["type"] == "BSDF_GLASS"
    assert node["inputs"]["Color"] == [1.0, 1.0, 1.0, 1.0]
    assert node["inputs"]["IOR"] == pytest.approx(1.33)
    assert node["inputs"]["Normal"] is None  # the implicit normal
    assert node["properties"]["distribution"] == "BECKMANN"
    assert "Weight" not in node["inputs"]  # internal, not available to users


def test_what_older_blenders_compute_otherwise(tree):
    """The graph says so: a description means the same in every version."""
    magic, cells = add(tree, "TexMagic"), add(tree, "TexVoronoi")
    tree.links.new(cells.outputs["Position"], magic.inputs["Vector"])
    to_output(tree, magic.outputs["Color"])
    _, nodes = flatten(tree)
    version = bpy.app.version
    assert ("old_points" in nodes[cells.name]["properties"]) == (version < (5, 0, 0))
    assert ("wraps_unscaled" in nodes[magic.name]["properties"]) == (version < (5, 2, 0))


def test_only_reachable_nodes_once(tree):
    shared = add(tree, "Fresnel", "Shared")
    mix = add(tree, "MixShader", "Mix")
    for index, kind in ((1, "BsdfDiffuse"), (2, "BsdfAnisotropic")):
        bsdf = add(tree, kind, f"Bsdf {index}")
        tree.links.new(bsdf.outputs[0], mix.inputs[index])
        tree.links.new(shared.outputs[0], bsdf.inputs["Roughness"])
    add(tree, "Emission", "Unreachable")
    to_output(tree, mix.outputs[0])
    graph, nodes = flatten(tree)
    assert sorted(nodes) == ["Bsdf 1", "Bsdf 2", "Mix", "Shared"]
    assert len(graph["nodes"]) == 4
    assert nodes["Mix"]["inputs"][mix.inputs[2].identifier] == {"link": ["Bsdf 2", "BSDF"]}


def test_constant_nodes_are_folded_and_converted(tree):
    diffuse = add(tree, "BsdfDiffuse")
    color = add(tree, "RGB")
    color.outputs[0].default_value = (1.0, 0.5, 0.0, 1.0)
    value = add(tree, "Value")
    value.outputs[0].default_value = 0.5
    tree.links.new(value.outputs[0], diffuse.inputs["Color"])
    tree.links.new(color.outputs[0], diffuse.inputs["Roughness"])
    to_output(tree, diffuse.outputs[0])
    _, nodes = flatten(tree)
    assert list(nodes) == ["Diffuse BSDF"]
    assert nodes["Diffuse BSDF"]["inputs"]["Color"] == [0.5, 0.5, 0.5, 1.0]
    assert nodes["Diffuse BSDF"]["inputs"]["Roughness"] == pytest.approx(0.2126 + 0.5 * 0.7152)


def test_reroutes(tree):
    emission = add(tree, "Emission")
    one, two = (tree.nodes.new("NodeReroute") for _ in range(2))
    tree.links.new(emission.outputs[0], one.inputs[0])
    tree.links.new(one.outputs[0], two.inputs[0])
    to_output(tree, two.outputs[0])
    graph, nodes = flatten(tree)
    assert graph["surface"] == {"link": ["Emission", "Emission"]}
    assert list(nodes) == ["Emission"]


def test_muted_node_passes_its_input_on(tree):
    emission = add(tree, "Emission", "Lamp")
    mix = add(tree, "MixShader", "Mix")
    tree.links.new(emission.outputs[0], mix.inputs[1])
    to_output(tree, mix.outputs[0])
    mix.mute = True
    graph, nodes = flatten(tree)
    assert graph["surface"] == {"link": ["Lamp", "Emission"]}
    assert list(nodes) == ["Lamp"]


def test_muted_node_with_unlinked_input_gives_no_value(tree):
    gamma = add(tree, "Gamma", Color=(0.1, 0.2, 0.3, 1.0))
    diffuse = add(tree, "BsdfDiffuse")
    tree.links.new(gamma.outputs[0], diffuse.inputs["Color"])
    to_output(tree, diffuse.outputs[0])
    gamma.mute = True
    _, nodes = flatten(tree)
    # From Blender 5.0 on it is a link to nothing: the value of the next socket counts.
    expected = [0.0, 0.0, 0.0, 1.0] if bpy.app.version < (5, 0, 0) else [0.8, 0.8, 0.8, 1.0]
    assert nodes["Diffuse BSDF"]["inputs"]["Color"] == pytest.approx(expected)


def test_muted_link_counts_as_none(tree):
    emission = add(tree, "Emission")
    to_output(tree, emission.outputs[0])
    tree.links[0].is_muted = True
    assert flatten(tree)[0] == {"nodes": [], "surface": None}


def test_groups_in_groups(tree):
    inner = make_group("Inner", inputs=[("Tint", "Color")], outputs=[("Shader", "Shader")])
    bsdf = add(inner, "BsdfDiffuse", "Bsdf")
    inner.links.new(inner.nodes["In"].outputs["Tint"], bsdf.inputs["Color"])
    inner.links.new(bsdf.outputs[0], inner.nodes["Out"].inputs["Shader"])

    outer = make_group("Outer", inputs=[("Paint", "Color")], outputs=[("Shader", "Shader")])
    node = use_group(outer, inner, "Deep")
    outer.links.new(outer.nodes["In"].outputs["Paint"], node.inputs["Tint"])
    outer.links.new(node.outputs[0], outer.nodes["Out"].inputs["Shader"])

    mix = add(tree, "MixShader", "Mix")
    for index, color in ((1, (1, 0, 0, 1)), (2, (0, 1, 0, 1))):
        group = use_group(tree, outer, f"Use {index}")
        group.inputs["Paint"].default_value = color
        tree.links.new(group.outputs[0], mix.inputs[index])
    fresnel = add(tree, "Fresnel", "Linked")
    tree.links.new(fresnel.outputs[0], tree.nodes["Use 2"].inputs["Paint"])
    to_output(tree, mix.outputs[0])

    _, nodes = flatten(tree)
    assert sorted(nodes) == ["Linked", "Mix", "Use 1/Deep/Bsdf", "Use 2/Deep/Bsdf"]
    assert nodes["Use 1/Deep/Bsdf"]["inputs"]["Color"] == [1, 0, 0, 1]
    link = ["Linked", fresnel.outputs[0].identifier]
    assert nodes["Use 2/Deep/Bsdf"]["inputs"]["Color"] == {"link": link}
    first = mix.inputs[1].identifier
    assert nodes["Mix"]["inputs"][first] == {"link": ["Use 1/Deep/Bsdf", "BSDF"]}


def test_constant_takes_the_type_of_the_group_socket(tree):
    """A vector through a number socket into a colour comes out grey, as in Blender."""
    group = make_group(inputs=[("Number", "Float")], outputs=[("Shader", "Shader")])
    emission = add(group, "Emission", "Lamp")
    group.links.new(group.nodes["In"].outputs["Number"], emission.inputs["Color"])
    group.links.new(emission.outputs[0], group.nodes["Out"].inputs["Shader"])
    outer = make_group("Outer", inputs=[("Vector", "Vector")], outputs=[("Shader", "Shader")])
    inner = use_group(outer, group)
    outer.links.new(outer.nodes["In"].outputs["Vector"], inner.inputs["Number"])
    outer.links.new(inner.outputs[0], outer.nodes["Out"].inputs["Shader"])
    node = use_group(tree, outer)
    node.inputs["Vector"].default_value = (1.0, 0.0, 0.5)
    to_output(tree, node.outputs[0])
    _, nodes = flatten(tree)
    assert nodes["Group/Group/Lamp"]["inputs"]["Color"] == pytest.approx([0.5] * 3 + [1.0])


def test_group_without_tree_or_output(tree):
    empty = use_group(tree, make_group(outputs=[("Shader", "Shader")]))
    to_output(tree, empty.outputs[0])
    assert flatten(tree)[0]["surface"] is None
    empty.node_tree = None
    assert flatten(tree)[0]["surface"] is None


def test_same_names_stay_apart(tree):
    group = make_group(outputs=[("Shader", "Shader")])
    bsdf = add(group, "BsdfDiffuse", "B")
    group.links.new(bsdf.outputs[0], group.nodes["Out"].inputs[0])
    mix = add(tree, "MixShader")
    tree.links.new(use_group(tree, group, "A").outputs[0], mix.inputs[1])
    tree.links.new(add(tree, "BsdfDiffuse", "A/B").outputs[0], mix.inputs[2])
    to_output(tree, mix.outputs[0])
    graph, nodes = flatten(tree)
    assert len(graph["nodes"]) == len(nodes) == 3


def test_color_into_surface_emits(tree):
    color = add(tree, "RGB")
    color.outputs[0].default_value = (0.1, 0.2, 0.3, 1.0)
    to_output(tree, color.outputs[0])
    graph, nodes = flatten(tree)
    name = graph["surface"]["link"][0]
    assert nodes[name]["type"] == "EMISSION"
    assert nodes[name]["inputs"]["Color"] == pytest.approx([0.1, 0.2, 0.3, 1.0])


def test_displacement(tree):
    to_output(tree, add(tree, "BsdfDiffuse").outputs[0])
    assert "displacement" not in flatten(tree)[0]
    displacement = add(tree, "Displacement", Scale=0.2)
    tree.links.new(add(tree, "TexNoise").outputs["Fac"], displacement.inputs["Height"])
    to_output(tree, displacement.outputs[0], "Displacement")
    graph, nodes = flatten(tree)
    assert graph["displacement"] == {"link": ["Displacement", "Displacement"]}
    assert nodes["Displacement"]["inputs"]["Height"] == {"link": ["Noise Texture", "Fac"]}
    assert nodes["Displacement"]["inputs"]["Normal"] is None
    to_output(tree, add(tree, "Value").outputs[0], "Displacement")  # a constant moves all alike
    assert "displacement" not in flatten(tree)[0]


def test_output_for_cycles_wins_over_eevee(tree):
    tree.nodes["Output"].target = "EEVEE"
    to_output(tree, add(tree, "Emission", "For Eevee").outputs[0])
    mine = add(tree, "OutputMaterial", "Mine")
    mine.target = "CYCLES"
    tree.links.new(add(tree, "BsdfDiffuse", "For Cycles").outputs[0], mine.inputs["Surface"])
    tree.nodes.active = tree.nodes["Output"]
    _, nodes = flatten(tree)
    assert list(nodes) == ["For Cycles"]


def test_no_output_and_no_tree(tree):
    tree.nodes.clear()
    assert flatten(tree)[0] == {"nodes": [], "surface": None}
    assert part("nodes").flatten_tree(None, bpy.context.scene) == {"nodes": [], "surface": None}


def test_long_chain_does_not_overflow_the_stack(tree):
    previous = add(tree, "Gamma", "First")
    for _ in range(400):
        node = tree.nodes.new("ShaderNodeGamma")
        tree.links.new(previous.outputs[0], node.inputs["Color"])
        previous = node
    to_output(tree, previous.outputs[0])
    assert len(flatten(tree)[0]["nodes"]) == 402  # and the implicit emission


def test_many_ways_to_one_node_take_no_time(tree):
    """Each doubles its input: 2^60 ways lead from the curve, which asks, to the number."""
    last = add(tree, "Value").outputs[0]
    for _ in range(60):
        double = add(tree, "Math")
        for socket in double.inputs[:2]:
            tree.links.new(last, socket)
        last = double.outputs[0]
    curve = add(tree, "FloatCurve")
    tree.links.new(last, curve.inputs["Value"])
    to_output(tree, curve.outputs[0])
    assert len(flatten(tree)[0]["nodes"]) == 62


def test_graph_is_plain_data(tree):
    """JSON can hold every node type of this Blender with all its values and properties."""
    import json

    kinds = [
        name
        for name in dir(bpy.types)
        if name.startswith("ShaderNode")
        and issubclass(getattr(bpy.types, name), bpy.types.ShaderNode)
        and not name.startswith("ShaderNodeOutput")
    ]
    assert len(kinds) > 60
    add_shader = None
    for kind in kinds:
        try:
            node = tree.nodes.new(kind)
        except RuntimeError:  # a base class
            continue
        if not len(node.outputs):
            continue
        new = add(tree, "AddShader")
        tree.links.new(node.outputs[0], new.inputs[0])
        if add_shader:
            tree.links.new(add_shader.outputs[0], new.inputs[1])
        add_shader = new
    to_output(tree, add_shader.outputs[0])
    graph, _ = flatten(tree)
    assert len(graph["nodes"]) > 60
    assert json.loads(json.dumps(graph)) == graph


def test_diffuse_has_one_name(tree):
    """In Blender 4.4 its type is another."""
    to_output(tree, add(tree, "BsdfDiffuse").outputs[0])
    _, nodes = flatten(tree)
    assert nodes["Diffuse BSDF"]["type"] == "BSDF_DIFFUSE"


@pytest.mark.skipif(bpy.app.version < (5, 1, 0), reason="Join Bundle came with Blender 5.1")
def test_bundles_joined_again_and_again_end(tree):
    """Each of the joined bundles is the one before, twice: 2^40 ways to what is not there."""
    joined = tree.nodes.new("NodeCombineBundle").outputs[0]
    for _ in range(40):
        node = tree.nodes.new("NodeJoinBundle")
        for _ in range(2):
            between = tree.nodes.new("NodeReroute")
            tree.links.new(joined, between.inputs[0])
            tree.links.new(between.outputs[0], node.inputs[0])
        joined = node.outputs[0]
    separate = tree.nodes.new("NodeSeparateBundle")
    separate.bundle_items.new("FLOAT", "X")
    tree.links.new(joined, separate.inputs[0])
    emission = add(tree, "Emission", "Lamp", Strength=3.0)
    tree.links.new(separate.outputs[0], emission.inputs["Strength"])
    to_output(tree, emission.outputs[0])
    _, nodes = flatten(tree)
    assert nodes["Lamp"]["inputs"]["Strength"] == 3.0


@pytest.mark.skipif(bpy.app.version < (5, 0, 0), reason="Repeat zones came with Blender 5.0")
class TestZones:
    @pytest.fixture
    def zone(self, tree):
        """A zone that adds 1 to X; its two nodes. X ends in an Emission."""
        start = tree.nodes.new("GeometryNodeRepeatInput")
        end = tree.nodes.new("GeometryNodeRepeatOutput")
        start.pair_with_output(end)
        end.repeat_items.new("FLOAT", "X")
        more = add(tree, "Math", "More")
        more.inputs[1].default_value = 1.0
        tree.links.new(start.outputs["X"], more.inputs[0])
        tree.links.new(more.outputs[0], end.inputs["X"])
        emission = add(tree, "Emission", "Lamp")
        tree.links.new(end.outputs["X"], emission.inputs["Strength"])
        to_output(tree, emission.outputs[0])
        return start, end

    def test_is_unrolled(self, tree, zone):
        start, end = zone
        start.inputs["Iterations"].default_value = 3
        start.inputs["X"].default_value = 5.0
        outside = add(tree, "TexCoord", "Outside")
        tree.links.new(outside.outputs["UV"], tree.nodes["More"].inputs[1])
        _, nodes = flatten(tree)
        inside = [f"{end.name}:{i}/More" for i in range(3)]
        assert sorted(nodes) == ["Lamp", "Outside", *inside]
        assert nodes[inside[0]]["inputs"]["Value"] == 5.0
        assert nodes[inside[2]]["inputs"]["Value"] == {"link": [inside[1], "Value"]}

    def test_number_of_iterations_that_varies_is_left_to_the_core(self, tree, zone):
        start, end = zone
        varying = add(tree, "TexCoord")
        tree.links.new(varying.outputs["UV"], start.inputs["Iterations"])
        _, nodes = flatten(tree)
        assert nodes[end.name]["type"] == "REPEAT_OUTPUT"

    def test_huge_number_of_iterations_ends(self, tree, zone):
        zone[0].inputs["Iterations"].default_value = 2**31 - 1
        _, nodes = flatten(tree)
        assert zone[1].name in nodes
