# SPDX-License-Identifier: GPL-3.0-or-later
"""Flattens a shader node tree into one plain graph.

Groups are inlined, reroutes and muted nodes resolved, constant nodes folded, and only what the
output reaches is kept. The format:

    {"nodes": [{"name", "type", "inputs": {identifier: value | {"link": [name, output]}},
                "properties": {identifier: value}}],
     "surface": {"link": [name, output]} | None}

Nothing is left out because it is unsupported: that is for the core to find and to say.
"""

from collections import deque
from dataclasses import dataclass

import bpy

from .convert import convert, plain, socket_value
from .drawn import drawn_properties

# Property types that are plain data; pointers (ramps, curves) need code of their own.
PLAIN_PROPERTIES = {"ENUM", "BOOLEAN", "INT", "FLOAT", "STRING"}
CONSTANT_NODES = {"RGB", "VALUE"}
MAX_STEPS = 10_000  # a cycle through broken links must end


@dataclass(frozen=True)
class Scope:
    """Where a node stands: the group node that was entered, and the scope around it."""

    group: object = None
    parent: "Scope | None" = None

    @property
    def prefix(self) -> str:
        return f"{self.parent.prefix}{self.group.name}/" if self.group else ""


@dataclass(frozen=True)
class Source:
    """What feeds an input: an output of a node of the flat graph, or a constant."""

    type: str  # of the socket that it comes from
    link: list[str] | None = None
    value: object = None

    def as_input(self):
        return {"link": self.link} if self.link else self.value


def flatten_tree(tree, target: str = "CYCLES") -> dict:
    """The graph behind the Surface input of the tree's active output for `target` or All."""
    output = tree.get_output_node(target) if tree else None
    surface = output.inputs.get("Surface") if output else None
    if surface is None:
        return {"nodes": [], "surface": None}
    flattener = _Flattener()
    link = flattener.input(surface, Scope())
    flattener.run()
    return {"nodes": flattener.nodes, "surface": link}


def diffuse_graph(color) -> dict:
    """The graph of a material without nodes."""
    inputs = {"Color": [*color[:3], 1.0], "Roughness": 0.0, "Normal": None}
    node = {"name": "Diffuse BSDF", "type": "BSDF_DIFFUSE", "inputs": inputs, "properties": {}}
    return {"nodes": [node], "surface": {"link": ["Diffuse BSDF", "BSDF"]}}


class _Flattener:
    def __init__(self):
        self.nodes = []
        self._names = {}  # (names of the groups around it, its own) -> unique flat name
        self._taken = set()
        self._pending = deque()

    def run(self) -> None:
        """Writes out the nodes that links have asked for, until none is new."""
        while self._pending:
            node, scope, name = self._pending.popleft()
            inputs = {s.identifier: self.input(s, scope) for s in node.inputs if s.enabled}
            self._write(name, node.type, inputs, _properties(node))

    def input(self, socket, scope: Scope):
        """What the graph says for one input: a link, a value, or None."""
        source = self._source(socket, scope)
        if source is None:
            return socket_value(socket)
        if socket.type == "SHADER":
            return source.as_input() if source.type == "SHADER" else self._emission(source)
        if source.type == "SHADER":  # Blender draws this link red and ignores it
            return socket_value(socket)
        if source.link:
            return source.as_input()
        value = convert(source.value, source.type, socket.type)
        return socket_value(socket) if value is None else value

    def _source(self, socket, scope: Scope) -> Source | None:
        """Follows links through reroutes, muted nodes and groups. None: nothing is connected.

        A constant takes the type of every socket that it passes, as in Blender.
        """
        passed = []
        for _ in range(MAX_STEPS):
            link = _active_link(socket)
            if link is None:
                return None
            node, output = link.from_node, link.from_socket
            if not node.mute and node.type == "GROUP_INPUT" and scope.group is None:
                return None
            if not _passes_through(node):
                return _through(self._output(node, output, scope), passed)
            socket, scope = _behind(node, output, scope)
            if socket is None:
                return None
            if not socket.is_linked and node.type != "REROUTE":
                value = socket_value(socket)
                return None if value is None else _through(Source(socket.type, value=value), passed)
            passed.append(socket.type)
        return None

    def _output(self, node, output, scope: Scope) -> Source:
        if node.type in CONSTANT_NODES:
            return Source(output.type, value=plain(output.default_value))
        return Source(output.type, link=[self._name(node, scope), output.identifier])

    def _name(self, node, scope: Scope) -> str:
        """The node's name in the flat graph; the first request puts it on the list of work."""
        path = [node.name]
        around = scope
        while around.group is not None:
            path.append(around.group.name)
            around = around.parent
        key = tuple(path)
        if key not in self._names:
            self._names[key] = self._unique(scope.prefix + node.name)
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


def _through(source: Source, passed: list[str]) -> Source:
    """A constant source after the sockets on its way, given from the destination on."""
    if source.link or source.type == "SHADER":
        return source
    for kind in reversed(passed):
        value = convert(source.value, source.type, kind)
        if value is not None:
            source = Source(kind, value=value)
    return source


def _active_link(socket):
    if not socket.is_linked:
        return None
    for link in socket.links:
        if link.is_valid and not link.is_muted:
            return link
    return None


def _passes_through(node) -> bool:
    return node.mute or node.type in ("REROUTE", "GROUP", "GROUP_INPUT")


def _behind(node, output, scope: Scope):
    """The input that feeds `output` of a node that only passes values on, and its scope."""
    if node.mute:
        inputs = [k.from_socket for k in node.internal_links if k.to_socket == output]
        return (inputs[0] if inputs else None), scope
    if node.type == "REROUTE":
        return node.inputs[0], scope
    if node.type == "GROUP_INPUT":
        return _by_identifier(scope.group.inputs, output.identifier), scope.parent
    inner = _group_output(node.node_tree)
    socket = _by_identifier(inner.inputs, output.identifier) if inner else None
    return socket, Scope(node, scope)


def _group_output(tree):
    if tree is None:
        return None
    outputs = [node for node in tree.nodes if node.type == "GROUP_OUTPUT"]
    return next((node for node in outputs if node.is_active_output), None)


def _by_identifier(sockets, identifier: str):
    return next((socket for socket in sockets if socket.identifier == identifier), None)


def image_key(image) -> str:
    """What a texture node's property "image" says: the key under which its pixels are sent."""
    return f"image:{image.name_full}"


def _properties(node) -> dict:
    common = bpy.types.Node.bl_rna.properties
    image = getattr(node, "image", None)
    return (
        ({"image": image_key(image)} if isinstance(image, bpy.types.Image) else {})
        | {
            p.identifier: plain(getattr(node, p.identifier))
            for p in node.bl_rna.properties
            if p.type in PLAIN_PROPERTIES and p.identifier not in common
        }
        | drawn_properties(node)
    )
