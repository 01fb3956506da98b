# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for procedural textures.

Most look at places on a grid of about a pixel: there both engines compute the same numbers,
whatever the slope. The others take what a texture takes by itself.
"""

from __future__ import annotations

from .node_cases import CASES, case, enum_items

DIMENSIONS = ("1D", "2D", "3D", "4D")


def add_cases() -> None:
    import bpy

    white_noise_cases()
    pattern_cases()
    brick_cases()
    wave_cases()
    voronoi_cases()
    if bpy.app.version >= (4, 3, 0):
        gabor_cases()
    if bpy.app.version >= (5, 0, 0):
        radial_tiling_cases()
    for first in (370.0, 500.0, 630.0):
        add(
            f"wavelength {first:.0f}",
            "Wavelength",
            lambda t, first=first: {0: spread(t, t.signed()[0], first, first + 160.0)},
            ("Color",),
        )
    noise_cases()


def place(t, size=0.27, shift=(0.013, 0.37, 0.11)):
    """A vector from about -2 to 2 that is the same all over a pixel."""
    snapped = t.out("VectorMath", {0: t.vector(), 1: [size] * 3}, operation="SNAP")
    return t.out("VectorMath", {0: snapped, 1: shift}, operation="ADD")


def numbers(t):
    """Three of them."""
    return t.node("SeparateXYZ", {0: place(t)}).outputs


def spread(t, number, low, high):
    return t.out(
        "MapRange",
        {"Value": number, "From Min": -2.0, "From Max": 2.0, "To Min": low, "To Max": high},
    )


def add(name, kind, inputs, outputs, **properties):
    """A case for each output of a node, within limits that a tile can show; inputs: a function of
    the tree.
    """
    for output in outputs:

        def build(t, output=output):
            seen = t.out(kind, inputs(t), output, **properties)
            above = t.around("VectorMath", {0: seen, 1: [-50.0] * 3}, operation="MAXIMUM")
            return t.around("VectorMath", {0: above, 1: [50.0] * 3}, operation="MINIMUM")

        CASES[f"{name} {output}"] = build


def white_noise_cases() -> None:
    def inputs(dimensions):
        def make(t):
            wanted = {} if dimensions == "1D" else {"Vector": place(t, 0.25, (0.0, 0.5, 3.0))}
            if dimensions in ("1D", "4D"):
                wanted["W"] = t.out("Math", {0: t.signed()[1], 1: 0.25}, operation="SNAP")
            return wanted

        return make

    for d in DIMENSIONS:
        add(f"white noise {d}", "TexWhiteNoise", inputs(d), ("Value", "Color"), noise_dimensions=d)
    add("white noise of nothing", "TexWhiteNoise", lambda t: {}, ("Value", "Color"))


def pattern_cases() -> None:
    for kind in enum_items("TexGradient", "gradient_type"):
        add(
            f"gradient {kind}",
            "TexGradient",
            lambda t: {"Vector": place(t)},
            ("Fac", "Color"),
            gradient_type=kind,
        )
        add(
            f"gradient {kind} of nothing", "TexGradient", lambda t: {}, ("Fac",), gradient_type=kind
        )

    def colors(t):
        return {"Color1": t.color(), "Color2": t.color(0.4)}

    add(
        "checker",
        "TexChecker",
        lambda t: {"Vector": place(t), "Scale": 3.3} | colors(t),
        ("Fac", "Color"),
    )
    add(
        "checker of whole numbers",
        "TexChecker",
        lambda t: {"Vector": place(t, 0.25, (0.0, 0.5, 3.0)), "Scale": 4.0},
        ("Fac", "Color"),
    )
    add(
        "checker by a number",
        "TexChecker",
        lambda t: {"Scale": spread(t, numbers(t)[0], -4.0, 4.0)},
        ("Fac", "Color"),
    )
    for depth in range(11):
        add(
            f"magic {depth}",
            "TexMagic",
            lambda t: {"Vector": place(t), "Scale": 1.3, "Distortion": 0.8},
            ("Fac", "Color"),
            turbulence_depth=depth,
        )
    add(
        "magic of many turns",
        "TexMagic",
        lambda t: {
            "Vector": t.out("VectorMath", {0: place(t), "Scale": 11.0}, operation="SCALE"),
            "Scale": 1.3,
        },
        ("Color",),
    )
    add("magic of nothing", "TexMagic", lambda t: {}, ("Fac", "Color"))
    add(
        "magic by numbers",
        "TexMagic",
        lambda t: {"Scale": numbers(t)[0], "Distortion": numbers(t)[1]},
        ("Color",),
        turbulence_depth=4,
    )
    for distortion in (0.0, -1.5):
        add(
            f"magic {distortion}",
            "TexMagic",
            lambda t, distortion=distortion: {"Vector": place(t), "Distortion": distortion},
            ("Color",),
        )


def brick_cases() -> None:
    def colors(t):
        return {"Color1": t.color(), "Color2": t.color(0.4), "Mortar": (0.9, 0.1, 0.4, 1.0)}

    def sizes(t):
        return {"Scale": 1.1, "Mortar Size": 0.08, "Bias": 0.1, "Brick Width": 0.9}

    for frequency, squash in ((1, 1), (2, 3), (3, 2)):
        add(
            f"brick {frequency} {squash}",
            "TexBrick",
            lambda t: {"Vector": place(t), "Mortar Smooth": 0.6} | colors(t) | sizes(t),
            ("Fac", "Color"),
            offset=0.3,
            offset_frequency=frequency,
            squash=0.7,
            squash_frequency=squash,
        )
    for smooth in (0.0, 1.0):
        add(
            f"brick smooth {smooth}",
            "TexBrick",
            lambda t, smooth=smooth: {"Vector": place(t), "Mortar Smooth": smooth} | sizes(t),
            ("Fac", "Color"),
        )
    add("brick of nothing", "TexBrick", lambda t: {}, ("Fac", "Color"))
    add(
        "brick by numbers",
        "TexBrick",
        lambda t: {
            "Vector": place(t),
            "Scale": spread(t, numbers(t)[0], -2.0, 2.0),
            "Mortar Size": spread(t, numbers(t)[1], -0.1, 0.5),
            "Mortar Smooth": spread(t, numbers(t)[2], -0.2, 1.2),
            "Bias": numbers(t)[0],
            "Brick Width": spread(t, numbers(t)[1], -0.5, 2.0),
            "Row Height": spread(t, numbers(t)[2], -0.5, 2.0),
        },
        ("Fac", "Color"),
    )


def wave_cases() -> None:
    def basic(t):
        return {"Vector": place(t), "Scale": 0.4, "Phase Offset": 0.7}

    for profile in enum_items("TexWave", "wave_profile"):
        for kind, directions in (("BANDS", "bands_direction"), ("RINGS", "rings_direction")):
            for direction in enum_items("TexWave", directions):
                settings = {"wave_type": kind, directions: direction, "wave_profile": profile}
                add(f"wave {kind} {direction} {profile}", "TexWave", basic, ("Fac",), **settings)
        add(f"wave of nothing {profile}", "TexWave", lambda t: {}, ("Fac",), wave_profile=profile)
        add(
            f"wave by numbers {profile}",
            "TexWave",
            lambda t: {
                "Vector": place(t),
                "Scale": spread(t, numbers(t)[0], -1.0, 2.0),
                "Distortion": numbers(t)[1],
                "Detail": spread(t, numbers(t)[2], -0.9, 6.0),
                "Detail Scale": numbers(t)[0],
                "Detail Roughness": spread(t, numbers(t)[1], -0.5, 1.5),
                "Phase Offset": numbers(t)[2],
            },
            ("Fac", "Color"),
            wave_profile=profile,
        )
    add(
        "wave distorted",
        "TexWave",
        lambda t: basic(t) | {"Distortion": 3.0, "Detail": 2.6, "Detail Scale": 1.4},
        ("Fac", "Color"),
    )


def voronoi_cases() -> None:
    outputs = {
        "DISTANCE_TO_EDGE": ("Distance",),
        "N_SPHERE_RADIUS": ("Radius",),
    }

    def inputs(dimensions, feature, metric, numbered):
        def make(t):
            wanted = {} if dimensions == "1D" else {"Vector": place(t)}
            if dimensions in ("1D", "4D"):
                wanted["W"] = numbers(t)[1]
            if feature == "SMOOTH_F1":
                wanted["Smoothness"] = spread(t, numbers(t)[0], -0.1, 1.1) if numbered else 0.7
            if metric == "MINKOWSKI" and dimensions != "1D":
                wanted["Exponent"] = spread(t, numbers(t)[1], 0.2, 3.0) if numbered else 1.6
            wanted["Randomness"] = spread(t, numbers(t)[2], -0.2, 1.2) if numbered else 0.8
            wanted["Scale"] = spread(t, numbers(t)[1], -1.0, 2.0) if numbered else 1.3
            if numbered and feature != "N_SPHERE_RADIUS":
                wanted["Detail"] = spread(t, numbers(t)[0], -1.0, 2.0)
                wanted["Roughness"] = spread(t, numbers(t)[1], -0.2, 1.2)
                wanted["Lacunarity"] = spread(t, numbers(t)[2], 0.3, 3.0)
            return wanted

        return make

    for d in DIMENSIONS:
        places = {"1D": ("W",), "4D": ("Position", "W")}.get(d, ("Position",))
        for feature in enum_items("TexVoronoi", "feature"):
            metrics = ["EUCLIDEAN"]
            if d != "1D" and feature not in outputs:
                metrics = enum_items("TexVoronoi", "distance")
            for metric in metrics:
                settings = {"voronoi_dimensions": d, "feature": feature, "distance": metric}
                for numbered in (False, True):
                    add(
                        f"voronoi {d} {feature} {metric}" + (" by numbers" if numbered else ""),
                        "TexVoronoi",
                        inputs(d, feature, metric, numbered),
                        outputs.get(feature, ("Distance", "Color", *places)),
                        **settings,
                        normalize=numbered,
                    )
    add("voronoi of nothing", "TexVoronoi", lambda t: {}, ("Distance", "Color", "Position"))

    @case("bump by voronoi")
    def _(t):
        cells = t.node("TexVoronoi", {"Scale": 1.5}, feature="SMOOTH_F1")
        return t.out("Bump", {"Height": cells.outputs[0], "Distance": 0.3})


def gabor_cases() -> None:
    def flat(t):
        return {"Orientation 2D": numbers(t)[0]}

    def deep(t):
        return {"Orientation 3D": place(t, 0.27, (0.3, 0.6, 0.2))}

    outputs = ("Value", "Phase", "Intensity")
    for kind, orientation in (("2D", flat), ("3D", deep)):
        add(f"gabor {kind} of nothing", "TexGabor", lambda t: {}, outputs, gabor_type=kind)
        for anisotropy in (0.0, 0.4, 1.0):
            add(
                f"gabor {kind} {anisotropy}",
                "TexGabor",
                lambda t, a=anisotropy: {"Vector": place(t), "Scale": 1.3, "Anisotropy": a},
                outputs,
                gabor_type=kind,
            )
        add(
            f"gabor {kind} by numbers",
            "TexGabor",
            lambda t, orientation=orientation: {
                "Vector": place(t),
                "Scale": spread(t, numbers(t)[0], -1.0, 2.0),
                "Frequency": spread(t, numbers(t)[1], -1.0, 6.0),
                "Anisotropy": spread(t, numbers(t)[2], -0.1, 1.1),
                **orientation(t),
            },
            outputs,
            gabor_type=kind,
        )


def radial_tiling_cases() -> None:
    outputs = ("Segment Coordinates", "Segment ID", "Segment Width", "Segment Rotation")
    for normalize in (False, True):
        for sides in (2.0, 2.6, 3.0, 4.7, 6.0):
            for roundness in (0.0, 0.35, 1.0):
                # The corners of two parallel sides lie at infinity.
                there = outputs[1:] if (sides, roundness) == (2.0, 0.35) else outputs
                add(
                    f"radial tiling {normalize} {sides} {roundness}",
                    "RadialTiling",
                    lambda t, sides=sides, roundness=roundness: {
                        "Vector": place(t),
                        "Sides": sides,
                        "Roundness": roundness,
                    },
                    there,
                    normalize=normalize,
                )
        add(
            f"radial tiling {normalize} by numbers",
            "RadialTiling",
            lambda t: {
                "Vector": place(t),
                "Sides": spread(t, numbers(t)[2], 2.1, 9.0),
                "Roundness": spread(t, numbers(t)[0], -0.1, 1.1),
            },
            outputs,
            normalize=normalize,
        )
    add("radial tiling of nothing", "RadialTiling", lambda t: {}, outputs)


def noise_cases() -> None:
    def inputs(dimensions, more):
        def make(t):
            wanted = {} if dimensions == "1D" else {"Vector": place(t)}
            if dimensions in ("1D", "4D"):
                wanted["W"] = numbers(t)[1]
            return wanted | more(t)

        return make

    def basic(t):
        return {"Scale": 1.7, "Detail": 2.4, "Roughness": 0.6, "Lacunarity": 2.3}

    def full(t):
        return {
            "Scale": spread(t, numbers(t)[0], -1.0, 2.0),
            "Detail": spread(t, numbers(t)[1], -1.0, 6.0),
            "Roughness": spread(t, numbers(t)[2], -0.2, 1.3),
            "Lacunarity": spread(t, numbers(t)[0], -0.5, 3.0),
            "Distortion": numbers(t)[1],
        }

    for d in DIMENSIONS:
        for kind in enum_items("TexNoise", "noise_type"):
            heights = {
                "FBM": {},
                "MULTIFRACTAL": {},
                "HETERO_TERRAIN": {"Offset": 0.4},
            }.get(kind, {"Offset": 0.7, "Gain": 1.4})
            for normalize in (False, True) if kind == "FBM" else (True,):
                name = f"noise {d} {kind}" + ("" if normalize else " as it is")
                settings = {"noise_dimensions": d, "noise_type": kind, "normalize": normalize}
                for more, outputs in ((basic, ("Fac", "Color")), (full, ("Color",))):
                    add(
                        f"{name} {more.__name__}",
                        "TexNoise",
                        inputs(d, lambda t, m=more, h=heights: m(t) | h),
                        outputs,
                        **settings,
                    )
        for scale in (3e5, 4e6, 1e20):
            add(
                f"noise {d} far {scale:g}",
                "TexNoise",
                inputs(d, lambda t, scale=scale: {"Scale": scale, "Detail": 0.0}),
                ("Fac",),
                noise_dimensions=d,
            )
    add("noise of nothing", "TexNoise", lambda t: {"Scale": 2.0}, ("Fac", "Color"))
    for name in ("UV", "Object"):
        add(
            f"noise of {name}",
            "TexNoise",
            lambda t, name=name: {"Vector": t.coordinate(name), "Scale": 1.5, "Distortion": 0.5},
            ("Color",),
        )

    @case("noise both")
    def _(t):
        node = t.node("TexNoise", {"Vector": place(t), "Scale": 1.3})
        return t.around("VectorMath", {0: node.outputs["Color"], 1: node.outputs[0]})

    for d in DIMENSIONS:

        @case(f"bump by noise {d}")
        def _(t, d=d):
            scale = {} if d == "1D" else {"Scale": 0.8}
            noise = t.node("TexNoise", {**scale, "Detail": 1.0}, noise_dimensions=d)
            if d in ("1D", "4D"):
                t.tree.links.new(t.parts()[0], noise.inputs["W"])
            return t.out("Bump", {"Height": noise.outputs[0], "Distance": 0.3})
