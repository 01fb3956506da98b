# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for nodes that not all Blenders have: old ones; joined bundles, constants, conversions."""

from __future__ import annotations

from .node_cases import CASES, case, enum_items
from .node_cases_groups import as_number, new_group, use


def add_cases() -> None:
    import bpy

    plain_cases()
    if bpy.app.version < (5, 0, 0):
        old_cases()
    if bpy.app.version >= (5, 1, 0):
        joined_bundle_cases()
    if bpy.app.version >= (5, 2, 0):
        constant_cases()


def plain_cases() -> None:
    CASES["combine xyz"] = lambda t: t.out("CombineXYZ", dict(enumerate(t.signed())))
    for index in range(3):
        CASES[f"separate xyz {index}"] = lambda t, index=index: t.out(
            "SeparateXYZ", {0: t.vector()}, index
        )
    for blend in enum_items("MixRGB", "blend_type"):
        for clamp in (False, True):

            def build(t, blend=blend, clamp=clamp):
                inputs = {"Fac": t.signed()[0], "Color1": t.color(), "Color2": t.color(0.4)}
                return t.out("MixRGB", inputs, blend_type=blend, use_clamp=clamp)

            CASES[f"mix rgb {blend} {clamp}"] = build


def old_cases() -> None:
    """What became Combine Color and Separate Color."""
    for model in ("RGB", "HSV"):
        CASES[f"old combine {model}"] = lambda t, model=model: t.out(
            f"Combine{model}", dict(enumerate(t.parts()))
        )
        for index in range(3):
            CASES[f"old separate {model} {index}"] = lambda t, model=model, index=index: t.out(
                f"Separate{model}", {0: t.color()}, index
            )


def new_constant(t, kind):
    """The output of a node that Blender 5.2 added."""
    if kind in ("Seconds", "Frame"):
        return t.tree.nodes.new("GeometryNodeInputSceneTime").outputs[kind]
    if kind == "Bool":
        node = t.tree.nodes.new("FunctionNodeInputBool")
        node.boolean = True
    elif kind == "Int":
        node = t.tree.nodes.new("FunctionNodeInputInt")
        node.integer = -3
    else:
        node = t.tree.nodes.new("FunctionNodeInputVector")
        node.vector_dimensions = size = int(kind[6:] or 3)
        node.vector = (0.3, -0.9, 2.6, 0.7)[:size]
    return node.outputs[0]


def joined_bundle_cases() -> None:
    def bundle(t, **values):
        node = t.tree.nodes.new("NodeCombineBundle")
        for name, value in values.items():
            node.bundle_items.new("FLOAT", name)
            if hasattr(value, "is_output"):
                t.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node.outputs[0]

    def join(t, *bundles):
        node = t.tree.nodes.new("NodeJoinBundle")
        for socket in bundles:
            t.tree.links.new(socket, node.inputs[0])
        return node.outputs[0]

    def items(t, joined):
        node = t.tree.nodes.new("NodeSeparateBundle")
        for name in "XYZ":
            node.bundle_items.new("FLOAT", name)
        t.tree.links.new(joined, node.inputs[0])
        return t.out("CombineXYZ", dict(enumerate(node.outputs[name] for name in "XYZ")))

    def parts(t):
        u, v, w = t.parts()
        return bundle(t, X=u, Y=0.7), bundle(t, Y=v, Z=w), bundle(t, X=0.1, Z=0.9)

    for order in ((0, 1), (1, 0), (0, 1, 2), (2, 1, 0), (1,), ()):

        def build(t, order=order):
            made = parts(t)
            return items(t, join(t, *(made[i] for i in order)))

        CASES[f"bundles joined {order}"] = build

    @case("bundles joined twice")
    def _(t):
        a, b, c = parts(t)
        return items(t, join(t, join(t, a, b), c))

    @case("bundles joined in a group")
    def _(t):
        group, start, stop = new_group([("A", "Bundle"), ("B", "Bundle")], [("Out", "Bundle")])
        node = group.nodes.new("NodeJoinBundle")
        for socket in start.outputs[:2]:
            group.links.new(socket, node.inputs[0])
        group.links.new(node.outputs[0], stop.inputs[0])
        return items(t, use(t, group, *parts(t)[:2]).outputs[0])

    @case("bundles joined by a muted node")
    def _(t):
        a, b, _ = parts(t)
        joined = join(t, a, b)
        joined.node.mute = True
        return items(t, joined)


def constant_cases() -> None:
    """What Blender 5.2 added: constants, and conversions that one sees."""
    kinds = ("FLOAT", "INT", "BOOLEAN", "VECTOR", "RGBA")
    sources = {
        **{name: lambda t, name=name: new_constant(t, name) for name in ("Int", "Vector", "Frame")},
        **{"RGB": lambda t: t.rgb((0.3, 0.9, 2.6, 1.0)), "Value": lambda t: t.value(2.74)},
        **{"color": lambda t: t.color(), "vector": lambda t: t.vector()},
    }
    for kind in kinds:
        for name, source in {"nothing": None, **sources}.items():

            def build(t, kind=kind, source=source):
                node = t.tree.nodes.new("NodeImplicitConversion")
                node.data_type = kind
                if source:
                    t.tree.links.new(source(t), node.inputs[0])
                return node.outputs[0]

            CASES[f"conversion {kind} of {name}"] = build
            CASES[f"conversion {kind} of {name} number"] = lambda t, b=build: as_number(t, b(t))

    for chosen in "ABC":

        def build(t, chosen=chosen):
            node = t.tree.nodes.new("GeometryNodeMenuSwitch")
            node.data_type = "FLOAT"
            node.enum_items.clear()
            for name, part in zip("ABC", t.parts(), strict=True):
                node.enum_items.new(name)
                t.tree.links.new(part, node.inputs[name])
            menu = t.tree.nodes.new("FunctionNodeInputMenu")
            t.tree.links.new(menu.outputs[0], node.inputs["Menu"])
            menu.value = chosen
            return node.outputs[0]

        CASES[f"menu {chosen} by a node"] = build
