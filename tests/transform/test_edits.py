"""Mirroring, turning, cropping, coarser pixels: by hand, and as properties of any recording."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from tests.refusals import Refusal, check_refusal

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent.transform.edits import flip_polarity, merge, reverse_time, shift, start_at_zero

from .recordings import CUTS, SIZE, packets, rows_of, stream, streams


def test_edits_by_hand() -> None:
    events = stream([(0, 0, 1, 1), (7, 5, 2, 0), (2, 1, 2, 1)])
    assert rows_of(events.flip("x")) == [(7, 0, 1, 1), (0, 5, 2, 0), (5, 1, 2, 1)]
    assert rows_of(events.flip("y")) == [(0, 5, 1, 1), (7, 0, 2, 0), (2, 4, 2, 1)]
    assert rows_of(events.flip("xy")) == rows_of(events.rotate(180))
    # The top left pixel comes to the top right.
    turned = events.rotate(90)
    assert turned.size == SensorSize(6, 8)
    assert rows_of(turned) == [(5, 0, 1, 1), (0, 7, 2, 0), (4, 2, 2, 1)]
    assert rows_of(events.crop(1, 1, 3, 2)) == [(1, 0, 2, 1)]
    assert rows_of(events.resize((2, 2))) == [(0, 0, 1, 1), (1, 1, 2, 0), (0, 0, 2, 1)]
    assert rows_of(shift(events, 1, -1)) == [(3, 0, 2, 1)]


EDITS: dict[str, tuple[Callable[[EventStream], EventStream], dict[str, object]]] = {
    "crop": (lambda events: events.crop(2, 1, 4, 3), {"crop": "2,1,4,3"}),
    "resize": (lambda events: events.resize((5, 7)), {"resize": "5x7"}),
    "flip": (lambda events: events.flip("xy"), {"flip": "xy"}),
    "rotate": (lambda events: events.rotate(90), {"rotate": 90}),
    "filter": (
        lambda events: events.filter("refractory", period_us=5),
        {"filter": ["refractory:period_us=5"]},
    ),
    "mask": (
        lambda events: events.filter("mask", pixels=np.zeros((6, 8), bool)),
        {"filter": ["mask:pixels"]},
    ),
    "shift": (lambda events: shift(events, 1, -2), {"shift": "1,-2"}),
    "polarity": (flip_polarity, {"flip_polarity": True}),
    "from zero": (start_at_zero, {"from_zero": True}),
    "between": (lambda events: events.between(500_000, 900_000), {"time": "0.5,0.9"}),
}


@pytest.mark.parametrize("name", EDITS)
def test_every_edit_is_noted_after_those_before_it(name: str) -> None:
    change, noted = EDITS[name]
    events = stream([(2, 1, 600_000, 1), (3, 2, 700_000, 0)])
    expected = {"seed": 1, "edits": [noted]}
    assert change(events).metadata == expected
    assert change(packets(events, [1])).metadata == expected
    again = reverse_time(change(events))
    assert again.metadata["edits"] == [noted, {"reverse_time": True}]
    assert events.metadata == {"seed": 1}


@given(streams())
def test_the_array_of_an_event_frame_turns_and_mirrors_with_its_events(events: EventStream) -> None:
    frame = count_events(events)
    for quarters in range(4):
        turned = count_events(events.rotate(90 * quarters))
        np.testing.assert_array_equal(turned, np.rot90(frame, -quarters, axes=(1, 2)))
    np.testing.assert_array_equal(count_events(events.flip("x")), frame[:, :, ::-1])
    np.testing.assert_array_equal(count_events(events.flip("y")), frame[:, ::-1])


@given(streams())
def test_done_twice_nothing_is_changed(events: EventStream) -> None:
    assert flip_polarity(flip_polarity(events)).equals(events)
    assert reverse_time(reverse_time(events)).equals(events)


@pytest.mark.parametrize("name", [name for name in EDITS if name != "between"])
@given(events=streams(), cuts=CUTS)
def test_packets_give_what_the_whole_gives(name: str, events: EventStream, cuts: list[int]) -> None:
    change, _ = EDITS[name]
    edited = change(packets(events, cuts))
    assert edited.collect().equals(change(events))
    assert edited.collect().equals(change(events))  # each pass begins anew
    assert edited.size == change(events).size


def test_reversed_by_hand() -> None:
    events = stream([(1, 1, 10, 1), (2, 2, 12, 0), (3, 3, 12, 1), (4, 4, 20, 0)])
    assert rows_of(reverse_time(events)) == [
        (4, 4, 10, 1), (3, 3, 18, 0), (2, 2, 18, 1), (1, 1, 20, 0),
    ]  # fmt: skip
    assert len(reverse_time(EventStream.empty(SIZE))) == 0


def test_labels_go_with_their_events() -> None:
    events = EventStream([0, 1], [0, 0], [1, 2], [1, 0], SIZE, label=np.array([0, 1], np.uint8))
    assert events.crop(1, 0, 2, 2).label.tolist() == [1]
    assert reverse_time(events).label.tolist() == [1, 0]
    assert events.rotate(90).label.tolist() == [0, 1]


class Odd:
    """A filter that answers with numbers of a type."""

    def __init__(self, dtype: type, extra: int = 0) -> None:
        self.dtype, self.extra = dtype, extra

    def start(self, events: object) -> Callable[[EventStream], Any]:
        return lambda packet: np.ones(len(packet) + self.extra, self.dtype)


REFUSED: dict[str, Refusal] = {
    "degrees": (lambda one: one.rotate(45), ConfigError,
                "degrees is 45; it must be 0, 90, 180 or 270", lambda one: one.rotate(270)),
    "axis": (lambda one: one.flip("z"), ConfigError, "axes is 'z'; give 'x'",
             lambda one: one.flip("y")),
    "region": (lambda one: one.crop(5, 0, 4, 6), InputError,
               "the region 5,0,4,6 does not lie inside the sensor of 8x6; give x,y,width,height "
               "with x + width <= 8 and y + height <= 6", lambda one: one.crop(4, 0, 4, 6)),
    "nothing": (lambda one: merge([]), InputError, "nothing to merge; give at least one recording",
                lambda one: merge([packets(one)])),
    "sizes": (lambda one: merge([packets(one), packets(one.rotate(90))]), InputError,
              "cannot merge sensors of 8x6 and 6x8; crop or resize one first",
              lambda one: merge([packets(one), packets(one.rotate(180))])),
    "numbers": (lambda one: one.filter(Odd(np.uint8)), InputError,
                "the filter Odd gave uint8 of shape (1,); it must give a mask, bool of shape (1,),",
                lambda one: one.filter(Odd(np.bool_))),
    "longer": (lambda one: one.filter(Odd(bool, 1)), InputError,
               "the filter Odd gave bool of shape (2,); it must give a mask, bool of shape (1,),",
               lambda one: one.filter(Odd(bool, 0))),
    "time": (lambda one: one.between("1", 9), InputError,
             "the start of the range is '1'; give a time in µs", lambda one: one.between(1, 9)),
    "reversed": (lambda one: one.between(3, 1), InputError,
                 "the range from 3 to 1 µs is reversed; its stop must come after its start: 1, 3",
                 lambda one: one.between(1, 3)),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_done_is_refused(name: str) -> None:
    check_refusal(REFUSED[name], stream([(0, 0, 1, 1)]))
