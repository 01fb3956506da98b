# SPDX-License-Identifier: GPL-3.0-or-later
"""The core of Janus, a bidirectional path tracer.

A scene goes in as arrays, node graphs and numbers, a picture comes out as an array:

    builder = janus_core.SceneBuilder()
    builder.set_mesh("mesh", name="Floor", positions=..., triangles=...)
    builder.set_instance("floor", name="Floor", mesh="mesh", transform=numpy.eye(4), materials=[])
    builder.set_light("lamp", name="Lamp", type="POINT", transform=..., energy=100.0)
    builder.set_camera(name="Camera", transform=..., window=(-0.5, 0.5, -0.5, 0.5))
    session = janus_core.RenderSession(
        builder.commit(), janus_core.RenderSettings(width=640, height=640, samples=64)
    )
    session.start()
    session.finish()
    pixels = session.snapshot("Combined")  # float32[640, 640, 4], bottom row first

Words and units are Blender's: metres, watts, radians, scene-linear Rec.709, 4x4 matrices that
multiply column vectors. `janus_core.capture` saves and loads scenes, `janus_core.exr` pictures;
`janus_core.dual` captures light transport matrices;
`python -m janus_core` renders a saved scene.
"""

from ._core import (
    Cancelled,
    CommitTask,
    Diagnostic,
    Error,
    IoError,
    RenderSession,
    RenderSettings,
    Scene,
    SceneBuilder,
    SceneError,
    TransportSession,
    __version__,
    build_info,
    check_expression,
    check_strategies,
    cryptomatte_hash,
    node_types,
)

__all__ = [
    "Cancelled",
    "CommitTask",
    "Diagnostic",
    "Error",
    "IoError",
    "RenderSession",
    "RenderSettings",
    "Scene",
    "SceneBuilder",
    "SceneError",
    "TransportSession",
    "__version__",
    "build_info",
    "check_expression",
    "check_strategies",
    "cryptomatte_hash",
    "node_types",
]
