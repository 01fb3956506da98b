# SPDX-License-Identifier: GPL-3.0-or-later
"""What Janus makes of each shader node of each Blender.

What is supported stands in the core's table of nodes; what is not stands below, and nowhere else.
An entry of a recording (record_nodes.py) that is in neither makes `undeclared()` say so, and a test
fails.
"""

from __future__ import annotations

# By node.type. The core names each where it is used.
REFUSED = {
    "AMBIENT_OCCLUSION": "needs rays of its own",
    "BEVEL": "needs rays of its own",
    "BSDF_RAY_PORTAL": "rays that go on elsewhere",
    "MATERIAL_RAYCAST": "needs rays of its own",
    "PRINCIPLED_VOLUME": "volume; named for the material",
    "SCRIPT": "OSL",
    "TEX_POINTDENSITY": "volume",
    "VOLUME_ABSORPTION": "volume; named for the material",
    "VOLUME_COEFFICIENTS": "volume; named for the material",
    "VOLUME_INFO": "volume",
    "VOLUME_SCATTER": "volume; named for the material",
}
NOT_FOR_CYCLES = {"EEVEE_SPECULAR", "OUTPUT_LINESTYLE", "SHADERTORGB", "SQUEEZE", "UVALONGSTROKE"}
# The add-on resolves them (addon/nodes/links.py), or starts from them.
FLATTENED = {
    *("FRAME", "GROUP", "GROUP_INPUT", "GROUP_OUTPUT", "MENU_SWITCH", "REROUTE", "RGB", "VALUE"),
    *("REPEAT_INPUT", "REPEAT_OUTPUT", "NodeClosureInput", "NodeClosureOutput"),
    *("NodeCombineBundle", "NodeSeparateBundle", "NodeJoinBundle", "NodeEvaluateClosure"),
    *("FunctionNodeInputMenu", "INPUT_BOOL", "INPUT_INT", "INPUT_SCENE_TIME", "INPUT_VECTOR"),
    "NodeImplicitConversion",
    *("OUTPUT_LIGHT", "OUTPUT_MATERIAL", "OUTPUT_WORLD"),
}
# What a version of Blender calls by another name: the add-on corrects it (addon/nodes/flatten.py).
RENAMED = {"DIFFUSE_BSDF": "BSDF_DIFFUSE"}
# Sockets that matter only together with an input that is left out and named.
IDLE_SOCKETS = {
    # Of Huang's model, which is named.
    "BSDF_HAIR_PRINCIPLED": {"Aspect Ratio", "R lobe", "TT lobe", "TRT lobe"},
    # Of geometry nodes, in whose trees the same node stands.
    "MIX": {"A_Rotation", "B_Rotation", "Result_Rotation"},
}
INTERNAL_SOCKETS = {"Weight"}
# By socket.type: what the core's table says instead.
CORE_TYPES = {
    **dict.fromkeys(("VALUE", "INT", "BOOLEAN"), "FLOAT"),
    **{"VECTOR": "VECTOR", "RGBA": "COLOR", "SHADER": "CLOSURE"},
}
IDLE_ITEMS = {
    ("BSDF_HAIR_PRINCIPLED", "model"): {"HUANG"},
    ("MIX", "data_type"): {"ROTATION"},
}
AS_BUMP = "as bump; what is to displace the surface itself is named"
FILMS = "films before 5.0 have the colours of 5.0"
REMARKS = {
    **dict.fromkeys(("BSDF_GLASS", "BSDF_METALLIC", "BSDF_PRINCIPLED"), FILMS),
    **dict.fromkeys(("DISPLACEMENT", "VECTOR_DISPLACEMENT"), AS_BUMP),
    "ATTRIBUTE": "rotations on edges, and instances in instances, are named; before 4.5 also "
    "what Geometry Nodes store on instances",
    "BSDF_HAIR": "on meshes named; where Cycles looks for lamps it leaves out a part of it",
    "BSDF_HAIR_PRINCIPLED": "Huang's model is named, and Chiang's is used; on meshes named",
    "BUMP": "a bump in the height of another bump is named",
    "LIGHT_FALLOFF": "surfaces and what they emit make no light paths, then",
    "LIGHT_PATH": "Is Singular Ray is named; what asks for counts, and surfaces that ask for Ray "
    "Length, make no light paths; lights that are looked for leave the vertex that they light out "
    "of Diffuse, Glossy and Transmission Depth in all techniques",
    "REPEAT_INPUT": "a number of iterations that is no constant is named",
    "TEX_COORD": "Window in the world of an orthographic camera is named",
}


def core_nodes() -> dict[str, dict]:
    import janus_core

    return {node["type"]: node for node in janus_core.node_types()}


def undeclared(recording: dict[str, dict]) -> list[str]:
    """What that Blender has and Janus neither supports nor refuses."""
    known, result = core_nodes(), []
    for entry in recording.values():
        kind = kind_of(entry)
        if kind in REFUSED or kind in NOT_FOR_CYCLES or kind in FLATTENED:
            continue
        if kind not in known:
            result.append(f"node {kind}")
            continue
        core = known[kind]
        inputs = {socket["identifier"]: socket["type"] for socket in core["inputs"]}
        idle = IDLE_SOCKETS.get(kind, set()) | INTERNAL_SOCKETS
        for identifier, socket_type, *_ in entry["inputs"]:
            if identifier in inputs:
                if inputs[identifier] != CORE_TYPES.get(socket_type):
                    result.append(f"type {kind}.{identifier} {socket_type}")
            elif identifier not in idle:
                result.append(f"socket {kind}.{identifier}")
        outputs = {*core["outputs"], *idle}
        result += [f"socket {kind}.{s[0]}" for s in entry["outputs"] if s[0] not in outputs]
        for setting, items in entry["settings"].items():
            declared = {x for part in core["settings"].get(setting, ()) for x in part}
            declared |= IDLE_ITEMS.get((kind, setting), set())
            result += [f"item {kind}.{setting}.{x}" for x in items if x not in declared]
    return result


def kind_of(entry: dict) -> str:
    """The node.type of an entry of a recording, as the add-on sends it."""
    return RENAMED.get(entry["type"], entry["type"])
