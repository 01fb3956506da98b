# SPDX-License-Identifier: GPL-3.0-or-later
"""Does the suite notice the classic mistakes of light transport? `./dev mutate [NAME...]`.

Each mistake of mistakes/ is made in a copy of the tree (build/mutation), which is built and
tested; at least one of the chosen tests must fail. First the copy as it is must pass all of them.

Results: red (noticed), GREEN (survived: a test is missing), STALE (the text to replace is not
there exactly once any more: adapt mistakes/), BROKEN (it does not compile). All but red are
failures, and the exit code is 1.
"""

from __future__ import annotations

import argparse
import fcntl
import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from mistake import Edit, Mistake
from mistakes import MISTAKES

ROOT = Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "mutation"
BUILD = COPY / "build" / "release"  # as deep as the real one, so that ccache knows the objects
COPIED = ("CMakeLists.txt", "core", "tests/core", "tests/bench", "addon/blender_manifest.toml")
TIMEOUT = 900  # seconds for the tests of one mistake; one that runs longer was noticed
RED, GREEN, STALE, BROKEN = "red", "GREEN", "STALE", "BROKEN"


@dataclass
class Outcome:
    mistake: Mistake
    result: str
    failed: list[str] = field(default_factory=list)
    detail: str = ""
    seconds: float = 0.0


class Stale(Exception):
    pass


def main() -> int:
    options = arguments()
    chosen = [m for m in MISTAKES if not options.names or m.name in options.names]
    if options.list:
        for mistake in chosen:
            print(f"{mistake.name:<28} {mistake.number:>3}  {mistake.what}")
        return 0
    outcomes = [Outcome(m, STALE, detail=problem) for m in chosen if (problem := stale(m))]
    for outcome in outcomes:
        print(line(outcome), flush=True)
    if options.check:
        return 1 if outcomes else 0
    COPY.mkdir(parents=True, exist_ok=True)
    lock = open(COPY / "lock", "w")  # closed, and with it given up, when the process ends
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        print("another ./dev mutate is at work in build/mutation", file=sys.stderr)
        return 1
    copy_tree()
    chosen = [m for m in chosen if not stale(m)]
    if not (configure() and prove_green(chosen)):
        return 1
    print(f"\n{'mistake':<28} {'no.':>3}  {'result':<7} {'time':>6}  failed tests")
    for mistake in chosen:
        outcomes.append(try_mistake(mistake, options.all_failures))
        print(line(outcomes[-1]), flush=True)
    survived = [o.mistake.name for o in outcomes if o.result != RED]
    print(f"\n{len(outcomes) - len(survived)} of {len(outcomes)} mistakes were noticed", end="")
    print(f"; not: {', '.join(survived)}" if survived else "")
    return 1 if survived else 0


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="./dev mutate",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these mistakes")
    parser.add_argument("--list", action="store_true", help="list the mistakes")
    parser.add_argument("--check", action="store_true", help="only look for stale ones")
    parser.add_argument(
        "--all-failures", action="store_true", help="run all of the chosen tests, not to the first"
    )
    options = parser.parse_args()
    unknown = set(options.names) - {mistake.name for mistake in MISTAKES}
    if unknown:
        parser.error(f"no mistake is called {', '.join(sorted(unknown))}; see --list")
    return options


# --- The copy -------------------------------------------------------------------------------------


def copy_tree() -> None:
    """Makes the copy equal to the tree. What is equal already is not touched: it is not rebuilt."""
    wanted = set()
    for name in COPIED:
        source = ROOT / name
        for path in source.rglob("*") if source.is_dir() else [source]:
            if path.is_file() and "__pycache__" not in path.parts:
                wanted.add(path.relative_to(ROOT))
    for name in COPIED:
        target = COPY / name
        for path in list(target.rglob("*")) if target.is_dir() else []:
            if path.is_file() and path.relative_to(COPY) not in wanted:
                path.unlink()
    for name in wanted:
        content = (ROOT / name).read_bytes()
        target = COPY / name
        if not target.is_file() or target.read_bytes() != content:
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)


def pattern(text: str) -> re.Pattern:
    """The text, with any white space where it has some: the formatter may break its lines."""
    return re.compile(r"\s+".join(re.escape(word) for word in text.split()))


def mutated(text: str, edit: Edit) -> str:
    count = len(pattern(edit.old).findall(text))
    if count != 1:
        raise Stale(f"{edit.file}: {count} times instead of once: {' '.join(edit.old.split())}")
    return pattern(edit.old).sub(lambda _: edit.new, text)


def apply(mistake: Mistake, root: Path) -> dict[Path, str]:
    """The files under `root` that the mistake changes, and to what; raises Stale."""
    changed: dict[Path, str] = {}
    for edit in mistake.edits:
        path = root / edit.file
        if not path.is_file():
            raise Stale(f"{edit.file}: no such file")
        changed[path] = mutated(changed.get(path, path.read_text(encoding="utf-8")), edit)
    return changed


def stale(mistake: Mistake) -> str:
    try:
        apply(mistake, ROOT)
    except Stale as error:
        return str(error)
    return ""


# --- Build and test -------------------------------------------------------------------------------


def environment(long: bool = False) -> dict[str, str]:
    extra = {"CCACHE_BASEDIR": str(COPY), "CCACHE_NOHASHDIR": "1"}
    clean = {key: value for key, value in os.environ.items() if key != "JANUS_FULL"}
    return clean | extra | ({"JANUS_FULL": "1"} if long else {})


def configure() -> bool:
    if (BUILD / "build.ninja").exists():
        return True
    shutil.rmtree(BUILD, ignore_errors=True)
    command = ["cmake", "-S", str(COPY), "-B", str(BUILD), "-G", "Ninja", "--log-level=NOTICE"]
    command += ["-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DJANUS_BUILD_PYTHON=OFF"]
    return subprocess.run(command, env=environment()).returncode == 0


def build() -> str:
    """Empty, or what the compiler said."""
    jobs = os.environ.get("JANUS_JOBS") or str(os.cpu_count())
    command = ["nice", "cmake", "--build", str(BUILD), "--target", "janus_tests", "-j", jobs]
    done = subprocess.run(command, env=environment(), capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout + done.stderr or "the build failed"


def run_tests(tests: str, long: bool, all_failures: bool) -> tuple[bool, list[str], int]:
    """(whether all passed, the names of those that failed, how many ran)."""
    command = [str(BUILD / "tests/core/janus_tests"), f"--gtest_filter={tests}"]
    if not all_failures:
        command.append("--gtest_fail_fast")
    try:
        done = subprocess.run(
            command, env=environment(long), capture_output=True, text=True, timeout=TIMEOUT
        )
    except subprocess.TimeoutExpired:
        return False, ["(timeout)"], 1
    failed = re.findall(
        r"^\[  FAILED  \] ([^\s,]+), where|^\[  FAILED  \] (\S+) \(", done.stdout, re.M
    )
    names = list(dict.fromkeys(a or b for a, b in failed))
    if done.returncode not in (0, 1):
        names.append(f"(crash: {done.returncode})")
    ran = re.search(r"\[={10}\] Running (\d+) test", done.stdout)
    return done.returncode == 0, names, int(ran[1]) if ran else 0


def any_test(tests: str) -> bool:
    command = [str(BUILD / "tests/core/janus_tests"), f"--gtest_filter={tests}"]
    done = subprocess.run([*command, "--gtest_list_tests"], capture_output=True, text=True)
    return "  " in done.stdout


def prove_green(chosen: list[Mistake]) -> bool:
    """The copy as it is passes every test that is going to be asked."""
    print("building and testing the copy as it is ...", file=sys.stderr, flush=True)
    if message := build():
        print(f"the copy does not compile:\n{message}", file=sys.stderr)
        return False
    for long in (False, True):
        selections = {m.tests for m in chosen if m.long == long}
        for tests in sorted(selections):
            if not any_test(tests):
                print(f"no test is called {tests}", file=sys.stderr)
                return False
        if selections:
            passed, failed, ran = run_tests(":".join(sorted(selections)), long, True)
            if not passed:
                print(f"without a mistake, these fail: {', '.join(failed)}", file=sys.stderr)
                return False
            print(f"without a mistake all {ran} tests pass", file=sys.stderr, flush=True)
    return True


def try_mistake(mistake: Mistake, all_failures: bool) -> Outcome:
    begin = time.monotonic()
    changed = apply(mistake, COPY)
    original = {path: path.read_bytes() for path in changed}
    try:
        for path, text in changed.items():
            path.write_text(text, encoding="utf-8")
        message = build()
        if message:
            error = re.search(r"error: (.*)", message)
            outcome = Outcome(mistake, BROKEN, detail=error[1] if error else message[-300:])
        else:
            passed, failed, _ = run_tests(mistake.tests, mistake.long, all_failures)
            outcome = Outcome(mistake, GREEN if passed else RED, failed)
    finally:
        for path, content in original.items():
            path.write_bytes(content)
    outcome.seconds = time.monotonic() - begin
    return outcome


def line(outcome: Outcome) -> str:
    shown = ", ".join(outcome.failed[:3]) or outcome.detail
    if len(outcome.failed) > 3:
        shown += f" and {len(outcome.failed) - 3} more"
    if outcome.result == GREEN:
        shown = f"(none of {outcome.mistake.tests})"
    mark = outcome.result + ("(!)" if outcome.result == GREEN else "")
    name, number = outcome.mistake.name, outcome.mistake.number
    return f"{name:<28} {number:>3}  {mark:<8} {outcome.seconds:4.0f} s  {shown}"


if __name__ == "__main__":
    sys.exit(main())
