# SPDX-License-Identifier: GPL-3.0-or-later
"""`random_cancels.py COUNT`: renders, commits and captures that end at any moment, in every way.

Prints the longest wait for an end, in seconds. A process of its own, as one may not end at all.
"""

from __future__ import annotations

import gc
import random
import sys
import threading
import time
from pathlib import Path

import janus_core
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tests.bindings.conftest import IDENTITY, fill, shader, translation  # noqa: E402

LONGEST_DELAY = 0.04
SIZE = {"width": 48, "height": 32, "max_bounces": 4}
WAYS = (
    *({"integrator": "bdpt"}, {"integrator": "pt"}, {"integrator": "lt"}),
    {"integrator": "bdpt", "connection_mode": "CLASSIC"},
    {"integrator": "bdpt", "merge_radius": 0.05},
    {"integrator": "bdpt", "adaptive_counts": True},
    {"data_passes": ["Depth", "AO", "Normal"], "light_passes": ["DiffDir"]},
)


def furnished():
    """With a mesh that takes a while to build."""
    builder = janus_core.SceneBuilder()
    fill(builder)
    builder.set_material("glass", name="Glass", graph=shader("BSDF_GLASS", Roughness=0.1))
    rng = np.random.default_rng(1)
    corners = rng.uniform(-1.0, 1.0, (20_000, 1, 3)) + rng.normal(0.0, 0.01, (20_000, 3, 3))
    triangles = np.arange(60_000).reshape(-1, 3)
    positions = corners.reshape(-1, 3).astype(np.float32)
    builder.set_mesh("dust", name="Dust", positions=positions, triangles=triangles)
    builder.set_instance("dust", name="Dust", mesh="dust", transform=IDENTITY, materials=["glass"])
    spot = {"name": "Spot", "type": "SPOT", "transform": translation(0, 0, 3)}
    builder.set_light("spot", **spot, spot_size=1.0)
    return builder


class Canceller:
    def __init__(self, seed: int):
        self._random = random.Random(seed)
        self._builder = furnished()
        self._scene = self._builder.commit()
        self.longest = 0.0
        self.kinds: dict[str, int] = {}
        self._good = self._picture()

    def _picture(self) -> np.ndarray:
        session = self._session(samples=2)
        session.start()
        session.finish()
        return session.snapshot()

    def _session(self, samples: int = 1 << 30, **how):
        settings = janus_core.RenderSettings(**SIZE, samples=samples, **how)
        return janus_core.RenderSession(self._scene, settings)

    def once(self) -> None:
        kind = self._random.choice(
            (self._stop, self._stop, self._stop, self._before, self._drop, self._commit)
            + (self._capture, self._from_other_thread)
        )
        kind()
        self.kinds[kind.__name__] = self.kinds.get(kind.__name__, 0) + 1

    def unchanged(self) -> bool:
        return np.array_equal(self._picture(), self._good)

    def _delay(self) -> None:
        if self._random.random() < 0.8:
            time.sleep(self._random.random() ** 3 * LONGEST_DELAY)

    def _ends(self, work) -> None:
        """Waits for its end, and measures that."""
        begin = time.perf_counter()
        assert work.wait(60.0), "it does not end"
        self.longest = max(self.longest, time.perf_counter() - begin)

    def _stop(self) -> None:
        session = self._session(**self._random.choice(WAYS))
        session.start()
        self._delay()
        for _ in range(self._random.choice((1, 1, 2, 5))):
            session.cancel()
        if self._random.random() < 0.3:
            session.snapshot()
        self._ends(session)
        session.finish()  # no error
        assert session.progress()["state"] == "cancelled"
        for name in session.passes():
            assert np.isfinite(session.snapshot(name)).all(), name
        session.cancel()

    def _before(self) -> None:
        """Cancelled before it starts."""
        session = self._session()
        session.cancel()
        session.start()
        self._ends(session)
        session.finish()
        assert session.progress() | {"seconds": 0} == {
            "samples": 0,
            "target_samples": 1 << 30,
            "seconds": 0,
            "remaining": 0.0,
            "state": "cancelled",
        }
        assert not session.snapshot()[..., :3].any()

    def _drop(self) -> None:
        session = self._session(**self._random.choice(WAYS))
        if self._random.random() < 0.9:
            session.start()
        self._delay()
        begin = time.perf_counter()
        del session
        gc.collect()
        self.longest = max(self.longest, time.perf_counter() - begin)

    def _from_other_thread(self) -> None:
        """While this one waits, or looks at the picture."""
        session = self._session()
        session.start()
        thread = threading.Thread(target=lambda: (self._delay(), session.cancel()))
        thread.start()
        while not session.wait(0.001):
            session.snapshot()
            session.stats()
        thread.join()
        session.finish()

    def _commit(self) -> None:
        builder = furnished()
        task = builder.start_commit()
        self._delay()
        if self._random.random() < 0.5:
            task.cancel()
            self._ends(task)
            try:
                task.scene()
            except janus_core.Cancelled:
                pass
            else:
                raise AssertionError("a cancelled commit gives a scene")
        begin = time.perf_counter()
        del task  # while it runs, in half of the cases
        self.longest = max(self.longest, time.perf_counter() - begin)

    def _capture(self) -> None:
        settings = janus_core.RenderSettings(**SIZE, samples=1 << 20)
        session = janus_core.TransportSession(
            self._scene, settings, projector="Spot", projector_width=16, projector_height=16
        )
        early = self._random.random() < 0.2
        if early:
            session.cancel()
        session.start()
        self._delay()
        session.cancel()
        self._ends(session)
        session.finish()
        assert session.progress()["state"] == "cancelled"
        assert np.isfinite(session.snapshot()).all()
        try:
            assert np.isfinite(session.matrix()["entry_value"]).all()
        except janus_core.Error as error:
            assert "before its first sample" in str(error)


def main() -> None:
    count = int(sys.argv[1])
    canceller = Canceller(count)
    for i in range(count):
        canceller.once()
        if i % 10 == 9:
            assert canceller.unchanged(), f"another picture after {i + 1} cancels"
    assert min(canceller.kinds.values()) > 0
    assert len(canceller.kinds) == 6, canceller.kinds
    print(canceller.longest)


if __name__ == "__main__":
    main()
