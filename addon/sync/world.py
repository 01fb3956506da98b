# SPDX-License-Identifier: GPL-3.0-or-later
"""The world: its node tree, or its plain colour."""

import bpy

from .graph import read_aovs, read_graph
from .visibility import LIGHT_RAYS, light_group


def sync_world(builder, depsgraph, images, log, aovs: dict[str, str]) -> None:
    """Sends the world of the view layer; none, or one that the layer leaves out, is black.
    `aovs`: see flatten_aovs().
    """
    layer = depsgraph.view_layer_eval
    world = getattr(layer, "world_override", None) or depsgraph.scene_eval.world
    if world is None or not layer.use_sky:
        builder.set_world(name="", graph=None)
        return
    written = None
    if uses_nodes(world):
        output = world.node_tree and world.node_tree.get_output_node("CYCLES")
        if output and output.inputs["Volume"].is_linked:
            log.warning("volumes are not supported yet", object=world.name)
        graph = read_graph(world.node_tree, depsgraph)
        images.send(graph, world)
        if written := read_aovs(world.node_tree, depsgraph, aovs):
            images.send(written, world)
    else:
        graph = background_graph(world.color)
    if getattr(getattr(world, "cycles", None), "max_bounces", 1024) < 1024:
        log.info(
            "the world's own limit of bounces is left out: in Cycles, too, light from the world "
            "that bounces more often is found where rays leave the scene",
            object=world.name,
        )
    builder.set_world(
        name=world.name,
        graph=graph,
        light_group=light_group(world, layer),
        aovs=written,
        **seen_by_world(world),
    )


def seen_by_world(world) -> dict:
    """Cycles keeps the ray visibility of worlds; without it, everything sees them."""
    visibility = getattr(world, "cycles_visibility", None)
    return {f"visible_{ray}": getattr(visibility, ray, True) for ray in LIGHT_RAYS}


def uses_nodes(owner) -> bool:
    """use_nodes of a world or material: it counts before Blender 5.0 only."""
    return bpy.app.version >= (5, 0, 0) or owner.use_nodes


def background_graph(color) -> dict:
    inputs = {"Color": [*color[:3], 1.0], "Strength": 1.0}
    node = {"name": "Background", "type": "BACKGROUND", "inputs": inputs, "properties": {}}
    return {"nodes": [node], "surface": {"link": ["Background", "Background"]}}
