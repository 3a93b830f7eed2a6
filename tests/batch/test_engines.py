"""Processes that die take one task with them, which is run again; only the guilty is given up."""

from __future__ import annotations

import os
import signal
from contextlib import closing
from dataclasses import dataclass

from texvent.batch.engines import ATTEMPTS, ProcessEngine


@dataclass(frozen=True)
class Task:
    """A task that gives its process, or kills it."""

    number: int
    is_deadly: bool = False
    is_video = False

    def run(self) -> int:
        if self.is_deadly:
            os.kill(os.getpid(), signal.SIGKILL)
        return os.getpid()


def test_a_task_that_takes_its_process_down_harms_no_other() -> None:
    with closing(ProcessEngine(2)) as engine:
        for number in range(4):
            engine.submit(Task(number, is_deadly=number == 1))
        outcomes = {outcome.task.number: outcome for outcome in (engine.next() for _ in range(4))}
    assert f"its process died {ATTEMPTS} times" in (outcomes.pop(1).failure or "")
    assert set(outcomes) == {0, 2, 3}
    assert not any(one.failure for one in outcomes.values())


def test_an_idle_process_that_was_killed_is_replaced() -> None:
    with closing(ProcessEngine(1)) as engine:
        engine.submit(Task(0))
        first = engine.next().result
        os.kill(first, signal.SIGKILL)
        engine.submit(Task(1))
        outcome = engine.next()
    assert outcome.failure is None
    assert outcome.result != first


def test_no_more_processes_than_asked_for() -> None:
    with closing(ProcessEngine(2)) as engine:
        for number in range(6):
            engine.submit(Task(number))
        found = {engine.next().result for _ in range(6)}
    assert 1 <= len(found) <= 2
    assert os.getpid() not in found
