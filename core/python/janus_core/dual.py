# SPDX-License-Identifier: GPL-3.0-or-later
"""Dual photography (Sen et al. 2005): light transport between a projector and the camera.

    from janus_core import capture, dual

    builder, settings = capture.load("scene.npz")
    matrix = dual.capture(builder.commit(), settings, "Projector", resolution=(128, 128))
    picture = matrix.relight(matrix.shown(slide))  # any slide, nothing is traced
    seen = matrix.dual()  # what the projector sees, lit by the camera
    matrix.save("matrix.npz")

A spot or area light is the projector, with the camera's measures: each of its pixels emits evenly
from its part of the film. T[i, j] is the radiance that camera pixel i gets while projector pixel j
emits one watt (1 / (m^2 sr)), by channel. Then the transpose is the matrix of the same scene with
camera and projector in each other's place; core/README.md derives it.

All pictures are [height, width, 3], scene-linear Rec.709, bottom row first.
"""

from __future__ import annotations

from collections.abc import Callable

from ._core import Cancelled, Error, RenderSettings, Scene, TransportSession
from ._transport import TransportMatrix

__all__ = ["MAX_CAMERA", "MAX_PROJECTOR", "TransportMatrix", "capture", "of_session"]

MAX_CAMERA = 512  # pixels on a side
MAX_PROJECTOR = 256
MEMORY = 256 << 20


def capture(
    scene: Scene,
    settings: RenderSettings,
    projector: str,
    *,
    resolution: tuple[int, int] = (64, 64),
    memory: int = MEMORY,
    poll: Callable[[TransportSession], object] | None = None,
) -> TransportMatrix:
    """Traces the matrix between the light called `projector` and the scene's camera.

    `settings` has the camera's width and height (up to MAX_CAMERA), the samples, bounces and the
    like. Pixels are boxes, nothing is clamped, and the light of everything but the projector is
    left out. `resolution`: width and height of the projector's picture, up to MAX_PROJECTOR.
    `memory`: bytes for the sums while it runs; more of it makes finer blocks. poll(session) is
    called every tenth of a second; if it returns something true, the capture ends with the samples
    so far.

    Raises SceneError, which names the light or the setting, for what cannot be captured, and
    Cancelled if the end came before the first sample.
    """
    width, height = resolution
    session = TransportSession(
        scene,
        settings,
        projector=projector,
        projector_width=width,
        projector_height=height,
        memory=memory,
    )
    session.start()
    while not session.wait(0.1):
        if poll is not None and poll(session):
            session.cancel()
    session.finish()
    return of_session(session)


def of_session(session: TransportSession) -> TransportMatrix:
    """The matrix of a session that has ended. Raises Cancelled if that was before a sample."""
    try:
        arrays = session.matrix()
    except Error as error:
        raise Cancelled(str(error)) from None
    projector, camera = session.projector, session.camera
    height, width = session.snapshot().shape[:2]
    arrays["own_watts"] = projector.pop("own_watts")
    arrays["plain_watts"] = projector.pop("plain_watts")
    return TransportMatrix(arrays, (width, height), projector, camera)
