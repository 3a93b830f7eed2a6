"""Events and files stay what they are: for a seed and options, and for events."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from tests.contract.golden import EVENTS_FILE, FILES_FILE, digest, event_cases, file_cases

CASES = dict(event_cases())


def test_golden_events_cover_all_cases() -> None:
    assert list(json.loads(EVENTS_FILE.read_text())) == list(CASES)


@pytest.mark.parametrize("name", CASES)
def test_golden_events_are_those_of_the_release(name: str) -> None:
    made: Any = CASES[name]()
    assert digest(name, made) == json.loads(EVENTS_FILE.read_text())[name]


def test_golden_files_are_those_of_the_release(tmp_path: Path) -> None:
    assert dict(file_cases(tmp_path)) == json.loads(FILES_FILE.read_text())
