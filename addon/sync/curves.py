# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair curves, particle hair and point clouds, as arrays of SceneBuilder.set_curves and
set_points."""

from itertools import chain

import bpy
import numpy as np

from .attributes import active_uv, in_texture_space, named_attribute

CURVE_RADIUS, POINT_RADIUS = 0.005, 0.01  # of curves and points without one, as in Cycles
POLY = 1  # of the attribute curve_type
# Since then Cycles draws curves of straight pieces as such.
HAS_STRAIGHT = bpy.app.version >= (5, 0, 0)
HAIR = "hair"  # what grows on a surface: the part of an object that is no shape of its own
DOMAINS = {"CURVE": "FACE"}  # what the core calls a curve's own


def curves_arrays(curves, keys, log) -> dict | None:
    """Of a Curves data-block; None: there is nothing to be seen."""
    starts = np.empty(len(curves.curve_offset_data), dtype=np.int32)
    curves.curve_offset_data.foreach_get("value", starts)
    if len(starts) < 2 or len(curves.points) == 0:
        return None
    positions, radii = _positions(curves), _radii(curves, CURVE_RADIUS)
    named = {}
    for key in sorted(keys):
        kind, _, name = key.partition(":")
        if kind == "attribute" or (kind == "uv" and name):
            named[key] = named_attribute(curves, name, log)
        elif kind == "uv":
            named[key] = named_attribute(curves, _first_uv(curves), log)
    return {
        "positions": positions,
        "radii": radii,
        "curves": starts,
        "straight": _straight(curves),
        "attributes": _attributes(named) + _along(positions, radii, starts, keys),
    }


def points_arrays(cloud, keys, log) -> dict | None:
    """Of a PointCloud data-block."""
    if len(cloud.points) == 0:
        return None
    named = {
        key: named_attribute(cloud, key.partition(":")[2], log)
        for key in sorted(keys)
        if key.startswith(("attribute:", "uv:"))
    }
    radii = _radii(cloud, POINT_RADIUS)
    if "point_radius" in keys:
        named["point_radius"] = {"domain": "POINT", "values": radii}
    return {
        "positions": _positions(cloud),
        "radii": radii,
        "attributes": _attributes(named),
    }


def curves_form(data) -> tuple[np.ndarray, None]:
    """The positions of either, as mesh_form() gives those of a mesh."""
    return _positions(data), None


def _positions(data) -> np.ndarray:
    positions = np.empty(3 * len(data.points), dtype=np.float32)
    data.attributes["position"].data.foreach_get("vector", positions)
    return positions.reshape(-1, 3)


def _radii(data, default: float) -> np.ndarray:
    radii = np.full(len(data.points), default, dtype=np.float32)
    attribute = data.attributes.get("radius")
    if attribute is not None and attribute.domain == "POINT" and attribute.data_type == "FLOAT":
        attribute.data.foreach_get("value", radii)
    return radii


def _straight(curves) -> bool:
    """As the first curve is, so are all, in Cycles' eyes."""
    kinds = curves.attributes.get("curve_type")
    return HAS_STRAIGHT and kinds is not None and kinds.data[0].value == POLY


def _first_uv(curves) -> str:
    """Curves have no UV maps: pairs of numbers on each serve as one."""
    return next(
        (a.name for a in curves.attributes if (a.data_type, a.domain) == ("FLOAT2", "CURVE")), ""
    )


def _attributes(named: dict) -> list[dict]:
    return [
        {"key": key, **value, "domain": DOMAINS.get(value["domain"], value["domain"])}
        for key, value in named.items()
        if value is not None
    ]


def _along(positions, radii, starts, keys) -> list[dict]:
    """What the node Curves Info asks for."""
    if keys.isdisjoint(("curve_intercept", "curve_length", "curve_radius")):
        return []
    counts = np.diff(starts)
    steps = np.zeros(len(positions))
    steps[1:] = np.linalg.norm(np.diff(positions.astype(np.float64), axis=0), axis=1)
    first = starts[:-1][counts > 0]
    total = np.cumsum(steps)
    way = total - np.repeat(total[first], counts[counts > 0])
    lengths = np.zeros(len(counts))
    lengths[counts > 0] = way[starts[1:][counts > 0] - 1]
    of_key = np.repeat(lengths, counts)
    intercept = np.divide(way, of_key, out=np.zeros_like(way), where=of_key > 0.0)
    found = {
        "curve_intercept": ("POINT", intercept),
        "curve_length": ("FACE", lengths),
        "curve_radius": ("POINT", radii),
    }
    return [
        {"key": key, "domain": domain, "values": np.asarray(values, dtype=np.float32)}
        for key, (domain, values) in found.items()
        if key in keys
    ]


# --- Particle hair -------------------------------------------------------------------------------


def hair_systems(obj, viewport: bool) -> list:
    """(modifier, system) of the particle systems of an object that are shown as hair."""
    shown = []
    for modifier in obj.modifiers:
        if modifier.type != "PARTICLE_SYSTEM":
            continue
        if not (modifier.show_viewport if viewport else modifier.show_render):
            continue
        settings = modifier.particle_system.settings
        if settings.type == "HAIR" and settings.render_type == "PATH":
            shown.append((modifier, modifier.particle_system))
    return shown


def particle_hair(obj, viewport: bool, keys, slots: int) -> dict | None:
    """The arguments of set_curves of all hair of an object; None: there is none."""
    parts = _parts(obj, viewport)
    if not parts:
        return None
    positions = np.concatenate([part.positions(obj) for part in parts])
    counts = np.concatenate([np.full(part.count, part.steps) for part in parts])
    starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    intercept = _along(positions, None, starts, {"curve_intercept"})[0]["values"]
    ends = np.concatenate([[0], np.cumsum([part.count * part.steps for part in parts])])
    radii = np.concatenate(
        [part.radii(intercept[ends[i] : ends[i + 1]]) for i, part in enumerate(parts)]
    ).astype(np.float32)
    slot = [part.slot(slots) for part in parts]
    return {
        "positions": positions,
        "radii": radii,
        "curves": starts,
        "material_indices": np.repeat(slot, [part.count for part in parts]).astype(np.int32),
        "attributes": _along(positions, radii, starts, keys)
        + _of_emitter(obj, parts, positions[starts[:-1]], keys),
    }


def particle_form(obj, viewport: bool) -> tuple[np.ndarray, None]:
    """The positions alone."""
    found = [part.positions(obj) for part in _parts(obj, viewport)]
    return (np.concatenate(found) if found else np.empty((0, 3), dtype=np.float32)), None


def _parts(obj, viewport: bool) -> list:
    parts = [_System(*shown, viewport) for shown in hair_systems(obj, viewport)]
    return [part for part in parts if part.count > 0]


class _System:
    """What Cycles reads of a particle system: its children, if it has some, else the particles."""

    def __init__(self, modifier, system, viewport: bool):
        settings = system.settings
        self.modifier, self.system, self.settings = modifier, system, settings
        parents, children = len(system.particles), len(system.child_particles)
        if viewport:
            children = int(children * settings.display_percentage / 100.0)
        has_children = settings.child_type != "NONE" and children > 0
        self.first = parents if has_children else 0
        self.count = parents + children - self.first
        self.steps = (1 << (settings.display_step if viewport else settings.render_step)) + 1
        if settings.kink == "SPIRAL":
            self.steps += settings.kink_extra_steps

    def numbers(self):
        return range(self.first, self.first + self.count)

    def positions(self, obj) -> np.ndarray:
        read, steps = self.system.co_hair, range(self.steps)
        keys = (read(obj, particle_no=n, step=step) for n in self.numbers() for step in steps)
        # Twenty times as fast as an array of vectors.
        numbers = np.fromiter(chain.from_iterable(keys), np.float64, 3 * self.count * self.steps)
        world = numbers.reshape(-1, 3)
        to_object = np.array(obj.matrix_world.inverted_safe(), dtype=np.float64)
        return (world @ to_object[:3, :3].T + to_object[:3, 3]).astype(np.float32)

    def radii(self, intercept: np.ndarray) -> np.ndarray:
        settings = self.settings
        scale = 0.5 * settings.radius_scale
        root, tip = scale * settings.root_radius, scale * settings.tip_radius
        shape = settings.shape
        power = 1.0 + shape if shape < 0.0 else 1.0 / max(1.0 - shape, 1e-6)
        radii = np.power(1.0 - np.clip(intercept, 0.0, 1.0), power) * (root - tip) + tip
        if settings.use_close_tip:
            radii[self.steps - 1 :: self.steps] = 0.0
        return radii

    def slot(self, slots: int) -> int:
        return min(max(self.settings.material - 1, 0), max(slots - 1, 0))


def _of_emitter(obj, parts, roots: np.ndarray, keys) -> list[dict]:
    """What the surface is where the hair grows."""
    mesh, found = obj.data, []
    for key in sorted(keys):
        kind, _, name = key.partition(":")
        values = None
        if kind == "generated":
            values = in_texture_space(mesh, roots)
        elif kind == "uv":
            values = _read_emitter(parts, mesh.uv_layers.find(name or active_uv(mesh)), "uv")
        elif kind in ("attribute", "color"):
            values = _color_of_emitter(mesh, parts, kind, name)
        if values is not None:
            found.append({"key": key, "domain": "FACE", "values": values})
    return found


def _read_emitter(parts, index: int, what: str) -> np.ndarray | None:
    if index < 0:
        return None
    rows = []
    for part in parts:
        read = getattr(part.system, f"{what}_on_emitter")
        particle = part.system.particles[0]
        for number in part.numbers():
            if number < len(part.system.particles):
                particle = part.system.particles[number]
            which = {"uv": "uv_no", "mcol": "vcol_no"}[what]
            rows.append(
                read(part.modifier, particle=particle, particle_no=number, **{which: index})
            )
    return np.array(rows, dtype=np.float32)


def _color_of_emitter(mesh, parts, kind: str, name: str) -> np.ndarray | None:
    colors = [
        a.name for a in mesh.attributes if (a.data_type, a.domain) == ("BYTE_COLOR", "CORNER")
    ]
    if kind == "color":
        index = mesh.color_attributes.render_color_index
        name = mesh.color_attributes[index].name if index >= 0 else ""
    if name in colors:
        encoded = _read_emitter(parts, colors.index(name), "mcol")
        return np.where(encoded > 0.04045, ((encoded + 0.055) / 1.055) ** 2.4, encoded / 12.92)
    if name in mesh.uv_layers:
        return _read_emitter(parts, mesh.uv_layers.find(name), "uv")
    return None
