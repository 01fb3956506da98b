# SPDX-License-Identifier: GPL-3.0-or-later
"""From an input of a node back to what feeds it, through all that only passes values on: reroutes,
muted nodes, groups, Repeat zones, Menu Switches, bundles and closures.

What cannot be resolved (a number of iterations that is no constant) stays a node of the graph, for
the core to name.
"""

from dataclasses import dataclass, field, replace

import bpy

from .convert import convert, plain, socket_value, triple

MAX_STEPS = 10_000  # a cycle through broken links must end, and so must a zone
# From Blender 5.0 on, the value of the next socket counts where nothing is behind a muted node.
MUTED_ARE_LINKS = bpy.app.version >= (5, 0, 0)
MAX_DEPTH = 50  # of bundles in bundles, menus by menus
# Where a node without inputs keeps its value; None: in its output.
CONSTANT_NODES = {
    **dict.fromkeys(("RGB", "VALUE", "INPUT_SCENE_TIME")),
    **{"INPUT_BOOL": "boolean", "INPUT_INT": "integer", "INPUT_VECTOR": "vector"},
    "FunctionNodeInputMenu": "value",
}
ZONE_INPUTS = {"REPEAT_INPUT", "NodeClosureInput"}


@dataclass(frozen=True)
class Scope:
    """Where a node stands: what was entered (a group node, or the output node of a zone), and the
    scope around it.
    """

    kind: str = ""  # GROUP, REPEAT, CLOSURE; empty: the tree itself
    node: object = None
    parent: "Scope | None" = None
    iteration: int = 0  # of a Repeat zone
    caller: "tuple | None" = field(default=None, compare=False)  # of a closure: who evaluates it

    @property
    def labels(self) -> tuple[str, ...]:
        """The names on the way here, from the outermost."""
        if self.parent is None:
            return ()
        number = f":{self.iteration}" if self.kind == "REPEAT" else ""
        own = f"{self.node.name}{number}"
        if self.caller is not None:
            evaluate, scope = self.caller
            own = "/".join((*scope.labels, evaluate.name, own))
        return (*self.parent.labels, own)


@dataclass(frozen=True)
class End:
    """What feeds an input: an output of a node, or a constant (then `node` is None)."""

    type: str  # of the socket that it comes from
    node: object = None
    output: object = None
    scope: Scope | None = None
    value: object = None
    passed: tuple[str, ...] = ()  # the types of the sockets on the way, from the destination on


class LinkReader:
    """Follows the links of a tree and of what it contains. `scene`: whose time nodes ask for."""

    def __init__(self, scene):
        self._scene = scene
        self._zones = {}
        self._joined = {}

    def follow(self, socket, scope: Scope, depth: int = 0, link=None) -> End | None:
        """What feeds the input; None: nothing is connected, so that its own value counts.

        `link`: which of the input's links, if it has several.
        """
        passed, unlinked = [], None
        for _ in range(MAX_STEPS):
            link = link or next(_active_links(socket), None)
            if link is None:
                return unlinked
            node, output = link.from_node, link.from_socket
            scope = self._leave_zones(node, scope)
            step = self._behind(node, output, scope, depth)
            if isinstance(step, End):
                return replace(step, passed=(*passed, *step.passed))
            if step is None or step[0] is None:
                return unlinked
            socket, scope = step
            if node.type != "REROUTE" and not (node.mute and MUTED_ARE_LINKS):
                # What muted nodes pass on is nothing, not the value of their socket.
                value = convert(0.0, "VALUE", socket.type) if node.mute else socket_value(socket)
                end = End(socket.type, value=value, passed=(*passed,))
                unlinked = None if value is None else end
            passed.append(socket.type)
            link = None
        return None

    def value(self, node, output):
        """Of a node of CONSTANT_NODES."""
        if node.type == "INPUT_SCENE_TIME":
            frame, rate = self._scene.frame_current_final, self._scene.render
            return frame if output.identifier == "Frame" else frame * rate.fps_base / rate.fps
        name = CONSTANT_NODES[node.type]
        value = plain(getattr(node, name) if name else output.default_value)
        return triple(value) if node.type == "INPUT_VECTOR" else value

    def constant(self, socket, scope: Scope, depth: int = 0):
        """The value of an input if it is one and the same everywhere, else None."""
        end = self.follow(socket, scope, depth + 1)
        if end is None:
            return socket_value(socket)
        value, kind = end.value, end.type
        if end.node is not None:
            if end.node.type not in CONSTANT_NODES:
                return None
            value = self.value(end.node, end.output)
        for target in (*reversed(end.passed), socket.type):
            value, kind = convert(value, kind, target), target
        return value

    def _behind(self, node, output, scope: Scope, depth: int):
        """The input that feeds `output` of a node that only passes values on, and its scope; an End
        where there is none to look behind; None: nothing feeds it.
        """
        if node.mute:
            inputs = [k.from_socket for k in node.internal_links if k.to_socket == output]
            return (inputs[0], scope) if inputs else None
        step = STEPS.get(node.type)
        found = (
            step(self, node, output, scope, depth) if step and depth < MAX_DEPTH else NotImplemented
        )
        return End(output.type, node, output, scope) if found is NotImplemented else found

    def _reroute(self, node, _output, scope, _depth):
        return node.inputs[0], scope

    def _group_input(self, _node, output, scope, _depth):
        if scope.kind != "GROUP":
            return None
        return _by_identifier(scope.node.inputs, output.identifier), scope.parent

    def _group(self, node, output, scope, _depth):
        inner = _group_output(node.node_tree)
        socket = _by_identifier(inner.inputs, output.identifier) if inner else None
        return socket, Scope("GROUP", node, scope)

    def _menu_switch(self, node, output, scope, depth):
        chosen = self.constant(node.inputs["Menu"], scope, depth)
        items = [s for s in node.inputs if s.identifier.startswith("Item_")]
        item = next((s for s in items if s.name == chosen), None)
        if output.identifier.startswith("Item_"):
            is_chosen = item is not None and item.identifier == output.identifier
            return End("BOOLEAN", value=is_chosen)
        return None if item is None else (item, scope)

    def _repeat_output(self, node, output, scope, depth):
        start = zone_input(node)
        count = self.constant(start.inputs["Iterations"], scope, depth) if start else None
        if count is None or count > MAX_STEPS:
            return NotImplemented
        if count < 1:
            return _by_identifier(start.inputs, output.identifier), scope
        inside = Scope("REPEAT", node, scope, count - 1)
        return _by_identifier(node.inputs, output.identifier), inside

    def _repeat_input(self, node, output, scope, _depth):
        if scope.kind != "REPEAT":
            return None
        if output.identifier == "Iteration":
            return End("INT", value=scope.iteration)
        if scope.iteration == 0:
            return _by_identifier(node.inputs, output.identifier), scope.parent
        before = Scope("REPEAT", scope.node, scope.parent, scope.iteration - 1)
        return _by_identifier(scope.node.inputs, output.identifier), before

    def _separate_bundle(self, node, output, scope, depth):
        end = self.follow(node.inputs["Bundle"], scope, depth + 1)
        return self._item(end, output.name, depth + 1)

    def _item(self, end: End | None, name: str, depth: int):
        """The input that puts an item into the bundle at `end`, and its scope; None: none does."""
        if end is None or end.node is None or depth > MAX_DEPTH:
            return None
        if end.node.type == "NodeCombineBundle":
            socket = _by_name(end.node.inputs, name)
            return socket and (socket, end.scope)
        if end.node.type != "NodeJoinBundle":
            return None
        key = (*end.scope.labels, end.node.name, name)
        if key not in self._joined:  # each once: there are more ways to one than nodes
            self._joined[key] = None
            socket = end.node.inputs["Bundle"]
            for link in _active_links(socket):  # of equal names the first counts
                part = self.follow(socket, end.scope, depth + 1, link)
                self._joined[key] = self._item(part, name, depth + 1)
                if self._joined[key]:
                    break
        return self._joined[key]

    def _evaluate_closure(self, node, output, scope, depth):
        end = self.follow(node.inputs["Closure"], scope, depth + 1)
        if end is None or end.node is None or end.node.type != "NodeClosureOutput":
            return None
        inside = Scope("CLOSURE", end.node, end.scope, caller=(node, scope))
        return _by_name(end.node.inputs, output.name), inside

    def _closure_input(self, _node, output, scope, _depth):
        if scope.kind != "CLOSURE":
            return None
        evaluate, around = scope.caller
        return _by_name(evaluate.inputs, output.name), around

    def _leave_zones(self, node, scope: Scope) -> Scope:
        """What a zone does not change is outside of it, even if the zone reads it."""
        while scope.kind in ("REPEAT", "CLOSURE") and node.name not in self._inside(scope.node):
            scope = scope.parent
        return scope

    def _inside(self, output_node) -> set[str]:
        """The names of the nodes of a zone: those that its input reaches."""
        tree = output_node.id_data
        key = (tree.as_pointer(), output_node.name)
        if key not in self._zones:
            start = zone_input(output_node)
            targets = {}
            for link in tree.links:
                targets.setdefault(link.from_node.name, []).append(link.to_node.name)
            inside, pending = set(), [start.name] if start else []
            while pending:
                name = pending.pop()
                if name not in inside and name != output_node.name:
                    inside.add(name)
                    pending += targets.get(name, ())
            self._zones[key] = inside
        return self._zones[key]


STEPS = {
    "REROUTE": LinkReader._reroute,
    "NodeImplicitConversion": LinkReader._reroute,
    "GROUP_INPUT": LinkReader._group_input,
    "GROUP": LinkReader._group,
    "MENU_SWITCH": LinkReader._menu_switch,
    "REPEAT_OUTPUT": LinkReader._repeat_output,
    "REPEAT_INPUT": LinkReader._repeat_input,
    "NodeSeparateBundle": LinkReader._separate_bundle,
    "NodeEvaluateClosure": LinkReader._evaluate_closure,
    "NodeClosureInput": LinkReader._closure_input,
}


def zone_input(output_node):
    """The node with which a zone starts, by that with which it ends."""
    starts = (n for n in output_node.id_data.nodes if n.type in ZONE_INPUTS)
    return next((n for n in starts if n.paired_output == output_node), None)


def _active_links(socket):
    """What feeds an input, the link that is drawn at the top first."""
    links = socket.links if socket.is_linked else ()
    if len(links) > 1:
        links = sorted(links, key=lambda link: -link.multi_input_sort_id)
    return (link for link in links if link.is_valid and not link.is_muted)


def _group_output(tree):
    if tree is None:
        return None
    outputs = [node for node in tree.nodes if node.type == "GROUP_OUTPUT"]
    return next((node for node in outputs if node.is_active_output), None)


def _by_identifier(sockets, identifier: str):
    return next((socket for socket in sockets if socket.identifier == identifier), None)


def _by_name(sockets, name: str):
    return next((socket for socket in sockets if socket.name == name), None)
