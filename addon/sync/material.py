# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials: each is sent once, under a key that holds for the whole sync."""

from ..nodes import diffuse_graph
from .graph import read_aovs, read_graph
from .world import uses_nodes


class MaterialSync:
    """Sends materials on first use. `aovs`: those that are wanted, see flatten_aovs()."""

    def __init__(self, builder, depsgraph, images, cache, log, aovs):
        self._builder = builder
        self._cache = cache
        self._depsgraph = depsgraph
        self._override = depsgraph.view_layer_eval.material_override
        self._log = log
        self._aovs = aovs
        self._images = images
        self._sent = {}  # key -> keys of the mesh attributes that it reads

    def attributes(self, keys) -> frozenset[str]:
        """What the materials with these keys read of a mesh."""
        return frozenset().union(*(self._sent[key] for key in keys if key is not None))

    def keys(self, obj) -> list[str | None]:
        """The keys for the object's slots, in order; None for an empty slot."""
        slots = [slot.material for slot in obj.material_slots]
        if self._override is not None:
            slots = [self._override] * max(len(slots), 1)
        return [self._key(material) for material in slots]

    def _key(self, material) -> str | None:
        if material is None:
            return None
        key = self._cache.use(f"material:{material.name_full}")
        if key not in self._sent:
            graph = self._graph(material)
            self._images.send(graph, material)
            aovs = None
            if uses_nodes(material):
                aovs = read_aovs(material.node_tree, self._depsgraph, self._aovs)
            if aovs:
                self._images.send(aovs, material)
            self._sent[key] = self._builder.set_material(
                key,
                name=material.name,
                graph=graph,
                sample_emission=sample_emission(material),
                material_index=material.pass_index,
                aovs=aovs,
            )
        return key

    def _graph(self, material) -> dict:
        if not uses_nodes(material):
            return diffuse_graph(material.diffuse_color)
        tree = material.node_tree
        output = tree.get_output_node("CYCLES") if tree else None
        if output is None:
            self._log.warning(
                "there is no active output node, it renders black", material=material.name
            )
        elif output.inputs["Volume"].is_linked:
            self._log.warning("volumes are not supported yet", material=material.name)
        if output and output.inputs["Displacement"].is_linked:
            self._check_displacement(material, output)
        if not getattr(getattr(material, "cycles", None), "use_bump_map_correction", True):
            self._log.warning("bump map correction is always on", material=material.name)
        return read_graph(tree, self._depsgraph)

    def _check_displacement(self, material, output) -> None:
        if material.displacement_method != "BUMP":
            self._log.warning(
                "displacement of the surface itself is not supported yet; it is rendered as bump",
                material=material.name,
                node=output.name,
            )


def sample_emission(material) -> bool:
    """Shall lights be looked for on it? Cycles' other choices differ in noise alone."""
    return getattr(getattr(material, "cycles", None), "emission_sampling", "AUTO") != "NONE"
