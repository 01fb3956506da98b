# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes for the tests of whole pictures: captured once through Blender, rendered without it."""

from __future__ import annotations

import functools
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
DRIVER = ROOT / "scenes" / "render.py"

# What is captured: a scene, and the size at which the statistics are made.
CAPTURES = {
    "diffuse_box": (48, 48),
    "glass_box": (48, 48),
    "hero_soft": (64, 40),
}


def drive(*arguments: object, timeout: float = 300.0) -> subprocess.CompletedProcess:
    """Runs `./dev render` with the arguments; its own Python process, as bpy wants one."""
    command = [sys.executable, str(DRIVER), *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout)


def driven(*arguments: object) -> str:
    """The same, but it must succeed; what it printed."""
    result = drive(*arguments)
    assert result.returncode == 0, f"render {arguments} failed:\n{result.stdout}{result.stderr}"
    return result.stdout


class Captured:
    """A captured scene, committed once; `render` makes one picture of it, [H, W, 4], and
    `render_passes` all that its settings ask for."""

    def __init__(self, path: Path):
        import janus_core
        from janus_core import capture

        self._core = janus_core
        self._series: dict[tuple, list] = {}
        self.path = path
        builder, self.settings = capture.load(str(path))
        self.scene = builder.commit()

    def render(self, **changes: object) -> np.ndarray:
        return self.render_passes(**changes)["Combined"]

    def render_passes(self, **changes: object) -> dict[str, np.ndarray]:
        settings = self._core.RenderSettings(**{**self.settings.to_dict(), **changes})
        session = self._core.RenderSession(self.scene, settings)
        session.start()
        while not session.wait(1.0):
            pass
        session.finish()
        return {name: session.snapshot(name) for name in session.passes()}

    def series(self, integrator: str, samples: int, seeds: int, **changes: object) -> list:
        """Independent pictures, made once; no two integrators ever share a seed.

        With the counts that the settings say: where path tracing is as good, automatic counts would
        make bdpt one, and nothing would be compared.
        """
        changes = {"adaptive_counts": False, **changes}
        key = (integrator, samples, seeds, *sorted(changes.items()))
        if key not in self._series:
            first = 1000 * ("pt", "lt", "bdpt").index(integrator) + 1
            self._series[key] = [
                self.render(integrator=integrator, samples=samples, seed=first + i, **changes)
                for i in range(seeds)
            ]
        return self._series[key]


@pytest.fixture(scope="session")
def captured(tmp_path_factory):
    """captured(scene) -> Captured. Each scene goes through Blender once."""
    folder = tmp_path_factory.mktemp("captures")
    made: dict[str, Captured] = {}

    def get(name: str) -> Captured:
        if name not in made:
            path = folder / f"{name}.npz"
            width, height = CAPTURES[name]
            driven(
                *(name, "--resolution", f"{width}x{height}", "--samples", 1),
                *("--capture", path, "--output", folder / f"{name}.exr"),
            )
            made[name] = Captured(path)
        return made[name]

    return get


def made_by_both(cases: ModuleType, folder: Path, timeout: float = 600.0) -> Callable:
    """Runs both.py on a module of cases; see pictures_in()."""
    program = Path(__file__).with_name("both.py")
    command = [sys.executable, str(program), cases.__name__.rpartition(".")[2], str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    assert done.returncode == 0, done.stdout + done.stderr
    return pictures_in(cases, folder)


def pictures_in(cases: ModuleType, folder: Path) -> Callable:
    """What both.py has written there: get(case) -> (our capture, Cycles' pictures)."""
    from janus_core import exr

    read = exr.read_layers if hasattr(cases, "save") else exr.read

    @functools.lru_cache(maxsize=2)
    def get(case: str) -> tuple[Captured, list]:
        seeds = range(1, cases.SEEDS + 1)
        cycles = [read(folder / f"{case}-{seed}.exr")[0] for seed in seeds]
        return Captured(folder / f"{case}.npz"), cycles

    return get
