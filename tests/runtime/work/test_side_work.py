"""Side work ends with its run: a normal end waits for it, an interrupted one for some seconds."""

import subprocess
import sys
import threading
import time

import pytest

from texvent.errors import InputError, warn, warnings_to
from texvent.runtime.work.engines import attempt
from texvent.runtime.work.side_work import _running, begin_side_work, finish_side_work

SCRIPT = """
import time
from texvent.runtime.work import side_work
from texvent.runtime.work.interrupts import clean_up

side_work.PATIENCE_S = 0.1
side_work.begin_side_work(0, lambda: (time.sleep({seconds}), print("kept", flush=True)))
{end}
"""


@pytest.mark.parametrize(
    ("seconds", "end", "is_kept"),
    [
        (0.5, "", True),
        (0.5, "raise ValueError", True),
        (600, "raise KeyboardInterrupt", False),
        (600, "clean_up()", False),
    ],
)
def test_the_end_of_a_process_waits_unless_it_is_interrupted(seconds, end, is_kept):
    command = [sys.executable, "-c", SCRIPT.format(seconds=seconds, end=end)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert (ended.stdout == "kept\n") == is_kept


class Task:
    """A task whose side work waits until it may go on."""

    is_video = False

    def __init__(self, error: BaseException | None = None) -> None:
        self.error = error
        self.go = threading.Event()

    def run(self) -> None:
        begin_side_work(self, lambda: (self.go.wait(300), warn("not kept"))[-1])
        if self.error is not None:
            raise self.error


@pytest.mark.parametrize("error", [None, InputError("it cannot be made")])
def test_a_task_that_ends_hears_the_warnings_of_its_side_work(error):
    said, task = [], Task(error)
    threading.Timer(0.1, task.go.set).start()
    with warnings_to(said.append):
        attempt(task)
    assert said == ["not kept"]


def test_a_task_that_is_interrupted_does_not_wait():
    task = Task(KeyboardInterrupt())
    with warnings_to(lambda text: None):
        with pytest.raises(KeyboardInterrupt):
            attempt(task)
        assert not task.go.is_set()
        task.go.set()
        finish_side_work()


def test_work_of_one_key_is_done_once_at_a_time_however_many_threads_begin_it():
    busy, done = threading.Lock(), []

    def work() -> None:
        assert busy.acquire(blocking=False)
        time.sleep(0.001)
        busy.release()
        done.append(0)

    begun = [threading.Thread(target=begin_side_work, args=("key", work)) for _ in range(50)]
    for one in begun:
        one.start()
    for one in begun:
        one.join()
    finish_side_work("key")
    assert len(done) == 50
    assert not _running
