# SPDX-License-Identifier: GPL-3.0-or-later
"""`fuzz_graphs.py FIRST COUNT FOLDER`: node graphs that no editor would make, one for each seed.

Any nodes with any properties, links in circles, to nothing and of wrong types, thousands of nodes
in a row or side by side, numbers that are none. Each is rendered as a surface, a world or a lamp.
A process of its own, as a crash is what is looked for; the seed is in FOLDER/calls.txt.
"""

from __future__ import annotations

import resource
import sys
from pathlib import Path

import janus_core
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tests.bindings.conftest import fill  # noqa: E402
from tests.hardening.nonsense import NUMBERS, Nonsense  # noqa: E402

MEMORY = 6 << 30
TYPES = {node["type"]: node for node in janus_core.node_types()}
SHADERS = [
    name for name, node in TYPES.items() if {"BSDF", "BSSRDF", "Shader"} & {*node["outputs"]}
]
PROPERTIES = (
    *(
        "clamp",
        "clamp_factor",
        "clamp_result",
        "from_instancer",
        "invert",
        "normalize",
        "use_clamp",
    ),
    *("old_points", "sun_disc", "use_pixel_size", "direction", "ies", "object_matrix", "range"),
    *("sun_direction", "table", "tiles", "value", "air_density", "altitude", "filter_width"),
    *("ground_albedo", "offset", "offset_frequency", "ozone_density", "projection_blend"),
    *("squash", "squash_frequency", "sun_elevation", "sun_intensity", "sun_rotation", "sun_size"),
    *("turbidity", "turbulence_depth", "aov_name", "attribute_name", "attribute_type", "axis"),
    *("blend_type", "clamp_type", "convention", "convert_from", "convert_to", "data_type"),
    *("distance", "extension", "factor_mode", "falloff", "feature", "gabor_type", "image"),
    *("interpolation", "interpolation_type", "mode", "noise_dimensions", "noise_type", "operation"),
    *("projection", "sky_type", "space", "subsurface_method", "uv_map", "vector_type"),
    *("voronoi_dimensions", "wave_profile", "wave_type", "rotation_type", "distribution", "model"),
    *("component", "parametrization", "folded", "wraps_unscaled", "world_normals"),
)
WORDS = (
    *("", "ADD", "DIVIDE", "POWER", "LOGARITHM", "MODULO", "WRAP", "SNAP", "REFRACT", "REFLECT"),
    *("NORMALIZE", "PROJECT", "PINGPONG", "MULTIPLY_ADD", "TANGENT", "SQRT", "INVERSE_SQRT"),
    *("STEPPED", "SMOOTHSTEP", "BURN", "DODGE", "HSV", "HSL", "VECTOR", "RGBA", "FLOAT", "BOX"),
    *("1D", "2D", "3D", "4D", "F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"),
    *("MINKOWSKI", "FBM", "RIDGED_MULTIFRACTAL", "HETERO_TERRAIN", "HYBRID_MULTIFRACTAL", "TUBE"),
    *("PREETHAM", "HOSEK_WILKIE", "NISHITA", "MULTIPLE_SCATTERING", "GGX", "MULTI_GGX", "BECKMANN"),
    *(
        "ASHIKHMIN_SHIRLEY",
        "F82",
        "PHYSICAL_CONDUCTOR",
        "RANDOM_WALK",
        "RANDOM_WALK_SKIN",
        "BURLEY",
    ),
    *("OBJECT", "WORLD", "CAMERA", "BLENDER_OBJECT", "sky", "no image", "REPEAT", "CLIP", "MIRROR"),
    *("Cubic", "UV", "SPHERE", "EULER_XYZ", "AXIS_ANGLE", "FRESNEL", "CHIANG", "HUANG", "MELANIN"),
    *(
        "ABSORPTION",
        "COLOR",
        "Reflection",
        "Transmission",
        "Transmittance",
        "GEOMETRY",
        "INSTANCER",
    ),
)
TABLE_LENGTHS = (0, 1, 2, 3, 4, 5, 8, 16, 255, 256, 257, 1024, 1028)
DEEP = 20_000


class Maker:
    def __init__(self, seed: int):
        self._nonsense = Nonsense(seed)
        self._random = self._nonsense.random

    def graph(self) -> dict:
        shape = self._random.random()
        if shape < 0.06:
            nodes = self._row()
        elif shape < 0.08:
            nodes = self._side_by_side()
        else:
            nodes = [self._node(i) for i in range(self._random.randint(1, 25))]
        graph = {"nodes": nodes}
        if self._random.random() < 0.95:
            shaders = [node for node in nodes if node["type"] in SHADERS]
            end = self._random.choice(shaders or nodes)
            graph["surface"] = {"link": [end["name"], self._output(end["type"])]}
        if self._random.random() < 0.3:
            graph["displacement"] = self._link(len(nodes))
        self._types = [node["type"] for node in nodes]
        return graph

    def _node(self, number: int) -> dict:
        kind = self._random.choice(SHADERS if self._random.random() < 0.3 else list(TYPES))
        if self._random.random() < 0.02:
            kind = self._random.choice(("NO_SUCH_NODE", "", "VOLUME_SCATTER"))
        known = TYPES.get(kind, {"inputs": []})
        inputs = {
            socket["identifier"]: self._input(number)
            for socket in known["inputs"]
            if self._random.random() < 0.8
        }
        if self._random.random() < 0.05:
            inputs["No such input"] = self._input(number)
        properties = {
            self._random.choice(PROPERTIES): self._property()
            for _ in range(self._random.randint(0, 12))
        }
        # Names that are not unique, now and then.
        name = f"n{self._random.randrange(number + 1) if self._random.random() < 0.02 else number}"
        return {"name": name, "type": kind, "inputs": inputs, "properties": properties}

    def _input(self, number: int):
        choice = self._random.random()
        if choice < 0.5:
            return self._link(number)
        if choice < 0.6:
            return None
        if choice < 0.8:
            return self._float()
        return [self._float() for _ in range(self._random.choice((3, 3, 4)))]

    def _link(self, number: int) -> dict:
        """Mostly to a node before, now and then to any, itself or none."""
        choice = self._random.random()
        to = self._random.randrange(max(number, 1))
        if choice < 0.05:
            to = self._random.randrange(30)
        kind = self._random.choice(list(TYPES)) if self._random.random() < 0.3 else None
        return {"link": [f"n{to}", self._output(kind)]}

    def _output(self, kind: str | None) -> str:
        outputs = TYPES[kind]["outputs"] if kind in TYPES else ()
        common = (
            "BSDF",
            "Color",
            "Value",
            "Vector",
            "Fac",
            "Emission",
            "Shader",
            "Result",
            "Normal",
        )
        return self._random.choice(outputs or common)

    def _float(self) -> float:
        if self._random.random() < 0.2:
            return self._random.choice([x for x in NUMBERS if isinstance(x, float)])
        return self._random.uniform(-1.0, 2.0)

    def _property(self):
        choice = self._random.random()
        if choice < 0.6:
            return self._random.choice(WORDS)
        if choice < 0.75:
            return self._random.random() < 0.5
        if choice < 0.9:
            return self._float()
        length = self._random.choice(TABLE_LENGTHS)
        return [self._float() for _ in range(length)]

    def _row(self) -> list[dict]:
        """Each node's value is the next one's, some the first one's, too: deeper than any stack."""
        kind, output, sockets = self._random.choice(
            (
                ("MATH", "Value", ("Value",)),
                ("MIX_SHADER", "Shader", ("Shader", "Shader_001")),
                ("ADD_SHADER", "Shader", ("Shader", "Shader_001")),
                ("BUMP", "Normal", ("Normal", "Height")),
            )
        )
        length = self._random.choice((100, 1000, DEEP))
        nodes = [{"name": "n0", "type": "EMISSION" if "SHADER" in kind else "FRESNEL"}]
        first = "Emission" if "SHADER" in kind else "Fac"
        for i in range(1, length):
            link = {"link": [f"n{i - 1}", output if i > 1 else first]}
            inputs = {name: link for name in sockets}
            nodes.append({"name": f"n{i}", "type": kind, "inputs": inputs})
        if "SHADER" in kind and self._random.random() < 0.5:
            link = {"link": [f"n{length - 1}", output]}
            nodes[0] = {"name": "n0", "type": kind, "inputs": dict.fromkeys(sockets, link)}
        elif "SHADER" not in kind:
            socket = "Normal" if kind == "BUMP" else "Roughness"
            link = {"link": [f"n{length - 1}", output]}
            nodes.append({"name": "end", "type": "BSDF_GLOSSY", "inputs": {socket: link}})
        return nodes

    def _side_by_side(self) -> list[dict]:
        """A tree of thousands of leaves."""
        count = self._random.choice((64, 1000, 4000))
        shaders = self._random.random() < 0.5
        leaf, out = ("BSDF_DIFFUSE", "BSDF") if shaders else ("TEX_NOISE", "Fac")
        join, result, sockets = (
            ("ADD_SHADER", "Shader", ("Shader", "Shader_001"))
            if shaders
            else ("MATH", "Value", ("Value", "Value_001"))
        )
        nodes = [{"name": f"n{i}", "type": leaf} for i in range(count)]
        open_ends = [(node["name"], out) for node in nodes]
        while len(open_ends) > 1:
            a, b = open_ends.pop(0), open_ends.pop(0)
            name = f"n{len(nodes)}"
            inputs = {sockets[0]: {"link": list(a)}, sockets[1]: {"link": list(b)}}
            nodes.append({"name": name, "type": join, "inputs": inputs})
            open_ends.append((name, result))
        if not shaders:
            link = {"link": list(open_ends[0])}
            nodes.append({"name": "end", "type": "EMISSION", "inputs": {"Strength": link}})
        return nodes


SETTINGS = janus_core.RenderSettings(
    width=8, height=8, samples=1, max_bounces=4, threads=2, data_passes=["Normal", "UV"]
)


def render(seed: int) -> bool:
    """Whether there was something to render."""
    graph = Maker(seed).graph()
    builder = janus_core.SceneBuilder()
    fill(builder)
    try:
        if seed % 8 == 0:
            builder.set_world(name="World", graph=graph)
        elif seed % 8 == 1:
            lamp = {"name": "Lamp", "type": ("POINT", "SPOT", "AREA", "SUN")[seed // 8 % 4]}
            builder.set_light("lamp", **lamp, transform=np.eye(4), graph=graph)
        else:
            builder.set_image("sky", name="Sky", pixels=np.ones((2, 2, 4)))
            builder.set_material("m", name="Paint", graph=graph)
        scene = builder.commit()
    except (janus_core.SceneError, MemoryError) as error:
        assert str(error)
        return False
    session = janus_core.RenderSession(scene, SETTINGS)
    session.start()
    session.finish()
    for name in session.passes():
        pixels = session.snapshot(name)
        assert np.isfinite(pixels).all(), f"pass {name}"
    return True


def main() -> None:
    first, count, folder = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    rendered = 0
    for seed in range(first, first + count):
        (folder / "calls.txt").write_text(f"graph of seed {seed}")
        rendered += render(seed)
    print(rendered)


if __name__ == "__main__":
    main()
