# SPDX-License-Identifier: GPL-3.0-or-later
"""`fuzz_calls.py FIRST COUNT FOLDER`: each seed is a handful of wrong calls of the bindings.

A process of its own, as a crash is what is looked for. Its calls are in FOLDER/calls.txt.
"""

from __future__ import annotations

import gc
import resource
import sys
import warnings
from pathlib import Path

import janus_core
import numpy as np
from janus_core import capture, dual, exr

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tests.bindings.conftest import IDENTITY, PLANE, fill, shader, translation  # noqa: E402
from tests.hardening.nonsense import Nonsense  # noqa: E402

ALLOWED = (janus_core.Error, TypeError, ValueError, MemoryError)
MEMORY = 6 << 30  # what nonsense may ask for
SIDE = 8

GRAPH = shader("BSDF_DIFFUSE", Color=[0.8, 0.5, 0.2, 1.0])
SPOT = {"name": "Lamp", "type": "SPOT", "transform": translation(0, 0, 3), "spot_size": 1.0}
KEYS = np.array([(0, 0, 0), (0, 0.1, 0.5), (0, 0, 1), (1, 0, 0), (1, 0, 1)], np.float32)
HAIR = {"positions": KEYS, "radii": np.full(5, 0.1, np.float32)}
METHODS = {
    "set_mesh": {
        "key": "mesh",
        "name": "Floor",
        **PLANE,
        "corner_vertices": np.arange(4),
        "vertex_normals": None,
        "corner_normals": np.tile([0.0, 0.0, 1.0], (4, 1)),
        "material_indices": np.zeros(2, np.int32),
        "faces": np.zeros(2, np.int32),
        "edges": np.array([(0, 1), (1, 2)]),
        "attributes": [
            {"key": "uv:", "domain": "CORNER", "values": np.zeros((4, 2))},
            {"key": "pointiness"},
        ],
    },
    "set_curves": {
        "key": "hair",
        "name": "Hair",
        **HAIR,
        "curves": np.array([0, 3, 5]),
        "straight": False,
        "material_indices": np.zeros(2, np.int32),
        "attributes": [{"key": "attribute:x", "domain": "FACE", "values": np.zeros(2)}],
    },
    "set_points": {"key": "points", "name": "Points", **HAIR, "attributes": []},
    "set_material": {
        "key": "m",
        "name": "Paint",
        "graph": GRAPH,
        "sample_emission": True,
        "material_index": 1.0,
        "aovs": None,
    },
    "set_image": {
        "key": "sky",
        "name": "Sky",
        "pixels": np.ones((2, 4, 3), np.float32),
        "srgb": False,
        "associated": False,
    },
    "set_instance": {
        "key": "floor",
        "name": "Floor",
        "mesh": "mesh",
        "transform": IDENTITY,
        "materials": ["m", None],
        "visible_camera": True,
        "visible_shadow": True,
        "holdout": False,
        "color": (1.0, 1.0, 1.0, 1.0),
        "object_index": 0.0,
        "random": 0.0,
        "attributes": {"object:x": (1.0, 2.0, 3.0, 4.0)},
        "light_group": "",
        "asset": "",
        "receiver_set": -1,
        "blocker_set": -1,
        "unlit_by": [],
        "lets_pass": [],
        "shadow_catcher": False,
    },
    "set_light": {
        "key": "lamp",
        **SPOT,
        "color": (1.0, 1.0, 1.0),
        "energy": 10.0,
        "radius": 0.0,
        "soft_falloff": True,
        "shape": "SQUARE",
        "size": 0.25,
        "size_y": 0.5,
        "spread": 1.0,
        "spot_blend": 0.15,
        "spot_square": False,
        "angle": 0.1,
        "normalize": True,
        "exposure": 0.0,
        "visible_camera": True,
        "cast_shadow": True,
        "max_bounces": 1024,
        "graph": None,
        "light_group": "",
        "receiver_set": -1,
        "blocker_set": -1,
        "lights_catchers": True,
    },
    "set_world": {
        "name": "World",
        "graph": shader("BACKGROUND", Color=[0.1, 0.2, 0.3, 1.0], Strength=1.0)
        | {"surface": {"link": ["Shader", "Background"]}},
        "visible_camera": True,
        "light_group": "",
        "aovs": None,
    },
    "set_camera": {
        "name": "Camera",
        "type": "PERSP",
        "transform": translation(0, 0, 4),
        "window": (-0.5, 0.5, -0.25, 0.25),
        "clip_start": 0.1,
        "clip_end": 1000.0,
        "aperture_radius": 0.0,
        "focus_distance": 10.0,
        "aperture_blades": 0,
        "aperture_rotation": 0.0,
        "aperture_ratio": 1.0,
        "pixel_size": 0.0,
        "shift": (0.0, 0.0),
        "fisheye_fov": 3.0,
        "fisheye_lens": 10.0,
        "fisheye_polynomial": (0.0, 0.1, 0.0, 0.0, 0.0),
    },
    "set_mesh_motion": {"key": "mesh", "positions": np.zeros((2, 4, 3)), "normals": None},
    "set_instance_motion": {"key": "floor", "transforms": np.stack([IDENTITY] * 3)},
    "set_camera_motion": {"transforms": np.stack([IDENTITY] * 2), "windows": [(-1, 1, -1, 1)] * 2},
    "set_shutter": {"openness": [0.0, 1.0, 0.0]},
    "remove": {"key": "hair"},
}
POSITIONAL = ("key", "openness")
CAMERAS = (
    *("ORTHO", "EQUIRECTANGULAR", "FISHEYE_EQUIDISTANT", "FISHEYE_EQUISOLID", "MIRRORBALL"),
    *("FISHEYE_LENS_POLYNOMIAL", "EQUIANGULAR_CUBEMAP_FACE", "CENTRAL_CYLINDRICAL", "PERSP"),
)
LIGHTS = ("POINT", "SPOT", "SUN", "AREA")
SETTINGS = janus_core.RenderSettings(
    width=SIDE, height=SIDE, samples=1, max_bounces=4, threads=2
).to_dict()


class Fuzzer:
    def __init__(self, log: Path):
        self._log = log
        self._calls: list[str] = []
        self.allowed = self.succeeded = self.rendered = 0

    def run(self, seed: int) -> None:
        self._calls, self._nonsense = [f"seed {seed}"], Nonsense(seed)
        builder = janus_core.SceneBuilder()
        if self._nonsense.random.random() < 0.95:
            fill(builder)
        for _ in range(self._nonsense.random.randint(1, 4)):
            self._set(builder)
        scene = self._commit(builder)
        settings = self._settings()
        for _ in range(3):
            self._try(janus_core.check_expression, self._nonsense.value())
            self._try(janus_core.check_strategies, self._nonsense.value())
            self._try(janus_core.cryptomatte_hash, self._nonsense.value())
        self._try(janus_core.RenderSession, self._nonsense.value(), self._nonsense.value())
        if scene is None or settings is None:
            return
        if self._nonsense.random.random() < 0.2:
            self._transport(scene, settings)
        session = self._try(janus_core.RenderSession, scene, settings)
        if session is not None:
            self._drive(session, settings)

    def _try(self, call, *arguments, **keywords):
        """What the call returns; None if it was refused as it should be."""
        name = getattr(call, "__name__", repr(call))
        with np.printoptions(threshold=20), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self._calls.append(self._described(name, arguments, keywords))
            self._log.write_text("\n".join(self._calls), errors="replace")
            try:
                result = call(*arguments, **keywords)
            except ALLOWED as error:
                if not str(error):
                    raise AssertionError(f"{type(error).__name__} without a message") from error
                self.allowed += 1
                return None
        self.succeeded += 1
        return result

    def _described(self, name, arguments, keywords) -> str:
        def told(x):
            return f"array{x.shape} {x.dtype}" if getattr(x, "size", 0) > 99 else repr(x)[:400]

        words = [told(x) for x in arguments] + [f"{k}={told(v)}" for k, v in keywords.items()]
        return f"{name}({', '.join(words)})"

    def _set(self, builder) -> None:
        random = self._nonsense.random
        name = random.choice(list(METHODS))
        good = METHODS[name]
        if name == "set_camera":
            good = good | {"type": random.choice(CAMERAS)}
        elif name == "set_light":
            good = good | {"type": random.choice(LIGHTS)}
        arguments = self._nonsense.disturbed(good)
        first = [arguments.pop(key) for key in POSITIONAL if key in arguments]
        self._try(getattr(builder, name), *first, **arguments)

    def _commit(self, builder):
        random = self._nonsense.random
        choice = random.random()
        if choice < 0.1:
            self._try(builder.commit, self._nonsense.value())
        if choice < 0.3:
            task = self._try(builder.start_commit)
            for _ in range(random.randint(0, 3)):
                self._try(task.wait, random.choice((0.0, -1.0, float("nan"), "x", 1e-9)))
            if choice < 0.05:
                task.cancel()
            return self._try(task.scene)
        return self._try(builder.commit)

    def _settings(self):
        wrong = self._nonsense.disturbed(SETTINGS)
        if self._nonsense.random.random() < 0.5:
            wrong["integrator"] = self._nonsense.random.choice(("bdpt", "pt", "lt"))
        settings = self._try(janus_core.RenderSettings, **wrong)
        if settings is not None:
            assert janus_core.RenderSettings(**settings.to_dict()) == settings, repr(settings)
            repr(settings)
        return settings

    def _drive(self, session, settings) -> None:
        """The methods of a session in any order."""
        random, nonsense = self._nonsense.random, self._nonsense
        steps = ["start", "wait", "progress", "cancel", "snapshot", "passes", "manifest", "stats"]
        for _ in range(random.randint(0, 8)):
            step = random.choice(steps)
            wrong = [nonsense.value()] if random.random() < 0.2 else []
            if step == "wait":
                wrong = [random.choice((0.0, -1.0, 0.01, float("nan"), float("-inf"), "x", None))]
            elif step in ("snapshot", "manifest"):
                wrong = [nonsense.value()]
            self._try(getattr(session, step), *wrong)
        small = settings.width * settings.height <= 64 * 64 and settings.samples <= 4
        if not small or settings.light_paths > 8 or settings.max_bounces > 64:
            session.cancel()
        if session.progress()["state"] == "waiting":
            self._try(session.start)
        self._finish(session)

    def _finish(self, session) -> None:
        self._try(session.finish)
        state = session.progress()["state"]
        assert state in ("done", "cancelled", "failed"), state
        if state == "done":
            for name in session.passes():
                assert np.isfinite(session.snapshot(name)).all(), f"pass {name}"
            self.rendered += 1

    def _transport(self, scene, settings) -> None:
        good = {"projector": "Lamp", "projector_width": 4, "projector_height": 4}
        wrong = self._nonsense.disturbed(good | {"memory": 1 << 24})
        session = self._try(janus_core.TransportSession, scene, settings, **wrong)
        if session is None:
            return
        for step in ("matrix", "snapshot", "stats", "progress", "finish"):
            self._try(getattr(session, step))
        session.start()
        if settings.samples > 4 or self._nonsense.random.random() < 0.3:
            session.cancel()
        self._try(session.finish)
        matrix = self._try(dual.of_session, session)
        if matrix is None:
            return
        for step in ("relight", "relight_variance", "dual", "dual_variance", "shown"):
            self._try(getattr(matrix, step), self._nonsense.value())
        for step in ("row", "column"):
            self._try(getattr(matrix, step), self._nonsense.value(), self._nonsense.value())


class FileFuzzer(Fuzzer):
    """Damaged captures, matrices and pictures."""

    def __init__(self, log: Path):
        super().__init__(log)
        builder = capture.CapturingBuilder()
        fill(builder)
        builder.set_light(
            "spot", **SPOT | {"name": "Spot", "graph": None, "transform": translation(0, 0, 2)}
        )
        settings = janus_core.RenderSettings(**SETTINGS)
        matrix = dual.capture(builder.commit(), settings, "Spot", resolution=(4, 4))
        folder = log.parent
        builder.save(folder / "scene.npz", settings)
        matrix.save(folder / "matrix.npz")
        exr.write_layers(
            folder / "picture.exr", {"Combined": np.ones((9, 7, 4)), "Z": np.ones((9, 7, 1))}
        )
        self._good = {
            name: ((folder / name).read_bytes(), load)
            for name, load in (
                ("scene.npz", capture.load),
                ("matrix.npz", dual.TransportMatrix.load),
                ("picture.exr", exr.read_layers),
            )
        }

    def run(self, seed: int) -> None:
        self._calls, self._nonsense = [f"seed {seed}"], Nonsense(seed)
        random = self._nonsense.random
        name = random.choice(list(self._good))
        content, load = self._good[name]
        damaged = bytearray(content)
        for _ in range(random.choice((0, 1, 2, 5, 30))):
            damaged[random.randrange(len(damaged))] = random.randrange(256)
        if random.random() < 0.3:
            damaged = damaged[: random.randrange(len(damaged))]
        path = self._log.parent / f"damaged_{name}"
        path.write_bytes(damaged)
        self._try(load, path)


def main() -> None:
    first, count, folder = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    fuzzers = [Fuzzer(folder / "calls.txt"), FileFuzzer(folder / "calls.txt")]
    for seed in range(first, first + count):
        for fuzzer in fuzzers:
            fuzzer.run(seed)
        if seed % 50 == 0:
            gc.collect()
    print(*(f"{f.succeeded} {f.allowed} {f.rendered}" for f in fuzzers), sep="\n")


if __name__ == "__main__":
    main()
