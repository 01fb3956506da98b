# SPDX-License-Identifier: GPL-3.0-or-later
"""`./dev gallery`: renders the figures and writes a page; --help has the options.

Exit codes: 0 done, 1 failed, 2 wrong usage, 130 stopped by Ctrl-C.
"""

from __future__ import annotations

import sys
from pathlib import Path

# In the place of this folder, so that its modules are found as scenes.gallery alone.
sys.path[0] = str(Path(__file__).resolve().parents[2])

from scenes.gallery import arguments  # noqa: E402


def main(words: list[str]) -> None:
    options = arguments.parse(words)
    try:
        import bpy  # noqa: F401  before anything that needs it, or that it could clash with
    except ImportError as error:
        sys.exit(f"./dev gallery: the bpy module cannot be loaded: {error}")
    from scenes.driver import run
    from scenes.driver.setup import one_line
    from scenes.gallery import produce

    try:
        produce.produce(options)
        code = 0
    except KeyboardInterrupt:
        code = 130
    except Exception as error:  # one line says what; nothing may hang at the interpreter's exit
        print(f"./dev gallery: {one_line(error)}", file=sys.stderr)
        code = 1
    run.leave(code)


if __name__ == "__main__":
    main(sys.argv[1:])
