# SPDX-License-Identifier: GPL-3.0-or-later
"""Part of _core.pyi: captures of light transport matrices."""

from typing import Any, final

import numpy as np
import numpy.typing as npt

from ._core import Scene
from ._settings import RenderSettings
from ._typed_dicts import Progress, Stats

@final
class TransportSession:
    """Captures the light transport matrix between a projector, the spot or area light of that
    name, and the camera. janus_core.dual has what works with it.

    On threads of its own, as RenderSession; dropping it cancels it. Raises SceneError, which names
    the light or the setting, for what cannot be captured.
    """

    def __init__(
        self,
        scene: Scene,
        settings: RenderSettings,
        *,
        projector: str,
        projector_width: int = 64,
        projector_height: int = 64,
        memory: int = 256 << 20,
    ) -> None: ...
    def start(self) -> None:
        """Starts the capture and returns. Once only."""
    def wait(self, seconds: float) -> bool:
        """Waits up to `seconds` for the end, without the GIL; True if the capture has ended."""
    def progress(self) -> Progress:
        """As RenderSession.progress(), with the first passes, which choose the blocks."""
    def stats(self) -> Stats:
        """As RenderSession.stats(), of the passes of which the matrix is made."""
    def cancel(self) -> None:
        """Asks the capture to stop and returns. Whole passes are kept."""
    def finish(self) -> None:
        """Waits for the end and raises what went wrong, if anything."""
    def snapshot(self) -> npt.NDArray[np.float32]:
        """The camera's picture while each pixel of the projector shines with one watt:
        float32[height, width, 4], bottom row first."""
    def matrix(self) -> dict[str, Any]:
        """After the end: the arrays of a TransportMatrix (see janus_core.dual). A new copy each
        time. Raises Error if the capture ended before its first sample."""
    @property
    def projector(self) -> dict[str, Any]:
        """name, type, transform (4x4), window (left, right, bottom, top), and the watts that the
        lamp emits into each pixel: own_watts, with its node tree, and plain_watts without."""
    @property
    def camera(self) -> dict[str, Any]:
        """name, transform, window."""
