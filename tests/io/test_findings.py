"""What fuzzing found once, and hostile files made by hand, is refused in one line for ever."""

from __future__ import annotations

from pathlib import Path

import pytest

from texvent.errors import InputError
from texvent.io.files import load

from .format_cases import CASE_OF

FINDINGS = sorted(Path(__file__).with_name("findings").glob("*/*"))


def test_there_are_findings_to_look_at() -> None:
    assert len(FINDINGS) >= 5


@pytest.mark.parametrize("path", FINDINGS, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_a_finding_is_one_clear_line(path: Path) -> None:
    case = CASE_OF[path.parent.name]
    if case.extra:
        pytest.importorskip(case.extra, reason=f"{case.name} needs {case.extra}")
    with pytest.raises(InputError) as caught:
        load(path, format=case.name, size=case.sensor)
    assert "\n" not in str(caught.value)
