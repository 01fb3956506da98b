# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for both.py: one scene with depth, seen by every kind of camera."""

from __future__ import annotations

SEEDS, SAMPLES = 4, 64
# With bounces left out the pictures differ by the camera alone, and have little noise.
BOUNCES = 1

# Of panoramas. Three blades show which way up the opening is.
OPEN = {
    "aperture_fstop": 0.08,
    "focus_distance": 1.8,
    "aperture_blades": 3,
    "aperture_rotation": 0.3,
    "aperture_ratio": 1.6,
}
# The angle turns back at 9 mm, in the frame.
POLYNOMIAL = {
    "fisheye_polynomial_k0": -0.05,
    "fisheye_polynomial_k1": -0.19,
    "fisheye_polynomial_k2": 0.01,
    "fisheye_polynomial_k3": 0.0,
    "fisheye_polynomial_k4": 0.0,
}

CASES = {
    "shift": {"shift_x": 0.3, "shift_y": -0.2},
    "pixel_aspect": {"pixel_aspect_x": 1.0, "pixel_aspect_y": 1.7, "shift_y": 0.1},
    "vertical_fit": {"sensor_fit": "VERTICAL", "sensor_height": 20.0, "shift_x": 0.2},
    "ortho": {"type": "ORTHO", "ortho_scale": 4.0},
    "ortho_shift": {"type": "ORTHO", "ortho_scale": 3.0, "shift_x": 0.3, "shift_y": -0.2},
    "clipping": {"clip_start": 3.2, "clip_end": 6.5},
    "lens": {"aperture_fstop": 0.1, "focus_distance": 3.5},
    "lens_clipping": {"aperture_fstop": 0.1, "focus_distance": 5.0, "clip_start": 2.9},
    "lens_blades": {
        "aperture_fstop": 0.06,
        "focus_distance": 3.5,
        "aperture_blades": 5,
        "aperture_rotation": 0.5,
        "aperture_ratio": 2.0,
    },
    "lens_object": {"aperture_fstop": 0.1, "focus_object": "Far"},
    "ortho_lens": {
        "type": "ORTHO",
        "ortho_scale": 4.0,
        "aperture_fstop": 1.2,
        "focus_distance": 3.5,
        "aperture_blades": 3,
        "aperture_rotation": 0.2,
        "aperture_ratio": 0.7,
    },
    "pano": {"type": "PANO"},
    "pano_part": {
        "type": "PANO",
        "longitude_min": -1.2,
        "longitude_max": 0.7,
        "latitude_min": -0.6,
        "latitude_max": 0.9,
        "clip_start": 2.0,
        "clip_end": 5.0,
    },
    "pano_lens": {
        "type": "PANO",
        "aperture_fstop": 0.1,
        "focus_distance": 2.0,
        "aperture_blades": 4,
        "aperture_rotation": 0.3,
        "aperture_ratio": 1.6,
    },
    "pano_shift": {"type": "PANO", "shift_x": 0.2, "shift_y": -0.15},
    "fisheye": {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 2.8},
    "fisheye_shift": {
        "panorama_type": "FISHEYE_EQUIDISTANT",
        "fisheye_fov": 7.5,  # more than a turn: it shows things twice
        "shift_x": 0.2,
        "shift_y": -0.1,
    },
    "equisolid": {
        "panorama_type": "FISHEYE_EQUISOLID",
        "fisheye_lens": 9.0,
        "fisheye_fov": 2.6,
        "sensor_fit": "VERTICAL",
        "sensor_height": 24.0,
        "pixel_aspect_x": 1.0,
        "pixel_aspect_y": 1.2,
    },
    "polynomial": {
        "panorama_type": "FISHEYE_LENS_POLYNOMIAL",
        "fisheye_fov": 2.4,
        "sensor_width": 30.0,
        **POLYNOMIAL,
    },
    "mirror_ball": {"panorama_type": "MIRRORBALL", "clip_start": 0.8, "clip_end": 4.0},
    "cubemap_face": {"panorama_type": "EQUIANGULAR_CUBEMAP_FACE", "shift_x": 0.1},
    "cylinder": {
        "panorama_type": "CENTRAL_CYLINDRICAL",
        "central_cylindrical_range_u_min": -2.5,
        "central_cylindrical_range_u_max": 1.5,
        "central_cylindrical_range_v_min": -1.6,
        "central_cylindrical_range_v_max": 2.0,
        "central_cylindrical_radius": 1.5,
    },
    # What materials are told of a camera: "coordinates" is an output of Texture Coordinate.
    "fisheye_window": {
        "panorama_type": "FISHEYE_EQUIDISTANT",
        "fisheye_fov": 2.8,
        "shift_x": 0.2,
        "coordinates": "Window",
    },
    "polynomial_window": {
        "panorama_type": "FISHEYE_LENS_POLYNOMIAL",
        "fisheye_fov": 2.4,
        "coordinates": "Window",
    },
    "mirror_ball_window": {"panorama_type": "MIRRORBALL", "coordinates": "Window"},
    "mirror_ball_camera": {"panorama_type": "MIRRORBALL", "coordinates": "Camera"},
    "cylinder_window": {"panorama_type": "CENTRAL_CYLINDRICAL", "coordinates": "Window"},
    "fisheye_lens": {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 2.8, **OPEN},
    "equisolid_lens": {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_lens": 9.0, **OPEN},
    "polynomial_lens": {
        "panorama_type": "FISHEYE_LENS_POLYNOMIAL",
        "fisheye_fov": 2.4,
        **POLYNOMIAL,
        **OPEN,
    },
    "mirror_ball_lens": {"panorama_type": "MIRRORBALL", **OPEN},
    "cubemap_face_lens": {"panorama_type": "EQUIANGULAR_CUBEMAP_FACE", **OPEN},
    "cylinder_lens": {"panorama_type": "CENTRAL_CYLINDRICAL", **OPEN},
}


def build(case: str):
    """A room of 6 x 8 x 3 m with blocks at several depths and a lamp that the camera passes by."""
    import bpy

    from scenes import kit

    scene = bpy.context.scene
    kit.neutral_settings(scene, 48, 32, SAMPLES)
    kit.limit_bounces(scene.cycles, BOUNCES)
    kit.world(scene)
    room = kit.box(scene, "Room", (6, 8, 3), kit.diffuse("Wall", (0.7, 0.65, 0.6)))
    room.location = (0.3, 1.5, -0.2)
    colors = {"Near": (0.8, 0.2, 0.1), "Middle": (0.1, 0.6, 0.2), "Far": (0.1, 0.2, 0.8)}
    places = {"Near": (-0.6, 0.2), "Middle": (0.2, 1.4), "Far": (1.1, 3.2)}
    for i, (name, color) in enumerate(colors.items()):
        block = kit.box(scene, name, (0.6, 0.5, 0.7 + 0.5 * i), kit.diffuse(name, color))
        block.location = (*places[name], 0.3)
        block.rotation_euler = (0.2 * i, 0.1, 0.4 + 0.3 * i)
    behind = kit.box(scene, "Behind", (0.8, 0.3, 1.2), kit.diffuse("Behind", (0.7, 0.7, 0.1)))
    behind.location = (-0.8, -2.3, 0.1)
    kit.area_light(scene, "Lamp", (0.5, 0.8, 2.5), (0.2, 1.0, 0.0), (1.5, 1.0), 60.0)
    kit.camera(scene, (-0.2, -1.6, 1.3), (0.2, 2.0, 0.8), lens=24.0)
    settings = dict(CASES[case])
    coordinates = settings.pop("coordinates", None)
    if coordinates:
        bpy.data.objects.remove(scene.objects["Lamp"])
        for material in bpy.data.materials:
            show(material, coordinates)
    change(scene, settings)
    return scene


def show(material, coordinates: str) -> None:
    """Makes a material shine in the coordinates where it is, made positive."""
    tree = material.node_tree
    tree.nodes.clear()
    source, size = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeVectorMath")
    light, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    size.operation = "ABSOLUTE"
    tree.links.new(source.outputs[coordinates], size.inputs[0])
    tree.links.new(size.outputs[0], light.inputs["Color"])
    tree.links.new(light.outputs[0], output.inputs["Surface"])


def change(scene, settings: dict) -> None:
    """Sets each setting where this Blender keeps it."""
    import bpy

    data = scene.camera.data
    dof = data.dof
    dof.use_dof = "aperture_fstop" in settings
    panorama = data if hasattr(data, "panorama_type") else data.cycles
    panorama.panorama_type = "EQUIRECTANGULAR"
    if "panorama_type" in settings:
        data.type = "PANO"
    for name, value in settings.items():
        if name == "focus_object":
            dof.focus_object = bpy.data.objects[value]
            continue
        owner = next(o for o in (dof, data, panorama, scene.render) if hasattr(o, name))
        setattr(owner, name, value)
