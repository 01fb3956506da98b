# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between versions of Blender, recorded as plain data: FOLDER/VERSION.json.

One thing is one line, sorted, so that the difference of two versions can be read.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path


def version() -> str:
    """Of the running Blender; patches of a release are alike."""
    import bpy

    return ".".join(map(str, bpy.app.version[:2]))


def to_text(things: dict) -> str:
    lines = [f"{json.dumps(name)}: {json.dumps(thing)}" for name, thing in sorted(things.items())]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def stored(folder: Path) -> dict[str, dict]:
    """Every recording there is, by version, oldest first."""
    files = sorted(folder.glob("*.json"), key=lambda f: [int(n) for n in f.stem.split(".")])
    return {file.stem: json.loads(file.read_text()) for file in files}


def record(folder: Path, recording: Callable[[], dict]) -> None:
    """Writes the file of the running Blender, there or where the command says, and leaves it."""
    arguments = sys.argv[1:]
    if not sys.argv[0].endswith(".py"):  # blender's own come first
        arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    file = (Path(arguments[0]) if arguments else folder) / f"{version()}.json"
    file.write_text(to_text(recording()))
    print(f"{file}: written")
    sys.stdout.flush()
    os._exit(0)  # some of them hang or crash at their own exit
