"""How work is shared out among threads."""

import os
import threading
import time

import pytest

from texvent.errors import ConfigError
from texvent.runtime.threads import _workers, count_threads, run_parts, split

VARIABLES = ("TEXVENT_NUM_THREADS", "NUMBA_NUM_THREADS")


@pytest.fixture(autouse=True)
def _unset(monkeypatch):
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)


@pytest.mark.parametrize(
    ("size", "parts", "unit"), [(0, 2, 1), (1, 4, 4096), (10, 3, 1), (9, 2, 4)]
)
def test_slices_make_up_the_whole(size, parts, unit):
    slices = split(size, parts, unit=unit)
    assert [i for one in slices for i in range(one.start, one.stop)] == list(range(size))
    assert len(slices) <= parts
    assert all((one.stop - one.start) % unit == 0 for one in slices[:-1])


@pytest.mark.parametrize("cores", [1, 2, 5])
def test_without_a_setting_there_is_a_thread_for_each_core_of_this_process(monkeypatch, cores):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {*range(3, 3 + cores)}, raising=False)
    assert count_threads() == cores
    monkeypatch.delattr(os, "sched_getaffinity")
    for known in (cores, None):  # as macOS and Windows count, if they can
        monkeypatch.setattr(os, "cpu_count", lambda: known)  # noqa: B023
        assert count_threads() == (known or 1)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_no_more_threads_work_at_once_than_are_set(monkeypatch, count):
    monkeypatch.setenv("TEXVENT_NUM_THREADS", str(count))
    _workers.cache_clear()
    waiting, seen = threading.Barrier(count, timeout=300), set()

    def work(part):
        waiting.wait()  # until as many as are set
        seen.add(threading.get_ident())
        return part

    try:
        assert run_parts(work, range(4 * count)) == [*range(4 * count)]
    finally:
        _workers().shutdown()
        _workers.cache_clear()
    assert len(seen) == count


def test_results_come_in_the_order_of_the_parts_and_threads_work_at_once():
    waiting = threading.Barrier(2, timeout=300)

    def work(part):
        waiting.wait()
        return part, threading.get_ident()

    (one, here), (two, there) = run_parts(work, [10, 20])
    assert (one, two) == (10, 20)
    assert here != there
    assert threading.get_ident() in (here, there)


def test_an_error_is_raised_when_no_part_is_worked_on():
    done, is_begun = [], threading.Event()

    def work(part):
        if part == 0:
            is_begun.wait(60)
            raise ValueError("part 0")
        is_begun.set()
        time.sleep(0.05)
        done.append(part)

    with pytest.raises(ValueError, match="part 0"):
        run_parts(work, [0, 1])
    assert done == [1]


def test_the_number_of_threads_is_a_setting(monkeypatch):
    assert count_threads() >= 1
    monkeypatch.setenv("NUMBA_NUM_THREADS", "3")
    assert count_threads() == 3
    monkeypatch.setenv("TEXVENT_NUM_THREADS", "2")
    assert count_threads() == 2
    for wrong in ("0", "-1", "two"):
        monkeypatch.setenv("TEXVENT_NUM_THREADS", wrong)
        with pytest.raises(ConfigError, match=r"TEXVENT_NUM_THREADS is .* at least 1"):
            count_threads()
