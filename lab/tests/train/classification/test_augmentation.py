"""Changed copies of recordings: which of all changes they are, and how often each is drawn."""

import itertools

import numpy as np
import pytest
from tests.represent.definitions import rows

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.train.classification.config import Augmentation
from texvent_lab.train.classification.samples import augment, take_run

EVENTS = EventStream([0, 1, 3], [0, 2, 1], [10, 14, 20], [1, 0, 1], SensorSize(4, 3))


def changed(flip_time, flip_x, dx, dy):
    found = [(x, y, 20 - t, 1 - p) for x, y, t, p in rows(EVENTS)][::-1] if flip_time else None
    found = [(3 - x if flip_x else x, y, t, p) for x, y, t, p in found or rows(EVENTS)]
    return tuple((x + dx, y + dy, t, p) for x, y, t, p in found
                 if 0 <= x + dx < 4 and 0 <= y + dy < 3)  # fmt: skip


@pytest.mark.parametrize("flip_time", [False, True])
@pytest.mark.parametrize("flip_x", [False, True])
@pytest.mark.parametrize("shift", [0, 1])
def test_a_copy_is_turned_in_time_and_space_and_shifted_each_as_often(flip_time, flip_x, shift):
    options = Augmentation(shift=shift, flip_x=flip_x, flip_time=flip_time)
    steps = range(-shift, shift + 1)
    ways = [*itertools.product({False, flip_time}, {False, flip_x}, steps, steps)]
    expected = {changed(*way) for way in ways}
    drawn = [tuple(rows(augment(EVENTS, options, np.random.default_rng(seed))))
             for seed in range(30 * len(ways))]  # fmt: skip
    counts = {one: drawn.count(one) for one in expected}
    assert sum(counts.values()) == len(drawn)
    assert min(counts.values()) > 10


def test_a_run_is_drawn_of_longer_recordings_only():
    stream = EventStream([0] * 9, [0] * 9, range(9), [1] * 9, SensorSize(1, 1))
    assert take_run(stream, None, np.random.default_rng(0)) is stream
    assert take_run(stream, 9, np.random.default_rng(0)) is stream
    runs = [take_run(stream, 7, np.random.default_rng(seed)).t.tolist() for seed in range(60)]
    assert {*map(tuple, runs)} == {tuple(range(first, first + 7)) for first in range(3)}
