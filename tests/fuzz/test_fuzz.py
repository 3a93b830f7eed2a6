"""Damaged inputs for every reader: those of `outcomes.txt`, or as many as $FUZZ_INPUTS says."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from texvent.errors import InputError, TexventWarning

from .outcomes import mark, stored_outcomes
from .reader import Reader
from .worker import BAD, LONGEST_ERROR, Worker, outcome_of, readers

INPUTS = int(os.environ.get("FUZZ_INPUTS", "4"))
STORED = stored_outcomes()
FINDINGS = sorted(Path(__file__).with_name("findings").glob("*/*"))
"""FORMAT/FILE: what was found once, or made by hand, is refused for ever."""


@pytest.fixture(scope="module")
def worker() -> Iterator[Worker]:
    one = Worker()
    yield one
    one.end()


@pytest.mark.parametrize("name", readers())
def test_damaged_inputs_are_read_or_refused_in_one_line(worker, name):
    marks = STORED.get(name, [])
    outcomes = [worker.one(name, number) for number in range(max(INPUTS, len(marks)))]
    if outcomes[0].kind == "not run":
        pytest.skip(outcomes[0].detail)
    assert [(number, one) for number, one in enumerate(outcomes) if one.kind in BAD] == []
    assert [mark(one) for one in outcomes[: len(marks)]] == marks


@pytest.mark.parametrize("path", FINDINGS, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_a_finding_is_refused_in_one_line(worker, path):
    assert worker.one(f"events {path.parent.name}", 0, path).kind == "refused"


@pytest.mark.long
@pytest.mark.parametrize(
    ("kind", "read"),
    [
        ("same", lambda path: "sound"),
        ("changed", lambda path: "other"),
        ("refused", lambda path: open_nothing(InputError(f"{path}: no"))),
        ("warned", lambda path: open_nothing(TexventWarning("no"))),
        ("too long", lambda path: open_nothing(InputError("x" * LONGEST_ERROR))),
        ("traceback", lambda path: open_nothing(KeyError("x"))),
        ("blow-up", lambda path: open_nothing(MemoryError())),
    ],
)
def test_a_reader_that_misbehaves_is_told_from_one_that_refuses(kind, read):
    reader = Reader("x", lambda folder: folder, read)
    assert outcome_of(reader, Path("input"), "sound").kind == kind


def open_nothing(error: Exception) -> str:
    raise error
