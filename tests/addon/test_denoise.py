# SPDX-License-Identifier: GPL-3.0-or-later
"""The denoiser by itself: OpenImageDenoise as Blender ships it, by ctypes."""

import ctypes
import os
import sys
import threading
import time
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from conftest import part

HEIGHT, WIDTH = 96, 128


@pytest.fixture
def denoise(addon):
    """The module, with a fresh look for the library before and after."""
    module = part("render.denoise")
    module._find.cache_clear()
    yield module
    module._find.cache_clear()


class Spy:
    """The library, how many of its devices and filters are alive, and whether it is at work."""

    def __init__(self, library):
        self._library, self.alive, self.made, self.works = library, 0, 0, False

    def __getattr__(self, name):
        self.works = name == "oidnExecuteFilter"
        if name.startswith("oidnNew"):
            self.alive, self.made = self.alive + 1, self.made + 1
        self.alive -= name.startswith("oidnRelease")
        return getattr(self._library, name)


@pytest.fixture
def spy(denoise, monkeypatch):
    spy = Spy(denoise._find()[0])
    find = denoise._find
    monkeypatch.setattr(denoise, "_find", lambda: (spy, None))
    yield spy
    monkeypatch.setattr(denoise, "_find", find)


def ramps() -> np.ndarray:
    """What there is to see: a bright disk before a ramp."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH].astype(np.float32)
    clean = np.stack([x / WIDTH, y / HEIGHT, 0.5 + 0 * x], axis=-1)
    clean[np.hypot(x - 60, y - 50) < 20] = (4.0, 2.0, 1.0)
    return clean


def pattern() -> np.ndarray:
    """An albedo of fine checks."""
    y, x = np.mgrid[0:HEIGHT, 0:WIDTH]
    return (np.where((x // 3 + y // 3) % 2, 0.7, 0.4)[..., None] * np.ones(3)).astype(np.float32)


def upwards() -> np.ndarray:
    normal = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    normal[..., 2] = 1.0
    return normal


def grain(clean: np.ndarray, seed: int = 1) -> np.ndarray:
    """The same in the mean, as a renderer with few samples sees it."""
    noise = np.random.default_rng(seed).gamma(4.0, 0.25, (*clean.shape[:2], 1))
    return (clean * noise).astype(np.float32)


def error(pixels: np.ndarray, clean: np.ndarray) -> float:
    return float(np.sqrt(np.mean((pixels[..., :3] - clean) ** 2)))


def with_alpha(pixels: np.ndarray) -> np.ndarray:
    alpha = np.random.default_rng(5).random((*pixels.shape[:2], 1), dtype=np.float32)
    return np.concatenate([pixels, alpha], axis=-1)


def test_the_library_is_found(denoise):
    assert denoise.unavailable() is None
    assert [file for file in denoise.library_files() if file.is_file()]


@pytest.mark.skipif(sys.platform != "linux", reason="names of Linux")
def test_it_is_the_one_that_blender_has_loaded(denoise):
    """A second copy in the process would bring its own threads, and may clash."""
    blenders = ctypes.CDLL("libOpenImageDenoise.so.2", mode=os.RTLD_NOLOAD | os.RTLD_NOW)
    assert denoise._find()[0]._handle == blenders._handle


@pytest.mark.skipif(sys.platform != "linux", reason="names of Linux")
def test_a_library_of_the_system_will_do_if_blender_uses_it(denoise, monkeypatch):
    monkeypatch.setattr(denoise, "library_files", lambda: [])
    assert denoise.unavailable() is None


def test_a_missing_library_is_a_sentence(denoise, monkeypatch):
    monkeypatch.setattr(denoise, "_candidates", lambda: [])
    assert "comes without OpenImageDenoise" in denoise.unavailable()
    with pytest.raises(denoise.DenoiseFailed, match="comes without OpenImageDenoise"):
        denoise.denoise(grain(ramps()))


def test_a_library_that_is_none_is_a_sentence(denoise, monkeypatch, tmp_path):
    broken = tmp_path / "libOpenImageDenoise.so.2"
    broken.write_text("no library")
    candidates = [(str(broken), ctypes.DEFAULT_MODE)]
    monkeypatch.setattr(denoise, "_candidates", lambda: candidates)
    assert "does not load" in denoise.unavailable()
    candidates[0] = (None, ctypes.DEFAULT_MODE)  # the process itself, which has no such functions
    denoise._find.cache_clear()
    assert "older than version 2" in denoise.unavailable()


def test_noise_falls_and_the_light_stays(denoise):
    clean = ramps()
    noisy = grain(clean)
    before = noisy.copy()
    result = denoise.denoise(noisy)
    assert result.shape == noisy.shape and result.dtype == np.float32
    assert np.array_equal(noisy, before)
    assert error(result, clean) < 0.3 * error(noisy, clean)
    assert result.mean(axis=(0, 1)) == pytest.approx(noisy.mean(axis=(0, 1)), rel=0.02)


def test_brightness_has_no_limit(denoise):
    noisy = grain(ramps())
    result = denoise.denoise(noisy * 1000.0)
    assert result.max() > 2000.0
    assert result / 1000.0 == pytest.approx(denoise.denoise(noisy), rel=0.02, abs=0.01)


def test_alpha_is_left_as_it_is(denoise):
    noisy = with_alpha(grain(ramps()))
    result = denoise.denoise(noisy)
    assert np.array_equal(result[..., 3], noisy[..., 3])
    assert np.array_equal(result[..., :3], denoise.denoise(noisy[..., :3]))


def test_alpha_of_noise_is_denoised_like_a_picture(denoise):
    clean = ramps()
    clean /= clean.max()
    color, grey = grain(clean), grain(clean[..., :1].repeat(3, axis=2))
    noisy = np.concatenate([color, grey[..., :1]], axis=2)
    result = denoise.denoise(noisy, alpha=True)
    assert np.array_equal(result[..., :3], denoise.denoise(color))
    alone = denoise.denoise(noisy[..., 3:].repeat(3, axis=2))
    assert np.array_equal(result[..., 3], np.clip(alone[..., 0], 0.0, 1.0))
    assert error(result[..., 3:], clean[..., :1]) < 0.5 * error(noisy[..., 3:], clean[..., :1])
    with pytest.raises(ValueError, match="no alpha"):
        denoise.denoise(color, alpha=True)


def test_guides_keep_detail(denoise):
    """Noise is stronger than the pattern: only the albedo tells."""
    albedo, normal = pattern(), upwards()
    clean = ramps() * albedo
    noisy = grain(clean)
    alone = error(denoise.denoise(noisy), clean)
    guided = error(denoise.denoise(noisy, albedo, normal, "NONE"), clean)
    assert guided < 0.6 * alone
    assert error(denoise.denoise(noisy, albedo, prefilter="NONE"), clean) < 0.6 * alone
    assert error(denoise.denoise(with_alpha(noisy), albedo, normal), clean) < 0.8 * alone


def test_prefilters_are_for_noisy_guides(denoise, spy):
    clean = ramps() * pattern()
    noise = np.random.default_rng(3).normal(0.0, 0.3, clean.shape)
    noisy, albedo, normal = grain(clean), grain(pattern(), seed=2), upwards() + noise
    errors, made = {}, {}
    for prefilter in ("NONE", "FAST", "ACCURATE"):
        spy.made = 0
        result = denoise.denoise(noisy, albedo, normal, prefilter)
        errors[prefilter], made[prefilter] = error(result, clean), spy.made
    assert made == {"NONE": 2, "FAST": 2, "ACCURATE": 4}  # the device, and each filter
    assert errors["ACCURATE"] < errors["FAST"] < 0.8 * errors["NONE"]


def test_qualities_differ(denoise):
    """The two better ones with guides only."""
    clean = ramps() * pattern()
    arguments = (grain(clean), pattern(), upwards(), "NONE")
    errors = [
        error(denoise.denoise(*arguments, quality=name), clean)
        for name in ("HIGH", "BALANCED", "FAST")
    ]
    assert errors[0] < errors[1] < errors[2] < 0.5 * error(arguments[0], clean)


def test_the_number_of_threads_changes_nothing(denoise):
    noisy = grain(ramps())
    assert np.array_equal(denoise.denoise(noisy, threads=1), denoise.denoise(noisy, threads=2))


@pytest.mark.parametrize("channels", [3, 4])
@pytest.mark.parametrize("size", [(1, 1), (1, 7), (7, 1), (17, 31), (33, 64)])
def test_sizes(denoise, size, channels):
    flat = np.full((*size, channels), 0.5, dtype=np.float32)
    result = denoise.denoise(flat)
    assert result.shape == flat.shape
    assert result == pytest.approx(flat, rel=0.1)  # 1x1 and black around would be a fifth of it


def test_other_arrays_are_taken(denoise):
    """Views and double precision."""
    noisy = grain(ramps())
    expected = denoise.denoise(np.ascontiguousarray(noisy[::-1]))
    assert np.array_equal(denoise.denoise(noisy[::-1]), expected)
    assert np.array_equal(denoise.denoise(noisy[::-1].astype(np.float64)), expected)


@pytest.mark.parametrize("shape", [(4, 4), (4, 4, 2), (0, 4, 3)])
def test_what_is_no_picture(denoise, shape):
    with pytest.raises(ValueError, match="a picture is"):
        denoise.denoise(np.zeros(shape, np.float32))


def test_guides_of_another_size(denoise):
    with pytest.raises(ValueError, match="normal is"):
        denoise.denoise(np.zeros((4, 4, 3)), np.zeros((4, 4, 3)), np.zeros((4, 5, 3)))


def test_what_the_library_says_is_told_and_nothing_is_left(denoise, spy):
    with pytest.raises(denoise.DenoiseFailed, match="OpenImageDenoise says: .*[a-z]{3}"):
        denoise.denoise(grain(ramps()), normal=np.zeros((HEIGHT, WIDTH, 3)), prefilter="NONE")
    assert spy.alive == 0 and spy.made == 2
    denoise.denoise(grain(ramps()))
    assert spy.alive == 0 and spy.made == 4


def test_no_device_is_told(denoise, spy, monkeypatch):
    monkeypatch.setattr(denoise, "DEVICE_CPU", 99)
    with pytest.raises(denoise.DenoiseFailed, match="OpenImageDenoise says"):
        denoise.denoise(grain(ramps()))


def test_a_cancel_is_answered_at_once_and_nothing_is_left(denoise, spy, monkeypatch):
    noisy = np.tile(grain(ramps()), (8, 8, 1))
    caller, asked, ends = threading.get_ident(), [], []
    work = denoise._work

    def watched(*arguments):
        try:
            work(*arguments)
        except BaseException as error:
            ends.append(type(error))
            raise

    monkeypatch.setattr(denoise, "_work", watched)

    def cancel():
        asked.append(threading.get_ident())
        return len(asked) > 1

    started = time.perf_counter()
    with pytest.raises(denoise.DenoiseCancelled):
        denoise.denoise(noisy, cancel=cancel)
    answered = time.perf_counter() - started
    assert asked == [caller] * 2
    assert spy.alive  # the library has not ended: nobody has waited for it
    assert answered < 1.0  # 2 * POLL_SECONDS on an idle machine
    until = time.perf_counter() + 30.0
    while not ends and time.perf_counter() < until:
        time.sleep(0.01)
    assert ends == [denoise.DenoiseCancelled] and spy.alive == 0


@pytest.mark.skipif(bpy.app.version < (4, 4, 0), reason="OpenImageDenoise 2.3.0 may go on")
def test_the_library_stops_when_it_is_told(denoise, spy):
    """Told by its own question alone: after it, nobody says stop any more."""
    stop = SimpleNamespace(is_set=lambda: spy.works)
    with pytest.raises(denoise.DenoiseCancelled):
        denoise._work(spy, {"color": grain(ramps())}, "NONE", 6, 0, stop)
    assert spy.alive == 0


def test_what_was_to_stop_gives_nothing(denoise, spy):
    """Even where the library does not hear it."""
    spy.oidnSetFilterProgressMonitorFunction = lambda *_: None
    stop = threading.Event()
    stop.set()
    with pytest.raises(denoise.DenoiseCancelled):
        denoise._work(spy, {"color": grain(ramps())}, "NONE", 6, 0, stop)
    assert spy.alive == 0


def test_an_error_of_the_caller_ends_it_too(denoise):
    with pytest.raises(ZeroDivisionError):
        denoise.denoise(np.tile(grain(ramps()), (8, 8, 1)), cancel=lambda: 1 / 0)
