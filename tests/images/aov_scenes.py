# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: AOVs, which node trees write."""

from __future__ import annotations

import math

from . import data_scenes, film_scenes
from .pass_scenes import save  # noqa: F401  (both.py looks for it)

SEEDS, SAMPLES = 2, 512
WIDTH, HEIGHT = 48, 36
# Name: settings of the stage.
CASES = {
    "perspective": {},
    "panorama": {"panorama": True},
    "transparent_film": {"film": True},
    "holdouts": {"held": ("Block", "Thin"), "threshold": 0.8},
    "hidden_world": {"hidden": True, "crossings": 1},
}
AOVS = {"Sides": "COLOR", "Turned": "VALUE", "Map": "COLOR", "Sum": "VALUE", "Sky": "COLOR"}


def build(name: str):
    import bpy

    from scenes import kit

    case = CASES[name]
    scene = bpy.context.scene
    kit.neutral_settings(scene, WIDTH, HEIGHT, SAMPLES)
    film_scenes.stage(scene, mirror=True)
    panes(scene)
    kit.world(scene, (0.3, 0.4, 0.6), 0.5)
    layer = scene.view_layers[0]
    for aov, kind in AOVS.items():
        made = layer.aovs.add()
        made.name, made.type = aov, kind
    writers = groups()
    for number, obj in enumerate(o for o in scene.objects if o.type == "MESH"):
        obj.color = (0.1 * number, 0.5, 1.0 - 0.1 * number, 1.0)
        uv = obj.data.uv_layers.new(name="UVMap")
        uv.data.foreach_set("uv", [0.37 * (i % 5) for i in range(2 * len(uv.data))])
        tree = obj.data.materials[0].node_tree
        for writer in writers if obj.name != "Floor" else writers[1:]:
            tree.nodes.new("ShaderNodeGroup").node_tree = writer
    write_sky(scene.world.node_tree)
    for held in case.get("held", ()):
        scene.objects[held].is_holdout = True
    scene.render.film_transparent = case.get("film", False)
    layer.pass_alpha_threshold = case.get("threshold", 0.5)
    scene.cycles.transparent_max_bounces = case.get("crossings", 8)
    scene.world.cycles_visibility.camera = not case.get("hidden", False)
    if case.get("panorama"):
        data_scenes.look_around(scene.camera.data)
    return scene


def panes(scene) -> None:
    """One before another, of little alpha; the last one is cut out like a leaf."""
    from scenes import kit

    def pane(name, alpha, shader, x, y):
        clear = kit.shader(f"{name} Clear", "BsdfTransparent", Color=(0.9, 0.8, 1.0, 1.0))
        material = kit.combined(name, "MixShader", shader, clear)
        material.node_tree.nodes["Mix Shader"].inputs[0].default_value = 1.0 - alpha
        corners = [(x, y, 0.2), (x + 1.4, y, 0.2), (x + 1.4, y, 1.5), (x, y, 1.5)]
        kit.quad(scene, name, corners, material)
        return material

    pane("Thin", 0.3, kit.diffuse("Blue", (0.2, 0.3, 0.8)), -1.3, -1.2)
    pane("Gloss", 0.2, kit.shader("Coat", "BsdfAnisotropic", Roughness=0.3), -1.0, -1.3)
    pane("Light", 0.1, kit.emission("Ember", (1.0, 0.5, 0.2), 0.5), -0.7, -1.4)
    cut = pane("Cut", 0.5, kit.diffuse("Red", (0.8, 0.3, 0.2)), -0.1, -1.5).node_tree
    geometry, steps = cut.nodes.new("ShaderNodeNewGeometry"), cut.nodes.new("ShaderNodeMath")
    separate = cut.nodes.new("ShaderNodeSeparateXYZ")
    steps.operation, steps.inputs[1].default_value = "GREATER_THAN", 0.8
    cut.links.new(geometry.outputs["Position"], separate.inputs[0])
    cut.links.new(separate.outputs["Z"], steps.inputs[0])
    cut.links.new(steps.outputs[0], cut.nodes["Mix Shader"].inputs[0])


def groups() -> list:
    """Trees with AOV Output nodes, and no outputs."""
    import bpy

    def group(name):
        tree = bpy.data.node_groups.new(name, "ShaderNodeTree")

        def node(kind, **settings):
            made = tree.nodes.new(f"ShaderNode{kind}")
            for setting, value in settings.items():
                setattr(made, setting, value)
            return made

        def write(name, output, times=1):
            for _ in range(times):
                end = node("OutputAOV", aov_name=name)
                tree.links.new(output, end.inputs[AOVS[name].capitalize()])

        return tree, node, write

    # What depends on the side and the place; numbers below 0.
    sides, node, write = group("Sides")
    geometry = node("NewGeometry")
    scale = node("VectorMath", operation="MULTIPLY_ADD")
    sides.links.new(geometry.outputs["Normal"], scale.inputs[0])
    sides.links.new(geometry.outputs["Position"], scale.inputs[1])
    sides.links.new(geometry.outputs["Incoming"], scale.inputs[2])
    write("Sides", scale.outputs["Vector"])

    # A bumped normal and the view.
    turned, node, write = group("Turned")
    wave, bump = node("Math", operation="SINE"), node("Bump")
    bump.inputs["Distance"].default_value = 0.05
    scaled = node("VectorMath", operation="DOT_PRODUCT")
    scaled.inputs[1].default_value = (7.0, 11.0, 13.0)
    turned.links.new(node("NewGeometry").outputs["Position"], scaled.inputs[0])
    turned.links.new(scaled.outputs["Value"], wave.inputs[0])
    turned.links.new(wave.outputs[0], bump.inputs["Height"])
    weight = node("LayerWeight")
    turned.links.new(bump.outputs["Normal"], weight.inputs["Normal"])
    write("Turned", weight.outputs["Facing"])

    # What meshes and objects have.
    mapped, node, write = group("Map")
    mix = node("Mix", data_type="RGBA", blend_type="MULTIPLY")
    mix.inputs[0].default_value = 0.7
    colors = [socket for socket in mix.inputs if socket.type == "RGBA"]
    mapped.links.new(node("UVMap").outputs["UV"], colors[0])
    mapped.links.new(node("ObjectInfo").outputs["Color"], colors[1])
    result = next(socket for socket in mix.outputs if socket.type == "RGBA")
    write("Map", result)

    # Three nodes of one name, in a group in a group: the sum.
    inner, node, write = group("Inner")
    write("Sum", node("LightPath").outputs["Is Camera Ray"], times=2)
    node("OutputAOV", aov_name="Sum").inputs["Value"].default_value = 0.25
    node("OutputAOV", aov_name="Nobody's").inputs["Value"].default_value = 9.0
    outer, node, _ = group("Sum")
    node("Group", node_tree=inner)
    return [sides, turned, mapped, outer]


def write_sky(tree) -> None:
    """A colour by direction, and a number for all."""
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Rotation"].default_value = (0.1, 0.2, math.pi / 3)
    end = tree.nodes.new("ShaderNodeOutputAOV")
    end.aov_name = "Sky"
    tree.links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], end.inputs["Color"])
    end = tree.nodes.new("ShaderNodeOutputAOV")
    end.aov_name, end.inputs["Value"].default_value = "Sum", -1.5
