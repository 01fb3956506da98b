# SPDX-License-Identifier: GPL-3.0-or-later
"""dist/janus-*.zip, and a real Blender in which it is installed."""

import os
from pathlib import Path

import pytest
from blenders import ROOT, Blender, Unavailable


def cannot(reason: object) -> None:
    """Skips; with JANUS_REQUIRE_BLENDER=1 that is a failure."""
    if os.environ.get("JANUS_REQUIRE_BLENDER") == "1":
        pytest.fail(str(reason))
    pytest.skip(str(reason))


@pytest.fixture(scope="session")
def extension() -> Path:
    found = sorted((ROOT / "dist").glob("janus-*.zip"))
    assert found, "there is no dist/janus-*.zip: run ./dev package"
    return found[-1]


@pytest.fixture(scope="session")
def blender() -> Blender:
    try:
        blender = Blender()
    except Unavailable as error:
        cannot(f"no real Blender here: {error}")
    yield blender
    blender.remove()


@pytest.fixture(scope="session")
def installed(blender: Blender, extension: Path) -> Blender:
    """Blender after `Install from Disk` of the extension."""
    done = blender.install(blender.add(extension))
    assert done.returncode == 0, done.stdout
    assert (blender.folder / "user/extensions/user_default/janus/blender_manifest.toml").exists()
    return blender
