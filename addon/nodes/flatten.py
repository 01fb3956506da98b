# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattens a shader node tree into one plain graph.

Groups are inlined, reroutes and muted nodes resolved, constant nodes folded, and only what the
output reaches is kept: that of the material, or those of AOVs, in a graph of their own. The format:

    {"nodes": [{"name", "type", "inputs": {identifier: value | {"link": [name, output]}},
                "properties": {identifier: value}}],
     "surface": {"link": [name, output]} | None,
     "displacement": the same, where something is linked to it}

Nothing is left out because it is unsupported: that is for the core to find and to say.
"""

from collections import deque
from dataclasses import dataclass

import bpy

from .convert import TRIPLES, conversion_node, convert, plain, socket_value
from .drawn import constant_curves, drawn_properties
from .links import CONSTANT_NODES, MUTED_ARE_LINKS, End, LinkReader, Scope

# Property types that are plain data; pointers (ramps, curves) need code of their own.
PLAIN_PROPERTIES = {"ENUM", "BOOLEAN", "INT", "FLOAT", "STRING"}
MAX_NODES = 100_000  # of a flat graph: zones in zones may ask for any number
MAX_DEPTH = 100
# Nodes that Blender computes itself where all their inputs are constants (from 5.0 on): what they
# give is a constant, too, and takes the types of the sockets that it passes.
FOLDED_NODES = {
    *("BLACKBODY", "CLAMP", "COMBXYZ", "CURVE_FLOAT", "CURVE_RGB", "CURVE_VEC", "GAMMA"),
    *("MAP_RANGE", "MATH", "MIX", "MIX_RGB", "SEPXYZ", "VALTORGB", "VECTOR_ROTATE", "VECT_MATH"),
}

UNFOLDED = {"RGB", "INPUT_SCENE_TIME"}  # constants that Blender leaves to Cycles
DIFFERENT_FOLDED = {"CURVE_FLOAT", "CURVE_RGB", "CURVE_VEC", "MAP_RANGE"}
# Of Cycles before there was such a socket: Filter Width came with Blender 4.5.
OLD_INPUTS = {"BUMP": {"Filter Width": 1.0}}
# What Cycles computed otherwise in older Blenders: before which one, and what is said of it.
OLD_PROPERTIES = {
    "TEX_VORONOI": ((5, 0, 0), {"old_points": True}),
    "TEX_MAGIC": ((5, 2, 0), {"wraps_unscaled": True}),
}
# Values of properties that Blender 5.2 has given to something new.
SUBSURFACE_METHODS = {"RANDOM_WALK": "RANDOM_WALK_LEGACY"}
OLD_VALUES = {"falloff": SUBSURFACE_METHODS, "subsurface_method": SUBSURFACE_METHODS}
# Of AOV Output, by the type of the AOV.
AOV_INPUTS = {"COLOR": "Color", "VALUE": "Value"}
RENAMED = {"DIFFUSE_BSDF": "BSDF_DIFFUSE"}  # in Blender 4.4, and only there


@dataclass(frozen=True)
class Source:
    """What feeds an input: an output of a node of the flat graph, or a constant."""

    type: str
    link: list[str] | None = None
    value: object = None

    def as_input(self):
        return {"link": self.link} if self.link else self.value


def flatten_tree(tree, scene, target: str = "CYCLES") -> dict:
    """The graph behind the Surface and Displacement inputs of the tree's active output for `target`
    or All, at the time of the scene.
    """
    output = tree.get_output_node(target) if tree else None
    surface = output.inputs.get("Surface") if output else None
    if surface is None:
        return {"nodes": [], "surface": None}
    flattener = _Flattener(scene)
    link = flattener.input(surface, Scope())
    displacement = _displacement(flattener, output)
    flattener.run()
    return {"nodes": flattener.nodes, "surface": link, **displacement}


def _displacement(flattener, output) -> dict:
    socket = output.inputs.get("Displacement") if output else None
    found = flattener.input(socket, Scope()) if socket else None
    return {"displacement": found} if isinstance(found, dict) else {}


def flatten_aovs(tree, scene, wanted: dict[str, str], target: str = "CYCLES") -> dict | None:
    """The graph of the tree's AOV Output nodes, at the time of the scene; None: there are none.
    They see the surface as it is displaced, too.

    `wanted`: name of an AOV -> its type, COLOR or VALUE. Of a node only the input for that type
    is kept.
    """
    flattener = _Flattener(scene)
    for node, scope in _aov_outputs(tree, Scope()) if wanted else ():
        if node.aov_name in wanted:
            flattener.aov(node, scope, AOV_INPUTS[wanted[node.aov_name]])
    if not flattener.nodes:
        return None
    displacement = _displacement(flattener, tree.get_output_node(target))
    flattener.run()
    return {"nodes": flattener.nodes, "surface": None, **displacement}


def _aov_outputs(tree, scope: Scope, depth: int = 0):
    """(AOV Output node, its scope), also of groups, whose output need not be used.

    Blender 5.0 and later leaves muted ones as they are.
    """
    for node in tree.nodes if tree and depth < MAX_DEPTH else ():
        if node.type == "OUTPUT_AOV" and (MUTED_ARE_LINKS or not node.mute):
            yield node, scope
        elif node.type == "GROUP" and not node.mute:
            yield from _aov_outputs(node.node_tree, Scope("GROUP", node, scope), depth + 1)


def diffuse_graph(color) -> dict:
    """The graph of a material without nodes."""
    inputs = {"Color": [*color[:3], 1.0], "Roughness": 0.0, "Normal": None}
    node = {"name": "Diffuse BSDF", "type": "BSDF_DIFFUSE", "inputs": inputs, "properties": {}}
    return {"nodes": [node], "surface": {"link": ["Diffuse BSDF", "BSDF"]}}


class _Flattener:
    def __init__(self, scene):
        self.nodes = []
        self._links = LinkReader(scene)
        self._names = {}  # (names of what is around it, its own) -> unique flat name
        self._taken = set()
        self._folds = {}  # the same keys -> whether Blender computes the node
        self._pending = deque()

    def run(self) -> None:
        """Writes out the nodes that links have asked for, until none is new.

        Of more than MAX_NODES the rest is left out, and the core says that it is not there.
        """
        while self._pending and len(self.nodes) < MAX_NODES:
            node, scope, name = self._pending.popleft()
            inputs = {s.identifier: self.input(s, scope) for s in node.inputs if s.enabled}
            inputs = OLD_INPUTS.get(node.type, {}) | inputs
            properties = _properties(node)
            if node.type in DIFFERENT_FOLDED and self._is_folded(node, scope):
                properties |= self._folded(node, scope)
            self._write(name, RENAMED.get(node.type, node.type), inputs, properties)

    def aov(self, node, scope: Scope, identifier: str) -> None:
        """Writes out an AOV Output node; of the rest no more than MAX_NODES are."""
        if len(self.nodes) < MAX_NODES:
            name = self._unique("/".join((*scope.labels, node.name)))
            inputs = {identifier: self.input(node.inputs[identifier], scope)}
            self._write(name, node.type, inputs, {"aov_name": node.aov_name})

    def input(self, socket, scope: Scope):
        """What the graph says for one input: a link, a value, or None."""
        end = self._links.follow(socket, scope)
        if end is None:
            return socket_value(socket)
        source = self._source(end)
        if socket.type == "SHADER":
            return source.as_input() if source.type == "SHADER" else self._emission(source)
        if source.type == "SHADER":  # Blender draws this link red and ignores it
            return socket_value(socket)
        if source.link:
            return source.as_input()
        value = convert(source.value, source.type, socket.type)
        return socket_value(socket) if value is None else value

    def _source(self, end: End) -> Source:
        if end.node is None:
            return _through(Source(end.type, value=end.value), end.passed)
        if end.node.type in CONSTANT_NODES:
            source = Source(end.type, value=self._links.value(end.node, end.output))
            straight = end.node.type in UNFOLDED and converts_constants_only()
            return source if straight else _through(source, end.passed)
        source = Source(end.type, [self._name(end.node, end.scope), end.output.identifier])
        if not end.passed or source.type == "SHADER":
            return source
        if converts_constants_only() and not self._is_folded(end.node, end.scope):
            return source
        for target in reversed(end.passed):
            source = self._converted(source, target)
        return source

    def _is_folded(self, node, scope: Scope, depth: int = 0) -> bool:
        """Does Blender compute the node before Cycles sees it?"""
        if node.type in CONSTANT_NODES:
            return node.type not in UNFOLDED
        if not converts_constants_only() or node.type not in FOLDED_NODES or depth > MAX_DEPTH:
            return False
        key = (*scope.labels, node.name)
        if key not in self._folds:  # each node once: there are more ways to one than nodes
            ends = (self._links.follow(s, scope) for s in node.inputs if s.enabled)
            self._folds[key] = all(
                e is None or e.node is None or self._is_folded(e.node, e.scope, depth + 1)
                for e in ends
            )
        return self._folds[key]

    def _folded(self, node, scope: Scope) -> dict:
        """What is different where Blender computes the node: curves are no tables, and have limits;
        an empty range has another value.
        """
        if node.type == "MAP_RANGE":
            return {"folded": True}
        changed = {"extend": "HORIZONTAL"} if node.type == "CURVE_FLOAT" else {}
        value = self._links.constant(node.inputs[1], scope)
        return changed if value is None else changed | constant_curves(node, value)

    def _converted(self, source: Source, target: str) -> Source:
        """The source as a socket of another type lets it pass."""
        made = conversion_node(source.type, target, source.as_input())
        if made is None:
            return source
        kind, inputs, properties, output = made
        name = self._unique("Conversion")
        self._write(name, kind, inputs, properties)
        result = Source(target, [name, output])
        if target == "BOOLEAN" and source.type in TRIPLES:
            return self._converted(Source("VALUE", result.link), target)
        return result

    def _name(self, node, scope: Scope) -> str:
        """The node's name in the flat graph; the first request puts it on the list of work."""
        key = (*scope.labels, node.name)
        if key not in self._names:
            self._names[key] = self._unique("/".join(key))
            self._pending.append((node, scope, self._names[key]))
        return self._names[key]

    def _emission(self, source: Source) -> dict:
        """A colour or a number that feeds a closure emits, as in Cycles."""
        color = source.as_input()
        if source.link is None:
            color = convert(source.value, source.type, "RGBA")
        name = self._unique("Emission")
        self._write(name, "EMISSION", {"Color": color, "Strength": 1.0}, {})
        return {"link": [name, "Emission"]}

    def _unique(self, name: str) -> str:
        unique, number = name, 1
        while unique in self._taken:
            unique, number = f"{name}#{number}", number + 1
        self._taken.add(unique)
        return unique

    def _write(self, name, kind, inputs, properties) -> None:
        self.nodes.append({"name": name, "type": kind, "inputs": inputs, "properties": properties})


def converts_constants_only() -> bool:
    """From Blender 5.0 on what varies passes the sockets of groups as it is."""
    return bpy.app.version >= (5, 0, 0)


def _through(source: Source, passed: tuple[str, ...]) -> Source:
    """A constant source after the sockets on its way, given from the destination on."""
    for kind in reversed(passed):
        value = convert(source.value, source.type, kind)
        if value is not None:
            source = Source(kind, value=value)
    return source


def image_key(image) -> str:
    """What a texture node's property "image" says: the key under which its pixels are sent."""
    return f"image:{image.name_full}"


def _value(node, key: str):
    value = plain(getattr(node, key))
    if key in OLD_VALUES and bpy.app.version < (5, 2, 0):
        return OLD_VALUES[key].get(value, value)
    return value


def _properties(node) -> dict:
    common = bpy.types.Node.bl_rna.properties
    until, old = OLD_PROPERTIES.get(node.type, ((0,), {}))
    image = getattr(node, "image", None)
    return (
        ({"image": image_key(image)} if isinstance(image, bpy.types.Image) else {})
        | {
            p.identifier: _value(node, p.identifier)
            for p in node.bl_rna.properties
            if p.type in PLAIN_PROPERTIES and p.identifier not in common
        }
        | drawn_properties(node)
        | (old if bpy.app.version < until else {})
    )
