# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pictures of a viewport are denoised, and which are shown."""

import time

import numpy as np
import pytest
from conftest import part

GUIDES = ("Denoising Albedo",)
SETTINGS = {"start_sample": 2, "guides": GUIDES, "prefilter": "FAST", "quality": "FAST"}


class Session:
    """Its guides are grey."""

    def __init__(self):
        self.asked = []

    def snapshot(self, name):
        self.asked.append(name)
        return np.full((20, 30, 3), 0.5, np.float32)


class Clock:
    def __init__(self):
        self.time = 0.0

    def __call__(self):
        return self.time


@pytest.fixture
def noisy():
    rng = np.random.default_rng(3)
    return rng.random((20, 30, 4), dtype=np.float32)


@pytest.fixture
def make(monkeypatch):
    """A denoiser and its clock."""
    denoise = part("render.denoise")
    if denoise.unavailable():
        pytest.skip(denoise.unavailable())

    def make(**changes):
        clock = Clock()
        return part("render.viewport_denoise").PictureDenoiser(SETTINGS | changes, clock), clock

    return make


def wait(denoiser) -> np.ndarray:
    end = time.monotonic() + 20.0
    while denoiser.busy and time.monotonic() < end:
        pixels = denoiser.take()
        if pixels is not None:
            return pixels
        time.sleep(0.01)
    raise AssertionError("nothing has been denoised")


def test_the_noisy_picture_is_shown_until_there_is_a_clean_one(make, noisy):
    denoiser, clock = make()
    session = Session()
    denoiser.begin(True)
    assert denoiser.add(session, noisy, 1, False) and not denoiser.busy  # too few samples
    assert denoiser.add(session, noisy, 2, False) and denoiser.busy
    assert session.asked == list(GUIDES)
    clean = wait(denoiser)
    expected = part("render.denoise").denoise(
        noisy, np.full((20, 30, 3), 0.5, np.float32), prefilter="FAST", quality="FAST"
    )
    assert np.array_equal(clean, expected) and clean[..., :3].std() < 0.7 * noisy[..., :3].std()
    assert denoiser.take() is None
    assert not denoiser.add(session, noisy, 3, False)  # the clean one stays


def test_it_takes_its_share_of_the_time(make, noisy):
    denoiser, clock = make()
    denoiser.begin(True)
    denoiser.add(Session(), noisy, 2, False)
    clock.time = 1.0  # it takes a second
    wait(denoiser)
    denoiser.add(Session(), noisy, 3, False)
    assert not denoiser.busy
    clock.time = 3.9
    denoiser.add(Session(), noisy, 4, False)
    assert not denoiser.busy
    clock.time = 4.1
    denoiser.add(Session(), noisy, 5, False)
    assert denoiser.busy
    wait(denoiser)
    denoiser.add(Session(), 0.5 * noisy, 6, True)  # the last one is always denoised
    assert wait(denoiser).mean() < 0.7 * noisy.mean()


def test_a_change_shows_at_once(make, noisy):
    denoiser, clock = make()
    denoiser.begin(True)
    denoiser.add(Session(), noisy, 2, False)
    wait(denoiser)
    denoiser.begin(False)  # finer pixels of the same
    assert not denoiser.add(Session(), noisy, 2, False)
    denoiser.begin(True)
    assert not denoiser.busy and denoiser.take() is None
    assert denoiser.add(Session(), noisy, 1, False)


def test_without_the_library_all_is_shown(make, noisy, monkeypatch):
    monkeypatch.setattr(part("render.denoise"), "unavailable", lambda: "none")
    denoiser, _ = make()
    assert denoiser.add(Session(), noisy, 9, True) and not denoiser.busy
