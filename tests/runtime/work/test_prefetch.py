"""Work in another thread: the same items and errors, and an end when it is no longer wanted."""

import subprocess
import sys
import threading

import pytest

from texvent.runtime.work.worker_threads import prefetch


def own_threads():
    return [one for one in threading.enumerate() if one.name.startswith("texvent-prefetch")]


class Counted:
    """Whole numbers that know how many of them were made, by which threads, and their end."""

    def __init__(self, stop):
        self.made = []
        self.threads = set()
        self.is_closed = False
        self.has_made = threading.Condition()
        self._stop = stop

    def __iter__(self):
        # Refers to itself, so that only `close` ends it before the collector of cycles.
        self._numbers = self._make()
        return self._numbers

    def _make(self):
        try:
            for number in range(self._stop):
                with self.has_made:
                    self.made.append(number)
                    self.has_made.notify_all()
                self.threads.add(threading.current_thread())
                yield number
        finally:
            self.is_closed = True


@pytest.mark.parametrize(("count", "depth"), [(0, 2), (5, 1), (5, 7), (100, 2)])
def test_every_item_comes_in_order_from_one_other_thread(count, depth):
    items = Counted(count)
    assert list(prefetch(items, depth=depth)) == list(range(count))
    assert len(items.threads) <= 1
    assert threading.main_thread() not in items.threads
    assert not own_threads()


def test_no_more_is_made_than_was_asked_for_and_the_depth():
    items = Counted(100)
    ahead = prefetch(items, depth=3)
    assert next(ahead) == 0
    with items.has_made:  # one was given, three are ready
        assert items.has_made.wait_for(lambda: len(items.made) == 4, 60)
    ahead.close()
    assert items.made == [0, 1, 2, 3]
    assert items.is_closed
    assert not own_threads()


def test_an_error_comes_after_the_items_before_it():
    def failing():
        yield 1
        yield 2
        raise ValueError("the third is broken")

    ahead = prefetch(failing(), depth=2)
    assert next(ahead) == 1
    assert next(ahead) == 2
    with pytest.raises(ValueError, match="the third is broken"):
        next(ahead)
    assert list(ahead) == []
    assert not own_threads()


def test_an_error_of_the_reader_ends_the_work():
    items = Counted(1000)

    def read_until_interrupted():
        for number in prefetch(items, depth=2):
            if number == 5:
                raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        read_until_interrupted()
    assert items.is_closed
    assert not own_threads()
    assert len(items.made) <= 9


def test_a_process_that_forgets_a_reader_still_ends():
    script = (
        "import itertools, time\n"
        "from texvent.runtime.work.worker_threads import prefetch\n"
        "ahead = prefetch((time.sleep(0.01) for _ in itertools.count()), depth=2)\n"
        "next(ahead)\n"
        "print('done')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=300, check=True
    )
    assert done.stdout == "done\n"
    assert done.stderr == ""
