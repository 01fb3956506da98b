# SPDX-License-Identifier: GPL-3.0-or-later
"""What Janus makes of each shader node of the running Blender: core/NODES.md.

`python node_coverage.py [--write]` prints the document, or writes it. What is supported stands in
the core's table of nodes; what is not stands below, and nowhere else. An entry of Blender's that is
in neither makes `undeclared()` say so, and a test fails.
"""

from __future__ import annotations

import sys
from pathlib import Path

DOCUMENT = Path(__file__).resolve().parents[2] / "core" / "NODES.md"

# By node.type. The core names each where it is used.
REFUSED = {
    "AMBIENT_OCCLUSION": "needs rays of its own",
    "BEVEL": "needs rays of its own",
    "BSDF_HAIR": "hair",
    "BSDF_HAIR_PRINCIPLED": "hair",
    "BSDF_METALLIC": "closure",
    "BSDF_RAY_PORTAL": "rays that go on elsewhere",
    "BSDF_SHEEN": "closure",
    "BSDF_TOON": "closure",
    "BSDF_VELVET": "closure",
    "DISPLACEMENT": "displacement; named for the material",
    "HAIR_INFO": "hair",
    "LIGHT_FALLOFF": "the distance to what is lit",
    "OUTPUT_AOV": "passes; the picture is the same without it",
    "PARTICLE_INFO": "particles",
    "POINT_INFO": "point clouds",
    "PRINCIPLED_VOLUME": "volume; named for the material",
    "SCRIPT": "OSL",
    "SUBSURFACE_SCATTERING": "subsurface scattering",
    "ShaderNodeRadialTiling": "procedural texture",
    "TEX_BRICK": "procedural texture",
    "TEX_CHECKER": "procedural texture",
    "TEX_GABOR": "procedural texture",
    "TEX_GRADIENT": "procedural texture",
    "TEX_IES": "beams of IES files",
    "TEX_MAGIC": "procedural texture",
    "TEX_MUSGRAVE": "procedural texture",
    "TEX_NOISE": "procedural texture",
    "TEX_POINTDENSITY": "volume",
    "TEX_SKY": "procedural texture",
    "TEX_VORONOI": "procedural texture",
    "TEX_WAVE": "procedural texture",
    "TEX_WHITE_NOISE": "procedural texture",
    "VECTOR_DISPLACEMENT": "displacement; named for the material",
    "VOLUME_ABSORPTION": "volume; named for the material",
    "VOLUME_COEFFICIENTS": "volume; named for the material",
    "VOLUME_INFO": "volume",
    "VOLUME_SCATTER": "volume; named for the material",
    "WAVELENGTH": "not yet",
    "WIREFRAME": "not yet",
}
NOT_FOR_CYCLES = {"EEVEE_SPECULAR", "OUTPUT_LINESTYLE", "SHADERTORGB", "SQUEEZE", "UVALONGSTROKE"}
# The add-on resolves them (addon/nodes/links.py), or starts from them.
FLATTENED = {
    *("FRAME", "GROUP", "GROUP_INPUT", "GROUP_OUTPUT", "MENU_SWITCH", "REROUTE", "RGB", "VALUE"),
    *("REPEAT_INPUT", "REPEAT_OUTPUT", "NodeClosureInput", "NodeClosureOutput"),
    *("NodeCombineBundle", "NodeSeparateBundle", "NodeEvaluateClosure"),
    *("OUTPUT_LIGHT", "OUTPUT_MATERIAL", "OUTPUT_WORLD"),
}
# Sockets that matter only together with an input that is left out and named.
IDLE_SOCKETS = {
    "BSDF_GLOSSY": {"Rotation", "Tangent"},
    "BSDF_ANISOTROPIC": {"Rotation", "Tangent"},
    "BSDF_GLASS": {"Thin Film IOR"},
    "BSDF_PRINCIPLED": {
        *("Subsurface Radius", "Subsurface Scale", "Subsurface IOR", "Subsurface Anisotropy"),
        *("Anisotropic Rotation", "Tangent", "Coat Roughness", "Coat IOR", "Coat Tint"),
        *("Coat Normal", "Sheen Roughness", "Sheen Tint", "Thin Film IOR"),
    },
    # Of geometry nodes, in whose trees the same node stands.
    "MIX": {"A_Rotation", "B_Rotation", "Result_Rotation"},
}
INTERNAL_SOCKETS = {"Weight"}
IDLE_ITEMS = {
    ("MIX", "data_type"): {"ROTATION"},
    ("BSDF_PRINCIPLED", "subsurface_method"): {"BURLEY", "RANDOM_WALK", "RANDOM_WALK_SKIN"},
}
REMARKS = {
    "ATTRIBUTE": "rotations on edges, and instances in instances, are named",
    "BUMP": "a bump in the height of another bump is named",
    "LIGHT_PATH": "which kind of ray asks: camera, shadow, diffuse, glossy, reflection or "
    "transmission; counts of bounces, lengths and Is Singular Ray are named",
    "REPEAT_INPUT": "a number of iterations that is no constant is named",
    "TEX_COORD": "Window in the world of an orthographic camera is named",
}


def blender_nodes() -> dict[str, list[dict]]:
    """By node.type: the nodes that a tree of this Blender takes, with sockets and settings."""
    import bpy

    material = bpy.data.materials.new("Coverage")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    tree = material.node_tree
    common = bpy.types.Node.bl_rna.properties
    found = {}
    for name in sorted(dir(bpy.types)):
        kind = getattr(bpy.types, name)
        of_others = name.startswith(("CompositorNode", "TextureNode"))
        if of_others or not (isinstance(kind, type) and issubclass(kind, bpy.types.Node)):
            continue
        try:
            node = tree.nodes.new(name)
        except RuntimeError:  # a base class, or of another kind of tree
            continue
        settings = {
            p.identifier: [item.identifier for item in p.enum_items]
            for p in node.bl_rna.properties
            if p.identifier not in common and p.type == "ENUM" and not p.is_enum_flag
        }
        entry = {
            "label": node.bl_label,
            "inputs": [s.identifier for s in node.inputs],
            "outputs": [s.identifier for s in node.outputs],
            "settings": settings,
        }
        found.setdefault(node.type, []).append(entry)
    bpy.data.materials.remove(material)
    return found


def core_nodes() -> dict[str, dict]:
    import janus_core

    return {node["type"]: node for node in janus_core.node_types()}


def undeclared() -> list[str]:
    """What this Blender has and Janus neither supports nor refuses."""
    known, result = core_nodes(), []
    for kind, entries in blender_nodes().items():
        if kind in REFUSED or kind in NOT_FOR_CYCLES or kind in FLATTENED:
            continue
        if kind not in known:
            result.append(f"node {kind}")
            continue
        core = known[kind]
        inputs = {socket["identifier"] for socket in core["inputs"]}
        idle = IDLE_SOCKETS.get(kind, set()) | INTERNAL_SOCKETS
        for entry in entries:
            missing = [s for s in entry["inputs"] if s not in inputs | idle]
            missing += [s for s in entry["outputs"] if s not in {*core["outputs"], *idle}]
            result += [f"socket {kind}.{socket}" for socket in missing]
            for setting, items in entry["settings"].items():
                declared = {x for part in core["settings"].get(setting, ()) for x in part}
                declared |= IDLE_ITEMS.get((kind, setting), set())
                result += [f"item {kind}.{setting}.{x}" for x in items if x not in declared]
    return result


def document() -> str:
    """core/NODES.md, for the running Blender."""
    import bpy

    version = ".".join(map(str, bpy.app.version[:2]))
    known, rows = core_nodes(), []
    counts = {"exact": 0, "partly": 0, "refused": 0, "not for Cycles": 0}
    for kind, entries in sorted(blender_nodes().items(), key=lambda item: item[1][0]["label"]):
        status, notes = _status(kind, known.get(kind))
        counts[status] += 1
        settings = [
            f"{setting} ({len(items)})"
            for setting, items in entries[0]["settings"].items()
            if kind in known and setting in known[kind]["settings"]
        ]
        notes += [f"all of {', '.join(settings)}"] if settings and status == "exact" else []
        rows.append(f"| {entries[0]['label']} | `{kind}` | {status} | {'; '.join(notes)} |")
    total = ", ".join(f"{number} {status}" for status, number in counts.items())
    return "\n".join(
        [
            "# Shader nodes",
            "",
            f"What Janus makes of the shader nodes of Blender {version}: {total}.",
            "",
            "*Exact* nodes give Cycles' results for every setting and input. What is *partly*",
            "supported or *refused* is named in the UI and in the log, with material and node,",
            "where it is used.",
            "",
            "Written by `tests/addon/node_coverage.py --write` from the core's table of nodes; a",
            "test keeps it up to date.",
            "",
            "| Node | Type | | Remarks |",
            "|---|---|---|---|",
            *rows,
            "",
        ]
    )


def _status(kind: str, core: dict | None) -> tuple[str, list[str]]:
    remarks = [REMARKS[kind]] if kind in REMARKS else []
    if kind in NOT_FOR_CYCLES:
        return "not for Cycles", remarks
    if kind in REFUSED:
        return "refused", [REFUSED[kind]]
    if core is None:
        return "partly" if remarks else "exact", remarks
    left_out = [socket["identifier"] for socket in core["inputs"] if socket["left_out"]]
    named = [item for _, items in core["settings"].values() for item in items]
    notes = [f"without {', '.join(left_out)}"] if left_out else []
    notes += [f"GGX for {', '.join(named)} on rough surfaces"] if named else []
    return "partly" if notes or remarks else "exact", notes + remarks


if __name__ == "__main__":
    text = document()
    if "--write" in sys.argv:
        DOCUMENT.write_text(text)
    else:
        print(text)
