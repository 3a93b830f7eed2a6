"""A fixed sample of damaged inputs for every reader; `python -m tests.fuzz` is the whole of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from .outcomes import BAD, Outcome, table
from .readers import readers
from .supervisor import Supervisor

INPUTS = 4
FINDINGS = sorted(Path(__file__).with_name("findings").glob("*/*"))
"""FORMAT/FILE: what was found once, or made by hand, is refused for ever."""


@pytest.fixture(scope="module")
def supervisor() -> Iterator[Supervisor]:
    with Supervisor() as one:
        yield one


@pytest.mark.parametrize("name", readers())
def test_damaged_inputs_are_read_or_refused_in_one_line(supervisor: Supervisor, name: str) -> None:
    outcomes = [supervisor.one(name, number) for number in range(INPUTS)]
    if outcomes[0].kind == "not run":
        pytest.skip(outcomes[0].detail)
    assert [f"{one}" for one in outcomes if one.kind in BAD] == []


@pytest.mark.parametrize("path", FINDINGS, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_a_finding_is_refused_in_one_line(supervisor: Supervisor, path: Path) -> None:
    assert supervisor.one(f"events {path.parent.name}", 0, path).kind == "refused"


def test_a_reader_that_misbehaves_is_told_from_one_that_refuses() -> None:
    changed = Path(__file__)
    with Supervisor(kill_seconds=3.0) as supervisor:
        found = {kind: supervisor.one(f"broken {kind}", 0, changed).kind for kind in BAD}
    assert found == {kind: kind for kind in BAD}


def test_the_table_has_a_row_per_reader_and_names_what_did_not_run() -> None:
    outcomes = [
        Outcome("a", 0, "refused", "", ""),
        Outcome("a", 1, "hang", "", ""),
        Outcome("b", 0, "not run", "", ""),
    ]
    lines = table(outcomes).splitlines()
    assert lines[2] == "| a | 2 | 0 | 0 | 1 | 0 | 0 | 0 | 1 | 0 | 0 | 0 |"
    assert lines[3].startswith("| **all** | 2 |")
    assert lines[-1] == "Not run, a package is missing: b."
