# SPDX-License-Identifier: GPL-3.0-or-later
"""The driver behind `./dev render`: `render.py --help` has the options.

Runs in a Python that has the bpy module, or by itself inside Blender:
`blender -b --python scenes/render.py -- SCENE --output F.exr`.

Exit codes: 0 done, 1 failed, 2 wrong usage, 130 stopped by Ctrl-C (the picture so far is kept).
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from scenes.driver import arguments  # noqa: E402


def main(words: list[str]) -> int:
    options = arguments.parse(words)
    if options.blender:
        from scenes.driver import blender

        return blender.run(options.blender, arguments.without_blender(words))
    try:
        import bpy  # noqa: F401  before anything that needs it, or that it could clash with
    except ImportError as error:
        print(f"./dev render: the bpy module cannot be loaded: {error}", file=sys.stderr)
        return 1
    from scenes.driver import run

    run.leave(run.run(options))
    return 1


def _words() -> list[str]:
    """Our arguments: inside Blender those after `--`, which its own command line precedes."""
    if Path(sys.argv[0]).resolve() == Path(__file__).resolve():
        return sys.argv[1:]
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []


if __name__ == "__main__":
    try:
        code = main(_words())
    except KeyboardInterrupt:
        code = 130
    sys.exit(code)
