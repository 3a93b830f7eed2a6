"""Processes that die take one task with them, which is run again; only the guilty is given up."""

import os
import signal
import subprocess
import sys
import time
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import pytest

from texvent.errors import InputError
from texvent.runtime.threads import THREADS_VARIABLE, count_threads
from texvent.runtime.work.engines import ATTEMPTS, Outcome, ProcessEngine


@dataclass(frozen=True)
class Task:
    """A task that gives its process and the threads it may use, fails, kills its process, or waits
    for a file."""

    number: int
    how: str = "works"
    deaths: Path | None = None
    """Gets a line before every death; or the file that is waited for."""
    is_video = False

    def run(self) -> tuple[int, int]:
        if self.how == "fails":
            raise InputError("it cannot be made")
        if self.how == "kills" and self.deaths is not None:
            with self.deaths.open("a") as file:
                file.write("died\n")
            os.kill(os.getpid(), signal.SIGKILL)
        if self.how == "waits" and self.deaths is not None:
            stop = time.monotonic() + 60.0
            while not self.deaths.exists() and time.monotonic() < stop:
                time.sleep(0.01)
        return os.getpid(), count_threads()


def outcomes_of(processes: int, *tasks: Task) -> dict[int, Outcome]:
    """Number of a task → its outcome."""
    with closing(ProcessEngine(processes)) as engine:
        for task in tasks:
            engine.submit(task)
        return {outcome.task.number: outcome for outcome in (engine.next() for _ in tasks)}


def test_a_task_that_takes_its_process_down_harms_no_other(tmp_path: Path) -> None:
    deaths = tmp_path / "deaths"
    deadly = Task(1, "kills", deaths)
    outcomes = outcomes_of(2, Task(0), deadly, Task(2), Task(3))
    assert f"its process died {ATTEMPTS} times" in (outcomes.pop(1).failure or "")
    assert len(deaths.read_text().splitlines()) == ATTEMPTS
    assert set(outcomes) == {0, 2, 3}
    assert not any(one.failure for one in outcomes.values())


def test_tasks_that_fail_leave_their_processes_to_others() -> None:
    outcomes = outcomes_of(1, *(Task(number, "fails") for number in range(3)), Task(3))
    assert [bool(outcomes[number].failure) for number in range(4)] == [True, True, True, False]


def test_an_outcome_does_not_wait_for_those_of_longer_tasks(tmp_path: Path) -> None:
    with closing(ProcessEngine(2)) as engine:
        for task in (Task(0, "waits", tmp_path / "stop"), Task(1), Task(2)):
            engine.submit(task)
        early = [engine.next().task.number for _ in range(2)]
        (tmp_path / "stop").touch()
        assert [*early, engine.next().task.number] == [1, 2, 0]


def test_processes_share_the_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(THREADS_VARIABLE, "5")
    assert [one.result[1] for one in outcomes_of(2, Task(0), Task(1)).values()] == [2, 2]


def test_an_idle_process_that_was_killed_is_replaced() -> None:
    with closing(ProcessEngine(1)) as engine:
        engine.submit(Task(0))
        first, _ = engine.next().result
        os.kill(first, signal.SIGKILL)
        engine.submit(Task(1))
        outcome = engine.next()
    assert outcome.failure is None
    assert outcome.result[0] != first


def test_no_more_processes_than_asked_for() -> None:
    found = {one.result[0] for one in outcomes_of(2, *map(Task, range(6))).values()}
    assert 1 <= len(found) <= 2
    assert os.getpid() not in found


PROGRAM = """
import os, sys, time
from pathlib import Path
from texvent.runtime.work.engines import interruptible, start_pool, stop_pools
from texvent.runtime.files.hidden_parts import hidden_file

def work(folder):
    with interruptible(), hidden_file(folder, ".part"):
        (folder / "begun").touch()
        try:
            time.sleep(60)
        finally:
            time.sleep(1)  # a second signal comes while it cleans up

if __name__ == "__main__":
    folder, how = Path(sys.argv[1]), sys.argv[2]
    pool = start_pool(2)
    pool.submit(work, folder)
    pool.submit(os.getpid).result()  # the other process waits for a task
    while not (folder / "begun").exists():
        time.sleep(0.01)
    if how == "stop":
        stop_pools(pool)
    else:
        os._exit(9)
"""


@pytest.mark.parametrize("how", ["stop", "die"])
def test_processes_of_a_pool_end_and_clean_up(tmp_path: Path, how: str) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    folder = tmp_path / "folder"
    folder.mkdir()
    started = subprocess.run(
        [sys.executable, str(program), str(folder), how], timeout=300, capture_output=True
    )
    assert started.returncode == (0 if how == "stop" else 9), started.stderr
    ends = time.monotonic() + 300
    while time.monotonic() < ends and is_running(program):
        time.sleep(0.1)
    assert not is_running(program)
    if how == "stop":
        assert [path.name for path in folder.iterdir()] == ["begun"]


def is_running(program: Path) -> bool:
    """Whether a process of the pool is left; its main module is the program."""
    found = subprocess.run(["pgrep", "-f", str(program)], capture_output=True)
    return found.returncode == 0


STUBBORN = """
import signal, sys, time
from pathlib import Path
import texvent.runtime.work.engines as pools

def work(begun):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    begun.touch()
    time.sleep(600)

if __name__ == "__main__":
    begun, pool, pools.PATIENCE_S = Path(sys.argv[1]), pools.start_pool(1), 0.5
    pool.submit(work, begun)
    while not begun.exists():
        time.sleep(0.01)
    pools.stop_pools(pool)
"""


def test_a_process_that_no_signal_ends_is_killed(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(STUBBORN)
    subprocess.run([sys.executable, str(program), str(tmp_path / "begun")], timeout=300, check=True)
    assert not is_running(program)
