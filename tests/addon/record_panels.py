# SPDX-License-Identifier: GPL-3.0-or-later
"""Which panels of a Blender are open to Janus, and why the others are not, as plain data:
blender_panels/VERSION.json.

Needs nothing but a Blender, of any version, with its own Python:

    blender -b --factory-startup --python tests/addon/record_panels.py [-- FOLDER]
    python tests/addon/record_panels.py [FOLDER]          (where `import bpy` works)

writes the file of that Blender, here or into FOLDER. The line of an open panel is
empty.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))  # blender does not
from recordings import record  # noqa: E402

FOLDER = Path(__file__).resolve().parent / "blender_panels"
RULE = FOLDER.parents[2] / "addon" / "ui" / "engine_panels.py"
# Modules of Blender's own panels, and of Cycles'; other add-ons come and go.
MODULES = {"bl_ui", "cycles"}


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


if __name__ == "__main__":
    record(FOLDER, recording)
