"""Augmentations: by hand, keyed by seed, epoch and number, and always valid streams."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent import Augment
from texvent._registry import AUGMENTATIONS
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.transform.augment import (
    Crop,
    DropArea,
    DropEvents,
    DropTime,
    FlipX,
    JitterTime,
    Shift,
)

from .recordings import SIZE, rows_of, stream, streams

EVERY = ["crop:width=5,height=4" if name == "crop" else name for name in AUGMENTATIONS.builtin]


class Chance:
    """Draws that are given, between 0 and 1."""

    def __init__(self, *values: float) -> None:
        self._values = np.array(values)

    def random(self, count: int | None = None) -> np.ndarray:
        taken, self._values = np.split(self._values, [count or 1])
        return taken if count else taken[0]


def many(count: int = 4000, size: SensorSize = SIZE) -> EventStream:
    rng = np.random.default_rng(0)
    x, y, p = (rng.integers(0, end, count) for end in (*size, 2))
    return EventStream(x, y, np.sort(rng.integers(0, 10_000, count)), p, size)


@pytest.mark.parametrize("step", EVERY)
@given(events=streams(), seed=st.integers(0, 2**63 - 1), number=st.integers(0, 2**40))
def test_a_changed_copy_is_a_valid_stream_between_the_same_times(
    step: str, events: EventStream, seed: int, number: int
) -> None:
    before = rows_of(events)
    found = Augment([step], seed)(events, number)
    assert rows_of(events) == before
    assert len(found) <= len(events)
    if len(found):
        assert events.t[0] <= found.t[0] <= found.t[-1] <= events.t[-1]
    assert found.size == ((5, 4) if "crop" in step else events.size)
    assert found.equals(Augment([step], seed)(events, number))


def test_draws_depend_on_seed_epoch_and_number_and_not_on_what_came_before() -> None:
    events, augment = many(), Augment(["drop-events", "flip-x", "jitter-time"], seed=3)
    alone = augment(events, 5, epoch=2)
    for number in (9, 0, 5):
        augment(events, number)
    assert augment(events, 5, epoch=2).equals(alone)
    assert Augment(augment.steps, seed=3)(events, 5, epoch=2).equals(alone)
    others = [augment(events, 6, epoch=2), augment(events, 5, epoch=3)]
    others += [augment(events, 2, epoch=5), Augment(augment.steps, seed=4)(events, 5, epoch=2)]
    others += [Augment(augment.steps, seed=2**32 + 3)(events, 5, epoch=2)]
    assert not any(one.equals(alone) for one in others)


def test_a_pinned_draw() -> None:
    """NumPy may change its generators; this notices."""
    found = Augment(["shift:pixels=2", "drop-events:most=0.8"], seed=7)(many(), 11)
    assert (len(found), int(found.x.sum()), int(found.t.sum())) == PINNED


PINNED = (1808, 8141, 9086704)


def test_steps_happen_with_the_probability_that_is_asked_for() -> None:
    events = stream([(0, 0, 1, 1)])
    flipped = sum(Augment(["flip-x"], 1)(events, number).x[0] == 7 for number in range(400))
    assert 160 < flipped < 240
    assert all(Augment(["flip-x:probability=0"])(events, n).equals(events) for n in range(20))
    assert all(Augment([FlipX(probability=1)])(events, n).x[0] == 7 for n in range(20))


def test_dropping_by_hand() -> None:
    events = stream([(x, y, 10 * x, 1) for x in range(8) for y in range(6)])
    half = DropEvents(most=1.0).apply(events, Chance(0.5, *np.tile([0.4, 0.6], 24)))
    assert half.y.tolist() == [1, 3, 5] * 8
    # 71 µs in all: a span of 0.5 · 71 = 36 µs (35.5 rounds to even) from 0.25 · 36 = 9 µs on.
    kept = DropTime(most=1.0).apply(events, Chance(0.5, 0.25))
    assert sorted(set(kept.t.tolist())) == [0, 50, 60, 70]
    assert DropTime(most=1.0).apply(events, Chance(0.5, 0.999)).t.max() == 30  # up to the last µs
    # A rectangle of half of each side, as far to the right and down as it fits.
    kept = DropArea(most=1.0).apply(events, Chance(0.5, 0.999, 0.999))
    assert {(x, y) for x, y, _, _ in rows_of(events)} - {
        (x, y) for x, y, _, _ in rows_of(kept)
    } == {(x, y) for x in range(4, 8) for y in range(3, 6)}
    assert DropArea(most=0.0).apply(events, Chance(0.5, 0.5, 0.5)).equals(events)
    assert DropTime(most=0.0).apply(events, Chance(0.5, 0.5)).equals(events)


def test_places_of_a_random_crop_are_all_reached_and_the_centre_is_one() -> None:
    events = stream([(x, y, 1, 1) for y in range(6) for x in range(8)])
    rng = np.random.default_rng(0)
    crops = [Crop(width=6, height=5).apply(events, rng) for _ in range(100)]
    assert {len(part) for part in crops} == {30}
    corner = stream([(2, 1, 1, 1)])
    found = {tuple(rows_of(Crop(width=6, height=5).apply(corner, rng))[0][:2]) for _ in range(100)}
    assert found == {(x, y) for x in (0, 1, 2) for y in (0, 1)}
    middle = Crop(width=4, height=2, centre=True).apply(events, rng)
    assert middle.equals(events.crop(2, 2, 4, 2))
    with pytest.raises(InputError, match="crop is 9x2 and the events are of 8x6"):
        Crop(width=9, height=2).apply(events, rng)


def test_jitter_has_the_deviation_that_is_asked_for() -> None:
    events = EventStream.from_columns([500] * 4000, [500] * 4000, np.arange(4000) * 1000,
                                      [1] * 4000, size=(1000, 1000))  # fmt: skip
    moved = Augment(["jitter-space:sd_pixels=3"], seed=1)(events)
    assert 2.8 < moved.x.std() < 3.2
    assert 2.8 < moved.y.std() < 3.2
    later = Augment(["jitter-time:sd_us=50"], seed=1)(events)
    assert 45 < (later.t - events.t).std() < 55
    assert JitterTime(sd_us=0).apply(events, np.random.default_rng(0)).equals(events)
    assert Shift(pixels=0).apply(events, np.random.default_rng(0)).equals(events)


def test_what_was_done_is_noted_with_events_that_say_how_they_were_made() -> None:
    augment = Augment(["flip-x", "crop:width=4,height=4,centre=true"], seed=2)
    events = stream([(3, 3, 1, 1)]).with_metadata({"prompt": "a car", "edits": [{"time": "0,1"}]})
    noted = augment(events, 4, epoch=1).metadata
    assert noted["prompt"] == "a car"
    assert noted["edits"] == [
        {"time": "0,1"},
        {
            "augment": {
                "seed": 2,
                "steps": [
                    {"step": "FlipX", "probability": 0.5},
                    {"step": "Crop", "width": 4, "height": 4, "centre": True},
                ],
            },
            "number": 4,
            "epoch": 1,
        },
    ]
    json.dumps(noted)
    assert augment(events.with_metadata({}), 4).metadata == {}


def test_what_is_wrong_is_refused_when_it_is_made() -> None:
    with pytest.raises(ConfigError, match=r"unknown augmentation 'flip'.*flip-x"):
        Augment(["flip"])
    with pytest.raises(ConfigError, match="steps is 'flip-x'; give a list"):
        Augment("flip-x")
    with pytest.raises(ConfigError, match="7 is no augmentation"):
        Augment([7])
    with pytest.raises(ConfigError, match=r"FlipX'> is no augmentation; give .* an object with"):
        Augment([FlipX])
    with pytest.raises(
        ConfigError, match="crop needs width, height; write crop:width=VALUE,height=VALUE"
    ):
        Augment(["crop"])
    with pytest.raises(ConfigError, match=r"probability is 2; it must be 0\.\.1"):
        Augment(["flip-x:probability=2"])
    with pytest.raises(ConfigError, match="seed is -1"):
        Augment([], seed=-1)
    with pytest.raises(ConfigError, match="number is -1"):
        Augment([])(stream([]), -1)
