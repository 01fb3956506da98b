# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blenders that the tests run: real binaries in chroots, and bpy modules in environments.

Both run scripts in a profile of their own, and install extensions as far as they can as users do.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODULE = "bl_ext.user_default.janus"
STEPS = ROOT / "tests/package/matrix_steps.py"
FACTORY = ("--factory-startup", "--python-exit-code", "1")
HANGS = 300  # seconds: what takes longer never ends, also on a machine that is busy


class Unavailable(Exception):
    """This Blender cannot be had here; says why."""


def _made(*command: str) -> Path:
    """The path that a script of .ci/ prints."""
    script = ROOT / ".ci" / command[0]
    made = subprocess.run([script, *command[1:]], capture_output=True, text=True)
    if made.returncode != 0:
        raise Unavailable((made.stderr.strip() or "unknown").splitlines()[-1])
    return Path(made.stdout.strip())


def _finish(command: list[str], shown: str, timeout: int, **options):
    """Runs it to its end; what it says goes to pytest's report, too."""
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            timeout=timeout,
            **options,
        )
    except subprocess.TimeoutExpired as error:
        said = (error.output or b"").decode(errors="replace")
        raise AssertionError(f"`{shown}` does not end in {timeout} s:\n{said}") from None
    print(f"$ {shown}\n{done.stdout}\nexit code {done.returncode}")
    return done


class Blender:
    """Runs a chroot's blender, with preferences and files of its own in one scratch folder."""

    is_binary = True

    def __init__(self, suite: str = "sid", options: tuple[str, ...] = FACTORY):
        self.chroot = _made("blender_chroot.sh", suite)
        self.options = options
        self.sudo = [] if os.getuid() == 0 else ["sudo", "-n"]
        self.folder = Path(tempfile.mkdtemp(prefix="janus-test-", dir=self.chroot / "tmp"))
        self.folder.chmod(0o755)

    def inside(self, name: str) -> str:
        """The path, as Blender sees it, of a file in the scratch folder."""
        return f"/{(self.folder / name).relative_to(self.chroot)}"

    def add(self, path: Path) -> str:
        """Copies a file or folder in; its path as Blender sees it."""
        return _copy(path, self)

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
            *self.options,
            *arguments,
        ]

    def start(self, *arguments: str, environment: tuple[str, ...] = (), stdout=None):
        """`blender ARGUMENTS`, with windows: the running process."""
        return subprocess.Popen(
            self.command(*arguments, environment=environment),
            stdin=subprocess.DEVNULL,
            stdout=stdout,
            stderr=subprocess.STDOUT,
        )

    def run(self, *arguments: str, environment: tuple[str, ...] = (), timeout: int = HANGS):
        """`blender -b ARGUMENTS`."""
        command = self.command("-b", *arguments, environment=environment)
        return _finish(command, f"blender -b {' '.join(arguments)}", timeout)

    def install(self, archive: str):
        """`Install from Disk`, on the command line."""
        return self.run(
            "--command", "extension", "install-file", "-r", "user_default", "-e", archive
        )

    def step(self, name: str, *arguments: str, trace: bool = False):
        """A step of matrix_steps.py. `trace`: the dynamic linker writes to bindings.* in the
        folder which library each symbol came from."""
        linker = (f"LD_DEBUG_OUTPUT={self.inside('bindings')}", "LD_DEBUG=bindings")
        script = ("--python-exit-code", "1", "-P", self.add(STEPS), "--", self.inside(""))
        return self.run(*script, name, *arguments, environment=linker if trace else ())

    def render(self, blend: str, picture: str):
        """`blender -b BLEND -o PICTURE -f 1`, as on a render farm."""
        return self.run(blend, "-o", picture, "-F", "PNG", "-f", "1")

    def remove(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)


class BpyModule:
    """A Python with bpy. It has no command line, and does not read the preferences that it saves:
    each script enables Janus for itself."""

    is_binary = False

    def __init__(self, version: str | None):
        """Of the project's own environment (version: None), or of one made for it."""
        self.python = _made("bpy_environment.sh", version) if version else Path(sys.executable)
        self.folder = Path(tempfile.mkdtemp(prefix="janus-test-"))

    def inside(self, name: str) -> str:
        return str(self.folder / name)

    def add(self, path: Path) -> str:
        return _copy(path, self)

    def install(self, archive: str):
        """The operator behind `Install from Disk`."""
        return self.step("install", archive)

    def step(self, name: str, *arguments: str, trace: bool = False):
        # -I: neither the development build nor anything else of this machine is found.
        words = [self.add(STEPS), "--", self.inside(""), name, *arguments]
        return _finish(
            [str(self.python), "-I", *words],
            f"python {' '.join(words)}",
            HANGS,
            env={
                "PATH": "/usr/bin:/bin",
                "LC_ALL": "C.UTF-8",
                "HOME": self.inside("home"),
                "BLENDER_USER_RESOURCES": self.inside("user"),
                "TMPDIR": self.inside(""),
            },
        )

    def render(self, blend: str, picture: str):
        return self.step("render", blend, picture)

    def remove(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)


def _copy(path: Path, place: Blender | BpyModule) -> str:
    if path.is_dir():
        shutil.copytree(path, place.folder / path.name, dirs_exist_ok=True)
    else:
        shutil.copy(path, place.folder)
    return place.inside(path.name)
