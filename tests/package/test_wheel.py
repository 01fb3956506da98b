# SPDX-License-Identifier: GPL-3.0-or-later
"""What needs no Blender: the checks of ./dev package, on dist/, and that they can fail."""

import shutil
import sys
import zipfile
from pathlib import Path

import pytest
from blenders import ROOT

sys.path.insert(0, str(ROOT / ".ci"))

import package  # noqa: E402


@pytest.fixture(scope="module")
def wheel(extension: Path, tmp_path_factory) -> Path:
    """The wheel inside the extension."""
    folder = tmp_path_factory.mktemp("extension")
    with zipfile.ZipFile(extension) as archive:
        archive.extractall(folder)
    (found,) = folder.glob("wheels/*.whl")
    return found


def test_extension_content(extension: Path):
    package.check_extension(extension)


def test_wheel_is_self_contained(wheel: Path, tmp_path: Path):
    package.check_wheel(wheel, tmp_path)


def test_wheel_serves_every_blender_that_could_be_built_for(wheel: Path):
    headers = [p.name for p in (ROOT / "build/python-headers").glob("3.*")]
    names = zipfile.ZipFile(wheel).namelist()
    for version in ["3.11", *headers]:
        soabi = f"cpython-{version.replace('.', '')}-x86_64-linux-gnu"
        assert f"janus_core/_core.{soabi}.so" in names


def test_openexr_is_not_in_it(wheel: Path):
    assert not [n for n in zipfile.ZipFile(wheel).namelist() if "_exr" in n or "OpenEXR" in n]


def test_a_library_with_its_own_names_is_refused(wheel: Path, tmp_path: Path):
    """The check sees what the renaming prevents: Debian's Embree as it is."""
    line = next(x for x in package.run("ldconfig", "-p").splitlines() if "libembree" in x)
    library = Path(shutil.copy(line.split()[-1], tmp_path))
    wrong = package.check_binary(library, {library.name: set()})
    assert any("rtcNewDevice can clash" in text for text in wrong)
    assert any("needs libtbb.so.12" in text for text in wrong)
    assert any("newer than the wheel's tag allows" in text for text in wrong)
    assert any("insists on GLIBC_2.34" in text for text in wrong)
