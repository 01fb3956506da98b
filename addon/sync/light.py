# SPDX-License-Identifier: GPL-3.0-or-later
"""Lights, in Blender's own words and units."""

import bpy
import numpy as np

from .graph import read_graph
from .visibility import LIGHT_RAYS, light_group, seen_by


def sync_light(builder, key: str, obj, matrix, depsgraph, images, links: dict, log) -> None:
    """Sends the light object `obj` at `matrix`; portals, which emit nothing, are left out. `links`:
    what it shines on, Linking.of_light() among it.
    """
    light = obj.data
    if getattr(getattr(light, "cycles", None), "is_portal", False):
        log.info("portals are not used for sampling yet", object=obj.name)
        return
    check_light(obj, log)
    graph = read_graph(light.node_tree, depsgraph) if has_nodes(light) else None
    if graph is not None:
        images.send(graph, obj)
    builder.set_light(
        key,
        name=obj.name,
        type=light.type,
        transform=np.array(matrix, dtype=np.float64),
        color=color(light),
        energy=light.energy,
        normalize=getattr(light, "normalize", True),
        exposure=getattr(light, "exposure", 0.0),
        cast_shadow=light.use_shadow,
        max_bounces=getattr(getattr(light, "cycles", None), "max_bounces", 1024),
        graph=graph,
        light_group=light_group(obj, depsgraph.view_layer_eval),
        **shape(light),
        **seen_by(obj, LIGHT_RAYS),
        **links,
    )


def color(light) -> tuple[float, float, float]:
    """The tint, with the colour of the temperature where that is in use."""
    tint = tuple(light.color)
    if getattr(light, "use_temperature", False):
        return tuple(a * b for a, b in zip(tint, light.temperature_color, strict=True))
    return tint


def has_nodes(light) -> bool:
    """Blender 5.2 gives each light a tree; before, use_nodes decides."""
    if bpy.app.version >= (5, 1, 0) and light.node_tree is not None:
        return True
    return light.use_nodes and light.node_tree is not None


def shape(light) -> dict:
    """The arguments of set_light that belong to the light's type."""
    if light.type == "AREA":
        return {
            "shape": light.shape,
            "size": light.size,
            "size_y": light.size_y,
            "spread": light.spread,
        }
    if light.type == "SUN":
        return {"angle": light.angle}
    point = {"radius": light.shadow_soft_size, "soft_falloff": light.use_soft_falloff}
    if light.type == "SPOT":
        point |= {
            "spot_size": light.spot_size,
            "spot_blend": light.spot_blend,
            "spot_square": light.use_square,
        }
    return point


def check_light(obj, log) -> None:
    """Names what the core does not know about this light yet."""
    if obj.data.type == "SPOT" and obj.data.use_square:
        log.info("a square spot is round here, as in Cycles", object=obj.name)
    cycles = getattr(obj.data, "cycles", None)
    if not getattr(cycles, "use_multiple_importance_sampling", True):
        log.info("mirrors show this light, though its multiple importance is off", object=obj.name)
