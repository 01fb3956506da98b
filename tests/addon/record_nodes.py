# SPDX-License-Identifier: GPL-3.0-or-later
"""What a Blender registers for trees of shader nodes, as plain data: blender_nodes/VERSION.json.

Needs nothing but a Blender, of any version, with its own Python:

    blender -b --factory-startup --python tests/addon/record_nodes.py [-- FOLDER]
    python tests/addon/record_nodes.py [FOLDER]          (where `import bpy` works)

writes the file of that Blender, here or into FOLDER.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))  # blender does not
from recordings import record  # noqa: E402

FOLDER = Path(__file__).resolve().parent / "blender_nodes"


def recording() -> dict[str, dict]:
    """By bl_idname: the nodes that a tree of this Blender takes, with sockets and enums.

    A socket is [identifier, type, name]; the name is left out where it is the identifier.
    """
    import bpy

    material = bpy.data.materials.new("Recording")
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    tree = material.node_tree
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
        found[name] = {
            "type": node.type,
            "label": node.bl_label,
            "inputs": [_socket(s) for s in node.inputs],
            "outputs": [_socket(s) for s in node.outputs],
            "settings": _settings(node),
        }
    bpy.data.materials.remove(material)
    return found


def _socket(socket) -> list[str]:
    name = [] if socket.name == socket.identifier else [socket.name]
    return [socket.identifier, socket.type, *name]


def _settings(node) -> dict[str, list[str]]:
    import bpy

    common = bpy.types.Node.bl_rna.properties
    return {
        p.identifier: [item.identifier for item in p.enum_items]
        for p in sorted(node.bl_rna.properties, key=lambda p: p.identifier)
        if p.identifier not in common and p.type == "ENUM" and not p.is_enum_flag
    }


if __name__ == "__main__":
    record(FOLDER, recording)
