# SPDX-License-Identifier: GPL-3.0-or-later
"""Other packages of Janus, made from the one in dist/ without another build: an older version, and
another build of the same version. Everything that says which it is says so: manifest, wheel,
metadata, RECORD, the compiled modules and the add-on's Python.
"""

import re
import shutil
import sys
import zipfile
from pathlib import Path

from blenders import ROOT

sys.path.insert(0, str(ROOT / ".ci"))

import package  # noqa: E402

CORE_SAYS = "The native core of Janus."  # the start of its docstring
LABEL = "Janus"


def _replace(text, old, new, count: int = 1):
    """Of str or bytes; what is not there as often as it should be makes no package."""
    assert text.count(old) == count, f"{old!r} is there {text.count(old)} times"
    return text.replace(old, new)


def repacked(extension: Path, folder: Path, *, version: str, says: str, label: str) -> Path:
    """A zip in `folder` of another version (of as many letters: it is written into the compiled
    modules), whose core's docstring starts with `says`, and whose engine is named `label`."""
    ours = re.fullmatch(r"janus-(.+)\.zip", extension.name)[1]
    addon, wheel = folder / "addon", folder / "wheel"
    for tree in (addon, wheel):
        shutil.rmtree(tree, ignore_errors=True)
    with zipfile.ZipFile(extension) as archive:
        archive.extractall(addon)
    (found,) = addon.glob("wheels/*.whl")
    with zipfile.ZipFile(found) as archive:
        archive.extractall(wheel)

    assert len(version) == len(ours) and len(says) == len(CORE_SAYS)
    for module in wheel.glob("janus_core/_core.*.so"):
        code = _replace(module.read_bytes(), CORE_SAYS.encode(), says.encode())
        module.write_bytes(_replace(code, f"\0{ours}\0".encode(), f"\0{version}\0".encode()))
    series = [tuple(map(int, v.split(".")[:2])) for v in (ours, version)]
    for name, old, new in (
        ("engine.py", f'bl_label = "{LABEL}"', f'bl_label = "{label}"'),
        ("bridge.py", f"CORE_SERIES = {series[0]}", f"CORE_SERIES = {series[1]}"),
        ("blender_manifest.toml", f'version = "{ours}"', f'version = "{version}"'),
        ("blender_manifest.toml", f'wheels = ["./wheels/{found.name}"]', "wheels = []"),
    ):
        path = addon / name
        path.write_text(_replace(path.read_text(), old, new))
    shutil.rmtree(addon / "wheels")
    new_wheel = package.pack_wheel(wheel, version, folder)
    package.check_wheel(new_wheel, folder)
    return package.pack_extension(new_wheel, version, addon, folder)
