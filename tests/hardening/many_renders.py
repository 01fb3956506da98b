# SPDX-License-Identifier: GPL-3.0-or-later
"""`many_renders.py core|blender|persistent COUNT`: renders of changing scenes in one process.

Prints the resident memory after each, in megabytes.
"""

from __future__ import annotations

import contextlib
import ctypes
import gc
import os
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
TRIANGLES = 20_000


def resident() -> float:
    """Without what has been freed but not given back."""
    gc.collect()
    with contextlib.suppress(AttributeError, OSError):
        ctypes.CDLL("libc.so.6").malloc_trim(0)
    text = Path("/proc/self/status").read_text()
    return int(text.split("VmRSS:")[1].split()[0]) / 1024


def soup(number: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles, as many each time."""
    corners = np.random.default_rng(number).uniform(-1.0, 1.0, (TRIANGLES, 1, 3))
    corners = corners + np.random.default_rng(number + 1).normal(0.0, 0.05, (TRIANGLES, 3, 3))
    return corners.reshape(-1, 3).astype(np.float32), np.arange(3 * TRIANGLES).reshape(-1, 3)


def through_core():
    import janus_core

    from tests.bindings.conftest import IDENTITY, fill, shader, sky

    kept = janus_core.SceneBuilder()
    ways = (
        *({"integrator": "bdpt"}, {"integrator": "pt"}, {"integrator": "lt"}),
        {"data_passes": ["Depth", "AO"], "cryptomatte": ["Object"], "strategy_images": 3},
        {"expressions": [("all", "L.*E")], "noise_threshold": 0.1, "merge_radius": 0.01},
    )

    def render(number: int) -> None:
        # A new builder, or one that has been committed before.
        builder = janus_core.SceneBuilder() if number % 2 else kept
        fill(builder)
        positions, triangles = soup(number)
        builder.set_mesh("soup", name="Soup", positions=positions, triangles=triangles)
        builder.set_instance("soup", name="Soup", mesh="soup", transform=IDENTITY, materials=["m"])
        kind = ("BSDF_GLASS", "BSDF_PRINCIPLED", "EMISSION")[number % 3]
        graph = shader(kind)
        if kind == "EMISSION":
            graph["surface"] = {"link": ["Shader", "Emission"]}
        builder.set_material("m", name="Paint", graph=graph)
        sky(builder, np.random.default_rng(number).random((128, 256, 3)))
        scene = builder.commit()
        settings = janus_core.RenderSettings(
            width=64, height=64, samples=1, **ways[number % len(ways)]
        )
        session = janus_core.RenderSession(scene, settings)
        session.start()
        session.finish()
        for name in session.passes():
            session.snapshot(name)

    return render


def through_blender(persistent: bool):
    sys.path.insert(0, str(ROOT / "tests/addon"))
    import bpy
    import conftest
    from viewport_kit import furnish

    conftest._load().register()
    scene = bpy.context.scene
    scene.render.engine = "JANUS"
    furnish(scene)
    scene.render.use_persistent_data = persistent
    scene.janus.samples = 1
    scene.view_layers[0].use_pass_z = True

    def render(number: int) -> None:
        positions, triangles = soup(number)
        if old := bpy.data.objects.get("Soup"):
            bpy.data.meshes.remove(old.data)
        obj = conftest.add_mesh("Soup", positions.tolist(), triangles.tolist())
        obj.location.x = number % 5
        bpy.data.objects["Ball"].location.z = 0.1 * (number % 7)
        bpy.ops.render.render()
        assert conftest.part("render.final").last_render["samples"] == 1

    return render


def main() -> None:
    kind, count = sys.argv[1], int(sys.argv[2])
    render = through_core() if kind == "core" else through_blender(kind == "persistent")
    found = []
    for number in range(count):
        render(number)
        found.append(resident())
    print(*(f"{megabytes:.1f}" for megabytes in found))
    sys.stdout.flush()
    os._exit(0)  # bpy may hang at exit


if __name__ == "__main__":
    main()
