# SPDX-License-Identifier: GPL-3.0-or-later
"""What is too large for the machine is refused with a message; the process goes on."""

import resource

import janus_core
import pytest

from tests.bindings.conftest import SETTINGS, fill, render

from .conftest import FULL, apart

STEPS = 300 if FULL else 7
LARGE = {"width": 1 << 16, "height": 1 << 16, "strategy_images": 8, "light_passes": ["DiffDir"]}


@pytest.fixture
def limited():
    """Of this process: more than it has, less than the machine."""
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_AS, before)


def test_pictures_larger_than_memory(builder, limited):
    scene = builder.commit()
    with pytest.raises(janus_core.SceneError, match="less resolution") as caught:
        janus_core.RenderSession(scene, janus_core.RenderSettings(**SETTINGS | LARGE))
    assert "the machine has" in str(caught.value)
    render(scene)


def test_the_limit_of_the_process_counts(builder, limited):
    """40 bytes a pixel fit into most machines, not into 8 GB."""
    scene = builder.commit()
    wide = SETTINGS | {"width": 1 << 16, "height": 1 << 13}
    with pytest.raises(janus_core.SceneError, match="has [78] GB|has 9 GB"):
        janus_core.RenderSession(scene, janus_core.RenderSettings(**wide))


def test_more_threads_than_there_is_room_for(builder):
    """They change nothing in the picture: fewer do."""
    scene = builder.commit()
    expected = render(scene, threads=1).snapshot()
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (mapped() + (400 << 20), before[1]))
    try:
        assert (render(scene, threads=1000).snapshot() == expected).all()
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def test_no_room_for_any_thread(builder):
    scene = builder.commit()
    session = janus_core.RenderSession(scene, janus_core.RenderSettings(**SETTINGS))
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (mapped() + (4 << 20), before[1]))
    try:
        with pytest.raises(MemoryError, match="not enough memory"):
            session.start()
        with pytest.raises(MemoryError, match="not enough memory"):
            builder.start_commit()
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)
    assert session.progress()["state"] == "waiting"
    session.start()  # now there is
    session.finish()
    assert session.progress()["state"] == "done"


def mapped() -> int:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[0]) * resource.getpagesize()


def test_any_amount_of_memory(tmp_path):
    """From too little for anything to enough for all: pictures, or words."""
    printed = apart("little_memory.py", STEPS, tmp_path, timeout=120 + 20 * STEPS)
    print(printed)
    pictures, *messages = printed.splitlines()
    assert 0 < int(pictures) < STEPS
    assert any("not enough memory" in line for line in messages)


def test_f12(tmp_path):
    assert apart("large_render.py", timeout=300).splitlines()[-1] == "a small one: FINISHED"


@pytest.fixture
def builder():
    builder = janus_core.SceneBuilder()
    fill(builder)
    return builder
