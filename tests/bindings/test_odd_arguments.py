# SPDX-License-Identifier: GPL-3.0-or-later
"""What fuzzing (tests/hardening) has found to crash, or to be refused without a reason."""

import janus_core
import numpy as np
import pytest

from .conftest import IDENTITY, PLANE, render, translation


def test_names_with_zeros_are_in_messages(builder):
    with pytest.raises(janus_core.SceneError, match="there is no such instance") as caught:
        builder.set_instance_motion("\0", transforms=np.stack([IDENTITY] * 2))
    assert caught.value.key == "\0"


@pytest.mark.parametrize("attribute", [{"key": 3}, {"key": "a", "domain": 1, "values": [0.0]}])
def test_words_of_attributes(builder, attribute):
    with pytest.raises(janus_core.SceneError, match="must be strings"):
        builder.set_mesh("mesh", name="Floor", **PLANE, attributes=[attribute])


def test_arrays_that_no_machine_can_hold(builder):
    """They are views of one number, until they are copied."""
    huge = 1 << 44
    for name, shape in (("positions", (huge, 3)), ("triangles", (huge, 3))):
        wrong = PLANE | {name: np.broadcast_to(np.zeros((), PLANE[name].dtype), shape)}
        with pytest.raises(MemoryError):
            builder.set_mesh("mesh", name="Floor", **wrong)
    render(builder.commit())


@pytest.mark.parametrize("integrator", ["bdpt", "pt", "lt"])
def test_cameras_that_are_nowhere(builder, integrator):
    """For rays from so far some builds of Embree end the process."""
    window = (-1, 1, -1, 1)
    builder.set_camera(name="Camera", transform=translation(0, 0, 2e18), window=window)
    assert np.isfinite(render(builder.commit(), integrator=integrator).snapshot()).all()
    sheared = np.eye(4)
    sheared[0, 1] = -1e20
    builder.set_camera_motion(transforms=np.stack([sheared, IDENTITY]), windows=[window] * 2)
    with pytest.raises(janus_core.SceneError, match="degenerate"):
        builder.commit()


@pytest.mark.parametrize("scale", [1e-16, 1e-20, 1e-30])
def test_instances_too_thin(builder, scale):
    """What is near is far away in their space: for some builds of Embree the end of the process."""
    builder.set_mesh("wall", name="Wall", **PLANE | {"positions": PLANE["positions"][:, ::-1]})
    matrix = np.diag([scale, 1.0, 1.0, 1.0])
    matrix[0, 3] = 0.1
    builder.set_instance("wall", name="Wall", mesh="wall", transform=matrix)
    scene = builder.commit()
    assert np.isfinite(render(scene).snapshot()).all()
    assert [d.object for d in scene.diagnostics if "is flat" in d.message] == ["Wall"]
