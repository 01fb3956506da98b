# SPDX-License-Identifier: GPL-3.0-or-later
"""The only door to the native core.

`janus_core` is imported here and nowhere else, on first use and after bpy, so that the add-on
registers and can explain itself where the core is missing or does not fit.
"""

import importlib
import platform
import sys
from pathlib import Path

import bpy

CORE_SERIES = (0, 1)  # major and minor version of janus_core that this add-on speaks to

OLDEST_SYSTEM = "glibc 2.28 or newer, and libstdc++ of GCC 8 or newer"  # see .ci/package.py

_failure: str | None = None
_checked = None  # the core that is known to be the one that was installed with this Python


class CoreUnavailable(Exception):
    """janus_core cannot be used; the message tells the user why and what to do."""


def core():
    """The module janus_core. Raises CoreUnavailable; tries again at each call."""
    global _failure, _checked
    try:
        module = importlib.import_module("janus_core")
        if module is not _checked:
            _check_wheel(module)
            _check_version(module)
            _checked = module
    except CoreUnavailable as error:
        _failure = str(error)
        raise
    except Exception as error:  # a broken native module can raise anything while it initialises
        _failure = _explain(error)
        raise CoreUnavailable(_failure) from error
    _failure = None
    return module


def capturing_builder(builder):
    """A builder that passes every call on to `builder` and can save them all to a file."""
    core()
    return importlib.import_module("janus_core.capture").CapturingBuilder(builder)


def dual():
    """The module janus_core.dual."""
    core()
    return importlib.import_module("janus_core.dual")


def failure() -> str | None:
    """Why the core could not be used when it was last asked for; cheap enough for drawing."""
    return _failure


def _check_wheel(module) -> None:
    """Where Janus is installed anew, Blender loads its Python again, but a native module that is
    loaded stays until Blender ends. The loaded one remembers which wheel it came from."""
    folder = Path(module.__file__).parents[1]
    wheels = sorted(path.name for path in folder.glob("janus_core-*.dist-info"))
    loaded = module.__dict__.setdefault("_wheels", wheels)
    if loaded != wheels:
        raise CoreUnavailable(
            "Janus was installed anew while its render core was in use. Restart Blender to render "
            "with the new one."
        )


def _check_version(module) -> None:
    version = str(getattr(module, "__version__", "unknown"))
    wanted = ".".join(map(str, CORE_SERIES))
    if version.split(".")[:2] != wanted.split("."):
        raise CoreUnavailable(
            f"Janus needs its render core in version {wanted}, but found {version}. "
            "Restart Blender; if that does not help, reinstall the Janus extension."
        )


def _explain(error: Exception) -> str:
    python = ".".join(map(str, sys.version_info[:2]))
    if isinstance(error, ModuleNotFoundError) and (error.name or "").startswith("janus_core"):
        reason = f"there is no render core for Python {python} on {sys.platform}"
    elif "GLIBC" in str(error):  # what the loader says of a C or C++ library that is too old
        system = " ".join(platform.libc_ver())
        reason = f"its render core needs {OLDEST_SYSTEM}, and this system has {system} ({error})"
    else:
        reason = f"its render core does not load ({type(error).__name__}: {error})"
    return (
        f"Janus cannot render in Blender {bpy.app.version_string}: {reason}. "
        "Install the extension zip made for this platform and restart Blender."
    )
