# SPDX-License-Identifier: GPL-3.0-or-later
"""Which panels of a Blender are open to Janus, and why the others are not, as plain data:
blender_panels/VERSION.json.

Needs nothing but a Blender, of any version, with its own Python:

    blender -b --factory-startup --python tests/addon/record_panels.py [-- FOLDER]
    python tests/addon/record_panels.py [FOLDER]          (where `import bpy` works)

writes the file of that Blender, here or into FOLDER. One panel is one line, sorted, so that the
difference of two versions can be read; of an open panel the line is empty.
"""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "blender_panels"
RULE = FOLDER.parents[2] / "addon" / "ui" / "engine_panels.py"
# Modules of Blender's own panels, and of Cycles'; other add-ons come and go.
MODULES = {"bl_ui", "cycles"}


def version() -> str:
    """Of the running Blender; patches of a release have the same panels."""
    import bpy

    return ".".join(map(str, bpy.app.version[:2]))


def recording(rule=None) -> dict[str, str]:
    """By name: why a panel is closed to Janus. `rule`: the module ui.engine_panels."""
    rule = rule or _rule()
    return {
        panel.__name__: rule.why_closed(panel)
        for panel in rule.panels_of_engines()
        if panel.__module__.partition(".")[0] in MODULES
    }


def _rule():
    spec = importlib.util.spec_from_file_location("engine_panels", RULE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def to_text(panels: dict[str, str]) -> str:
    lines = [f"{json.dumps(name)}: {json.dumps(why)}" for name, why in sorted(panels.items())]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def stored() -> dict[str, dict[str, str]]:
    """Every recording there is, by version, oldest first."""
    files = sorted(FOLDER.glob("*.json"), key=lambda f: [int(n) for n in f.stem.split(".")])
    return {file.stem: json.loads(file.read_text()) for file in files}


def main() -> None:
    arguments = sys.argv[1:]
    if not sys.argv[0].endswith(".py"):  # blender's own come first
        arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    file = (Path(arguments[0]) if arguments else FOLDER) / f"{version()}.json"
    file.write_text(to_text(recording()))
    print(f"{file}: written")
    sys.stdout.flush()
    os._exit(0)  # some of them hang or crash at their own exit


if __name__ == "__main__":
    main()
