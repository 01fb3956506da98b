# SPDX-License-Identifier: GPL-3.0-or-later
"""What benchmarks share: a captured scene in this process, Cycles in another, robust numbers."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import janus_core
import numpy as np
from janus_core import capture, exr

ROOT = Path(__file__).resolve().parents[2]
FOREVER = 1 << 24  # samples, where time is the limit


@dataclass
class Shot:
    """A picture, [H, W, 3], and what it took: nothing that does not grow with the samples."""

    picture: np.ndarray
    samples: float
    seconds: float
    cpu: float  # processor time of all threads, seconds


class CapturedScene:
    """A scene of scenes/, exported once through Blender, rendered by the core alone.

    `bounces` and `filter_`: None for the scene's own.
    """

    def __init__(
        self,
        scene: str,
        size: int,
        bounces: int | None,
        threads: int,
        filter_: str | None = None,
    ) -> None:
        self.arguments = [scene, "--resolution", f"{size}x{size}", "--threads", str(threads)]
        if bounces is not None:
            self.arguments += ["--max-bounces", str(bounces)]
        if filter_ is not None:
            self.arguments += ["--filter", filter_]
        self._folder = tempfile.TemporaryDirectory()
        self.path = Path(self._folder.name) / "scene.npz"
        command = [sys.executable, str(ROOT / "scenes" / "render.py"), *self.arguments]
        command += ["--samples", "1", "--capture", str(self.path)]
        command += ["--output", str(self.path.with_suffix(".exr"))]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, timeout=600)
        builder, self.settings = capture.load(self.path)
        self.scene = builder.commit()
        self.pixels = size * size

    def render(self, **changes: object) -> tuple[np.ndarray, dict]:
        """(picture, statistics) with the settings of the capture but for the changes."""
        settings = janus_core.RenderSettings(**{**self.settings.to_dict(), **changes})
        session = janus_core.RenderSession(self.scene, settings)
        session.start()
        session.finish()
        return session.snapshot("Combined"), session.stats()

    def shot(self, seconds: float, **changes: object) -> Shot:
        """A render of about that time."""
        cpu = time.process_time()
        picture, stats = self.render(samples=FOREVER, seconds=seconds, **changes)
        cpu = time.process_time() - cpu
        return Shot(picture[..., :3], stats["samples"], stats["seconds"], cpu)

    def speed(self, seconds: float, **changes: object) -> tuple[float, dict]:
        """(samples of all pixels per second, statistics) of a render of about that time."""
        _, stats = self.render(samples=FOREVER, seconds=seconds, **changes)
        return stats["samples"] * self.pixels / stats["seconds"], stats


class Cycles:
    """Cycles renders the same in a process of its own. Between renders it does nothing."""

    def __init__(self, scene: CapturedScene) -> None:
        command = [sys.executable, str(Path(__file__).with_name("_cycles.py")), *scene.arguments]
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self._pixels = scene.pixels
        if self._process.stdout.readline().strip() != "ready":
            raise RuntimeError("Cycles does not start")

    def speed(self, samples: int) -> float:
        """Samples of all pixels per second.

        From the difference between two renders, so that what does not grow with the samples
        (export, BVH, kernels) is in neither side.
        """
        short, long = (self.render(n)["seconds"] for n in (samples, 4 * samples))
        return 3 * samples * self._pixels / max(long - short, 1e-6)

    def render(
        self, samples: int, seed: int = 0, guiding: bool = False, output: Path | None = None
    ) -> dict:
        """{"seconds": ..., "cpu": ...} of a render, export included; `output`: an .exr to write."""
        wanted = {"samples": samples, "seed": seed, "guiding": guiding}
        wanted["output"] = str(output) if output else None
        print(json.dumps(wanted), file=self._process.stdin, flush=True)
        return json.loads(self._process.stdout.readline())

    def shot(self, samples: int, none: dict, seed: int, guiding: bool) -> Shot:
        """A render of so many samples, at least 2; `none`: what a render of one sample takes."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cycles.exr"
            took = self.render(samples, seed, guiding, path)
            picture = exr.read(str(path))[0][..., :3]
        share = samples / (samples - 1)  # the difference is the time of all samples but one
        seconds, cpu = (max(took[key] - none[key], 1e-3) * share for key in ("seconds", "cpu"))
        return Shot(picture, samples, seconds, cpu)

    def close(self) -> None:
        self._process.stdin.close()
        self._process.wait(timeout=60)


class Peer:
    """Another renderer, in a process of its own: a service that speaks _peer.py's protocol.

    Raises Unavailable where it is not installed, or cannot be given exactly the same scene.
    """

    def __init__(self, service: str, python: str, scene: CapturedScene, threads: int) -> None:
        script = Path(__file__).with_name(service)
        self._process = subprocess.Popen(
            [python, str(script), str(scene.path), str(threads)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self._folder = tempfile.TemporaryDirectory()
        for line in self._process.stdout:  # libraries may print before they can be stopped
            if line.startswith("cannot: "):
                raise Unavailable(line.removeprefix("cannot: ").strip())
            if line.strip() == "ready":
                return
        raise Unavailable("not installed, or it does not start")

    def shot(self, seconds: float, seed: int) -> Shot:
        path = Path(self._folder.name) / "peer.npy"
        wanted = {"seconds": seconds, "seed": seed, "output": str(path)}
        print(json.dumps(wanted), file=self._process.stdin, flush=True)
        took = json.loads(self._process.stdout.readline())
        return Shot(np.load(path), took["samples"], took["seconds"], took["cpu"])

    def close(self) -> None:
        self._process.stdin.close()
        self._process.wait(timeout=60)


class Unavailable(Exception):
    """A renderer that cannot take part, and why."""


def spread(values: list[float]) -> float:
    """Half the range between the quartiles, relative to the median."""
    low, high = np.percentile(values, [25, 75])
    return float(0.5 * (high - low) / median(values))


def relative_variance(pictures: list[np.ndarray]) -> float:
    """Of one picture: mean over pixels of the variance between seeds over the squared value."""
    values = np.array([picture[..., :3].mean(axis=2) for picture in pictures], dtype=float)
    mean, variance = values.mean(axis=0), values.var(axis=0, ddof=1)
    return float((variance / (mean**2 + (0.1 * mean.mean()) ** 2)).mean())
