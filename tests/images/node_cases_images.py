# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases for pictures: how they are looked up, their alpha, colour spaces, tiles and frames."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

from .node_cases import CASES, enum_items

FRAME = 4  # of the scene


def add_cases() -> None:
    texture_cases()
    space_cases()
    tile_cases()
    frame_cases()


def picture(name: str, width=5, height=4, alpha=False, floats=False, space=None):
    import bpy

    if name in bpy.data.images:
        return bpy.data.images[name]
    image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=floats)
    if space:
        image.colorspace_settings.name = space
    pixels = np.random.default_rng(5).uniform(0.0, 1.0, (height, width, 4)).astype(np.float32)
    if not alpha:
        pixels[..., 3] = 1.0
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    return image


def file(name: str, write) -> str:
    """The path of a file, which write(path) makes on first use."""
    import bpy

    path = Path(bpy.app.tempdir) / name
    if not path.exists():
        write(path)
    return str(path)


def png(path: Path, pixels: np.ndarray) -> None:
    """Writes uint8 or uint16 [H, W, 3 or 4], the bottom row first."""
    height, width, channels = pixels.shape
    size = pixels.dtype.itemsize
    rows = np.ascontiguousarray(pixels[::-1], dtype=f">u{size}").tobytes()
    step = width * channels * size
    data = b"".join(b"\0" + rows[i * step : (i + 1) * step] for i in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8 * size, 2 if channels == 3 else 6, 0, 0, 0)
    chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(data)), (b"IEND", b""))
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + b"".join(
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
            for kind, body in chunks
        )
    )


def noise(seed: int, width=5, height=4, channels=3, kind=np.uint8) -> np.ndarray:
    top = np.iinfo(kind).max
    return np.random.default_rng(seed).integers(0, top, (height, width, channels)).astype(kind)


def load(path: str, space: str | None = None, fresh=True):
    import bpy

    image = bpy.data.images.load(path, check_existing=not fresh)
    if space:
        image.colorspace_settings.name = space
    return image


def space_cases() -> None:
    import bpy

    probe = bpy.data.images.new("Probe", 1, 1)
    settings = probe.colorspace_settings.bl_rna.properties["name"]
    spaces = [item.identifier for item in settings.enum_items]
    bpy.data.images.remove(probe)

    def look(t, image):
        return t.node("TexImage", {0: t.coordinate("UV")}, image=image)

    def dim(t, socket):
        """Logarithmic spaces hold more than a tile shows."""
        above = t.around("VectorMath", {0: socket, 1: [-20.0] * 3}, operation="MAXIMUM")
        return t.around("VectorMath", {0: above, 1: [20.0] * 3}, operation="MINIMUM")

    for space in spaces:
        CASES[f"image bytes in {space}"] = lambda t, space=space: dim(
            t, look(t, picture(f"Bytes {space}", space=space)).outputs[0]
        )

        def build(t, space=space):
            image = load(file("float.exr", float_exr), space)
            return dim(t, look(t, image).outputs[0])

        CASES[f"image floats in {space}"] = build
    for space in ("ACEScg", "Rec.1886", "Linear Rec.2020", "sRGB", "Non-Color"):
        if space not in spaces:
            continue
        for mode in ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"):
            for used in (False, True):

                def build(t, space=space, mode=mode, used=used):
                    image = picture(f"Alpha {mode} {space}", alpha=True, space=space)
                    image.alpha_mode = mode
                    node = look(t, image)
                    if not used:
                        return node.outputs[0]
                    return t.around("VectorMath", {0: node.outputs[0], 1: node.outputs[1]})

                CASES[f"image alpha in {space} {mode} {used}"] = build
    for space in ("sRGB", "Non-Color"):

        def build(t, space=space):
            path = file("deep.png", lambda path: png(path, noise(3, kind=np.uint16)))
            return look(t, load(path, space)).outputs[0]

        CASES[f"image of 16 bits in {space}"] = build


def float_exr(path: Path) -> None:
    from janus_core import exr

    exr.write(path, np.random.default_rng(4).uniform(0.0, 1.0, (4, 5, 3)).astype(np.float32))


def tile_cases() -> None:
    import bpy

    def tiled(missing=False, packed=False):
        name = f"Tiles {missing} {packed}"
        if name in bpy.data.images:
            return bpy.data.images[name]
        for number in (1001, 1002, 1012):
            width = 3 + number % 4
            path = file(
                f"tile.{number}.png",
                lambda p, n=number, w=width: png(p, noise(n, width=w, channels=4)),
            )
        image = load(path.replace("1012", "1001"))
        image.name = name
        image.source = "TILED"
        image.filepath = path.replace("1012", "<UDIM>")
        for number in (1002, 1012, *((1011,) if missing else ())):
            image.tiles.new(number)
        if packed:
            image.pack()
        return image

    def place(t, scale, move):
        return t.out("Mapping", {0: t.coordinate("UV"), "Scale": scale, "Location": move})

    for missing, packed in ((False, False), (True, False), (False, True)):
        for interpolation in ("Closest", "Linear"):

            def build(t, missing=missing, packed=packed, interpolation=interpolation):
                return t.out(
                    "TexImage",
                    {0: place(t, (2.9, 2.9, 1.0), (-0.4, -0.4, 0.0))},
                    image=tiled(missing, packed),
                    interpolation=interpolation,
                )

            CASES[f"tiles {missing} {packed} {interpolation}"] = build
    CASES["tiles alpha"] = lambda t: t.out(
        "TexImage", {0: place(t, (2.0, 2.0, 1.0), (0.0, 0.0, 0.0))}, 1, image=tiled()
    )


def frame_cases() -> None:
    import bpy

    def sequence():
        if "Sequence" not in bpy.data.images:
            for number in range(1, 7):
                path = file(f"frame_{number:03}.png", lambda p, n=number: png(p, noise(n)))
            image = load(path)
            image.name, image.source = "Sequence", "SEQUENCE"
        return bpy.data.images["Sequence"]

    def movie():
        if "Movie" not in bpy.data.images:
            image = load(file("movie.mkv", film))
            image.name = "Movie"
        return bpy.data.images["Movie"]

    settings = [(6, 1, 0, False), (3, 1, 0, True), (3, 2, 1, False), (2, 1, 0, False)]
    settings += [(3, 5, 0, True), (4, 3, 2, True), (6, 4, 0, False), (6, 9, 2, False)]
    settings += [(0, 1, 0, False), (100, 1, 50, False)]  # without a picture
    for kind, get in (("sequence", sequence), ("movie", movie)):
        for duration, start, offset, cyclic in settings:

            def build(t, get=get, user=(duration, start, offset, cyclic)):
                node = t.node("TexImage", {0: t.coordinate("UV")}, image=get())
                node.image_user.frame_duration, node.image_user.frame_start = user[:2]
                node.image_user.frame_offset, node.image_user.use_cyclic = user[2:]
                return node.outputs[0]

            CASES[f"{kind} {duration} {start} {offset} {cyclic}"] = build


def film(path: Path) -> None:
    """A movie of six grey frames."""
    import bpy

    scene = bpy.data.scenes.new("Film")
    world = scene.world = bpy.data.worlds.new("Film")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    light, out = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(light.outputs[0], out.inputs[0])
    for frame in range(1, 7):
        light.inputs[1].default_value = frame / 8
        light.inputs[1].keyframe_insert("default_value", frame=frame)
    scene.camera = bpy.data.objects.new("Film", bpy.data.cameras.new("Film"))
    scene.collection.objects.link(scene.camera)
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    scene.render.resolution_x = scene.render.resolution_y = 32
    scene.frame_start, scene.frame_end = 1, 6
    if hasattr(scene.render.image_settings, "media_type"):
        scene.render.image_settings.media_type = "VIDEO"
    scene.render.image_settings.file_format = "FFMPEG"
    scene.render.ffmpeg.format, scene.render.ffmpeg.codec = "MKV", "FFV1"
    scene.render.filepath = str(path)
    bpy.ops.render.render(animation=True, scene=scene.name)
    bpy.data.scenes.remove(scene)


def texture_cases() -> None:
    def nowhere(t):
        return t.out("VectorMath", {0: t.vector(), 1: (0.0, 0.0, 0.0)}, operation="MULTIPLY")

    def placed(t, scale=(1.7, 1.3, 1.0), move=(-0.3, -0.2, 0.1), kind="UV"):
        return t.out("Mapping", {"Vector": t.coordinate(kind), "Scale": scale, "Location": move})

    for interpolation in ("Linear", "Closest", "Cubic", "Smart"):
        for extension in enum_items("TexImage", "extension"):

            def build(t, interpolation=interpolation, extension=extension):
                return t.out(
                    "TexImage",
                    {0: placed(t)},
                    image=picture("Bytes"),
                    interpolation=interpolation,
                    extension=extension,
                )

            CASES[f"image {interpolation} {extension}"] = build
    for projection in ("SPHERE", "TUBE"):
        CASES[f"image {projection}"] = lambda t, projection=projection: t.out(
            "TexImage",
            {0: placed(t, kind="Generated")},
            image=picture("Bytes"),
            projection=projection,
        )
    for blend in (0.0, 0.3, 1.0):
        CASES[f"image BOX {blend}"] = lambda t, blend=blend: t.out(
            "TexImage",
            {0: t.coordinate("Generated")},
            image=picture("Bytes"),
            projection="BOX",
            projection_blend=blend,
        )
    for mode in ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"):
        for space in ("sRGB", "Non-Color"):
            for output in (0, 1):

                def build(t, mode=mode, space=space, output=output):
                    image = picture(f"Alpha {mode} {space}", alpha=True, space=space)
                    image.alpha_mode = mode
                    node = t.node("TexImage", {0: placed(t)}, image=image)
                    return node.outputs[output]

                CASES[f"image alpha {mode} {space} {output}"] = build

            def build(t, mode=mode, space=space):
                image = picture(f"Alpha {mode} {space}", alpha=True, space=space)
                image.alpha_mode = mode
                node = t.node("TexImage", {0: placed(t)}, image=image)
                return t.out(
                    "Mix",
                    {
                        "Factor_Float": node.outputs[1],
                        "A_Color": (0, 0, 0, 1),
                        "B_Color": node.outputs[0],
                    },
                    "Result_Color",
                    data_type="RGBA",
                )

            CASES[f"image alpha used {mode} {space}"] = build
    CASES["image floats"] = lambda t: t.out(
        "TexImage", {0: placed(t)}, image=picture("Floats", floats=True)
    )
    for kind in ("UV", "Generated"):
        CASES[f"image over {kind}"] = lambda t, kind=kind: t.out(
            "TexImage", {0: t.coordinate(kind)}, image=picture("Bytes")
        )
    CASES["image without vector"] = lambda t: t.out("TexImage", image=picture("Bytes"))
    CASES["image missing"] = lambda t: t.out("TexImage")
    for projection in enum_items("TexEnvironment", "projection"):
        for interpolation in enum_items("TexEnvironment", "interpolation"):
            for place in ("", " nowhere"):

                def build(t, projection=projection, interpolation=interpolation, place=place):
                    return t.out(
                        "TexEnvironment",
                        {0: nowhere(t) if place else t.vector()},
                        image=picture("Bytes"),
                        projection=projection,
                        interpolation=interpolation,
                    )

                CASES[f"environment {projection} {interpolation}{place}"] = build
