# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever the bindings are given: a result, or an error with a message. No crash, no hang."""

import time

import pytest

from .conftest import FULL, apart

CALLS = 6000 if FULL else 100
GRAPHS = 20_000 if FULL else 100
# New seeds each day in full runs; failures name theirs.
FIRST = int(time.time()) // 86400 % 10_000 * 100_000 if FULL else 0


def fuzzed(script: str, count: int, folder) -> list[list[int]]:
    """The numbers that it prints; its last calls are in the failure."""
    try:
        printed = apart(script, FIRST, count, folder, timeout=60 + count)
    except Exception as error:
        pytest.fail(f"{(folder / 'calls.txt').read_text(errors='replace')[-8000:]}\n{error}")
    return [[int(word) for word in line.split()] for line in printed.splitlines()]


def test_wrong_calls(tmp_path):
    (succeeded, refused, rendered), (read, damaged, _) = fuzzed("fuzz_calls.py", CALLS, tmp_path)
    assert min(succeeded, refused) > 4 * CALLS
    assert rendered > CALLS / 8
    assert read > CALLS / 20
    assert damaged > CALLS / 2


def test_wrong_graphs(tmp_path):
    ((rendered,),) = fuzzed("fuzz_graphs.py", GRAPHS, tmp_path)
    assert rendered > GRAPHS / 2
