# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as nobody would make them: any node, any setting, any link, groups in groups.

`cases(first, count)` maps "graph N" to functions of a Tree, as node_cases.py does; N is the seed.
From LATER on there are also the nodes that Janus learned later, so that the graphs before stay as
they are; from WILD on numbers are those at which floats end.
"""

from __future__ import annotations

import random

from .node_cases import Tree
from .node_cases_groups import new_group, repeat
from .node_cases_images import picture

VALUES = (
    *("Math", "VectorMath", "Mix", "MixRGB", "MapRange", "Clamp", "Mapping", "VectorRotate"),
    *("VectorTransform", "CombineXYZ", "SeparateXYZ", "CombineColor", "SeparateColor", "Gamma"),
    *("HueSaturation", "BrightContrast", "Invert", "RGBToBW", "ValToRGB", "RGBCurve", "FloatCurve"),
    *("VectorCurve", "Normal", "Blackbody", "Value", "RGB", "TexImage", "TexEnvironment"),
    *("TexCoord", "UVMap", "Attribute", "VertexColor", "NewGeometry", "Tangent", "ObjectInfo"),
    *("CameraData", "Fresnel", "LayerWeight", "NormalMap", "Bump", "Wavelength", "TexWhiteNoise"),
    *("TexNoise", "TexVoronoi", "TexGabor", "RadialTiling", "TexGradient", "TexChecker"),
    *("TexMagic", "TexBrick", "TexWave"),
)
LEARNED = (
    *("Wireframe", "LightPath", "LightFalloff", "ParticleInfo", "PointInfo", "HairInfo"),
    *("Displacement", "VectorDisplacement"),
)
SELDOM = ("AmbientOcclusion", "Bevel", "Wireframe", "LightPath", "ParticleInfo", "PointInfo")
SHADERS = ("BsdfDiffuse", "Emission", "MixShader")
ATTRIBUTES = ("Float", "Edge Bool", "Vector", "Color", "Face", "Pair", "Missing", "Number", "Layer")
SOCKETS = ("Float", "Int", "Bool", "Vector", "Color")
LIMIT = 20.0  # what a tile shows
LATER, WILD = 100_000, 1_000_000
RARE = (0.0, 1.0, -1.0, 1e4, -1e4, 1e-6)
RARER = (1e20, -1e20, 3e38, -3e38, 1e-38, 1e30)


def cases(first: int, count: int) -> dict:
    return {f"graph {n}": lambda t, n=n: Maker(n).graph(t) for n in range(first, first + count)}


class Maker:
    """Makes the tree of a seed."""

    def __init__(self, seed: int):
        self._random = random.Random(seed)
        self._seldom = self._random.random() < 0.15
        self._values = VALUES + LEARNED if seed >= LATER else VALUES
        self._rare = RARE + RARER if seed >= WILD else RARE

    def graph(self, t: Tree):
        sources = [*t.parts(), t.vector(), t.color(), t.coordinate("Object")]
        self._grow(t.tree, sources, self._random.randint(5, 40), 0)
        ends = [s for s in sources[-6:] if s.type in ("VALUE", "VECTOR", "RGBA")]
        return self._within_limits(t, self._random.choice(ends or sources[:3]))

    @staticmethod
    def _within_limits(t: Tree, socket):
        above = t.out("VectorMath", {0: socket, 1: [-LIMIT] * 3}, operation="MAXIMUM")
        return t.out("VectorMath", {0: above, 1: [LIMIT] * 3}, operation="MINIMUM")

    def _grow(self, tree, sources: list, count: int, depth: int) -> None:
        """Adds nodes to the tree, and their outputs to the sources of those after them."""
        for _ in range(count):
            made = self._node(tree, sources, depth)
            for node in made:
                self._settings(node)
                self._links(tree, node, sources)
                if self._random.random() < 0.05:
                    node.mute = True
            outputs = [s for s in made[-1].outputs if s.enabled and s.type != "CUSTOM"]
            if self._random.random() < 0.1 and outputs:
                reroute = tree.nodes.new("NodeReroute")
                tree.links.new(self._random.choice(outputs), reroute.inputs[0])
                outputs = reroute.outputs
            sources += outputs

    def _node(self, tree, sources, depth: int) -> list:
        choice = self._random.random()
        if choice < 0.06 and depth < 3:
            return [self._group(tree, depth)]
        if choice < 0.08 and depth < 2 and self._has_zones():
            return self._zone(tree, sources, depth)
        if choice < 0.1:
            return [tree.nodes.new(f"ShaderNode{self._random.choice(SHADERS)}")]
        names = SELDOM if self._seldom and choice < 0.2 else self._values
        return [tree.nodes.new(f"ShaderNode{self._random.choice(self._known(names))}")]

    @staticmethod
    def _known(names) -> list[str]:
        """Without those that this Blender does not have."""
        import bpy

        return [name for name in names if hasattr(bpy.types, f"ShaderNode{name}")]

    @staticmethod
    def _has_zones() -> bool:
        import bpy

        return bpy.app.version >= (5, 0, 0)

    def _group(self, tree, depth: int):
        interface = [
            [(f"S{i}", self._random.choice(SOCKETS)) for i in range(self._random.randint(1, 3))]
            for _ in range(2)
        ]
        group, start, end = new_group(*interface)
        sources = [s for s in start.outputs if s.type != "CUSTOM"]
        self._grow(group, sources, self._random.randint(1, 5), depth + 1)
        for socket in end.inputs:
            if socket.type != "CUSTOM" and self._random.random() < 0.8:
                group.links.new(self._random.choice(sources), socket)
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        return node

    def _zone(self, tree, sources, depth: int) -> list:
        kind = self._random.choice(("FLOAT", "VECTOR", "RGBA", "INT"))
        start, end = repeat(tree, [(kind, "Item")], self._random.randint(0, 3))
        inner = [s for s in start.outputs if s.type != "CUSTOM"]
        self._grow(tree, inner, self._random.randint(1, 3), depth + 1)
        tree.links.new(self._random.choice(inner), end.inputs[0])
        tree.links.new(self._random.choice(sources), start.inputs["Item"])
        return [end]

    def _settings(self, node) -> None:
        import bpy

        common = bpy.types.Node.bl_rna.properties
        for p in node.bl_rna.properties:
            if p.identifier in common or p.is_readonly or not self._random.random() < 0.7:
                continue
            if p.type == "ENUM" and not p.is_enum_flag:
                items = [i.identifier for i in p.enum_items if i.identifier != "ROTATION"]
                setattr(node, p.identifier, self._random.choice(items))
            elif p.type == "BOOLEAN":
                setattr(node, p.identifier, self._random.random() < 0.5)
            elif node.type in ("TEX_MAGIC", "TEX_BRICK") and p.type in ("INT", "FLOAT"):
                low, high = p.soft_min, p.soft_max
                x = self._random.uniform(low, high)
                setattr(node, p.identifier, round(x) if p.type == "INT" else x)
        if node.type == "ATTRIBUTE":
            node.attribute_name = self._random.choice(ATTRIBUTES)
        elif node.type in ("TEX_IMAGE", "TEX_ENVIRONMENT"):
            node.image = picture("Bytes") if self._random.random() < 0.9 else None
        elif node.type == "VALTORGB":
            node.color_ramp.elements.new(self._random.random()).color = self._numbers(4)
        elif hasattr(node, "mapping") and hasattr(node.mapping, "curves"):
            curve = self._random.choice(list(node.mapping.curves))
            curve.points.new(self._random.random(), self._random.random())
            node.mapping.update()

    def _links(self, tree, node, sources) -> None:
        for socket in node.inputs:
            if not socket.enabled or socket.type in ("CUSTOM", "MENU"):
                continue
            if self._random.random() < 0.6:
                link = tree.links.new(self._random.choice(sources), socket)
                link.is_muted = self._random.random() < 0.03
            elif socket.type == "VALUE":
                socket.default_value = self._numbers(1)[0]
            elif socket.type in ("INT", "BOOLEAN"):
                socket.default_value = self._random.randint(0, 1)
            elif socket.type in ("VECTOR", "RGBA") and not socket.hide_value:
                socket.default_value = self._numbers(len(socket.default_value))

    def _numbers(self, count: int) -> list[float]:
        """Everyday numbers, and now and then one that is none."""
        if self._random.random() < 0.1:
            return [self._random.choice(self._rare)] * count
        return [self._random.uniform(-1.5, 2.5) for _ in range(count)]
