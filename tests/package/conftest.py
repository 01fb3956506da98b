# SPDX-License-Identifier: GPL-3.0-or-later
"""A real Blender in a chroot, with dist/janus-*.zip installed; see .ci/blender_chroot.sh."""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
MODULE = "bl_ext.user_default.janus"


class Blender:
    """Runs the chroot's blender, with preferences and files of its own in one scratch folder."""

    def __init__(self, chroot: Path):
        self.chroot = chroot
        self.sudo = [] if os.getuid() == 0 else ["sudo", "-n"]
        self.folder = Path(tempfile.mkdtemp(prefix="janus-test-", dir=chroot / "tmp"))
        self.folder.chmod(0o755)

    def inside(self, name: str) -> str:
        """The path, as Blender sees it, of a file in the scratch folder."""
        return f"/{(self.folder / name).relative_to(self.chroot)}"

    def add(self, path: Path) -> str:
        """Copies a file or folder in; its path as Blender sees it."""
        if path.is_dir():
            shutil.copytree(path, self.folder / path.name, dirs_exist_ok=True)
        else:
            shutil.copy(path, self.folder)
        return self.inside(path.name)

    def command(self, *arguments: str, environment: tuple[str, ...] = ()) -> list[str]:
        return [
            *self.sudo,
            "chroot",
            f"--userspec={os.getuid()}:{os.getgid()}",
            str(self.chroot),
            "/usr/bin/env",
            "-i",
            "PATH=/usr/bin:/bin",
            "LC_ALL=C.UTF-8",
            f"HOME={self.inside('home')}",
            f"BLENDER_USER_RESOURCES={self.inside('user')}",
            f"TMPDIR={self.inside('')}",
            *environment,
            "blender",
            "-noaudio",
            "--factory-startup",
            "--python-exit-code",
            "1",
            *arguments,
        ]

    def start(self, *arguments: str, environment: tuple[str, ...] = (), stdout=None):
        """`blender --factory-startup ARGUMENTS`, with windows: the running process."""
        return subprocess.Popen(
            self.command(*arguments, environment=environment),
            stdin=subprocess.DEVNULL,
            stdout=stdout,
            stderr=subprocess.STDOUT,
        )

    def run(self, *arguments: str, environment: tuple[str, ...] = (), timeout: int = 300):
        """`blender -b --factory-startup ARGUMENTS`; the output goes to pytest's report."""
        done = subprocess.run(
            self.command("-b", *arguments, environment=environment),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=timeout,
        )
        print(f"$ blender -b {' '.join(arguments)}\n{done.stdout}\nexit code {done.returncode}")
        return done


@pytest.fixture(scope="session")
def extension() -> Path:
    found = sorted((ROOT / "dist").glob("janus-*.zip"))
    assert found, "there is no dist/janus-*.zip: run ./dev package"
    return found[-1]


@pytest.fixture(scope="session")
def blender() -> Blender:
    made = subprocess.run([ROOT / ".ci/blender_chroot.sh"], capture_output=True, text=True)
    if made.returncode != 0:
        reason = f"no real Blender here: {(made.stderr.strip() or 'unknown').splitlines()[-1]}"
        if os.environ.get("JANUS_REQUIRE_BLENDER") == "1":
            pytest.fail(reason)
        pytest.skip(reason)
    blender = Blender(Path(made.stdout.strip()))
    yield blender
    shutil.rmtree(blender.folder, ignore_errors=True)


@pytest.fixture(scope="session")
def installed(blender: Blender, extension: Path) -> Blender:
    """Blender after `Install from Disk` of the extension."""
    archive = blender.add(extension)
    done = blender.run(
        "--command", "extension", "install-file", "-r", "user_default", "-e", archive
    )
    assert done.returncode == 0, done.stdout
    assert (blender.folder / "user/extensions/user_default/janus/blender_manifest.toml").exists()
    return blender
