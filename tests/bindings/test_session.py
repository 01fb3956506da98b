# SPDX-License-Identifier: GPL-3.0-or-later
"""RenderSettings and RenderSession."""

import gc
import threading
import time

import janus_core
import numpy as np
import pytest

from .conftest import endless, render


def test_settings_round_trip():
    settings = janus_core.RenderSettings(
        width=7, height=9, crop=(1, 2, 3, 4), seed=2**32 - 1, filter="GAUSSIAN", integrator="lt"
    )
    again = janus_core.RenderSettings(**settings.to_dict())
    assert again == settings
    assert again != janus_core.RenderSettings()
    assert again.crop == (1, 2, 3, 4)
    assert again.integrator == "lt"
    assert "GAUSSIAN" in repr(again)


def test_settings_cannot_be_changed():
    with pytest.raises(AttributeError):
        janus_core.RenderSettings().samples = 3


@pytest.mark.parametrize(
    ("name", "value"),
    [("width", 0), ("samples", -1), ("crop", (4, 4, 4, 8)), ("seconds", float("nan"))],
)
def test_wrong_settings_are_named(name, value):
    with pytest.raises(janus_core.SceneError) as caught:
        janus_core.RenderSettings(**{name: value})
    assert (caught.value.key, caught.value.path) == ("settings", name)


def test_exposure_and_glass_of_the_film(builder):
    scene = builder.commit()
    plain = render(scene, samples=2).snapshot()
    exposed = render(scene, samples=2, film_exposure=2.0, film_transparent_roughness=0.5)
    assert np.allclose(exposed.snapshot()[..., :3], 2 * plain[..., :3])
    assert np.array_equal(exposed.snapshot()[..., 3], plain[..., 3])
    for name, value in (("film_exposure", -1.0), ("film_transparent_roughness", 1.5)):
        with pytest.raises(janus_core.SceneError) as caught:
            janus_core.RenderSettings(**{name: value})
        assert caught.value.path == name


def test_wrong_words_and_types():
    with pytest.raises(ValueError, match="bdpt, pt, lt"):
        janus_core.RenderSettings(integrator="magic")
    with pytest.raises(ValueError, match="COLOR, VALUE"):
        janus_core.RenderSettings(aovs=[("Mask", "VECTOR")])
    with pytest.raises(TypeError):
        janus_core.RenderSettings(sampels=3)
    with pytest.raises(TypeError):
        janus_core.RenderSession(None, janus_core.RenderSettings())


@pytest.mark.parametrize("integrator", ["bdpt", "pt", "lt"])
def test_picture(builder, integrator):
    session = render(builder.commit(), integrator=integrator, samples=32)
    pixels = session.snapshot()
    assert pixels.shape == (16, 32, 4)
    assert pixels.dtype == np.float32
    assert np.all(pixels[..., 3] == 1.0)
    # The lamp is on the right, halfway up.
    assert pixels[:, 16:, :3].sum() > 2 * pixels[:, :16, :3].sum()
    assert np.allclose(pixels[:8, :, :3].sum(), pixels[8:, :, :3].sum(), rtol=0.05)
    red, green, blue = pixels[..., :3].reshape(-1, 3).mean(0)
    assert red / blue == pytest.approx(4.0, rel=1e-4)
    assert session.stats()["samples"] == 32
    assert session.progress()["state"] == "done"
    assert session.progress()["remaining"] == 0.0


def test_rows_start_at_the_bottom(builder):
    matrix = np.eye(4)
    matrix[:3, 3] = 0.0, 0.8, 0.5
    builder.set_light("lamp", name="Lamp", type="POINT", transform=matrix)
    pixels = render(builder.commit(), samples=8).snapshot()
    assert pixels[8:, :, :3].sum() > 2 * pixels[:8, :, :3].sum()  # +y is up


def test_threads_give_the_same_bits(builder):
    scene = builder.commit()
    one = render(scene, threads=1).snapshot()
    for threads in (2, 3, 7):
        assert np.array_equal(render(scene, threads=threads).snapshot(), one)


def test_crop(builder):
    scene = builder.commit()
    full = render(scene, integrator="pt").snapshot()
    part = render(scene, integrator="pt", crop=(3, 2, 20, 10)).snapshot()
    assert np.array_equal(part, full[2:10, 3:20])


def test_snapshot_names(builder):
    session = render(builder.commit())
    with pytest.raises(ValueError, match="Depth"):
        session.snapshot("Depth")
    a, b = session.snapshot(), session.snapshot("Combined")
    a[:] = 0.0
    assert b.max() > 0.0


def test_cancel_is_quick_and_keeps_passes(builder):
    session = endless(builder.commit())
    assert session.progress()["state"] == "waiting"
    session.finish()  # not started: nothing to wait for
    session.start()
    while session.progress()["samples"] == 0:
        assert not session.wait(0.01)
    session.cancel()
    begin = time.monotonic()
    assert session.wait(10.0)
    assert time.monotonic() - begin < 1.0  # 0.2 s on a quiet machine
    session.finish()
    assert session.progress()["state"] == "cancelled"
    assert session.snapshot()[..., :3].max() > 0.0
    with pytest.raises(janus_core.Error):
        session.start()


def test_python_runs_while_waiting(builder):
    session = endless(builder.commit())
    session.start()
    ticks = []
    thread = threading.Thread(target=lambda: [ticks.append(time.sleep(0.005)) for _ in range(20)])
    thread.start()
    session.wait(0.5)
    assert len(ticks) == 20
    thread.join()


@pytest.mark.parametrize("seconds", [float("nan"), float("-inf"), -1.0, 0.0])
def test_waiting_for_no_time(builder, seconds):
    session = endless(builder.commit())
    session.start()
    before = time.monotonic()
    assert session.wait(seconds) is False
    assert time.monotonic() - before < 5.0  # and not for ever
    session.cancel()
    assert session.wait(float("inf")) is True


def test_session_keeps_its_scene(builder):
    scene = builder.commit()
    session = endless(scene)
    del scene, builder
    gc.collect()
    session.start()
    assert not session.wait(0.05)
    del session  # while it runs
    gc.collect()


def test_weights_can_be_checked(builder):
    stats = render(builder.commit(), check_weights=True).stats()
    assert 0.0 < stats["weight_error"] < 1e-4
    assert stats["dropped"] == 0
    assert stats["paths"] == {"camera": 4 * 512, "light": 4 * 512}
    assert set(stats["rays"]) == {"camera", "specular", "light", "nee", "connection", "splat"}
