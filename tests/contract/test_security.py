"""Every promise of SECURITY.md names its tests."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROMISES = [
    line.split("|")[1:3]
    for line in (ROOT / "SECURITY.md").read_text("utf-8").splitlines()
    if "`tests/" in line
]


@pytest.mark.parametrize(("promise", "tests"), PROMISES, ids=[str(n) for n in range(len(PROMISES))])
def test_every_promise_names_tests_that_exist(promise, tests):
    named = re.findall(r"`([^`]+)`", tests)
    assert named
    assert [one for one in named if not (ROOT / one).exists()] == []
    assert promise.strip().endswith((".", ")"))
