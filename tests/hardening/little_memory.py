# SPDX-License-Identifier: GPL-3.0-or-later
"""`little_memory.py COUNT`: a scene is made and rendered COUNT times with more and more memory.

Each in a forked process: from too little for anything to enough for all. Prints how many pictures
came of it, and what the others were told.
"""

from __future__ import annotations

import collections
import contextlib
import faulthandler
import os
import resource
import signal
import sys
from pathlib import Path

import janus_core
import numpy as np
from janus_core import capture, dual, exr

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tests.bindings.conftest import IDENTITY, fill, shader, sky, translation  # noqa: E402

DONE, REFUSED, EMPTY = 0, 3, 4
SECONDS = 40  # a hang
MOST_MEGABYTES = 700  # that all of it needs, beside what is there before


def megabytes_mapped() -> float:
    text = Path("/proc/self/status").read_text()
    return int(text.split("VmSize:")[1].split()[0]) / 1024


def work(folder: Path, way: int) -> None:
    rng = np.random.default_rng(2)
    builder = capture.CapturingBuilder()
    fill(builder)
    corners = rng.uniform(-1.0, 1.0, (30_000, 1, 3)) + rng.normal(0.0, 0.02, (30_000, 3, 3))
    triangles = np.arange(90_000).reshape(-1, 3)
    builder.set_mesh("soup", name="Soup", positions=corners.reshape(-1, 3), triangles=triangles)
    builder.set_instance("soup", name="Soup", mesh="soup", transform=IDENTITY, materials=["m"])
    spot = {"name": "Spot", "type": "SPOT", "transform": translation(0, 0, 3)}
    builder.set_light("spot", **spot, spot_size=1.0)
    glow = shader("EMISSION", Strength=1.0) | {"surface": {"link": ["Shader", "Emission"]}}
    builder.set_material("glow", name="Glow", graph=glow)
    if way % 2:
        builder.set_instance("lit", name="Lit", mesh="soup", transform=IDENTITY, materials=["glow"])
    sky(builder, rng.random((512, 1024, 3)))
    scene = builder.commit()
    if way % 5 == 4:
        settings = janus_core.RenderSettings(width=64, height=64, samples=4)
        matrix = dual.capture(scene, settings, "Spot", resolution=(64, 64), memory=64 << 20)
        matrix.relight()
        matrix.save(folder / "matrix.npz")
        return
    settings = janus_core.RenderSettings(
        width=512,
        height=256,
        samples=1,
        threads=64 if way % 3 == 0 else 2,
        max_bounces=3,
        strategy_images=(0, 4)[way % 2],
        merge_radius=(0.0, 0.05)[way // 2 % 2],
        connection_mode=("CACHE", "CLASSIC")[way // 4 % 2],
        data_passes=["Depth", "Normal", "AO"],
        cryptomatte=["Object"],
    )
    builder.save(folder / "scene.npz", settings)
    session = janus_core.RenderSession(scene, settings)
    session.start()
    session.finish()
    layers = {name: session.snapshot(name) for name in session.passes()}
    exr.write_layers(folder / "picture.exr", layers)


def told(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def child(folder: Path, megabytes: float, way: int, write: int) -> int:
    signal.alarm(SECONDS)
    most = int((megabytes_mapped() + megabytes) * (1 << 20))
    resource.setrlimit(resource.RLIMIT_AS, (most, most))
    try:
        work(folder, way)
    except (janus_core.Error, MemoryError) as error:
        with contextlib.suppress(MemoryError):
            os.write(write, (told(error) + "\n").encode())
        # Python's own says nothing.
        return REFUSED if str(error) or type(error) is MemoryError else EMPTY
    return DONE


def main() -> None:
    count, folder = int(sys.argv[1]), Path(sys.argv[2])
    faulthandler.enable()
    pictures, messages = 0, collections.Counter()
    for number in range(count):
        # Small steps where most is decided.
        megabytes = MOST_MEGABYTES * ((number + 0.5) / count) ** 1.5
        read, write = os.pipe()
        if (process := os.fork()) == 0:
            code = 1
            try:
                code = child(folder, megabytes, number, write)
            finally:
                os._exit(code)
        os.close(write)
        status = os.waitpid(process, 0)[1]
        with os.fdopen(read, errors="replace") as pipe:
            said = pipe.read().strip()
        if status not in (DONE, REFUSED << 8):
            sys.exit(f"number {number}, {megabytes:.0f} MB more: status {status:#x} {said}")
        pictures += status == DONE
        messages[said] += status != DONE
    print(pictures)
    for text, times in messages.most_common():
        print(f"{times} {text}")


if __name__ == "__main__":
    main()
