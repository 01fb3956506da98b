# SPDX-License-Identifier: GPL-3.0-or-later
"""The C headers of Pythons that this machine does not have, for the one wheel for every Blender.

They come from Debian's own packages, read with a private apt configuration: nothing is installed,
no root is needed, and the machine's apt is only asked for the mirror that it uses.
"""

import shutil
import subprocess
from pathlib import Path

# Python of Blender 5.1 and newer, of Debian's Blender 5.2; and the Debian release that has it.
# (Blender 4.2 to 5.0 have 3.11: the interpreter of the virtual environment.)
RELEASES = {"3.13": "trixie", "3.14": "sid"}

APT_CONFIG = """\
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
APT::Sandbox::User "";
APT::Architecture "amd64";
APT::Architectures "amd64";
Acquire::Check-Valid-Until "false";  // sid's lists are short-lived, mirrors lag behind
Acquire::Languages "none";
Acquire::Retries "2";
Dir::Etc::sourcelist "{folder}/sources.list";
Dir::Etc::sourceparts "/dev/null";
Dir::State "{folder}/state";
Dir::State::status "{folder}/status";
Dir::Cache "{folder}/cache";
"""


class HeadersError(Exception):
    """The headers cannot be had here; the message says why."""


def run(*command: object, cwd: Path | None = None) -> str:
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
        raise HeadersError(f"{Path(command[0]).name} failed: {' '.join(last)}")
    return done.stdout


def mirror() -> str:
    """The Debian mirror in this machine's own apt sources."""
    if not shutil.which("apt-get"):
        raise HeadersError("there is no apt-get")
    form = ("--format", "$(SITE) $(ORIGIN)")
    targets = run("apt-get", "indextargets", *form, "Created-By: Packages")
    for line in targets.splitlines():
        site, _, origin = line.partition(" ")
        if origin == "Debian" and "security" not in site:
            return site
    raise HeadersError("apt's sources name no Debian mirror (apt-get update may help)")


def fetch(version: str, folder: Path) -> Path:
    """Downloads and unpacks the headers of one Python below `folder`; the folder of Python.h."""
    include = folder / version / "usr/include" / f"python{version}"
    if (include / "Python.h").exists():
        return include

    apt = folder / f"apt-{version}"
    shutil.rmtree(apt, ignore_errors=True)
    for name in ("state/lists/partial", "cache/archives/partial"):
        (apt / name).mkdir(parents=True)
    (apt / "status").touch()
    (apt / "apt.conf").write_text(APT_CONFIG.format(folder=apt))
    keyring = Path("/usr/share/keyrings/debian-archive-keyring.gpg")
    signed = f"[signed-by={keyring}] " if keyring.exists() else ""
    (apt / "sources.list").write_text(f"deb {signed}{mirror()} {RELEASES[version]} main\n")
    apt_get = ("apt-get", "-c", apt / "apt.conf", "-q")
    run(*apt_get, "update")
    run(*apt_get, "download", f"libpython{version}-dev", cwd=apt)

    (package,) = apt.glob("*.deb")
    unpacked = apt / "unpacked"
    run("dpkg-deb", "-x", package, unpacked)
    target = folder / version
    shutil.rmtree(target, ignore_errors=True)
    (target / "usr").mkdir(parents=True)
    (unpacked / "usr/include").rename(target / "usr/include")
    shutil.rmtree(apt)
    if not (include / "Python.h").exists():
        raise HeadersError(f"{package.name} has no Python.h")
    return include


def fetch_all(folder: Path) -> dict[str, Path]:
    """version -> folder of Python.h, for those of RELEASES that can be had; says what cannot."""
    found = {}
    for version in RELEASES:
        try:
            found[version] = fetch(version, folder)
        except HeadersError as error:
            print(f"no headers of Python {version}, so the wheel will not have it: {error}")
    return found
