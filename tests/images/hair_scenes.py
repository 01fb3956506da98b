# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: hair and points. Cycles' hair is ribbons, as it is by default: its "3D Curves"
count on shadow rays as often as they are cut into pieces, where light comes through them."""

from __future__ import annotations

SEEDS = 6
BOUNCES = 4

# By case: the type of the closure's node, what it is set to, its inputs.
CLOSURES = {
    "diffuse": ("BsdfDiffuse", {}, {"Color": (0.8, 0.5, 0.3, 1)}),
    "principled": ("BsdfPrincipled", {}, {"Base Color": (0.3, 0.5, 0.2, 1), "Roughness": 0.4}),
    "translucent": ("BsdfTranslucent", {}, {"Color": (0.4, 0.8, 0.3, 1)}),
    "glass": ("BsdfGlass", {}, {"Roughness": 0.3, "IOR": 1.3}),
    "reflection": (
        "BsdfHair",
        {"component": "Reflection"},
        {"Color": (0.8, 0.6, 0.4, 1), "RoughnessU": 0.3, "RoughnessV": 0.5, "Offset": 0.1},
    ),
    "transmission": (
        "BsdfHair",
        {"component": "Transmission"},
        {"Color": (0.8, 0.6, 0.4, 1), "RoughnessU": 0.3, "RoughnessV": 0.5},
    ),
    "chiang_color": (
        "BsdfHairPrincipled",
        {"model": "CHIANG", "parametrization": "COLOR"},
        {"Color": (0.7, 0.4, 0.2, 1), "Roughness": 0.4, "Radial Roughness": 0.5},
    ),
    "chiang_melanin": (
        "BsdfHairPrincipled",
        {"model": "CHIANG", "parametrization": "MELANIN"},
        {
            **{"Melanin": 0.3, "Melanin Redness": 0.6, "Tint": (0.9, 0.8, 0.9, 1)},
            **{"Random Color": 0.6, "Random Roughness": 0.4, "Coat": 0.4, "Offset": 0.1},
        },
    ),
    "chiang_absorption": (
        "BsdfHairPrincipled",
        {"model": "CHIANG", "parametrization": "ABSORPTION"},
        {"Absorption Coefficient": (0.1, 0.3, 0.8), "Roughness": 0.9, "Radial Roughness": 0.8},
    ),
}
SHAPES = ("poly", "particles", "points", "points_glass", "moving", "info", "info_rest", "alpha")
CASES = (*CLOSURES, *SHAPES)


def samples(case: str) -> int:
    """Per pixel."""
    return 384 if case in ("glass", "points_glass", "chiang_melanin", "chiang_color") else 192


def build(case: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, 32, 24, samples(case))
    kit.limit_bounces(scene.cycles, BOUNCES)
    kit.world(scene, (0.4, 0.5, 0.7), 0.4)
    floor = kit.box(scene, "Floor", (8, 8, 0.2), kit.diffuse("Floor", (0.5, 0.5, 0.5)))
    floor.location = (0, 0, -0.1)
    kit.area_light(scene, "Lamp", (-1.5, -2.0, 3.0), (0.0, 0.0, 0.5), (1.0, 1.0), 120.0)
    kit.area_light(scene, "Behind", (1.0, 3.0, 1.5), (0.0, 0.0, 0.7), (1.0, 1.0), 60.0)
    if case in ("reflection", "transmission"):
        found_by_chance(scene, kit)
    kit.camera(scene, (0.0, -3.0, 1.2), (0.0, 0.0, 0.6), lens=45.0)
    scene.cycles_curves.shape, scene.cycles_curves.subdivisions = "RIBBONS", 4
    material = closure(case if case in CLOSURES else "diffuse")
    if case in CLOSURES:
        hair(scene, material)
    else:
        globals()[f"_{case}"](scene, material)
    return scene


def found_by_chance(scene, kit):
    """Cycles leaves out a part of these closures where it looks for light: so nobody does."""
    import bpy

    for name in ("Lamp", "Behind"):
        bpy.data.objects.remove(bpy.data.objects[name])
    scene.world.cycles.sampling_method = "NONE"
    sheet = kit.emission("Sheet", (1.0, 0.9, 0.8), 6.0)
    sheet.cycles.emission_sampling = "NONE"
    for place in ((-3.0, -3.0, 2.5), (1.0, 3.0, 1.5)):
        kit.box(scene, "Sheet", (1.5, 0.1, 1.5), sheet).location = place


def closure(case: str):
    import bpy

    kind, settings, inputs = CLOSURES[case]
    material = bpy.data.materials.new(case)
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node = tree.nodes.new(f"ShaderNode{kind}")
    for name, value in settings.items():
        setattr(node, name, value)
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], end.inputs["Surface"])
    return material


def hair(scene, material, radius=0.02, keys=8):
    """Bent tufts, thick enough to be seen one by one, thinner at their ends."""
    import bpy
    import numpy as np

    rng = np.random.default_rng(5)
    count = 60
    roots = np.stack([np.linspace(-1.0, 1.0, count), rng.uniform(-0.4, 0.4, count)], axis=1)
    along = np.linspace(0.0, 1.0, keys)
    places = np.zeros((count, keys, 3), dtype=np.float32)
    places[:, :, :2] = roots[:, None, :]
    lean = rng.uniform(-0.6, 0.6, (count, 1, 2))
    places[:, :, :2] += lean * (along**2)[None, :, None]
    places[:, :, 2] = along * rng.uniform(0.8, 1.3, (count, 1))
    radii = np.broadcast_to(radius * (1.0 - 0.6 * along), (count, keys)).astype(np.float32)
    curves = bpy.data.hair_curves.new("Hair")
    curves.add_curves([keys] * count)
    curves.attributes["position"].data.foreach_set("vector", places.ravel())
    curves.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", radii.ravel())
    curves.materials.append(material)
    obj = bpy.data.objects.new("Hair", curves)
    scene.collection.objects.link(obj)
    return obj


def _poly(scene, material):
    hair(scene, material, keys=3).data.set_types(type="POLY")


def _particles(scene, material):
    import bpy

    bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=0.4)
    ball = bpy.context.object
    ball.location = (0, 0, 0.6)
    ball.data.materials.append(material)
    ball.modifiers.new("Hair", "PARTICLE_SYSTEM")
    settings = ball.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 60, 0.5
    settings.child_type, settings.rendered_child_count = "SIMPLE", 4
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1.0, 0.3, 0.02
    settings.shape, settings.use_close_tip = 0.3, True
    bpy.context.view_layer.update()


def _cloud(scene, material):
    """Points that nodes make of the corners of a cube."""
    import bpy

    bpy.ops.mesh.primitive_cube_add(size=1.0)
    cube = bpy.context.object
    cube.location = (0, 0, 0.7)
    cube.rotation_euler = (0.4, 0.3, 0.5)
    tree = bpy.data.node_groups.new("Points", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    points = tree.nodes.new("GeometryNodeMeshToPoints")
    points.inputs["Radius"].default_value = 0.2
    paint = tree.nodes.new("GeometryNodeSetMaterial")
    paint.inputs["Material"].default_value = material
    tree.links.new(start.outputs[0], points.inputs[0])
    tree.links.new(points.outputs[0], paint.inputs[0])
    tree.links.new(paint.outputs[0], end.inputs[0])
    cube.modifiers.new("Nodes", "NODES").node_group = tree
    return cube


def _points(scene, material):
    _cloud(scene, material)


def _points_glass(scene, _material):
    _cloud(scene, closure("glass"))


def _moving(scene, material):
    obj = hair(scene, material)
    for frame, x in ((0, -0.5), (2, 0.5)):
        obj.location.x = x
        obj.keyframe_insert("location", frame=frame)
    scene.frame_set(1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.5


def _info(scene, material):
    """Colours of what Curves Info says."""
    tree = material.node_tree
    info, color = tree.nodes.new("ShaderNodeHairInfo"), tree.nodes.new("ShaderNodeCombineColor")
    thick = tree.nodes.new("ShaderNodeMath")
    thick.operation, thick.inputs[1].default_value = "MULTIPLY", 8.0
    tree.links.new(info.outputs["Thickness"], thick.inputs[0])
    for name, source in (
        ("Red", info.outputs["Intercept"]),
        ("Green", info.outputs["Random"]),
        ("Blue", thick.outputs[0]),
    ):
        tree.links.new(source, color.inputs[name])
    closure_node = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    tree.links.new(color.outputs[0], closure_node.inputs["Color"])
    hair(scene, material)


def _info_rest(scene, material):
    """Hair that shines with what else it says."""
    tree = material.node_tree
    info, glow = tree.nodes.new("ShaderNodeHairInfo"), tree.nodes.new("ShaderNodeEmission")
    positive, scaled = (tree.nodes.new("ShaderNodeVectorMath") for _ in range(2))
    positive.operation, scaled.operation = "ABSOLUTE", "SCALE"
    tree.links.new(info.outputs["Tangent Normal"], positive.inputs[0])
    tree.links.new(positive.outputs[0], scaled.inputs[0])
    tree.links.new(info.outputs["Length"], scaled.inputs["Scale"])
    tree.links.new(scaled.outputs[0], glow.inputs["Color"])
    tree.links.new(info.outputs["Is Strand"], glow.inputs["Strength"])
    end = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(glow.outputs[0], end.inputs["Surface"])
    hair(scene, material)


def _alpha(scene, material):
    """Half of what there is lets light pass."""
    tree = material.node_tree
    mix, clear = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfTransparent")
    diffuse = next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE")
    end = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(diffuse.outputs[0], mix.inputs[1])
    tree.links.new(clear.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], end.inputs["Surface"])
    hair(scene, material)
