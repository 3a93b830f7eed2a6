"""Writing from another thread: everything in order, errors raised, nothing written after one."""

import threading

import pytest

from texvent.runtime.work.worker_threads import DEPTH, BackgroundWriter


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
