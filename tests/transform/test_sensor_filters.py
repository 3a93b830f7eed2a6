"""Filters of Prophesee's sensors, trails and flicker: by hand, and against plain definitions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.transform.filters import kernels_cpu
from texvent.transform.filters.apply import NEVER, FlickerLimits
from texvent.transform.filters.rate_filters import AntiFlickerFilter

from . import reference
from .recordings import CUTS, SIZE, packets, rows_of, stream, streams

MODES = ("trail", "stc-cut-trail", "stc-keep-trail")


def times_kept(events: EventStream, name: str, **options: object) -> list[int]:
    return events.filter(name, **options).t.tolist()


def test_a_burst_ends_with_its_polarity_or_with_a_pause() -> None:
    on = [(1, 1, t, 1) for t in (0, 3, 12, 13)]
    off = [(1, 1, t, 0) for t in (14, 23)]
    elsewhere = [(2, 1, 13, 1)]
    events = stream([*on, *off, *elsewhere])
    # Bursts of the pixel: 0 and 3; 12 and 13, because 12 is 9 µs later; 14 alone; 23 alone.
    expected = {"trail": [0, 12, 13, 14, 23], "stc-cut-trail": [3, 13], "stc-keep-trail": [3, 13]}
    for mode in MODES:
        assert times_kept(events, "event-trail", mode=mode, threshold_us=9) == expected[mode]
    # One µs more, and 0, 3, 12, 13 are one burst, and so are 14 and 23.
    expected = {"trail": [0, 13, 14], "stc-cut-trail": [3, 23], "stc-keep-trail": [3, 12, 13, 23]}
    for mode in MODES:
        assert times_kept(events, "event-trail", mode=mode, threshold_us=10) == expected[mode]


def bursts(events: EventStream, threshold_us: int) -> Iterable[list[int]]:
    """Numbers of the events of each burst: every pixel on its own, from the definition."""
    for y, x in {(int(y), int(x)) for x, y in zip(events.x, events.y, strict=True)}:
        burst: list[int] = []
        for number in np.flatnonzero((events.x == x) & (events.y == y)).tolist():
            if burst and (
                events.p[burst[-1]] != events.p[number]
                or events.t[number] - events.t[burst[-1]] >= threshold_us
            ):
                yield burst
                burst = []
            burst.append(number)
        yield burst


@given(streams(), st.integers(1, 22))
def test_each_mode_keeps_its_part_of_every_burst(events: EventStream, threshold_us: int) -> None:
    parts = {"trail": slice(1), "stc-cut-trail": slice(1, 2), "stc-keep-trail": slice(1, None)}
    for mode, part in parts.items():
        numbers = sorted(n for burst in bursts(events, threshold_us) for n in burst[part])
        kept = events.filter("event-trail", mode=mode, threshold_us=threshold_us)
        assert rows_of(kept) == [rows_of(events)[number] for number in numbers]


def flicker(frequency_hz: float, periods: int, *, x: int = 0, first_us: int = 0) -> list:
    """Events of one pixel under a light that is on for half of each period: two at each edge."""
    period = 1e6 / frequency_hz
    starts = [first_us + round(number * period) for number in range(periods)]
    half = round(period / 2)
    return [
        row
        for t in starts
        for row in ((x, 0, t, 1), (x, 0, t + 40, 1), (x, 0, t + half, 0), (x, 0, t + half + 40, 0))
    ]


def test_flicker_passes_until_six_periods_were_counted() -> None:
    events = stream(flicker(100, 12))
    assert len(events.filter("anti-flicker")) == 6 * 4
    # The events that band-stop drops are those that band-pass keeps.
    assert len(events.filter("anti-flicker", mode="band-pass")) == 6 * 4
    assert len(events.filter("anti-flicker", start_bursts=2, stop_bursts=1)) == 2 * 4


@pytest.mark.parametrize(
    ("frequency_hz", "is_dropped"), [(85, False), (92, True), (108, True), (120, False)]
)
def test_flicker_outside_of_the_band_passes(frequency_hz: int, is_dropped: bool) -> None:
    events = stream(flicker(frequency_hz, 30))
    kept = events.filter("anti-flicker", low_hz=90, high_hz=110)
    assert (len(kept) < len(events)) == is_dropped


def test_a_light_that_stops_flickering_is_seen_again() -> None:
    before, after = flicker(100, 10), flicker(100, 3, first_us=300_000)
    kept = stream([*before, *after]).filter("anti-flicker")
    assert [row for row in rows_of(kept) if row[2] >= 300_000] == after


def test_flicker_is_found_in_blocks_of_4x4_pixels() -> None:
    # Two pixels of a block count its bursts once, one of the next block is left alone.
    beside, next_block = (3, 3, 80_010, 0), (4, 0, 80_010, 0)
    events = stream([*flicker(100, 12), beside, next_block])
    kept = rows_of(events.filter("anti-flicker"))
    assert next_block in kept
    assert beside not in kept


def test_bursts_that_come_too_early_count_down() -> None:
    # 6 periods of 10 ms; then ON and OFF every 6 ms, which is above the band of 90 to 110 Hz.
    slow = flicker(100, 7)
    fast = flicker(1e6 / 6000, 4, first_us=70_000)
    kept = stream([*slow, *fast]).filter("anti-flicker", low_hz=90, high_hz=110)
    # The first fast burst still comes 10 ms after the last slow one: 7.
    # Then 6, 5, 4: at 3 it stops.
    assert [t for *_, t, _ in rows_of(kept) if t >= 60_000] == []
    more = flicker(1e6 / 6000, 6, first_us=70_000)
    kept = stream([*slow, *more]).filter("anti-flicker", low_hz=90, high_hz=110)
    assert next(t for *_, t, _ in rows_of(kept) if t >= 60_000) == 70_000 + 4 * 6000


def test_the_units_are_those_of_the_sensor() -> None:
    # The reset values of its registers: 15 and 156 units of 128 µs, duty cycle 8 / 16.
    assert AntiFlickerFilter().limits == FlickerLimits(15 * 128, 157 * 128 - 1, 960, 6, 4)
    assert AntiFlickerFilter(duty_cycle=100.0).limits.hold_us == 15 * 128
    assert AntiFlickerFilter(duty_cycle=6.25).limits.hold_us == 120


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"low_hz": 49}, r"low_hz is 49; it must be 50..520"),
        ({"high_hz": 521}, r"high_hz is 521; it must be 50..520"),
        ({"low_hz": 120, "high_hz": 110}, r"low_hz is 120, above high_hz, 110"),
        ({"duty_cycle": 0.0}, r"duty_cycle is 0; it must be 6.25..100"),
        ({"start_bursts": 8}, r"start_bursts is 8; it must be 0..7"),
        ({"start_bursts": 3}, r"stop_bursts is 4, above start_bursts, 3"),
        ({"mode": "stop"}, r"mode is 'stop'; allowed: band-stop, band-pass"),
    ],
)
def test_a_wrong_flicker_filter_is_refused(options: dict, message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        AntiFlickerFilter(**options)


LIMITS = FlickerLimits(shortest_us=3, longest_us=8, hold_us=2, begin=2, end=1)


@given(streams(), CUTS, st.integers(1, 22), st.integers(-(10**15), 10**15))
def test_the_compiled_kernels_equal_the_reference_in_any_packets(
    events: EventStream, cuts: list[int], threshold_us: int, start: int
) -> None:
    found: dict[str, list] = {}
    for name, kernels in (("whole", reference), ("packets", kernels_cpu)):
        last = np.full(SIZE.shape, NEVER, np.int64)
        burst, state = np.zeros((2, *SIZE.shape), np.uint8), np.zeros((3, 2, 2), np.uint8)
        begun = np.full((2, 2), NEVER, np.int64)
        parts = [events] if name == "whole" else list(packets(events, cuts))
        places, flickers = [], []
        for part in parts:
            columns = part.x, part.y, part.t + start, part.p
            places += kernels.find_places_in_bursts(*columns, last, burst, threshold_us).tolist()
            flickers += kernels.find_flicker(*columns, begun, state, LIMITS).tolist()
        found[name] = [places, flickers, last.tolist(), burst.tolist(), state.tolist()]
    assert found["whole"] == found["packets"]
