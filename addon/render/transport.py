# SPDX-License-Identifier: GPL-3.0-or-later
"""Dual photography: a render that captures a light transport matrix, and pictures made of it."""

from dataclasses import dataclass

import bpy
import numpy as np

from .. import bridge
from ..report import RenderRefused
from .progress import run_to_end

MEGABYTE = 1 << 20

# What the next renders of these scenes capture instead, and what came of it: a TransportMatrix by
# the scene's name. Whoever asked clears both.
requests: dict[str, "Request"] = {}
matrices: dict[str, object] = {}


@dataclass(frozen=True)
class Request:
    """What is asked for, checked by the operator that asks."""

    light: str  # name of the object
    width: int  # of the projector's picture, pixels
    height: int
    camera_size: int  # pixels on the longer side of the camera's picture
    samples: int
    memory: int = 256  # megabytes

    def settings(self, keywords: dict) -> dict:
        """The arguments of RenderSettings for the render that captures."""
        width, height = camera_pixels(keywords["width"], keywords["height"], self.camera_size)
        changes = {"width": width, "height": height, "crop": None, "samples": self.samples}
        return keywords | changes | {"integrator": "bdpt", "noise_threshold": 0.0}


def camera_pixels(width: int, height: int, longest: int) -> tuple[int, int]:
    """A frame of that shape with so many pixels on its longer side, or as many as it has."""
    scale = min(longest / max(width, height), 1.0)
    return max(round(width * scale), 1), max(round(height * scale), 1)


def ask(scene, request: Request) -> None:
    """The next render of the scene captures."""
    matrices.pop(scene.name_full, None)
    requests[scene.name_full] = request


def withdraw(scene) -> object | None:
    """The next renders are as usual. What has been captured, if anything."""
    requests.pop(scene.name_full, None)
    return matrices.pop(scene.name_full, None)


def capture(request: Request, core, engine, scene, settings, frame, result) -> dict:
    """Runs the capture in a render, whose result shows the scene in the light of the lamp.

    Statistics of the session. Raises SceneError of the core for what cannot be captured.
    """
    session = core.TransportSession(
        scene,
        settings,
        projector=request.light,
        projector_width=request.width,
        projector_height=request.height,
        memory=request.memory * MEGABYTE,
    )
    cancelled = run_to_end(engine, session, settings.seconds, "Light transport | ")
    stats = session.stats() | {"cancelled": cancelled, "seed": settings.seed}
    if stats["samples"] == 0:
        raise RenderRefused("The capture was stopped before its first sample")
    matrix = bridge.dual().of_session(session)
    matrices[frame.scene] = matrix
    result.push({"Combined": _in_frame(matrix.relight(), frame)})
    result.stamp(version=core.__version__, samples=stats["samples"], seed=settings.seed)
    return stats


def _in_frame(pixels: np.ndarray, frame) -> np.ndarray:
    """The picture as large as Blender wants it, pixels repeated, opaque."""
    rows = np.arange(frame.height) * pixels.shape[0] // frame.height
    columns = np.arange(frame.width) * pixels.shape[1] // frame.width
    x0, y0, x1, y1 = frame.crop or (0, 0, frame.width, frame.height)
    large = pixels[rows[y0:y1]][:, columns[x0:x1]]
    return np.dstack([large, np.ones(large.shape[:2], dtype=np.float32)])


def show(name: str, pixels: np.ndarray):
    """An image of Blender with these float32[H, W, 3], scene linear, bottom row first."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.get(name)
    if image is not None and tuple(image.size) != (width, height):
        bpy.data.images.remove(image)
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=False, float_buffer=True)
    opaque = np.ones((height, width, 4), dtype=np.float32)
    opaque[..., :3] = pixels
    image.pixels.foreach_set(opaque.reshape(-1))
    image.update()
    image.pack()
    return image
