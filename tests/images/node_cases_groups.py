# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for what stands between nodes: groups, Repeat zones, menus, bundles, closures."""

from __future__ import annotations

from .node_cases import CASES, case

SOCKETS = ("Float", "Int", "Bool", "Vector", "Color")


def add_cases() -> None:
    import bpy

    group_cases()
    if bpy.app.version >= (5, 0, 0):
        zone_cases()
        menu_cases()
        bundle_cases()


def new_group(inputs, outputs):
    """A group with sockets (name, socket type); its tree, and its interface nodes."""
    import bpy

    group = bpy.data.node_groups.new("Group", "ShaderNodeTree")
    for in_out, sockets in (("INPUT", inputs), ("OUTPUT", outputs)):
        for name, kind in sockets:
            group.interface.new_socket(name, in_out=in_out, socket_type=f"NodeSocket{kind}")
    return group, group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")


def use(t, group, *values):
    """A node of the group, with sockets or values for its first inputs."""
    node = t.tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    for socket, value in zip(node.inputs, values, strict=False):
        if hasattr(value, "is_output"):
            t.tree.links.new(value, socket)
        else:
            socket.default_value = value
    return node


def as_number(t, socket):
    return t.around("Math", {0: socket, 1: 0.5}, operation="ADD")


def group_cases() -> None:
    import bpy

    def constant(t, kind):
        if kind in ("Bool", "Int", "Seconds", "Frame") or kind.startswith("Vector"):
            from .node_cases_versions import new_constant

            return new_constant(t, kind)
        if kind == "RGB":
            return t.rgb((0.3, 0.9, 2.6, 1.0))
        if kind == "Value":
            return t.value(2.74)
        if kind == "Math":
            return t.out("Math", {0: -1.37, 1: 2.0}, operation="MULTIPLY")
        if kind == "Combine":
            return t.out("CombineXYZ", {0: 0.375, 1: -0.2, 2: 2.6})
        return t.out("HueSaturation", {"Color": (0.3, 0.9, 0.2, 1.0), "Value": 1.5})

    sources = {
        "number": lambda t: t.signed()[0],
        "vector": lambda t: t.vector(),
        "color": lambda t: t.color(),
    }
    kinds = ["RGB", "Value", "Math", "Combine", "Hue"]
    if bpy.app.version >= (5, 2, 0):
        kinds += ["Bool", "Int", "Vector", "Vector4", "Seconds", "Frame"]
    for kind in kinds:
        sources[kind] = lambda t, kind=kind: constant(t, kind)
    for name, source in sources.items():
        for kind in SOCKETS:
            for end in ("", " number"):

                def build(t, source=source, kind=kind, end=end):
                    group, start, stop = new_group([("In", kind)], [("Out", kind)])
                    group.links.new(start.outputs[0], stop.inputs[0])
                    out = use(t, group, source(t)).outputs[0]
                    return as_number(t, out) if end else out

                CASES[f"group {kind} of {name}{end}"] = build
    for kind, value in (
        ("Float", 1.3),
        ("Int", 3),
        ("Bool", True),
        ("Vector", (0.2, -0.9, 0.4)),
        ("Color", (0.2, 0.9, 0.4, 1)),
    ):
        for end in SOCKETS:

            def build(t, kind=kind, value=value, end=end):
                inner, start, stop = new_group([("In", end)], [("Out", "Color")])
                inner.links.new(start.outputs[0], stop.inputs[0])
                outer, start, stop = new_group([("In", kind)], [("Out", "Float")])
                node = outer.nodes.new("ShaderNodeGroup")
                node.node_tree = inner
                outer.links.new(start.outputs[0], node.inputs[0])
                outer.links.new(node.outputs[0], stop.inputs[0])
                return use(t, outer, value).outputs[0]

            CASES[f"group value {kind} by {end}"] = build
    for socket in SOCKETS:

        def build(t, socket=socket):
            group, start, stop = new_group([("In", socket)], [("Out", socket)])
            group.links.new(start.outputs[0], stop.inputs[0])
            node = use(t, group)
            muted = t.node("Gamma", {"Color": (0.3, 0.5, 0.7, 1.0)})
            muted.mute = True
            t.tree.links.new(muted.outputs[0], node.inputs[0])
            return node.outputs[0]

        CASES[f"group {socket} of a muted node"] = build
    for value in (0.3, 1.8):
        for kind, socket in (("RGBCurve", "Color"), ("VectorCurve", "Vector")):

            def build(t, value=value, kind=kind, socket=socket):
                numbers = (value, 0.2, 0.7, 1.0)[: 4 if kind == "RGBCurve" else 3]
                node = t.node(kind, {socket: numbers, "Fac": 0.8})
                for curve in node.mapping.curves:
                    curve.points.new(0.3, 0.8)
                node.mapping.update()
                return node.outputs[0]

            CASES[f"{kind} of {value}"] = build
    for value in (0.3, None):
        for kind in ("FLOAT", "FLOAT_VECTOR"):

            def build(t, value=value, kind=kind):
                node = t.node("MapRange", data_type=kind)
                inputs = [s for s in node.inputs if s.enabled]
                numbers = (value, 0.7, 0.7, -0.25, 0.9)
                for socket, x in zip(inputs, numbers, strict=True):
                    if x is None:
                        t.tree.links.new(t.parts()[0], socket)
                    else:
                        socket.default_value = x if kind == "FLOAT" else (x, x, x)
                return next(s for s in node.outputs if s.enabled)

            CASES[f"empty range {kind} of {value}"] = build
    for name in ("Fresnel", "LayerWeight"):

        def build(t, name=name):
            return t.out(name, {"Normal": t.out("CombineXYZ", {0: 0.3, 1: 0.5, 2: 0.4})})

        CASES[f"{name} of a constant normal"] = build
    for value in (-0.7, 0.3, 1.8):

        def build(t, value=value):
            node = t.node("FloatCurve", {"Value": value, "Factor": 0.8})
            node.mapping.curves[0].points.new(0.3, 0.8)
            node.mapping.update()
            return node.outputs[0]

        CASES[f"float curve of {value}"] = build
    for size in (2, 4) if bpy.app.version >= (5, 0, 0) else ():

        def build(t, size=size):
            group, start, stop = new_group([("In", "Vector")], [("Out", "Vector")])
            for item in group.interface.items_tree:
                item.dimensions = size
            group.links.new(start.outputs[0], stop.inputs[0])
            return use(t, group, t.vector()).outputs[0]

        CASES[f"group of {size} dimensions"] = build

        def build(t, size=size):
            group, start, stop = new_group([("In", "Vector")], [("Out", "Vector")])
            for item in group.interface.items_tree:
                item.dimensions = size
            group.links.new(start.outputs[0], stop.inputs[0])
            return use(t, group, (0.1, 0.2, 0.3, 0.4)[:size]).outputs[0]

        CASES[f"group value of {size} dimensions"] = build


def repeat(tree, items, iterations):
    """A Repeat zone; items: [(socket type, name)]. Its two nodes."""
    start = tree.nodes.new("GeometryNodeRepeatInput")
    end = tree.nodes.new("GeometryNodeRepeatOutput")
    start.pair_with_output(end)
    end.repeat_items.clear()
    for kind, name in items:
        end.repeat_items.new(kind, name)
    if hasattr(iterations, "is_output"):
        tree.links.new(iterations, start.inputs[0])
    else:
        start.inputs[0].default_value = iterations
    return start, end


def zone_cases() -> None:
    def halves(t, iterations, value=None):
        """x -> 0.5 x + 0.3 u + i / 10, again and again."""
        start, end = repeat(t.tree, [("FLOAT", "X")], iterations)
        t.tree.links.new(t.parts()[1] if value is None else value, start.inputs["X"])
        scaled = t.out("Math", {0: t.parts()[0], 1: 0.3}, operation="MULTIPLY")  # not in the zone
        x = t.out("Math", {0: start.outputs["X"], 1: 0.5, 2: scaled}, operation="MULTIPLY_ADD")
        x = t.out("Math", {0: start.outputs[0], 1: 0.1, 2: x}, operation="MULTIPLY_ADD")
        t.tree.links.new(x, end.inputs["X"])
        return end.outputs["X"]

    for iterations in (0, 1, 2, 7, 100, -3):
        CASES[f"repeat {iterations}"] = lambda t, n=iterations: halves(t, n)
    CASES["repeat as often as a value says"] = lambda t: halves(t, t.value(3.9))

    @case("repeat by a group")
    def _(t):
        from .node_cases import Tree

        group, start, stop = new_group([("Times", "Int")], [("Out", "Float")])
        group.links.new(halves(Tree(group), start.outputs[0]), stop.inputs[0])
        return use(t, group, 4).outputs[0]

    @case("repeat in repeat")
    def _(t):
        start, end = repeat(t.tree, [("FLOAT", "X")], 3)
        t.tree.links.new(t.parts()[0], start.inputs["X"])
        t.tree.links.new(halves(t, 2, value=start.outputs["X"]), end.inputs["X"])
        return end.outputs["X"]

    @case("repeat swaps")
    def _(t):
        start, end = repeat(t.tree, [("RGBA", "A"), ("RGBA", "B")], 5)
        t.tree.links.new(t.color(), start.inputs["A"])
        t.tree.links.new(t.color(0.3), start.inputs["B"])
        t.tree.links.new(start.outputs["A"], end.inputs["B"])
        mixed = t.node("Mix", {"Factor_Float": 0.3}, data_type="RGBA")
        t.tree.links.new(start.outputs["A"], mixed.inputs[6])
        t.tree.links.new(start.outputs["B"], mixed.inputs[7])
        t.tree.links.new(mixed.outputs[2], end.inputs["A"])
        return end.outputs["B"]

    @case("repeat converts values")
    def _(t):
        start, end = repeat(t.tree, [("INT", "X")], 3)
        t.tree.links.new(t.value(2.9), start.inputs["X"])
        x = t.out("Math", {0: start.outputs["X"], 1: 0.75}, operation="ADD")
        t.tree.links.new(x, end.inputs["X"])
        return end.outputs["X"]


def menu_cases() -> None:
    def menu(tree, kind, names=("A", "B", "C")):
        node = tree.nodes.new("GeometryNodeMenuSwitch")
        node.data_type = kind
        node.enum_items.clear()
        for name in names:
            node.enum_items.new(name)
        return node

    for chosen in "ABC":

        def build(t, chosen=chosen):
            node = menu(t.tree, "FLOAT")
            for name, part in zip("ABC", t.parts(), strict=True):
                t.tree.links.new(part, node.inputs[name])
            node.inputs["Menu"].default_value = chosen
            return node.outputs[0]

        CASES[f"menu {chosen}"] = build

        def build(t, chosen=chosen):
            node = menu(t.tree, "VECTOR")
            node.inputs["B"].default_value = (0.3, 0.2, 0.9)
            node.inputs["Menu"].default_value = chosen
            value = t.out("Math", {0: node.outputs["B"], 1: 0.3}, operation="ADD")
            return t.out("Math", {0: node.outputs[0], 1: value}, operation="ADD")

        CASES[f"menu {chosen} by outputs"] = build

        def build(t, chosen=chosen):
            group, start, stop = new_group([("Kind", "Menu"), ("X", "Float")], [("Out", "Color")])
            node = menu(group, "RGBA")
            node.inputs["A"].default_value = (0.9, 0.5, 0.2, 1.0)
            group.links.new(start.outputs["X"], node.inputs["C"])
            group.links.new(start.outputs["Kind"], node.inputs["Menu"])
            group.links.new(node.outputs[0], stop.inputs[0])
            return use(t, group, chosen, t.parts()[0]).outputs[0]

        CASES[f"menu {chosen} of a group"] = build


def bundle_cases() -> None:
    @case("bundle")
    def _(t):
        pack, unpack = t.tree.nodes.new("NodeCombineBundle"), t.tree.nodes.new("NodeSeparateBundle")
        for node in (pack, unpack):
            for kind, name in (("FLOAT", "X"), ("RGBA", "Paint")):
                node.bundle_items.new(kind, name)
        t.tree.links.new(t.parts()[0], pack.inputs["X"])
        t.tree.links.new(t.color(), pack.inputs["Paint"])
        t.tree.links.new(pack.outputs[0], unpack.inputs[0])
        return t.out(
            "Mix",
            {"Factor_Float": unpack.outputs["X"], "A_Color": unpack.outputs["Paint"]},
            "Result_Color",
            data_type="RGBA",
        )

    @case("closure")
    def _(t):
        start, end = (t.tree.nodes.new(f"NodeClosure{n}") for n in ("Input", "Output"))
        start.pair_with_output(end)
        end.input_items.new("FLOAT", "X")
        end.output_items.new("FLOAT", "Y")
        y = t.out("Math", {0: start.outputs["X"], 1: t.parts()[1]}, operation="MULTIPLY")
        t.tree.links.new(y, end.inputs["Y"])
        found = []
        for part in t.signed()[:2]:
            node = t.tree.nodes.new("NodeEvaluateClosure")
            node.input_items.new("FLOAT", "X")
            node.output_items.new("FLOAT", "Y")
            t.tree.links.new(end.outputs[0], node.inputs[0])
            t.tree.links.new(part, node.inputs["X"])
            found.append(node.outputs["Y"])
        return t.out("Math", {0: found[0], 1: found[1]}, operation="SUBTRACT")
