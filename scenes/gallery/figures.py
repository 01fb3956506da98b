# SPDX-License-Identifier: GPL-3.0-or-later
"""What the gallery shows, and what it says about it. Plain data: no bpy, no rendering.

Texts are a little Markdown: `code`, *emphasis* and [links](path from the root of the tree).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

PT = {"integrator": "pt"}
LT = {"integrator": "lt"}
# The lecture's algorithm: a light path for each camera path, and all pairs of vertices are joined.
PAIRS = {"integrator": "bdpt", "connection_mode": "CLASSIC", "adaptive_counts": False}
BDPT = {"integrator": "bdpt", "connection_mode": "CACHE"}
VCM = {**BDPT, "merge_radius": 0.01}

LABELS = {
    "pt": "path tracing",
    "lt": "light tracing",
    "bdpt": "bidirectional",
    "pairs": "bidirectional, all pairs",
    "vcm": "bidirectional + merging",
}
PATHS_PER_PIXEL = 10  # as in the lecture


@dataclass(frozen=True)
class Comparison:
    """Ways to render one scene, measured against a reference.

    `at_samples`, `at_time`: by key of LABELS, how they render. `second`: the second opinion on the
    reference. `reference_variant`: what the scene's build() is told to make a scene that looks the
    same and is easier. `patience`: how many times the usual time its pictures have.
    """

    title: str
    scene: str
    text: tuple[str, ...]
    at_samples: Mapping[str, Mapping]
    at_time: Mapping[str, Mapping]
    second: Mapping | None = None
    reference_variant: Mapping[str, object] = field(default_factory=dict)
    patience: float = 1.0


@dataclass(frozen=True)
class Classes:
    """The light of classes of paths: pictures by light path expression, beside the whole."""

    title: str
    scene: str
    text: tuple[str, ...]
    expressions: tuple[tuple[str, str, str], ...]  # key, expression, what it is
    # Key, label, and the inputs of Principled BSDFs by name: the whole picture of the scene with
    # these inputs in all of its materials.
    altered: tuple[str, str, Mapping[str, float]] | None = None


LECTURE_SAMPLES = {"pt": PT, "lt": LT, "bdpt": PAIRS}
LECTURE_TIME = {"pt": PT, "lt": LT, "pairs": PAIRS, "bdpt": BDPT}
BEYOND = {"pt": PT, "lt": LT, "bdpt": BDPT, "vcm": VCM}

FIGURES: dict[str, Comparison | Classes] = {
    "diffuse": Comparison(
        "A simple scene",
        "cornell_box",
        (
            "Everything is diffuse and the lamp is large: `LD*E`. Every way finds all paths. A "
            "path from the eye is joined with a point of the lamp at each vertex "
            "([`connect_to_light`](core/janus/path/connect.h)), and a path from the lamp with the "
            "eye ([`connect_to_camera`](core/janus/path/connect.h)).",
            "*Look at* the noise of 10 paths per pixel, where bidirectional path tracing looks far "
            "better, and then at the costs: its sample is two paths and all joins between them, "
            "so that at equal time the path tracer has several times as many, and there is little "
            "between them. How many light paths and joins are worth their time is measured while "
            "it renders ([`AdaptiveCounts`](core/janus/integrator/adaptive_counts.h)).",
        ),
        LECTURE_SAMPLES,
        LECTURE_TIME,
        second=PT,
    ),
    "glass": Comparison(
        "... plus glass and mirror",
        "glass_box",
        (
            "A room like the first, with a glass and a mirror sphere. The caustic under the glass "
            "is `LS+DE`. A path tracer has no strategy for it but to leave the floor in just the "
            "right direction, through the glass, and to hit the lamp by chance.",
            "*Look at* the floor under the glass sphere: path tracing has dots, light tracing a "
            "smooth caustic. Then at the spheres in light tracing: **they are black**. Glass sends "
            "light on in one direction, and the chance that it is the one to the pinhole is 0, so "
            "that [`connect_to_camera`](core/janus/path/connect.h) has nothing to join. "
            "Bidirectional path tracing has the best of both, by weights "
            "([`Mis`](core/janus/path/mis.h)). What stays are bright dots *in* the glass and the "
            "mirror: `LS+DS+E`, the subject of the last figure.",
        ),
        LECTURE_SAMPLES,
        LECTURE_TIME,
        second=PT,
    ),
    "indirect": Comparison(
        "Lamps that hide",
        "hidden_light",
        (
            "After a scene of Veach's: the lamps stand in opaque shades, so that nearly all light "
            "is indirect. From most places in the room no lamp can be seen: a path tracer joins "
            "its vertices with the lamps in vain.",
            "*Look at* the walls: joins in the middle of the path, from a vertex that the light "
            "has reached to one that the eye has reached "
            "([`connect_vertices`](core/janus/path/connect.h)), find what neither end finds. The "
            "bright patch on the table is a caustic of the glass egg.",
        ),
        LECTURE_SAMPLES,
        LECTURE_TIME,
    ),
    "classes": Classes(
        "Classes of paths",
        "glass_box",
        (
            "Heckbert's notation as pictures, of one and the same render: each path is sorted by "
            "what happened at its vertices ([`parse_expression`](core/janus/path/expression.h), "
            "[`PathAutomaton`](core/janus/path/automaton.h)). Where classes share no path, their "
            "pictures add up.",
            "*Look at* `LDD+E`, diffuse inter-reflections: the ceiling is lit by nothing else, and "
            "the colours of the walls bleed. `LS+DE` are the caustics: of the glass on the floor, "
            "and of the mirror. [core/LECTURE.md](core/LECTURE.md) has more of them, the grammar, "
            "and the pyramid of strategies: what each (s,t) adds to the picture.",
        ),
        (
            ("direct", "L(D|S)E", "direct illumination"),
            ("inter", "LDD+E", "diffuse inter-reflections"),
            ("caustics", "LS+DE", "caustics"),
            ("specular", "L.*SE", "seen in mirror and glass"),
            ("hard", "LS+DS+E", "caustics seen in mirror and glass"),
        ),
    ),
    "subsurface": Classes(
        "Subsurface scattering",
        "skin",
        (
            "Light goes into skin and wax, scatters below the surface, and comes up elsewhere "
            "([`SubsurfaceWalk`](core/janus/render/subsurface_walk.h)). Such a walk is one vertex "
            "with two ends, and a D: both ends can be joined with the other side's path.",
            "*Look at* the candle below its flame, which glows, and at the ears and the shadowed "
            "side of the head: beside the opaque version of the same colours, edges of shadows "
            "are soft and red. The last picture is the light that has been below a surface alone, "
            "without the gloss on top of it.",
        ),
        (("below", "L.*(<D'Head'>|<D'Candle'>)E", "light from below the surface"),),
        ("opaque", "the same, opaque", {"Subsurface Weight": 0.0}),
    ),
    "mirror": Comparison(
        "Where even bidirectional path tracing fails: a caustic in a mirror",
        "caustic_mirror",
        (
            "A glass ball under a point light, and a mirror. The caustic on the floor is `LSSDE`, "
            "and light paths find it. In the mirror it is `LSSDSE`. Path tracing would have to hit "
            "a light without size ([`trace_camera_subpath`](core/janus/path/subpath.h)): "
            "impossible. It cannot look for the light either, as glass is in between "
            "([`connect_to_light`](core/janus/path/connect.h)). A light path cannot be joined with "
            "the eye, as the mirror is in between "
            "([`connect_to_camera`](core/janus/path/connect.h)). And there are no two D in a row "
            "to be joined ([`connect_vertices`](core/janus/path/connect.h)). All (s,t) have "
            "density 0.",
            "*Look at* the mirror: the ball's reflection stands in a shadow without a caustic, "
            "and no number of samples changes that: with bidirectional path tracing the picture "
            "stays too dark, which is what *brightness* says in the table, and *RMSE*. (*relMSE* "
            "is mostly about the noise of the many dark pixels.) With errors shown instead, what "
            "is missing is bright: the caustic, and around it the light that the mirror throws "
            "onto the floor, `LSDE`, which is `LSDSE` in the mirror.",
            "Merging ([`merge_vertices`](core/janus/path/connect.h)) has the caustic: both walks "
            "reach the floor, the one through the glass, the other by way of the mirror, and if "
            "they arrive within a centimetre of each other, that counts as the same point. It "
            "blurs light a little, a bias that gets smaller with each pass.",
            "The reference is unbiased: the mirror is replaced by a hole in the wall, with a "
            "mirrored copy of the room behind it. Then the caustic is seen directly. A pool in the "
            "sun is full of such paths, `LSDSE` (`./dev render pool`): as the sun has a size, a "
            "path from the eye may hit it by chance, which helps little "
            "([`SpecularWalks`](core/janus/integrator/specular_walks.h)).",
        ),
        {},
        BEYOND,
        reference_variant={"twin": True},
        patience=3.0,
    ),
}
