# SPDX-License-Identifier: GPL-3.0-or-later
"""A sheet of tiles, each with the Emission of one small node tree: pictures by Cycles and by Janus.

`python node_scenes.py FOLDER [NAME...]` writes FOLDER/sheet_N_cycles.exr, FOLDER/sheet_N_janus.exr
and FOLDER/sheets.json: for each sheet the names of its cases, the types of the nodes that they are
about, and what Janus said. One process makes them all. The filter is so narrow that every sample
lies in the middle of its pixel. `--random FIRST COUNT` takes the graphs of random_graphs.py, and
writes FOLDER/sheet_N_again.exr as well: Cycles' with other samples.
"""

from __future__ import annotations

import json
import math
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TILE, COLUMNS = 16, 16  # pixels along a tile; tiles along a sheet
SCALE, LIFT = 0.1, 10.0


def build_sheet(names, cases):
    """A scene with a tile for each name, seen from above; the types of the nodes looked at."""
    import bpy

    from tests.images import node_meshes
    from tests.images.node_cases import Tree, subject

    scene = bpy.context.scene
    rows = math.ceil(len(names) / COLUMNS)
    mesh = node_meshes.tile_mesh()
    pieces = node_meshes.pieces_mesh(mesh)
    other = bpy.data.objects.get("Other")
    types = []
    for number, name in enumerate(names):
        material = bpy.data.materials.new(name)
        if bpy.app.version < (5, 0, 0):
            material.use_nodes = True
        material.pass_index = number % 3
        tree = material.node_tree
        tree.nodes.clear()
        emission = tree.nodes.new("ShaderNodeEmission")
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        tree.links.new(emission.outputs[0], output.inputs["Surface"])
        seen = cases[name](Tree(tree))
        types.append(subject(seen))
        # Light below zero is no light: a tenth of the value, lifted.
        lifted = Tree(tree).out(
            "VectorMath",
            {0: seen, 1: [SCALE] * 3, 2: [LIFT] * 3},
            operation="MULTIPLY_ADD",
        )
        tree.links.new(lifted, emission.inputs["Color"])
        obj = bpy.data.objects.new(name, pieces if name.startswith("pieces") else mesh)
        obj.location = (2.2 * (number % COLUMNS), 2.2 * (number // COLUMNS), 0.0)
        # Turned, moved, and every second one looked at from behind.
        obj.rotation_euler = (0.2, math.pi - 0.15 if number % 2 else -0.15, 0.1)
        obj.color = (0.2, 0.4, 0.6, 0.8)
        obj.pass_index = number % 5
        obj.material_slots[0].link = "OBJECT"
        obj.material_slots[0].material = material
        node_meshes.add_properties(scene, obj, number)
        if name.startswith("instancer"):
            node_meshes.instanced(scene, obj, name.split()[1])
        else:
            scene.collection.objects.link(obj)
    other.location = (3.0, 1.0, 2.0)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 2.2 * max(COLUMNS, rows)
    camera.location = (1.1 * (COLUMNS - 1), 1.1 * (rows - 1), 8.0)
    scene.render.resolution_x, scene.render.resolution_y = TILE * COLUMNS, TILE * rows
    return types


def main(folder: Path, chosen: list[str]) -> None:
    import bpy

    from scenes import kit
    from scenes.driver import addon as addons
    from tests.images import node_cases, random_graphs
    from tests.images.node_cases_images import FRAME

    addon = addons.load()
    pictures = [("cycles", "CYCLES", 0), ("janus", addons.ENGINE, 0)]
    if chosen[:1] == ["--random"]:
        cases = random_graphs.cases(int(chosen[1]), int(chosen[2]))
        names = list(cases)
        pictures.append(("again", "CYCLES", 1))
    else:
        node_cases.add_cases()
        cases = node_cases.CASES
        names = [n for n in cases if not chosen or any(c in n for c in chosen)]
    sheets = []
    for start in range(0, len(names), COLUMNS * COLUMNS):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = bpy.context.scene
        kit.neutral_settings(scene, 8, 8, 64)
        kit.world(scene)
        scene.collection.objects.link(bpy.data.objects.new("Other", None))
        scene.frame_set(FRAME)
        part = names[start : start + COLUMNS * COLUMNS]
        types = build_sheet(part, cases)
        scene.render.image_settings.file_format = "OPEN_EXR"
        scene.render.image_settings.color_depth = "32"
        scene.render.threads_mode, scene.render.threads = "FIXED", 2
        scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BLACKMAN_HARRIS", 0.01
        scene.janus.pixel_filter_type, scene.janus.filter_width = "BLACKMAN_HARRIS", 0.01
        scene.janus.integrator = "PT"
        said = []
        for kind, engine, seed in pictures:
            scene.render.engine, scene.cycles.seed = engine, seed
            scene.render.filepath = str(folder / f"sheet_{len(sheets)}_{kind}.exr")
            bpy.ops.render.render(write_still=True)
        for entry, _ in addon.part("report").kept(scene.name_full):
            said.append([entry.severity, entry.material, entry.node, entry.message])
        scene.render.engine = "CYCLES"
        sheets.append({"names": part, "types": types, "said": said})
    (folder / "sheets.json").write_text(json.dumps(sheets))
    addon.unload()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)  # Blender's own exit can crash


if __name__ == "__main__":
    sys.path.insert(0, str(ROOT))
    main(Path(sys.argv[1]), sys.argv[2:])
