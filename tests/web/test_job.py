from __future__ import annotations

import pytest

from texvent.errors import InputError
from texvent.web.job import (
    Answer,
    ConvertJob,
    SimulateJob,
    answer_line,
    job_line,
    read_answer,
    read_job,
)
from texvent.web.limits import Limits


@pytest.mark.parametrize(
    "job",
    [
        SimulateJob(
            folder="/f", prompt="a\nb ü", options={"seed": 0}, limits=Limits(max_seconds=1)
        ),
        SimulateJob(folder="/f", video="/v.mp4"),
        ConvertJob(source="/e.h5", folder="/f", format="evt3"),
    ],
)
def test_a_job_survives_its_line(job) -> None:
    line = job_line(job)
    assert "\n" not in line
    assert read_job(line) == job


@pytest.mark.parametrize("line", ["", "{}", "[1]", '{"kind": "delete"}', '{"kind": "convert"}'])
def test_other_lines_are_no_jobs(line: str) -> None:
    with pytest.raises(InputError, match="not a job"):
        read_job(line)


def test_an_answer_survives_its_line_and_other_output_is_passed_over() -> None:
    answer = Answer(kind="done", text="x\ny", files={"video": "/a.mp4"})
    assert read_answer(answer_line(answer)) == answer
    assert read_answer("Downloading 3 %\n") is None
    assert read_answer('{"a": 1}') is None
