"""Jobs of pages, done by small programs in place of the worker."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from texvent.errors import InputError
from texvent.web import page_jobs, supervisor
from texvent.web.job import SimulateJob
from texvent.web.page_jobs import PageJobs
from texvent.web.supervisor import Supervisor

ANNA, BERT = ("anna", "tab 1"), ("bert", "tab 1")
PROGRAM = """
import json, pathlib, sys, time
folder = pathlib.Path(json.loads(sys.stdin.readline())["folder"])
print('{"kind": "progress", "text": "at work"}', flush=True)
while not (folder / "end").exists():
    (folder / "alive").touch()
    time.sleep(0.02)
print('{"kind": "done", "text": "made"}', flush=True)
"""


@pytest.fixture
def jobs(monkeypatch: pytest.MonkeyPatch) -> Iterator[PageJobs]:
    monkeypatch.setattr(supervisor, "WORKER", (sys.executable, "-c", PROGRAM))
    everything = Supervisor(time_limit_s=60)
    jobs = PageJobs(everything, max_waiting=1)
    yield jobs
    jobs.close()
    everything.close()


def until(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def start(jobs: PageJobs, page: tuple[str, str], folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    jobs.start(page, lambda: SimulateJob(folder=str(folder), prompt="a ball"))


def said(jobs: PageJobs, page: tuple[str, str]) -> str:
    answer = jobs.latest(page)
    return "" if answer is None else answer.text


def test_jobs_are_done_in_turn_and_few_may_wait(jobs: PageJobs, tmp_path: Path) -> None:
    first, second = tmp_path / "1", tmp_path / "2"
    start(jobs, ANNA, first)
    start(jobs, BERT, second)
    with pytest.raises(InputError, match="1 jobs wait already"):
        start(jobs, ("anna", "tab 2"), tmp_path / "3")
    until(lambda: said(jobs, ANNA) == "at work")
    assert said(jobs, BERT) == "waiting for its turn"
    (first / "end").touch()
    until(lambda: said(jobs, BERT) == "at work")
    assert said(jobs, ANNA) == "made"
    assert jobs.latest(("anna", "tab 2")) is None


def test_a_stopped_job_ends_at_once_and_makes_room(jobs: PageJobs, tmp_path: Path) -> None:
    first, second = tmp_path / "1", tmp_path / "2"
    start(jobs, ANNA, first)
    until(lambda: (first / "alive").exists())
    start(jobs, ANNA, second)  # instead of the first
    until(lambda: said(jobs, ANNA) == "at work")
    jobs.stop(ANNA)
    assert said(jobs, ANNA) == "Stopped."
    start(jobs, BERT, tmp_path / "3")
    until(lambda: said(jobs, BERT) == "at work")
    for folder in (first, second):
        (folder / "alive").unlink()
    time.sleep(0.3)
    assert not [folder for folder in (first, second) if (folder / "alive").exists()]
    assert said(jobs, ANNA) == "Stopped."


def test_a_job_that_no_page_asks_for_is_given_up(
    jobs: PageJobs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page_jobs, "ABANDONED_S", 1.0)
    start(jobs, ANNA, tmp_path / "1")
    start(jobs, BERT, tmp_path / "2")
    until(lambda: said(jobs, BERT) == "at work")
    assert said(jobs, ANNA) == "Stopped, as its page was closed."
