# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension on the command line of a real Blender, as the README says it."""

import re
import struct
from pathlib import Path

from blenders import MODULE, ROOT, Blender

VERSION = re.search(r'(?m)^version = "(.+)"', (ROOT / "addon/blender_manifest.toml").read_text())[1]


def png_texts(path: Path) -> dict[str, str]:
    """The tEXt chunks of a PNG file."""
    data, texts, at = path.read_bytes(), {}, 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        if data[at + 4 : at + 8] == b"tEXt":
            key, _, text = data[at + 8 : at + 8 + length].partition(b"\0")
            texts[key.decode()] = text.decode()
        at += 12 + length
    return texts


def test_blender_finds_the_extension_valid(blender: Blender, extension: Path):
    done = blender.run("--command", "extension", "validate", blender.add(extension))
    assert done.returncode == 0, done.stdout


def test_factory_scene_from_the_command_line(installed: Blender):
    small = installed.folder / "small.py"
    small.write_text(
        "import bpy\n"
        "scene = bpy.context.scene\n"
        "scene.render.resolution_percentage = 5\n"
        "scene.janus.samples = 8\n"
    )
    done = installed.run(
        *("--addons", MODULE, "-P", installed.inside("small.py"), "-E", "JANUS"),
        *("-o", installed.inside("cube_"), "-F", "PNG", "-f", "1"),
    )
    assert done.returncode == 0, done.stdout
    picture = installed.folder / "cube_0001.png"
    assert picture.exists(), "no picture was written"
    texts = png_texts(picture)
    assert VERSION in [v for k, v in texts.items() if "janus/version" in k.lower()], texts
    assert any("janus/samples" in k.lower() for k in texts), texts
