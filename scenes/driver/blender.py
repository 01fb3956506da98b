# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the driver again inside a real Blender (`--blender PATH`)."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys

from scenes.driver.arguments import SCENES


def run(path: str, arguments: list[str]) -> int:
    """The exit code of the driver inside `PATH -b`; `arguments` are those of ./dev render."""
    executable = shutil.which(path)
    if executable is None:
        print(f"./dev render: there is no program '{path}'", file=sys.stderr)
        return 1
    script = str(SCENES / "render.py")
    command = [executable, "-b", "--factory-startup", "--python-use-system-env"]
    command += ["--python-exit-code", "1", "--python", script, "--", *arguments]
    # Ctrl-C reaches Blender too, as it is in our process group; it decides what to keep.
    previous = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        child = subprocess.Popen(command, env=os.environ, preexec_fn=_default_interrupt)
        code = child.wait()
    finally:
        signal.signal(signal.SIGINT, previous)
    if code < 0:
        print(f"./dev render: Blender died of {signal.Signals(-code).name}", file=sys.stderr)
        return 128 - code
    return code


def _default_interrupt() -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
