# SPDX-License-Identifier: GPL-3.0-or-later
"""Node trees as graphs in which nothing is left to be looked up in Blender."""

from ..nodes import flatten_tree
from .properties import view_layer_value


def read_graph(tree, depsgraph) -> dict:
    """The flat graph of a tree, with what its nodes read of the view layer."""
    graph = flatten_tree(tree, depsgraph.scene_eval)
    for node in graph["nodes"]:
        properties = node["properties"]
        if node["type"] == "ATTRIBUTE" and properties["attribute_type"] == "VIEW_LAYER":
            properties["value"] = list(view_layer_value(depsgraph, properties["attribute_name"]))
    return graph
