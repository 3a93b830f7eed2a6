"""Jobs of a benchmark in this process and in others."""

import os
import time

import pytest

from texvent_lab.bench.jobs import run_jobs


def square(number):
    return number * number


def note_and_wait(folder, number):
    (folder / f"{number}-{os.getpid()}").touch()
    if number:
        time.sleep(600)
    return number


@pytest.mark.parametrize("jobs", [1, 2])
def test_results_come_in_the_order_of_the_arguments(jobs):
    assert list(run_jobs(square, [(1,), (2,), (3,)], jobs)) == [1, 4, 9]


def test_work_that_is_not_waited_for_ends_at_once(tmp_path):
    results = run_jobs(note_and_wait, [(tmp_path, number) for number in range(8)], 2)
    assert next(results) == 0
    results.close()
    started = [path.name.split("-") for path in tmp_path.iterdir()]
    assert len(started) < 8
    for _, process in started:
        with pytest.raises(ProcessLookupError):
            os.kill(int(process), 0)
