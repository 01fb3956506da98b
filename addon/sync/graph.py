# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as graphs in which nothing is left to be looked up in Blender."""

from ..nodes import flatten_aovs, flatten_tree
from .properties import view_layer_value


def read_graph(tree, depsgraph) -> dict:
    """The flat graph of a tree, with what its nodes read of the view layer."""
    return _with_layer(flatten_tree(tree, depsgraph.scene_eval), depsgraph)


def read_aovs(tree, depsgraph, wanted: dict[str, str]) -> dict | None:
    """The same of its AOV Output nodes, see flatten_aovs()."""
    graph = flatten_aovs(tree, depsgraph.scene_eval, wanted)
    return graph and _with_layer(graph, depsgraph)


def _with_layer(graph: dict, depsgraph) -> dict:
    for node in graph["nodes"]:
        properties = node["properties"]
        if node["type"] == "ATTRIBUTE" and properties["attribute_type"] == "VIEW_LAYER":
            properties["value"] = list(view_layer_value(depsgraph, properties["attribute_name"]))
    return graph
