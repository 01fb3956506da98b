# SPDX-License-Identifier: GPL-3.0-or-later
"""Part of check_tree.py: what the documents name is in the tree.

* links to files lead to files;
* in a table with the columns "function" and "file", each function is in one of its row's files,
  with the class before its ::, and each of the files has one of them;
* what else looks like a name of the code in core/THEORY.md is a word of the core's sources.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

DOCUMENTS = (
    *("README.md", ".github/CONTRIBUTING.md", "addon/CYCLES.md", "scenes/README.md"),
    *("core/README.md", "core/THEORY.md", "core/LECTURE.md", "core/DUAL.md", "core/NODES.md"),
)
THEORY = "core/THEORY.md"
SOURCES = (".h", ".cpp", ".py", ".pyi")

Problem = Callable[[Path, int, str], None]


def check_documents(root: Path, problem: Problem) -> None:
    """Calls problem(path, line, text) for all that is wrong."""
    for name in DOCUMENTS:
        path = root / name
        lines = path.read_text(encoding="utf-8").splitlines()
        for number, line in enumerate(lines, 1):
            for target in links(line):
                if not (path.parent / target).exists():
                    problem(path, number, f"there is no file '{target}'")
        for number, functions, targets in rows(lines):
            check_row(path, number, functions, targets, problem)
    check_words(root, problem)


def links(line: str) -> list[str]:
    """Paths that a line links to, without those of the web and places in the same document."""
    if line.startswith("    "):  # code
        return []
    found = re.findall(r"\[[^]]*\]\(([^)#\s]+)[^)]*\)", line)
    return [target for target in found if "://" not in target]


def rows(lines: list[str]) -> Iterator[tuple[int, list[str], list[str]]]:
    """(line, code in the column "function", links in the column "file") of the tables with both."""
    columns: list[str] | None = None
    for number, line in enumerate(lines, 1):
        if not line.startswith("|"):
            columns = None
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if columns is None:
            columns = cells
        elif {"function", "file"} <= set(columns) and not set(line) <= set("|-: "):
            row = dict(zip(columns, cells, strict=True))
            yield number, code(row["function"]), links(row["file"])


def code(text: str) -> list[str]:
    return re.findall(r"`([^`]+)`", text)


def check_row(
    path: Path, number: int, functions: list[str], targets: list[str], problem: Problem
) -> None:
    files = [path.parent / target for target in targets]
    texts = {file: file.read_text(encoding="utf-8") for file in files if file.is_file()}
    used: set[Path] = set()
    for function in functions:
        homes = {file for file, text in texts.items() if names(function, file, text)}
        used |= homes
        if not homes:
            problem(path, number, f"none of the row's files has '{function}'")
    for file in texts.keys() - used:
        problem(path, number, f"{file.name} has none of the row's functions")


def names(function: str, file: Path, text: str) -> bool:
    """Whether the file is called that (`dual.py`, `janus_core.dual`), or has each of its words."""
    if file.name == function or file.stem == function.rpartition(".")[2]:
        return True
    return all(re.search(rf"\b{re.escape(word)}\b", text) for word in function.split("::"))


def check_words(root: Path, problem: Problem) -> None:
    folders = (root / "core" / "janus", root / "core" / "python")
    sources = [p for folder in folders for p in folder.rglob("*") if p.suffix in SOURCES]
    known = {p.name for p in sources} | {p.stem for p in sources}
    for source in sources:
        known |= set(re.findall(r"\w+", source.read_text(encoding="utf-8")))
    path = root / THEORY
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        for text in code(line):
            # Names: several words, joined by ::, _ or a change to capitals.
            if not re.fullmatch(r"\w+(::\w+)*", text) or not re.search(r"::|_|[a-z][A-Z]", text):
                continue
            for word in text.split("::"):
                if word not in known:
                    problem(path, number, f"nothing in core/ is called '{word}'")
