#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes dist/: one wheel of janus_core for every Blender on Linux, and the extension that holds it.

The wheel has _core once per Python version, side by side, and one folder of private libraries
(Embree and TBB from Debian). A `blender` binary has another Embree and TBB in the same process, and
the dynamic linker binds by symbol name: our module would silently call Blender's Embree. So every
symbol of those libraries is renamed (prefix janus_), in the libraries and in our module.
And they ask for functions of the C library of the machine that builds; where those are newer than
the Blenders' own floor, a small library of ours stands in for them (older_systems.cpp).
OpenEXR has the same problem of names, and Blender writes its own files: _exr is not in this wheel.
`pip install .` builds a wheel with it, for use without Blender.
"""

import base64
import hashlib
import os
import re
import shutil
import struct
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import python_headers
from elftools.elf.elffile import ELFFile
from elftools.elf.gnuversions import Version

ROOT = Path(__file__).resolve().parent.parent
DIST = ROOT / "dist"
WORK = ROOT / "build/package"

LIBRARIES = "janus_core/_libs"
PREFIX = "janus_"
# The symbols of Embree and TBB, which Blender has too; also the weak ones that TBB looks for in
# tbbmalloc and tbbbind, so that it cannot find Blender's.
FOREIGN = re.compile(r"^(rtc[A-Z]|TBB_|__TBB_|__RML_|scalable_)|3tbb")
# What may come from the system: the part of the manylinux policy that we use, and its versions
# (glibc 2.28 is what Blender 4.2 and newer ask for; it came with GCC 8).
SYSTEM = re.compile(r"^(ld-linux-x86-64|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+))\.so\.\d+$")
NEWEST = {"GLIBC": (2, 28), "GLIBCXX": (3, 4, 25), "CXXABI": (1, 3, 11), "GCC": (8, 0, 0)}
TAG = "py3-none-manylinux_2_28_x86_64"
WEAK, VNA_FLAGS = 2, 4  # VER_FLG_WEAK; where it stands in an entry of .gnu.version_r
TIME = (1980, 1, 1, 0, 0, 0)  # the same input gives the same archive


def fail(text: str) -> None:
    sys.exit(f"package: {text}")


def run(*command: object, **options) -> str:
    # Tools of the virtual environment first: the distribution's patchelf is too old.
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    done = subprocess.run(
        [str(c) for c in command],
        env={**os.environ, "PATH": path},
        stdout=subprocess.PIPE,
        text=True,
        **options,
    )
    if done.returncode != 0:
        fail(f"this failed with exit code {done.returncode}: {' '.join(map(str, command))}")
    return done.stdout


def symbols(file: Path) -> list[tuple[str, str, str]]:
    """(type letter of nm, name, version or "") of each dynamic symbol."""
    found = []
    for line in run("nm", "-D", "--with-symbol-versions", file).splitlines():
        kind, name = line.split()[-2:]
        name, _, version = name.partition("@")
        found.append((kind, name, version.lstrip("@")))
    return found


def too_new(version: str) -> bool:
    """Of a symbol's version, such as GLIBC_2.34."""
    family, _, number = version.partition("_")
    numbers = tuple(int(n) for n in number.split(".") if n.isdigit())
    return family in NEWEST and numbers > NEWEST[family]


def needed(file: Path) -> list[str]:
    return run("patchelf", "--print-needed", file).split()


# --- The wheel ------------------------------------------------------------------------------------


def build_wheel() -> Path:
    """Builds the wheel for this Python, with further modules for the others; unpacked."""
    headers = python_headers.fetch_all(ROOT / "build/python-headers")
    defines = {
        "JANUS_OPENEXR": "OFF",
        "JANUS_EXTRA_PYTHONS": ";".join(map(str, headers.values())),
        # As in the development build, so that ccache finds its objects again.
        "JANUS_WERROR": "ON" if os.environ.get("JANUS_PRESET") == "ci" else "OFF",
    }
    shutil.rmtree(WORK, ignore_errors=True)
    settings = [f"--config-settings=cmake.define.{k}={v}" for k, v in defines.items()]
    # A build folder of its own: `pip install .` has other settings in build/wheel.
    settings.append("--config-settings=build-dir=build/wheel-blender")
    pip = (sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check")
    run("nice", *pip, "--no-deps", "--no-build-isolation", *settings, "-w", WORK, ROOT)
    (wheel,) = WORK.glob("*.whl")
    tree = WORK / "wheel"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tree)
    return tree


def bundle_libraries(tree: Path) -> None:
    """Adds the private libraries, renames their symbols, and points the modules there."""
    modules = sorted((tree / "janus_core").glob("_core.*.so"))
    folder = tree / LIBRARIES
    folder.mkdir()
    private = {}  # soname -> our copy
    for line in run("ldd", modules[0]).splitlines():
        match = re.match(r"\s*(\S+) => (/\S+)", line)
        if match and not SYSTEM.match(match[1]):
            private[match[1]] = folder / match[1].replace("lib", "libjanus_", 1)
            shutil.copy(match[2], private[match[1]])
            private[match[1]].chmod(0o755)

    older = build_older_systems(folder)
    files = [*modules, *private.values()]
    names = {name for file in files for _, name, _ in symbols(file) if FOREIGN.search(name)}
    replaced = {name for file in files for _, name, version in symbols(file) if too_new(version)}
    lacking = replaced - {name.removeprefix(PREFIX) for _, name, _ in symbols(older)}
    if lacking:
        fail(f"older_systems.cpp has nothing for {', '.join(sorted(lacking))}")
    renames = WORK / "renames.txt"
    renames.write_text("".join(f"{name} {PREFIX}{name}\n" for name in sorted(names | replaced)))
    for file in files:
        run("patchelf", "--rename-dynamic-symbols", renames, file)
        for name in sorted(replaced):
            run("patchelf", "--clear-symbol-version", PREFIX + name, file)
        run("patchelf", "--add-needed", older.name, file)
        for soname, copy in private.items():
            run("patchelf", "--replace-needed", soname, copy.name, file)
        run("patchelf", "--set-rpath", "$ORIGIN/_libs" if file in modules else "$ORIGIN", file)
        forget_versions(file)
    for copy in private.values():
        run("patchelf", "--set-soname", copy.name, copy)


def build_older_systems(folder: Path) -> Path:
    library = folder / "libjanus_older.so"
    flags = ("-std=c++20", "-O2", "-fPIC", "-shared", "-Wall", "-Wextra", "-Werror", "-s")
    soname = f"-Wl,-soname,{library.name}"
    run("c++", *flags, soname, ROOT / ".ci/older_systems.cpp", "-o", library)
    # Where threads and dlopen() were before glibc 2.34.
    run("patchelf", "--add-needed", "libpthread.so.0", "--add-needed", "libdl.so.2", library)
    return library


def required_versions(elf: ELFFile) -> Iterator[tuple[int, Version]]:
    """(place in the file, entry) of each version that the loader looks for."""
    section = elf.get_section_by_name(".gnu.version_r")
    at = section["sh_offset"]
    for library, versions in section.iter_versions():
        entry = at + library["vn_aux"]
        for version in versions:
            yield entry, version
            entry += version["vna_next"]
        at += library["vn_next"]


def forget_versions(file: Path) -> None:
    """Makes versions optional that no symbol asks for any more: the loader looks for all."""
    with file.open("r+b") as stream:
        elf = ELFFile(stream)
        used = {symbol["ndx"] for symbol in elf.get_section_by_name(".gnu.version").iter_symbols()}
        unused = [(at, v) for at, v in required_versions(elf) if v["vna_other"] not in used]
        for at, version in unused:
            stream.seek(at + VNA_FLAGS)
            stream.write(struct.pack("<H", version["vna_flags"] | WEAK))


def build_version(tree: Path, version: str) -> str:
    """The version with a digest of the package, such as 0.1.0+3f2a9c41.

    Blender takes wheels of one name and version for the same: who installs another build of it
    would get the new Python and keep the old core.
    """
    digest = hashlib.sha256()
    for file in sorted(p for p in (tree / "janus_core").rglob("*") if p.is_file()):
        digest.update(f"{file.relative_to(tree)} {file.stat().st_size}\n".encode())
        digest.update(file.read_bytes())
    return f"{version}+{digest.hexdigest()[:8]}"


def pack_wheel(tree: Path, version: str, folder: Path = DIST) -> Path:
    """Tags and zips the tree, whose .dist-info may be of another version."""
    version = build_version(tree, version)
    (old,) = tree.glob("*.dist-info")
    info = old.rename(tree / f"janus_core-{version}.dist-info")
    for name, key, value in (("WHEEL", "Tag", TAG), ("METADATA", "Version", version)):
        text, count = re.subn(rf"(?m)^{key}: .*$", f"{key}: {value}", (info / name).read_text())
        if count != 1:
            fail(f"{name} of the wheel has {count} lines '{key}:'")
        (info / name).write_text(text)
    for licence in (ROOT / "addon/licenses").iterdir():
        shutil.copy(licence, info / "licenses")

    record = info / "RECORD"
    record.unlink()
    rows = []
    for file in sorted(p for p in tree.rglob("*") if p.is_file()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=")
        rows.append(f"{file.relative_to(tree)},sha256={digest.decode()},{file.stat().st_size}\n")
    record.write_text("".join(rows) + f"{record.relative_to(tree)},,\n")

    wheel = folder / f"janus_core-{version}-{TAG}.whl"
    files = [file for file in tree.rglob("*") if file.is_file()]
    write_zip(wheel, {str(file.relative_to(tree)): file.read_bytes() for file in files})
    return wheel


def write_zip(path: Path, content: dict[str, bytes]) -> None:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in sorted(content):
            entry = zipfile.ZipInfo(name, TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if ".so" in Path(name).suffixes else 0o644) << 16
            archive.writestr(entry, content[name])


# --- The extension --------------------------------------------------------------------------------


def pack_extension(
    wheel: Path, version: str, addon: Path = ROOT / "addon", folder: Path = DIST
) -> Path:
    content = {
        str(file.relative_to(addon)): file.read_bytes()
        for file in addon.rglob("*")
        if file.is_file() and "__pycache__" not in file.parts and not file.name.startswith(".")
    }
    manifest = content["blender_manifest.toml"].decode()
    filled, count = re.subn(r"(?m)^wheels = \[\]$", f'wheels = ["./wheels/{wheel.name}"]', manifest)
    if count != 1:
        fail("addon/blender_manifest.toml has no line `wheels = []`")
    content["blender_manifest.toml"] = filled.encode()
    content["LICENSE"] = (ROOT / "LICENSE").read_bytes()
    content[f"wheels/{wheel.name}"] = wheel.read_bytes()
    extension = folder / f"janus-{version}.zip"
    write_zip(extension, content)
    return extension


# --- Checks ---------------------------------------------------------------------------------------


def check_binary(file: Path, private: dict[str, set[str]]) -> list[str]:
    """What is wrong with one module or library; `private`: our libraries and what they define."""
    with file.open("rb") as stream:
        versions = [v for _, v in required_versions(ELFFile(stream)) if too_new(v.name)]
    wrong = [f"insists on {v.name}" for v in versions if not v["vna_flags"] & WEAK]
    defined = set().union(*private.values())
    for library in needed(file):
        if library not in private and not SYSTEM.match(library):
            wrong.append(f"needs {library}, which is neither ours nor the system's")
    for kind, name, version in symbols(file):
        if FOREIGN.search(name) and not name.startswith(PREFIX):
            wrong.append(f"the symbol {name} can clash with Blender's")
        elif kind == "U" and name.startswith(PREFIX) and name not in defined:
            wrong.append(f"nothing defines {name}")
        elif kind == "U" and not version and not re.match(rf"_?Py|{PREFIX}", name):
            wrong.append(f"the symbol {name} could come from anywhere")
        elif too_new(version):
            wrong.append(f"needs {name}@{version}, newer than the wheel's tag allows")
        elif file.name.startswith("_core") and kind not in "Uw" and name != "PyInit__core":
            wrong.append(f"exports {name}")
    return wrong


def check_wheel(wheel: Path, scratch: Path) -> None:
    """Fails unless the wheel is what Blender can load beside its own libraries."""
    tree = scratch / "check"
    shutil.rmtree(tree, ignore_errors=True)
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tree)
    modules = sorted((tree / "janus_core").glob("*.so"))
    libraries = sorted((tree / LIBRARIES).iterdir())
    private = {lib.name: {n for k, n, _ in symbols(lib) if k not in "Uw"} for lib in libraries}
    wrong = [f"{f.name}: {text}" for f in modules + libraries for text in check_binary(f, private)]
    if any(not module.name.startswith("_core.cpython-3") for module in modules) or not modules:
        wrong.append(f"the modules are {[module.name for module in modules]}")
    # This Python's module loads, with our libraries and no other Embree or TBB.
    code = "import janus_core; janus_core.build_info(); print(open('/proc/self/maps').read())"
    maps = run(sys.executable, "-I", "-c", f"import sys; sys.path[0:0] = [{str(tree)!r}]; {code}")
    loaded = {Path(line.split()[-1]) for line in maps.splitlines() if ".so" in line}
    clashing = {p for p in loaded if re.search("embree|tbb|OpenEXR", p.name)}
    if clashing != {lib for lib in libraries if re.search("embree|tbb", lib.name)}:
        wrong.append(f"importing it loads {sorted(map(str, clashing)) or 'no Embree at all'}")
    if wrong:
        fail(f"{wheel.name} must not be shipped:\n  " + "\n  ".join(wrong))


def check_extension(extension: Path) -> None:
    with zipfile.ZipFile(extension) as archive:
        names = set(archive.namelist())
        manifest = archive.read("blender_manifest.toml").decode()
    required = {"__init__.py", "LICENSE", "licenses/embree-onetbb.txt", "licenses/glm.txt"}
    wrong = [f"{name} is missing" for name in required - names]
    wrong += [f"{name} is not ours" for name in names if name.endswith((".pyc", ".blend", ".so"))]
    wheels = re.findall(r'"\./(wheels/[^"]+)"', manifest)
    if len(wheels) != 1 or wheels != sorted(n for n in names if n.startswith("wheels/")):
        wrong.append(f"its manifest lists {wheels}, and there is not just that")
    if wrong:
        fail(f"{extension.name} must not be shipped:\n  " + "\n  ".join(wrong))


def main() -> None:
    manifest = (ROOT / "addon/blender_manifest.toml").read_text()
    version = re.search(r'(?m)^version = "(.+)"', manifest)[1]
    shutil.rmtree(DIST, ignore_errors=True)
    DIST.mkdir()
    print("==> building the wheel", flush=True)
    tree = build_wheel()
    print("==> bundling Embree and TBB under names of their own", flush=True)
    bundle_libraries(tree)
    wheel = pack_wheel(tree, version)
    check_wheel(wheel, WORK)
    extension = pack_extension(wheel, version)
    check_extension(extension)
    print("==> checked and ready to ship:")
    for file in (wheel, extension):
        print(f"{file.relative_to(ROOT)}  {file.stat().st_size / 1e6:.1f} MB")
    modules = sorted(p.name for p in (tree / "janus_core").glob("*.so"))
    print(f"modules: {', '.join(modules)}")


if __name__ == "__main__":
    main()
