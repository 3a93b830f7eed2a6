"""Writing from another thread: everything in order, errors raised, nothing written after one."""

import threading
import time

import pytest

from texvent.runtime.background_writer import DEPTH, BackgroundWriter


class Slow:
    """Takes numbers slowly; refuses one of them."""

    def __init__(self, refused=None, wait_s=0.0):
        self.taken = []
        self.threads = set()
        self.refused = refused
        self.wait_s = wait_s

    def append(self, number):
        time.sleep(self.wait_s)
        if number == self.refused:
            raise OSError(28, "disk full")
        self.taken.append(number)
        self.threads.add(threading.current_thread())


def write(sink, numbers):
    with BackgroundWriter(sink) as behind:
        for number in numbers:
            behind.append(number)


def test_everything_arrives_in_order_from_one_other_thread():
    sink = Slow()
    write(sink, range(500))
    assert sink.taken == list(range(500))
    assert len(sink.threads) == 1
    assert threading.main_thread() not in sink.threads


@pytest.mark.parametrize("refused", [0, 3, 99])
def test_an_error_of_the_sink_is_raised_where_the_work_is(refused):
    sink = Slow(refused)
    with pytest.raises(OSError, match="disk full"):
        write(sink, range(100))
    assert not [one for one in threading.enumerate() if one.name.startswith("texvent-writer")]


def test_an_error_of_the_sink_stops_the_work_soon():
    sink, given = Slow(refused=0), []

    def numbers():
        for number in range(10_000):
            given.append(number)
            time.sleep(0.001)
            yield number

    with pytest.raises(OSError, match="disk full"):
        write(sink, numbers())
    assert len(given) <= DEPTH + 2


def test_an_error_in_the_block_drops_what_waits():
    taken, released = [], threading.Event()

    class Stuck:
        def append(self, number):
            released.wait()
            taken.append(number)

    def interrupted():
        yield from range(DEPTH)
        threading.Timer(0.05, released.set).start()
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write(Stuck(), interrupted())
    # Only the one that was being written.
    assert taken == [0]
