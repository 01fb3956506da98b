# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes the noise out of a picture, with the OpenImageDenoise that Blender ships.

The library is called by ctypes, which gives Python's lock away while it works. It asks whether to
go on only after each of its steps, and a step can take a second. So it works in a thread of its
own, which ends by itself after a cancel: whoever called has answered the user long before.
"""

import contextlib
import ctypes
import functools
import os
import sys
import threading
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path

import bpy
import numpy as np

POLL_SECONDS = 0.05
BLOCK = 16  # pixels: the library works on multiples of it
MEMORY_MB = 1024  # what the library may use; it works in tiles then, with the same result

# Names and numbers of oidn.h, 2.x.
QUALITIES = {"FAST": 4, "BALANCED": 5, "HIGH": 6}
DEVICE_CPU, FORMAT_FLOAT3, ERROR_CANCELLED = 1, 3, 6

_handle, _name, _size = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t
_Progress = ctypes.CFUNCTYPE(ctypes.c_bool, _handle, ctypes.c_double)  # false: stop
_SIGNATURES = {  # result, arguments
    "oidnNewDevice": (_handle, [ctypes.c_int]),
    "oidnCommitDevice": (None, [_handle]),
    "oidnReleaseDevice": (None, [_handle]),
    "oidnSetDeviceBool": (None, [_handle, _name, ctypes.c_bool]),
    "oidnSetDeviceInt": (None, [_handle, _name, ctypes.c_int]),
    "oidnGetDeviceError": (ctypes.c_int, [_handle, ctypes.POINTER(ctypes.c_char_p)]),
    "oidnNewFilter": (_handle, [_handle, _name]),
    "oidnCommitFilter": (None, [_handle]),
    "oidnExecuteFilter": (None, [_handle]),
    "oidnReleaseFilter": (None, [_handle]),
    "oidnSetFilterBool": (None, [_handle, _name, ctypes.c_bool]),
    "oidnSetFilterInt": (None, [_handle, _name, ctypes.c_int]),
    "oidnSetFilterProgressMonitorFunction": (None, [_handle, _Progress, _handle]),
    "oidnSetSharedFilterImage": (
        None,  # filter, name, pixels, format, width, height, bytes: offset, of a pixel, of a row
        [_handle, _name, _handle, ctypes.c_int, _size, _size, _size, _size, _size],
    ),
}


class DenoiseFailed(Exception):
    """There is no picture without noise; the message is written for the user."""


class DenoiseCancelled(Exception):
    """The user did not want to wait for it."""


def unavailable() -> str | None:
    """Why pictures cannot be denoised, in words for the user; None if they can.

    Cheap enough for drawing: the library is looked for once.
    """
    return _find()[1]


def alpha_is_noisy(film_transparent: bool, counts: dict[str, int]) -> bool:
    """Alpha on shadow catchers is what is left of light; `counts`: the scene's, of the core."""
    return film_transparent and counts.get("shadow_catchers", 0) > 0


def denoise(
    color: np.ndarray,
    albedo: np.ndarray | None = None,
    normal: np.ndarray | None = None,
    prefilter: str = "ACCURATE",
    quality: str = "HIGH",
    threads: int = 0,
    alpha: bool = False,
    cancel=None,
) -> np.ndarray:
    """The picture without noise: a new array with the shape of `color`.

    A fourth channel stays as it is, unless `alpha` says that it is noisy, too.

    `color` is float32[H, W, 3 or 4], linear, finite, of any brightness. `albedo` from 0 to 1 and
    `normal` from -1 to 1 are float32[H, W, 3] and tell detail from noise; a normal needs an
    albedo. They are noisy themselves unless `prefilter`, in Cycles' words, is NONE. `threads` 0
    means all. `cancel` is called by this thread every POLL_SECONDS, true ends it.
    Raises DenoiseFailed, DenoiseCancelled, and ValueError for arrays that do not fit together.
    """
    task = DenoiseTask(color, albedo, normal, prefilter, quality, threads, alpha)
    try:
        while not task.wait(POLL_SECONDS):
            if cancel and cancel():
                raise DenoiseCancelled
        return task.result()
    finally:
        task.cancel()


class DenoiseTask:
    """The same in the background: for who cannot wait. Arguments and errors are denoise()'s."""

    def __init__(
        self,
        color,
        albedo=None,
        normal=None,
        prefilter="ACCURATE",
        quality="HIGH",
        threads=0,
        alpha=False,
    ):
        library, reason = _find()
        if library is None:
            raise DenoiseFailed(reason)
        images = {
            name: np.ascontiguousarray(pixels, dtype=np.float32)
            for name, pixels in (("color", color), ("albedo", albedo), ("normal", normal))
            if pixels is not None
        }
        _check_shapes(images, alpha)
        self._size = images["color"].shape[:2]
        images = {name: _grown(pixels) for name, pixels in images.items()}
        self._stop = threading.Event()
        executor = ThreadPoolExecutor(1, "denoise")
        if alpha:
            images["alpha"] = np.repeat(images["color"][..., 3:], 3, axis=2)
        arguments = (library, images, prefilter, QUALITIES[quality], threads, self._stop)
        self._future = executor.submit(_work, *arguments)
        executor.shutdown(wait=False)

    def wait(self, seconds: float) -> bool:
        """Waits so long for the end; true if it has come."""
        return bool(wait([self._future], seconds).done)

    def result(self) -> np.ndarray:
        height, width = self._size
        return self._future.result()[:height, :width]

    def cancel(self) -> None:
        """The result will not be asked for."""
        self._stop.set()


def _check_shapes(images: dict[str, np.ndarray], alpha: bool) -> None:
    color = images["color"]
    if color.ndim != 3 or color.shape[2] not in (3, 4) or color.size == 0:
        raise ValueError(f"a picture is [H, W, 3 or 4], not {list(color.shape)}")
    if alpha and color.shape[2] != 4:
        raise ValueError(f"a picture of {list(color.shape)} has no alpha")
    for name, pixels in images.items():
        if name != "color" and pixels.shape != (*color.shape[:2], 3):
            raise ValueError(f"{name} is {list(pixels.shape)}, the picture {list(color.shape)}")


def _grown(pixels: np.ndarray) -> np.ndarray:
    """The pixels, continued by their mirror image to full blocks.

    The library would continue them by black, which shows at the border, and ruins small pictures.
    """
    missing = [(0, -size % BLOCK) for size in pixels.shape[:2]]
    return np.pad(pixels, (*missing, (0, 0)), mode="symmetric")


def _work(library, images, prefilter, quality, threads, stop) -> np.ndarray:
    pictures = {name: images[name] for name in ("color", "alpha") if name in images}
    with _device(library, threads) as device:
        guides = {name: pixels for name, pixels in images.items() if name not in pictures}
        if prefilter == "ACCURATE":
            for name, pixels in guides.items():
                guides[name] = np.empty_like(pixels)
                found = {name: pixels, "output": guides[name]}
                _execute(library, device, found, {}, quality, stop)
        flags = {"hdr": True, "cleanAux": bool(guides) and prefilter != "FAST"}
        results = {}
        for name, pixels in pictures.items():
            results[name] = pixels.copy()  # with a fourth channel, which the filter does not touch
            found = {"color": pixels, **guides, "output": results[name]}
            _execute(library, device, found, flags, quality, stop)
    if "alpha" in results:
        results["color"][..., 3] = np.clip(results["alpha"][..., 0], 0.0, 1.0)
    return results["color"]


@contextlib.contextmanager
def _device(library, threads: int):
    device = library.oidnNewDevice(DEVICE_CPU)
    if not device:
        _check(library, None)
    try:
        # Threads that are bound to cores would get in the way of everybody else's.
        library.oidnSetDeviceBool(device, b"setAffinity", False)
        library.oidnSetDeviceInt(device, b"numThreads", threads)
        library.oidnCommitDevice(device)
        _check(library, device)
        yield device
    finally:
        library.oidnReleaseDevice(device)


def _execute(library, device, images, flags, quality, stop) -> None:
    """Runs one filter. Of pixels with four channels it reads and writes the first three.

    Whatever comes of it is none if it was to stop: version 2.3.0 only hears that now and then.
    """
    goes_on = _Progress(lambda _user, _done: not stop.is_set())
    ray_tracing = library.oidnNewFilter(device, b"RT")
    try:
        for name, pixels in images.items():
            height, width, channels = pixels.shape
            library.oidnSetSharedFilterImage(
                ray_tracing,
                name.encode(),
                pixels.ctypes.data,
                FORMAT_FLOAT3,
                width,
                height,
                0,
                channels * pixels.itemsize,
                width * channels * pixels.itemsize,
            )
        for name, value in flags.items():
            library.oidnSetFilterBool(ray_tracing, name.encode(), value)
        library.oidnSetFilterInt(ray_tracing, b"quality", quality)
        library.oidnSetFilterInt(ray_tracing, b"maxMemoryMB", MEMORY_MB)
        library.oidnSetFilterProgressMonitorFunction(ray_tracing, goes_on, None)
        library.oidnCommitFilter(ray_tracing)
        _check(library, device)
        library.oidnExecuteFilter(ray_tracing)
        _check(library, device)
        if stop.is_set():
            raise DenoiseCancelled
    finally:
        library.oidnReleaseFilter(ray_tracing)


def _check(library, device) -> None:
    """Raises the error that the library keeps for the device, or for this thread."""
    text = ctypes.c_char_p()
    error = library.oidnGetDeviceError(device, ctypes.byref(text))
    if error == ERROR_CANCELLED:
        raise DenoiseCancelled
    if error or not device:
        reason = (text.value or b"unknown error").decode(errors="replace")
        raise DenoiseFailed(f"OpenImageDenoise says: {reason}")


@functools.cache
def _find() -> tuple[ctypes.CDLL | None, str | None]:
    """The library, or why there is none."""
    blender = f"Blender {bpy.app.version_string}"
    reason = f"{blender} comes without OpenImageDenoise"
    for name, mode in _candidates():
        try:
            library = ctypes.CDLL(name, mode=mode)
            for function, (result, arguments) in _SIGNATURES.items():
                found = getattr(library, function)
                found.restype, found.argtypes = result, arguments
        except OSError as error:
            if os.path.exists(name):
                reason = f"The OpenImageDenoise of {blender} does not load: {error}"
        except AttributeError:
            reason = f"The OpenImageDenoise of {blender} is older than version 2"
        else:
            return library, None
    return None, reason


def _candidates() -> list[tuple[str, int]]:
    """(name, how to load it): what Blender has loaded, also from the system, or its own file.

    In this order: some Blenders (4.2.0) come with copies of the file under several names.
    """
    found = [(str(path), ctypes.DEFAULT_MODE) for path in library_files()]
    if hasattr(os, "RTLD_NOLOAD") and sys.platform != "darwin":
        found.insert(0, ("libOpenImageDenoise.so.2", os.RTLD_NOLOAD | os.RTLD_NOW))
    return found


def library_files() -> list[Path]:
    """The library in Blender's folders. Those of Windows and macOS are untested."""
    if sys.platform == "win32":
        folders, pattern = ("blender.shared", "."), "OpenImageDenoise.dll"
    elif sys.platform == "darwin":
        folders, pattern = ("lib",), "libOpenImageDenoise.*dylib"
    else:
        folders, pattern = ("lib",), "libOpenImageDenoise.so*"
    # Beside the scripts: the folder of the program, of the Python module, or of the app's resources
    program = Path(bpy.utils.resource_path("LOCAL")).parent
    return [file for folder in folders for file in sorted((program / folder).glob(pattern))]
