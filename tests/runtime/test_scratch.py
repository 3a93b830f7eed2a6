"""Scratch memory: the same array again, larger when needed, and never shared between threads."""

import threading

import numpy as np

from texvent.runtime.scratch import take_scratch


def test_it_grows_to_what_is_asked_for():
    take_scratch("test growth", 10, np.int64)
    assert take_scratch("test growth", 1000, np.int64).shape == (1000,)
    assert take_scratch("test growth", 0, np.int64).shape == (0,)


def test_each_thread_has_its_own():
    seen = []
    thread = threading.Thread(target=lambda: seen.append(take_scratch("test own", 8, np.uint8)))
    thread.start()
    thread.join()
    assert not np.shares_memory(seen[0], take_scratch("test own", 8, np.uint8))
