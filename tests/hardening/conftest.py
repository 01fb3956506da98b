# SPDX-License-Identifier: GPL-3.0-or-later
"""What may crash or hang runs in a process of its own: it is seen, and ends no other test."""

import os
import subprocess
import sys
from pathlib import Path

FULL = "JANUS_FULL" in os.environ
FOLDER = Path(__file__).parent
sys.path.insert(0, str(FOLDER.parents[1]))  # for the scene of tests/bindings


def apart(script: str, *arguments, timeout: float) -> str:
    """What a script of this folder prints. `timeout`, in seconds: a hang, not a slow machine."""
    command = [sys.executable, "-X", "faulthandler", str(FOLDER / script), *map(str, arguments)]
    done = subprocess.run(
        command, capture_output=True, text=True, errors="replace", timeout=timeout, check=False
    )
    assert done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout
