"""Work in other threads: it ends with its run, and files are written in order, errors raised."""

import subprocess
import sys
import threading
import time

import pytest

from texvent.errors import InputError, warn, warnings_to
from texvent.runtime.work.engines import attempt
from texvent.runtime.work.side_work import _running, begin_side_work, finish_side_work
from texvent.runtime.work.worker_threads import DEPTH, BackgroundWriter

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


class Sink:
    """Takes numbers; refuses one of them."""

    def __init__(self, refused=None):
        self.taken = []
        self.threads = set()
        self.refused = refused

    def append(self, number):
        if number == self.refused:
            raise OSError(28, "disk full")
        self.taken.append(number)
        self.threads.add(threading.current_thread())


def write(sink, numbers):
    with BackgroundWriter(sink) as behind:
        for number in numbers:
            behind.append(number)


def test_everything_arrives_in_order_from_one_other_thread():
    sink = Sink()
    write(sink, range(500))
    assert sink.taken == list(range(500))
    assert len(sink.threads) == 1
    assert threading.main_thread() not in sink.threads


@pytest.mark.parametrize("refused", [0, 3, 99])
def test_an_error_of_the_sink_is_raised_where_the_work_is(refused):
    sink = Sink(refused)
    with pytest.raises(OSError, match="disk full"):
        write(sink, range(100))
    assert not [one for one in threading.enumerate() if one.name.startswith("texvent-writer")]


def test_an_error_of_the_sink_stops_the_work_soon():
    numbers = iter(range(10_000))
    with pytest.raises(OSError, match="disk full"):
        write(Sink(refused=0), numbers)
    assert next(numbers) <= DEPTH + 2


def test_an_error_in_the_block_drops_what_waits():
    taken, released = [], threading.Event()

    class Stuck:
        def append(self, number):
            released.wait()
            taken.append(number)

    def work():
        with BackgroundWriter(Stuck()) as behind:
            for number in range(DEPTH):
                behind.append(number)
            # Called when it is dropped.
            behind._queue[-1].add_done_callback(lambda _: released.set())
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        work()
    # Only the one that was being written.
    assert taken == [0]
