# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: points and particles that shine with what they know of themselves."""

from __future__ import annotations

SEEDS, SIZE = 1, 144

# Output: by what it is multiplied and what is added, so that it shines brighter than nothing.
POINTS = {"Position": (0.2, 0.5), "Radius": (4.0, 0.1), "Random": (1.0, 0.1)}
PARTICLES = {
    **{"Index": (0.1, 0.1), "Random": (1.0, 0.1), "Age": (0.05, 0.1), "Lifetime": (0.02, 0.1)},
    **{"Location": (0.2, 0.6), "Size": (4.0, 0.1), "Velocity": (0.3, 0.8)},
    "Angular Velocity": (0.1, 1.0),
}
CASES = {
    **{f"points_{name}".lower(): ("points", "PointInfo", name) for name in POINTS},
    **{f"moving_points_{name}".lower(): ("moving", "PointInfo", name) for name in POINTS},
    **{f"not_points_{name}".lower(): ("particles", "PointInfo", name) for name in POINTS},
    **{
        f"particles_{name}".lower().replace(" ", "_"): ("particles", "ParticleInfo", name)
        for name in PARTICLES
    },
    **{
        f"not_particles_{name}".lower(): ("points", "ParticleInfo", name)
        for name in ("Random", "Size", "Location")
    },
}


def shining(kind: str, output: str):
    from .node_cases import material

    scale, offset = {**POINTS, **PARTICLES}[output]

    def shader(t):
        value = t.out(kind, output=output)
        inputs = {0: value, 1: (scale,) * 3, 2: (offset,) * 3}
        color = t.out("VectorMath", inputs, operation="MULTIPLY_ADD")
        return t.out("Emission", {"Color": color})

    return material(output, shader)


def cloud(scene, shine) -> None:
    """At the corners of a turned and scaled cube, each of its own size."""
    import bpy
    import numpy as np

    bpy.ops.mesh.primitive_cube_add(size=1.0)
    cube = bpy.context.object
    cube.location, cube.rotation_euler, cube.scale = (0.2, 0, 0.1), (0.4, 0.3, 0.5), (1.5,) * 3
    sizes = np.linspace(0.08, 0.22, 8, dtype=np.float32)
    cube.data.attributes.new("Size", "FLOAT", "POINT").data.foreach_set("value", sizes)
    tree = bpy.data.node_groups.new("Points", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    points = tree.nodes.new("GeometryNodeMeshToPoints")
    size = tree.nodes.new("GeometryNodeInputNamedAttribute")
    size.inputs["Name"].default_value = "Size"
    paint = tree.nodes.new("GeometryNodeSetMaterial")
    paint.inputs["Material"].default_value = shine
    tree.links.new(size.outputs["Attribute"], points.inputs["Radius"])
    tree.links.new(start.outputs[0], points.inputs[0])
    tree.links.new(points.outputs[0], paint.inputs[0])
    tree.links.new(paint.outputs[0], end.inputs[0])
    cube.modifiers.new("Nodes", "NODES").node_group = tree


def moving_cloud(scene, shine) -> None:
    """Its points themselves move: the camera sees each in many places."""
    import bpy

    cloud(scene, shine)
    cube = bpy.context.object
    cube.shape_key_add(name="Basis")
    key = cube.shape_key_add(name="Up")
    for point in key.data:
        point.co = (point.co[0], point.co[1] + 0.5, point.co[2])
    for frame, value in ((0, 0.0), (2, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    scene.frame_set(1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0


def particles(scene, shine) -> None:
    """Cubes that fly out of a square, turning."""
    import bpy

    bpy.ops.mesh.primitive_cube_add(size=1.0)
    cube = bpy.context.object
    cube.data.materials.append(shine)
    cube.location = (0.0, 0.0, -50.0)
    bpy.ops.mesh.primitive_plane_add(size=2.0)
    plane = bpy.context.object
    plane.show_instancer_for_render = False
    plane.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = plane.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end = 16, 1, 8
    settings.lifetime, settings.lifetime_random = 40, 0.5
    settings.render_type, settings.instance_object = "OBJECT", cube
    settings.particle_size, settings.size_random = 0.25, 0.5
    settings.normal_factor, settings.factor_random = 0.5, 1.5
    settings.use_rotations, settings.angular_velocity_factor = True, 4.0
    settings.angular_velocity_mode = "RAND"
    settings.effector_weights.gravity = 0.0
    for frame in range(1, 13):
        scene.frame_set(frame)


def build(case: str):
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, SIZE, SIZE, 64)
    kit.world(scene)
    shape, kind, output = CASES[case]
    make = {"points": cloud, "moving": moving_cloud, "particles": particles}[shape]
    make(scene, shining(kind, output))
    kit.camera(scene, (0.0, 0.0, 6.0), (0.0, 0.0, 0.0))
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 3.5
    return scene
