# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of what is displaced: Cycles bumps the whole surface by it, and all nodes see that."""

from __future__ import annotations

from .node_cases import CASES, enum_items
from .node_cases_places import normal_of


def seen_on(t, displacement, seen):
    """`seen`, of a surface that is displaced; the case is about the displacement."""
    t.displace(displacement)
    inputs = {0: displacement, 1: (0.0,) * 3, 2: seen}
    return t.around("VectorMath", inputs, operation="MULTIPLY_ADD")


def waves(t, times: float = 9.0):
    u, v, _ = t.parts()
    sine = t.out("Math", {0: t.out("Math", {0: u, 1: times}, operation="MULTIPLY")})
    sine.node.operation = "SINE"
    return t.out("Math", {0: sine, 1: v}, operation="MULTIPLY")


def displaced(t, height=None, scale=0.1, **settings):
    inputs = {"Height": height or waves(t), "Midlevel": 0.2, "Scale": scale}
    return t.out("Displacement", inputs, **settings)


def both_meshes(name: str, build) -> None:
    CASES[name] = build
    CASES[f"pieces {name}"] = build


def add_cases() -> None:
    value_cases()
    for space in enum_items("Displacement", "space"):

        def build(t, space=space):
            return seen_on(t, displaced(t, space=space), t.out("NewGeometry", output="Normal"))

        both_meshes(f"displaced {space}", build)
    for space in enum_items("VectorDisplacement", "space"):

        def build(t, space=space):
            inputs = {"Vector": t.color(), "Midlevel": 0.4, "Scale": 0.2}
            made = t.out("VectorDisplacement", inputs, space=space)
            return seen_on(t, made, t.out("NewGeometry", output="Normal"))

        both_meshes(f"displaced by vectors {space}", build)
    height_cases()
    reader_cases()


def value_cases() -> None:
    """What the nodes give, where it is only looked at."""
    for space in enum_items("Displacement", "space"):
        for linked in (False, True):

            def build(t, space=space, linked=linked):
                inputs = {"Height": t.parts()[0], "Midlevel": t.parts()[1], "Scale": t.signed()[2]}
                normal = {"Normal": t.vector()} if linked else {}
                return t.out("Displacement", {**inputs, **normal}, space=space)

            both_meshes(f"displacement {space} {linked}", build)
    for space in enum_items("VectorDisplacement", "space"):

        def build(t, space=space):
            inputs = {"Vector": t.color(), "Midlevel": t.parts()[1], "Scale": t.signed()[2]}
            return t.out("VectorDisplacement", inputs, space=space)

        both_meshes(f"vector displacement {space}", build)


def height_cases() -> None:
    heights = {
        **{f"coordinate {n}": ("TexCoord", n) for n in ("Normal", "Camera", "Generated", "Object")},
        **{f"geometry {n}": ("NewGeometry", n) for n in ("Normal", "Parametric", "Position")},
        "tangent": ("Tangent", "Tangent"),
        "facing": ("LayerWeight", "Facing"),
    }
    for name, (kind, output) in heights.items():

        def build(t, kind=kind, output=output):
            height = t.out("VectorMath", {0: t.out(kind, output=output), 1: (0.3, 0.5, 0.1)})
            made = displaced(t, height, 0.4)
            return seen_on(t, made, t.out("NewGeometry", output="Normal"))

        both_meshes(f"displaced by {name}", build)

    def by(name, height):
        def build(t):
            made = displaced(t, height(t), 0.3)
            return seen_on(t, made, t.out("NewGeometry", output="Normal"))

        CASES[f"displaced by {name}"] = build

    by("noise", lambda t: t.out("TexNoise", {"Scale": 0.8, "Detail": 1.0}))
    by("voronoi", lambda t: t.out("TexVoronoi", {"Scale": 1.5}, feature="SMOOTH_F1"))
    by("wireframe", lambda t: t.out("Wireframe", {0: 0.4}))
    by("a normal map", lambda t: t.out("Math", {0: t.out("NormalMap", {"Color": t.color()})}))
    for name, made in {"a number": waves, "a vector": lambda t: t.vector()}.items():

        def build(t, made=made):
            small = t.around("VectorMath", {0: made(t), 1: (0.1, 0.2, 0.15)}, operation="MULTIPLY")
            return seen_on(t, small, t.out("NewGeometry", output="Normal"))

        CASES[f"displaced by {name} alone"] = build

    def constant(t):
        made = t.out("Displacement", {"Height": 0.9, "Scale": 2.0})
        return seen_on(t, made, t.out("NewGeometry", output="Normal"))

    CASES["displaced by a constant"] = constant

    def along(t, normal):
        made = t.out("Displacement", {"Height": waves(t), "Scale": 0.1, "Normal": normal})
        return seen_on(t, made, t.out("NewGeometry", output="Normal"))

    both_meshes("displaced along another normal", lambda t: along(t, t.vector()))
    # Where Cycles displaces, bumps have no slope.
    both_meshes(
        "displaced along a bump",
        lambda t: along(t, t.out("Bump", {"Height": t.parts()[0], "Normal": t.vector()})),
    )
    both_meshes(
        "displaced along a normal map",
        lambda t: along(t, t.out("NormalMap", {"Color": t.color(), "Strength": 0.6})),
    )


def reader_cases() -> None:
    """What sees the new normal."""
    readers = {
        **{f"coordinate {n}": ("TexCoord", n) for n in ("Normal", "Reflection")},
        **{f"geometry {n}": ("NewGeometry", n) for n in ("Normal", "True Normal", "Tangent")},
        "tangent": ("Tangent", "Tangent"),
        "fresnel": ("Fresnel", "Fac"),
        "facing": ("LayerWeight", "Facing"),
    }
    for name, (kind, output) in readers.items():
        both_meshes(
            f"displaced for {name}",
            lambda t, kind=kind, output=output: seen_on(
                t, displaced(t), t.out(kind, output=output)
            ),
        )
    for space in enum_items("NormalMap", "space"):

        def build(t, space=space):
            inputs = {"Color": t.color(), "Strength": 0.4}
            mapped = t.out("NormalMap", inputs, space=space)
            return seen_on(t, displaced(t), normal_of(t, mapped))

        CASES[f"displaced for a normal map {space}"] = build

    def bumped(t, **inputs):
        height = t.out("Math", {0: t.parts()[1], 1: 5.0}, operation="MULTIPLY")
        height = t.out("Math", {0: height}, operation="SINE")
        return t.out("Bump", {"Height": height, "Distance": 0.1, **inputs})

    both_meshes("displaced for a bump", lambda t: seen_on(t, displaced(t), normal_of(t, bumped(t))))

    def by_normal(t):
        """The height of the bump sees it as well."""
        new = t.node("SeparateXYZ", {0: t.out("NewGeometry", output="Normal")}).outputs[2]
        height = t.out("Math", {0: new, 1: t.parts()[1]}, operation="MULTIPLY")
        bump = t.out("Bump", {"Height": height, "Distance": 0.3})
        return seen_on(t, displaced(t), normal_of(t, bump))

    both_meshes("displaced for a bump by the normal", by_normal)
