#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the rules of the source tree that no linter knows; names each file:line that breaks one.

* includes (C++) and imports (add-on) point one way only, in the order of the lists below;
* Embree is included by one .cpp, OpenEXR by what belongs to janus_exr, janus_core by bridge.py;
* every source file starts with its licence and stays short;
* what the mistakes of `./dev mutate` change is in the source;
* what the documents name is in the tree (check_docs.py).
"""

import ast
import re
import sys
from pathlib import Path

from check_docs import check_documents

ROOT = Path(__file__).resolve().parent.parent

# Lowest first. Modules of the same level do not know each other, a module may know itself.
CORE_LAYERS = [
    {"util"},
    {"math"},
    {"sampling"},
    {"image"},
    {"scene"},
    {"shading"},
    {"geometry"},
    {"light", "camera"},
    {"film"},
    {"render"},
    {"path"},
    {"integrator"},
    {"session"},
]
ADDON_LAYERS = [
    {"report", "bridge", "presets"},
    {"nodes"},
    {"sync"},
    {"properties"},
    {"render"},
    {"engine"},
    {"ui", "operators"},
    {"__init__"},
]
# Headers that only these files may include (suffixes of paths).
PRIVATE_HEADERS = {
    r"embree\d/": ("janus/geometry/",),
    r"Open(EXR)|Imf|Iex": ("janus/image/exr.cpp",),
    r"pybind11/": ("core/python/",),
}
MAX_LINES = 420
LICENCE = "SPDX-License-Identifier: GPL-3.0-or-later"

problems: list[str] = []


def problem(path: Path, line: int, text: str) -> None:
    problems.append(f"{path.relative_to(ROOT)}:{line}: {text}")


def levels(layers: list[set[str]]) -> dict[str, int]:
    return {name: level for level, names in enumerate(layers) for name in names}


def allowed(level: dict[str, int], user: str, used: str) -> bool:
    return user == used or level[used] < level[user]


def check_core(path: Path, level: dict[str, int]) -> None:
    """The #include lines of one C++ file."""
    in_core = path.is_relative_to(ROOT / "core/janus")
    module = path.relative_to(ROOT / "core/janus").parts[0] if in_core else None
    if in_core and module not in level:
        problem(path, 1, f"module '{module}' has no place in the include order")
        return
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
        if not match:
            continue
        header = match[1]
        used = re.match(r"janus/(\w+)/", header)
        if in_core and used and not allowed(level, module, used[1]):
            problem(path, number, f"{module}/ must not include {used[1]}/ (order of CORE_LAYERS)")
        for pattern, owners in PRIVATE_HEADERS.items():
            if re.match(pattern, header) and not any(owner in str(path) for owner in owners):
                problem(path, number, f"{header} is only for {', '.join(owners)}")


def imported_modules(path: Path, tree: ast.AST) -> list[tuple[int, str]]:
    """(line, top-level module of the add-on) for each relative import of one of its files."""
    package = path.relative_to(ROOT / "addon").parts[:-1]
    found = []
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = package[: len(package) - node.level + 1]
        full = [*base, *(node.module or "").split(".")] if node.module else list(base)
        if full:
            found.append((node.lineno, full[0]))
        else:  # from . import a, b in the add-on's own folder
            found += [(node.lineno, alias.name) for alias in node.names]
    return found


def check_addon(path: Path, level: dict[str, int]) -> None:
    """The imports of one file of the add-on."""
    parts = path.relative_to(ROOT / "addon").parts
    module = parts[0].removesuffix(".py")
    if module not in level:
        problem(path, 1, f"module '{module}' has no place in the import order")
        return
    tree = ast.parse(path.read_text(), str(path))
    for line, used in imported_modules(path, tree):
        if used in level and not allowed(level, module, used):
            problem(path, line, f"{module} must not import {used} (order of ADDON_LAYERS)")
    for node in ast.walk(tree):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names = [node.module]
        if module != "bridge" and any(name.split(".")[0] == "janus_core" for name in names):
            problem(path, node.lineno, "janus_core is imported by bridge.py only")


def check_file(path: Path) -> None:
    """Licence and length."""
    lines = path.read_text().splitlines()
    if not any(LICENCE in line for line in lines[:3]):
        problem(path, 1, f"the licence line is missing: {LICENCE}")
    if len(lines) > MAX_LINES:
        problem(path, len(lines), f"{len(lines)} lines; split it (limit {MAX_LINES})")


def files(folders: str, *patterns: str) -> list[Path]:
    return sorted(
        path
        for folder in folders.split()
        for pattern in patterns
        for path in (ROOT / folder).rglob(pattern)
    )


def check_mistakes() -> None:
    sys.path.insert(0, str(ROOT / "tests" / "mutation"))
    from mutate import MISTAKES, stale

    for mistake in MISTAKES:
        if why := stale(mistake):
            problems.append(f"tests/mutation: {mistake.name} is stale: {why}")


def main() -> int:
    cpp = files("core tests", "*.h", "*.cpp")
    addon = files("addon", "*.py")
    python = files(".ci core scenes tests", "*.py", "*.pyi") + addon
    build = files(".ci", "*.sh", "run") + files("core tests", "CMakeLists.txt")
    top = [ROOT / "dev", ROOT / "CMakeLists.txt", ROOT / "addon/blender_manifest.toml"]
    for path in cpp:
        check_core(path, levels(CORE_LAYERS))
    for path in addon:
        check_addon(path, levels(ADDON_LAYERS))
    for path in cpp + python + build + top:
        check_file(path)
    check_mistakes()
    check_documents(ROOT, problem)
    print("\n".join(problems) or f"tree: {len(cpp)} C++ and {len(python)} Python files in order")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
