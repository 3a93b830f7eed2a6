"""Changed copies of recordings, by hand and by properties."""

import numpy as np
from tests.represent.definitions import rows

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.train.classification.config import Augmentation
from texvent_lab.train.classification.samples import augment, take_run


class Chance:
    """Draws that are given: whether time and x are flipped, and the shift."""

    def __init__(self, *, time: bool = False, x: bool = False, shift: tuple[int, int] = (0, 0)):
        self._flips, self._shift = np.where([time, x], 0.1, 0.9), np.array(shift)

    def random(self, count: int) -> np.ndarray:
        return self._flips

    def integers(self, low: int, high: int, count: int) -> np.ndarray:
        assert ((low <= self._shift) & (self._shift < high)).all()
        return self._shift


def events() -> EventStream:
    return EventStream([0, 1, 3], [0, 2, 1], [10, 14, 20], [1, 0, 1], SensorSize(4, 3))


def test_reversed_events_begin_at_zero_with_the_opposite_polarity() -> None:
    found = augment(events(), Augmentation(shift=0, flip_time=True), Chance(time=True))
    assert rows(found) == [(3, 1, 0, 0), (1, 2, 6, 1), (0, 0, 10, 0)]


def test_mirrored_events_are_at_the_other_side() -> None:
    found = augment(events(), Augmentation(shift=0, flip_x=True), Chance(x=True))
    assert rows(found) == [(3, 0, 10, 1), (2, 2, 14, 0), (0, 1, 20, 1)]


def test_what_is_shifted_out_is_dropped() -> None:
    found = augment(events(), Augmentation(shift=2), Chance(shift=(1, -1)))
    assert rows(found) == [(2, 1, 14, 0)]


def test_a_run_is_drawn_of_longer_recordings_only() -> None:
    stream = EventStream([0] * 9, [0] * 9, range(9), [1] * 9, SensorSize(1, 1))
    assert take_run(stream, None, np.random.default_rng(0)) is stream
    assert take_run(stream, 9, np.random.default_rng(0)) is stream
    firsts = set()
    for seed in range(60):
        run = take_run(stream, 7, np.random.default_rng(seed))
        assert np.diff(run.t).tolist() == [1] * 6
        firsts.add(int(run.t[0]))
    assert firsts == {0, 1, 2}
