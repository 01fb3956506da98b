# SPDX-License-Identifier: GPL-3.0-or-later
"""Small trees of shader nodes, one for every setting: Emission of each is compared with Cycles'.

A case is a function of a `Tree` that returns the socket to look at. `CASES` maps names to them.
"""

from __future__ import annotations

AROUND = "around"


class Tree:
    """A material's node tree, with the inputs that cases start from."""

    def __init__(self, tree):
        self.tree = tree
        self._kept = {}

    def node(self, kind: str, inputs=None, **properties):
        """A new node; inputs: {identifier or index: value or socket}."""
        made = self.tree.nodes.new(f"ShaderNode{kind}")
        for name, value in properties.items():
            setattr(made, name, value)
        for key, value in (inputs or {}).items():
            socket = (
                made.inputs[key]
                if isinstance(key, int)
                else next(s for s in made.inputs if s.identifier == key)
            )
            if hasattr(value, "is_output"):
                self.tree.links.new(value, socket)
            else:
                socket.default_value = value
        return made

    def out(self, kind: str, inputs=None, output=0, **properties):
        made = self.node(kind, inputs, **properties)
        if isinstance(output, int):
            return made.outputs[output]
        return next(s for s in made.outputs if s.identifier == output)

    def around(self, kind: str, inputs, **properties):
        """The same for a node that only shows what its first input gives: see `subject`."""
        made = self.node(kind, inputs, **properties)
        made.label = AROUND
        return made.outputs[0]

    def displace(self, socket) -> None:
        """Links it to the Displacement of the material."""
        output = next(n for n in self.tree.nodes if n.type == "OUTPUT_MATERIAL")
        self.tree.links.new(socket, output.inputs["Displacement"])

    def value(self, x: float):
        """The output of a Value node."""
        output = self.node("Value").outputs[0]
        output.default_value = x
        return output

    def rgb(self, color):
        """The output of an RGB node."""
        output = self.node("RGB").outputs[0]
        output.default_value = color
        return output

    def coordinate(self, name: str):
        if "coordinates" not in self._kept:
            self._kept["coordinates"] = self.node("TexCoord")
        return self._kept["coordinates"].outputs[name]

    def parts(self):
        """u and v of the UV map, each on its own, and a third that mixes them; 0 to 1."""
        if "parts" not in self._kept:
            u, v, _ = self.node("SeparateXYZ", {0: self.coordinate("UV")}).outputs
            w = self.out("Math", {0: u, 1: v}, operation="MULTIPLY")
            self._kept["parts"] = u, v, w
        return self._kept["parts"]

    def signed(self):
        """The same from -2 to 2."""
        return [
            self.out("MapRange", {"Value": x, "To Min": -2.0, "To Max": 2.0}) for x in self.parts()
        ]

    def vector(self):
        """A vector that varies in all components, of both signs."""
        a, b, c = self.signed()
        return self.out("CombineXYZ", {0: a, 1: b, 2: c})

    def color(self, shift=0.0):
        """A colour from 0 to 1 that varies in hue, saturation and value."""
        u, v, w = self.parts()
        turned = self.out("Math", {0: u, 1: shift}, operation="ADD")
        return self.out("CombineColor", {0: turned, 1: v, 2: w}, mode="HSV")


def material(name: str, shader):
    """A material: shader(tree) makes its nodes and gives the last socket."""
    import bpy

    made = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader(Tree(tree)), output.inputs["Surface"])
    return made


def subject(socket) -> str:
    """The type of the node that a case is about: the last one that is not around another."""
    while socket.node.label == AROUND:
        socket = socket.node.inputs[0].links[0].from_socket
    return socket.node.type


def fill(node, **values) -> None:
    """Sets those inputs, by identifier, that the node's settings leave in use."""
    for socket in node.inputs:
        if socket.enabled and socket.identifier in values:
            socket.default_value = values[socket.identifier]


def enum_items(kind: str, name: str):
    import bpy

    return [
        i.identifier
        for i in getattr(bpy.types, f"ShaderNode{kind}").bl_rna.properties[name].enum_items
    ]


CASES = {}

# What Cycles does in older Blenders only, or Janus cannot do there: (until, beginning of the name).
OLDER = (
    ((4, 5), "instancer nodes"),  # Python cannot ask; named
    ((4, 5), "bump by coordinate Normal"),  # the normal has no slope
    ((4, 5), "pieces bump by coordinate Normal"),
    ((4, 5), "noise 3D far 1e+20"),  # where floats are coarse, remainders are what they like
    ((4, 5), "noise 4D far 1e+20"),
    ((5, 0), "attribute GEOMETRY tangent_sign"),  # 0, unless tangents are asked for as well
    ((5, 0), "image alpha in Rec.1886 CHANNEL_PACKED"),  # divided by an alpha that does not cover
)


def case(name):
    def keep(function):
        CASES[name] = function
        return function

    return keep


def add_cases() -> None:
    """Fills CASES; needs bpy for the enums."""
    if CASES:
        return
    import bpy

    from . import (
        node_cases_displacement,
        node_cases_groups,
        node_cases_ies,
        node_cases_images,
        node_cases_places,
        node_cases_textures,
        node_cases_versions,
    )

    math_cases()
    color_cases()
    node_cases_places.add_cases()
    node_cases_images.add_cases()
    node_cases_textures.add_cases()
    node_cases_groups.add_cases()
    node_cases_versions.add_cases()
    node_cases_places.sky_cases()
    node_cases_displacement.add_cases()
    node_cases_ies.add_cases()
    older = tuple(name for until, name in OLDER if bpy.app.version < until)
    for name in [n for n in CASES if n.startswith(older)]:
        del CASES[name]


def math_cases() -> None:
    for operation in enum_items("Math", "operation"):
        for clamp in (False, True):

            def build(t, operation=operation, clamp=clamp):
                a, b, c = t.signed()
                return t.out("Math", {0: a, 1: b, 2: c}, operation=operation, use_clamp=clamp)

            CASES[f"math {operation} {clamp}"] = build
    for kind in enum_items("Clamp", "clamp_type"):

        def build(t, kind=kind):
            a, b, c = t.signed()
            return t.out("Clamp", {0: a, 1: b, 2: c}, clamp_type=kind)

        CASES[f"clamp {kind}"] = build
    for interpolation in enum_items("MapRange", "interpolation_type"):
        for clamp in (False, True):
            for upside in (False, True):

                def build(t, interpolation=interpolation, clamp=clamp, upside=upside):
                    a, b, _ = t.signed()
                    low, high = (1.1, -0.7) if upside else (-0.7, 1.1)
                    inputs = {
                        "Value": a,
                        "From Min": low,
                        "From Max": high,
                        "To Min": b,
                        "To Max": 2.0,
                    }
                    if interpolation == "STEPPED":
                        inputs["Steps"] = 3.0
                    return t.out("MapRange", inputs, interpolation_type=interpolation, clamp=clamp)

                CASES[f"map range {interpolation} {clamp} {upside}"] = build

            def build(t, interpolation=interpolation, clamp=clamp):
                inputs = {
                    "Vector": t.vector(),
                    "From_Min_FLOAT3": (-1, 1, -0.5),
                    "From_Max_FLOAT3": (1, -1, 0.5),
                    "To_Min_FLOAT3": (0, -1, 1),
                    "To_Max_FLOAT3": (1, 1, 0),
                }
                if interpolation == "STEPPED":
                    inputs["Steps_FLOAT3"] = (2.0, 3.0, 4.0)
                return t.out(
                    "MapRange",
                    inputs,
                    "Vector",
                    interpolation_type=interpolation,
                    clamp=clamp,
                    data_type="FLOAT_VECTOR",
                )

            CASES[f"map range vector {interpolation} {clamp}"] = build

    @case("float curve")
    def _(t):
        node = t.node("FloatCurve", {"Value": t.signed()[0], "Factor": 0.8})
        node.mapping.curves[0].points.new(0.3, 0.8)
        node.mapping.update()
        return node.outputs[0]


def color_cases() -> None:
    for blend in enum_items("Mix", "blend_type"):
        for clamp in (False, True):

            def build(t, blend=blend, clamp=clamp):
                factor = t.signed()[0]
                return t.out(
                    "Mix",
                    {"Factor_Float": factor, "A_Color": t.color(), "B_Color": t.color(0.4)},
                    "Result_Color",
                    data_type="RGBA",
                    blend_type=blend,
                    clamp_factor=clamp,
                    clamp_result=clamp,
                )

            CASES[f"mix color {blend} {clamp}"] = build
    for clamp in (False, True):

        def build(t, clamp=clamp):
            a, b, c = t.signed()
            return t.out(
                "Mix",
                {"Factor_Float": a, "A_Float": b, "B_Float": c},
                "Result_Float",
                data_type="FLOAT",
                clamp_factor=clamp,
            )

        CASES[f"mix float {clamp}"] = build
        for mode in ("UNIFORM", "NON_UNIFORM"):

            def build(t, clamp=clamp, mode=mode):
                factor = (
                    {"Factor_Float": t.signed()[0]}
                    if mode == "UNIFORM"
                    else {"Factor_Vector": t.vector()}
                )
                return t.out(
                    "Mix",
                    factor | {"A_Vector": t.vector(), "B_Vector": (1, 2, -1)},
                    "Result_Vector",
                    data_type="VECTOR",
                    factor_mode=mode,
                    clamp_factor=clamp,
                )

            CASES[f"mix vector {mode} {clamp}"] = build
    for mode in enum_items("CombineColor", "mode"):

        def build(t, mode=mode):
            u, v, w = t.parts()
            return t.out("CombineColor", {0: u, 1: v, 2: w}, mode=mode)

        CASES[f"combine {mode}"] = build
        for index in range(3):

            def build(t, mode=mode, index=index):
                return t.out("SeparateColor", {0: t.color()}, index, mode=mode)

            CASES[f"separate {mode} {index}"] = build

    @case("hue saturation")
    def _(t):
        u, v, _ = t.parts()
        return t.out(
            "HueSaturation",
            {"Hue": u, "Saturation": 1.7, "Value": 0.8, "Fac": v, "Color": t.color()},
        )

    @case("bright contrast")
    def _(t):
        a, b, _ = t.signed()
        return t.out("BrightContrast", {"Bright": a, "Contrast": b, "Color": t.color()})

    @case("gamma")
    def _(t):
        return t.out("Gamma", {"Gamma": t.signed()[0], "Color": t.color()})

    @case("invert")
    def _(t):
        return t.out("Invert", {"Fac": t.parts()[0], "Color": t.color()})

    for low, high in ((700.0, 2000.0), (1500.0, 13000.0)):

        def build(t, low=low, high=high):
            kelvin = t.out("MapRange", {"Value": t.parts()[0], "To Min": low, "To Max": high})
            return t.out("Blackbody", {0: kelvin})

        CASES[f"blackbody {low:.0f}"] = build

    @case("rgb to bw")
    def _(t):
        return t.out("RGBToBW", {0: t.color()})

    for interpolation in ("LINEAR", "CONSTANT", "EASE", "CARDINAL", "B_SPLINE"):
        for output in (0, 1):

            def build(t, interpolation=interpolation, output=output):
                node = t.node("ValToRGB", {0: t.signed()[0]})
                ramp = node.color_ramp
                ramp.interpolation = interpolation
                ramp.elements[0].color = (0.1, 0.8, 0.3, 0.5)
                ramp.elements.new(0.37).color = (0.9, 0.2, 0.1, 0.9)
                return node.outputs[output]

            CASES[f"ramp {interpolation} {output}"] = build

    for extend in ("HORIZONTAL", "EXTRAPOLATED"):
        for kind, socket, name in (
            ("RGBCurve", "Color", "rgb"),
            ("VectorCurve", "Vector", "vector"),
        ):

            def build(t, extend=extend, kind=kind, socket=socket):
                node = t.node(kind, {"Fac": 0.7, socket: t.vector()})
                for i, curve in enumerate(node.mapping.curves):
                    curve.points.new(0.3 + 0.1 * i, 0.7 - 0.1 * i)
                node.mapping.extend = extend
                node.mapping.update()
                return node.outputs[0]

            CASES[f"{name} curves {extend}"] = build
