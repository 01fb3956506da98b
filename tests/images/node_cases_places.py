# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for nodes that ask where they are: vectors, coordinates, attributes, normals."""

from __future__ import annotations

from .node_cases import CASES, case, enum_items, fill


def normal_of(t, socket):
    """What a normal does, where it can be seen: its components, from 0 to 1."""
    return t.around(
        "VectorMath",
        {0: socket, 1: (0.5, 0.5, 0.5), 2: (0.5, 0.5, 0.5)},
        operation="MULTIPLY_ADD",
    )


def add_cases() -> None:
    vector_cases()
    input_cases()
    normal_cases()
    wireframe_cases()


def vector_cases() -> None:
    for kind in enum_items("Mapping", "vector_type"):

        def build(t, kind=kind):
            inputs = {"Vector": t.vector(), "Rotation": (0.3, -0.5, 1.1), "Scale": (0.5, -2.0, 1.5)}
            if kind in ("POINT", "TEXTURE"):
                inputs["Location"] = (0.2, 0.1, -0.3)
            return t.out("Mapping", inputs, vector_type=kind)

        CASES[f"mapping {kind}"] = build
    for scale in ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        CASES[f"mapping by {scale}"] = lambda t, scale=scale: t.out(
            "Mapping", {"Vector": t.vector(), "Location": (0.1, 0.2, 0.3), "Scale": scale}
        )
    for operation in enum_items("VectorMath", "operation"):

        def build(t, operation=operation):
            a, b, c = t.signed()
            first = t.vector()
            second = t.out("CombineXYZ", {0: c, 1: a, 2: b})
            node = t.node("VectorMath", {0: first}, operation=operation)
            if node.inputs[1].enabled:
                t.tree.links.new(second, node.inputs[1])
            fill(node, Vector_002=(0.3, -0.2, 0.8))
            fill(node, Scale=0.7)
            return next(o for o in node.outputs if o.enabled)

        CASES[f"vector math {operation}"] = build
    for kind in enum_items("VectorRotate", "rotation_type"):
        for invert in (False, True):

            def build(t, kind=kind, invert=invert):
                node = t.node(
                    "VectorRotate",
                    {"Vector": t.vector(), "Center": (0.1, 0.2, 0.3)},
                    rotation_type=kind,
                    invert=invert,
                )
                fill(node, Axis=(1, 2, 3), Angle=0.7, Rotation=(0.3, 0.5, 0.9))
                return node.outputs[0]

            CASES[f"vector rotate {kind} {invert}"] = build
    for kind in enum_items("VectorTransform", "vector_type"):
        for start in ("WORLD", "OBJECT", "CAMERA"):
            for end in ("WORLD", "OBJECT", "CAMERA"):

                def build(t, kind=kind, start=start, end=end):
                    return t.out(
                        "VectorTransform",
                        {0: t.vector()},
                        vector_type=kind,
                        convert_from=start,
                        convert_to=end,
                    )

                CASES[f"vector transform {kind} {start} {end}"] = build

    for output in (0, 1):

        def build(t, output=output):
            node = t.node("Normal", {0: t.vector()})
            node.outputs[0].default_value = (0.3, 0.4, 0.8)
            return node.outputs[output]

        CASES[f"normal {output}"] = build


def input_cases() -> None:
    for name in ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection"):
        CASES[f"coordinate {name}"] = lambda t, name=name: t.coordinate(name)
    for name in (
        "Position",
        "Normal",
        "Tangent",
        "True Normal",
        "Incoming",
        "Parametric",
        "Backfacing",
        "Pointiness",
        "Random Per Island",
    ):
        CASES[f"pieces geometry {name}"] = lambda t, name=name: t.out("NewGeometry", output=name)
        CASES[f"geometry {name}"] = lambda t, name=name: t.out("NewGeometry", output=name)
    for name in ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random"):
        CASES[f"object {name}"] = lambda t, name=name: t.out("ObjectInfo", output=name)
    for name in ("View Vector", "View Z Depth", "View Distance"):
        CASES[f"camera {name}"] = lambda t, name=name: t.out("CameraData", output=name)
    for name in ("Spare UV", ""):
        CASES[f"uv map {name}"] = lambda t, name=name: t.out("UVMap", uv_map=name)
    attribute_cases()
    for kind, name in (("UV_MAP", ""), ("UV_MAP", "Spare UV"), *(("RADIAL", a) for a in "XYZ")):
        for mesh in ("", "pieces "):
            settings = {"uv_map": name} if kind == "UV_MAP" else {"axis": name}
            CASES[f"{mesh}tangent {kind} {name}"] = lambda t, kind=kind, settings=settings: t.out(
                "Tangent", direction_type=kind, **settings
            )
    for name in ("Color", "Byte", ""):
        for output in (0, 1):
            CASES[f"color attribute {name} {output}"] = lambda t, name=name, output=output: t.out(
                "VertexColor", output=output, layer_name=name
            )

    lengths = ("Ray Length", "Ray Depth", "Diffuse Depth", "Glossy Depth", "Transmission Depth")
    for name in (*lengths, "Transparent Depth", "Is Camera Ray", "Is Shadow Ray"):
        CASES[f"light path {name}"] = lambda t, name=name: t.out("LightPath", output=name)
    for name in ("Quadratic", "Linear", "Constant"):
        for smooth in (0.0, 40.0):
            inputs = {"Strength": 0.1, "Smooth": smooth}
            CASES[f"light falloff {name} {smooth}"] = lambda t, name=name, inputs=inputs: t.out(
                "LightFalloff", inputs, name
            )
    CASES["fresnel"] = lambda t: t.out("Fresnel", {"IOR": t.signed()[0]})
    for output in (0, 1):
        CASES[f"layer weight {output}"] = lambda t, output=output: t.out(
            "LayerWeight", {"Blend": t.parts()[0]}, output
        )

    @case("coordinate of another object")
    def _(t):
        import bpy

        return t.out("TexCoord", output="Object", object=bpy.data.objects["Other"])


def attribute_cases() -> None:
    def attribute(name, output=0, kind="GEOMETRY", title="attribute"):
        CASES[f"{title} {kind} {name} {output}"] = lambda t: t.out(
            "Attribute", output=output, attribute_name=name, attribute_type=kind
        )

    own = ("Float", "Int", "Bool", "Vector", "Color", "Byte", "Face", "Corner", "Missing", "Edge")
    own += ("Edge Int", "Edge Bool", "Edge Byte", "Pair", "Int8", "Turn", "Ints", "UVMap")
    known = ("N", "uv", "generated", "tangent", "tangent_sign", "Spare UV.tangent", "vertex_color")
    known += ("pointiness", "random_per_island", "position", "undeformed")
    for name in (*own, *known):
        for output in range(4):
            attribute(name, output)
    ours = ("Number", "Whole", "Yes", "Two", "Four", "Five", "Text", "Both", "Missing", "Maker")
    paths = ("location", "color", "pass_index", "rotation_euler", "scale[0]", "delta_location.x")
    paths += ("matrix_world", "lock_location", "data.vertices[1].co", '["Number"]', "name")
    for name in (*ours, *paths):
        for output in range(4) if name in ours else (0, 3):
            attribute(name, output, "OBJECT")
    for name in ("Number", "Both", "Missing", "Maker", "location"):
        for output in (0, 2, 3):
            attribute(name, output, "INSTANCER")
            attribute(name, output, "INSTANCER", "instancer collection")
            attribute(name, output, "INSTANCER", "instancer faces")
            attribute(name, output, "INSTANCER", "instancer nodes")
    for output in range(4):
        attribute("Stored", output, "INSTANCER", "instancer nodes")
    for name in (
        "Layer",
        "Scene",
        "World",
        "Both",
        "Missing",
        "frame_current",
        "render.fps",
        "color",
    ):
        for output in range(4):
            attribute(name, output, "VIEW_LAYER")
    for title in ("instancer collection", "instancer faces", "not instanced"):
        CASES[f"{title} generated"] = lambda t: t.out(
            "TexCoord", output="Generated", from_instancer=True
        )
        CASES[f"{title} uv"] = lambda t: t.out("TexCoord", output="UV", from_instancer=True)
        CASES[f"{title} uv map"] = lambda t: t.out("UVMap", from_instancer=True)


def normal_cases() -> None:
    import bpy

    for space in enum_items("NormalMap", "space"):
        for strength in (1.0, 0.4, 1.5):

            def build(t, space=space, strength=strength):
                node = t.node("NormalMap", {"Color": t.color(), "Strength": strength}, space=space)
                return normal_of(t, node.outputs[0])

            CASES[f"normal map {space} {strength}"] = build
            CASES[f"pieces normal map {space} {strength}"] = build

    if bpy.app.version >= (5, 1, 0):
        for space in enum_items("NormalMap", "space"):
            for base in enum_items("NormalMap", "base"):

                def build(t, space=space, base=base):
                    node = t.node("NormalMap", {"Color": t.color()}, space=space, base=base)
                    node.convention = "DIRECTX"
                    return normal_of(t, node.outputs[0])

                CASES[f"normal map {space} {base} of DirectX"] = build

    def bumps(t, width, distance=0.1):
        u, v, _ = t.parts()
        height = t.out("Math", {0: u, 1: 9.0}, operation="MULTIPLY")
        height = t.out("Math", {0: height}, operation="SINE")
        height = t.out("Math", {0: height, 1: v}, operation="MULTIPLY")
        inputs = {"Height": height, "Distance": distance}
        if bpy.app.version >= (4, 5, 0):  # before, there is no choice
            inputs["Filter Width"] = width
        return t.node("Bump", inputs)

    for width in (0.01, 0.3, 1.0, 5.0):
        CASES[f"bump width {width}"] = lambda t, width=width: normal_of(
            t, bumps(t, width).outputs[0]
        )
    CASES["bump width value"] = lambda t: normal_of(t, bumps(t, t.out("Value")).outputs[0])
    CASES["bump width linked"] = lambda t: normal_of(t, bumps(t, t.parts()[0]).outputs[0])

    CASES["bump width below zero"] = lambda t: normal_of(t, bumps(t, -0.4).outputs[0])
    heights = {
        **{
            f"coordinate {n}": ("TexCoord", n)
            for n in ("Normal", "Camera", "Window", "Generated", "Object")
        },
        **{
            f"geometry {n}": ("NewGeometry", n)
            for n in ("Normal", "Tangent", "Parametric", "Position")
        },
        "camera": ("CameraData", "View Vector"),
        "tangent": ("Tangent", "Tangent"),
        "fresnel": ("Fresnel", "Fac"),
    }
    for name, (kind, output) in heights.items():
        for mesh in ("", "pieces "):

            def build(t, kind=kind, output=output):
                height = t.out("VectorMath", {0: t.out(kind, output=output), 1: (0.3, 0.5, 0.1)})
                node = t.node("Bump", {"Height": height, "Distance": 0.5, "Strength": 0.8})
                return normal_of(t, node.outputs[0])

            CASES[f"{mesh}bump by {name}"] = build

    @case("bump by a normal map")
    def _(t):
        mapped = t.out("NormalMap", {"Color": t.color()})
        height = t.out("Math", {0: mapped}, operation="ADD")
        return normal_of(t, t.out("Bump", {"Height": height, "Distance": 0.3}))

    @case("bump of a constant")
    def _(t):
        height = t.out("Math", {0: 0.3, 1: 0.4}, operation="MULTIPLY")
        return t.out("Bump", {"Height": height, "Normal": t.vector()})

    @case("bumps of several widths")
    def _(t):
        node = bumps(t, 3.0)
        t.tree.links.new(bumps(t, 0.5).outputs[0], node.inputs["Normal"])
        return normal_of(t, node.outputs[0])

    for invert in (False, True):
        for strength in (1.0, 0.5):

            def build(t, invert=invert, strength=strength):
                u, v, _ = t.parts()
                height = t.out(
                    "Math",
                    {0: t.out("Math", {0: u, 1: 9.0}, operation="MULTIPLY")},
                    operation="SINE",
                )
                height = t.out("Math", {0: height, 1: v}, operation="MULTIPLY")
                node = t.node(
                    "Bump", {"Height": height, "Strength": strength, "Distance": 0.1}, invert=invert
                )
                return normal_of(t, node.outputs[0])

            CASES[f"bump {invert} {strength}"] = build


def wireframe_cases() -> None:
    for pixels in (False, True):

        def wires(t, size, pixels=pixels):
            return t.out("Wireframe", {0: size}, use_pixel_size=pixels)

        for size in (0.1, 1.2):
            for mesh in ("", "pieces "):
                CASES[f"{mesh}wireframe {pixels} {size}"] = lambda t, size=size, wires=wires: wires(
                    t, size
                )

        @case(f"wireframe {pixels} by a number")
        def _(t, wires=wires):
            inputs = {"Value": t.signed()[0], "From Min": -2.0, "From Max": 2.0, "To Max": 2.0}
            return wires(t, t.out("MapRange", inputs))

        @case(f"bump by wireframe {pixels}")
        def _(t, wires=wires):
            return t.out("Bump", {"Height": wires(t, 0.5), "Distance": 0.3})


def sky_cases() -> None:
    """As a colour by direction: sky_views.py has worlds. Some models let nothing be linked."""
    for model in enum_items("TexSky", "sky_type"):
        for elevation in (0.3, 0.0):

            def build(t, model=model, elevation=elevation):
                node = t.node(
                    "TexSky",
                    sky_type=model,
                    sun_size=0.5,
                    sun_intensity=0.1,
                    sun_elevation=elevation,
                    sun_rotation=4.0,
                    altitude=500.0,
                    sun_direction=(0.5, 0.6, 2.0 * elevation),
                )
                if node.inputs[0].enabled:
                    unit = t.out("VectorMath", {0: t.vector()}, operation="NORMALIZE")
                    t.tree.links.new(unit, node.inputs[0])
                return node.outputs[0]

            CASES[f"sky {model} {elevation}"] = build
        CASES[f"sky {model} without vector"] = lambda t, model=model: t.out(
            "TexSky", sky_type=model, sun_size=0.5, sun_intensity=0.1, sun_elevation=0.9
        )
