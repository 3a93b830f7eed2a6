"""A light that switches between two brightnesses: which events follow which switch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from texvent.calibrate.events_only.pixel_trains import Float64Array, Int64Array, PixelTrains
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import MICROSECONDS

FREQUENCY_RANGE = 0.02
"""Relative range around the given frequency that is searched."""
TRIALS = 16
"""Frequencies tried for each cycle by which they differ over the recording: the nearest one is
wrong by less than `NEAR_BURST`."""
MOST_EVENTS = 200_000
"""Events that the frequency is found from."""
LEAST_STRENGTH = 0.2
"""Mean resultant length of ON and OFF events at the frequency below which there is no flicker."""
PHASE_BINS = 2000
NEAR_BURST = 0.05
"""Part of a cycle around the busiest instant in which a burst is looked for."""
LEAD = 0.01
"""Part of a cycle by which a half begins before its first events."""
RISE = 0.05
"""Part of the busiest bin that an onset reaches."""
END_BINS, END_RANGE = 100, 1000.0
"""Bins of times since the switch, each a few per cent longer than the one before, and the length of
a half over the time at which they begin."""
MOST_NOISE = 4.0
"""Rate over that of noise below which a burst has ended."""
LEAST_CYCLES = 3
"""Whole cycles that a recording needs."""


class Cycles(NamedTuple):
    """The rhythm of a flicker."""

    hz: float
    """The frequency of the light, Hz."""
    start_us: Float64Array
    """[2] where the first dark half and the first bright half begin, µs (index = polarity)."""
    number: int
    """Whole cycles."""


class Bursts(NamedTuple):
    """Events of one polarity that follow a switch in their direction, by pixel and time."""

    pixel: Int64Array
    """[n]."""
    cycle: Int64Array
    """[n]."""
    since_us: Float64Array
    """[n] time since the half began, µs."""
    follows: np.ndarray
    """[n] whether the event before of this pixel belongs to the same burst."""


def find_cycles(events: EventStream, hz: float) -> Cycles:
    """The frequency and the phase of a flicker.

    Args:
        events: ON after a light brightens, OFF after it darkens.
        hz: its frequency, within 2 %.

    Raises:
        InputError: the events do not follow that frequency, or for fewer than three cycles.
    """
    first_us, stop_us = events.time_range or (0, 0)
    seconds = (stop_us - first_us) / MICROSECONDS
    if seconds * hz < LEAST_CYCLES:
        raise InputError(
            f"{seconds:.3g} s of events hold {seconds * hz:.2g} cycles of {hz:g} Hz; calibration "
            f"needs {LEAST_CYCLES}"
        )
    step = max(1, len(events) // MOST_EVENTS)
    t = (events.t[::step] - first_us) / MICROSECONDS
    sign = events.p[::step].astype(np.float64) * 2 - 1
    count = 2 * int(TRIALS * seconds * hz * FREQUENCY_RANGE) + 9
    trials = hz * (1 + np.linspace(-1, 1, count) * FREQUENCY_RANGE)
    strength = np.array([abs((sign * np.exp(2j * np.pi * one * t)).mean()) for one in trials])
    best = int(strength.argmax())
    if strength[best] < LEAST_STRENGTH:
        raise InputError(
            f"ON and OFF events do not alternate at {hz:g} Hz (strength {strength[best]:.2f} of 1, "
            f"{LEAST_STRENGTH} is needed). Is that the frequency of the light?"
        )
    hz = _straighten(trials[best], t[sign > 0])
    phase = (t * hz) % 1.0
    rate = [np.histogram(phase[sign == one], PHASE_BINS, (0, 1))[0] for one in (-1, 1)]
    onset = [_onset(rate[p], rate[1 - p]) / PHASE_BINS - LEAD for p in (0, 1)]
    start = first_us + (np.array(onset) % 1.0) * MICROSECONDS / hz
    return Cycles(hz, start, int(seconds * hz) - 1)


def _straighten(hz: float, t: Float64Array) -> float:
    """The frequency at which bursts of one polarity come at the same phase in every cycle.

    The phase of a cycle is the median of its events near the busiest one; the slope over cycles is
    the median of those between cycles half of the recording apart, so noise moves neither. Cycles
    that the recording cuts, with less than half of the usual events, are left out.

    Args:
        hz: the frequency, Hz, wrong by less than `NEAR_BURST` cycles over the recording.
        t: times of the events, s.
    """
    rate = np.histogram((t * hz) % 1.0, PHASE_BINS, (0, 1))[0]
    place = t * hz - rate.argmax() / PHASE_BINS
    cycle = np.rint(place).astype(np.int64)
    late = place - cycle
    near = np.abs(late) < NEAR_BURST
    numbers, first, count = np.unique(cycle[near], return_index=True, return_counts=True)
    whole = count > np.median(count) / 2
    phase = np.array([np.median(part) for part in np.split(late[near], first[1:])])[whole]
    numbers = numbers[whole]
    half = len(numbers) // 2
    slopes = (phase[-half:] - phase[:half]) / (numbers[-half:] - numbers[:half])
    return hz / (1 + float(np.median(slopes)))


def _onset(rate: Int64Array, other: Int64Array) -> int:
    """The bin in which events of a polarity set in.

    Half a cycle that begins in the middle of the other polarity's cannot be cut by the onset.
    """
    half = PHASE_BINS // 2
    excess = np.cumsum(np.tile(rate.astype(np.float64) - other, 2))
    gain = excess[half : half + PHASE_BINS] - excess[:PHASE_BINS]
    best = np.flatnonzero(gain >= gain.max() - 1e-9)
    begin = int(best[0]) + 1
    ahead = np.roll(rate, -begin)[:half]
    return begin + int(np.flatnonzero(ahead >= RISE * ahead.max())[0])


def find_bursts(trains: PixelTrains, cycles: Cycles, p: int) -> Bursts:
    """The events of a polarity in the halves of its own.

    Args:
        trains: of the flickering field.
        cycles: its rhythm.
        p: 1 for ON events after the light brightens, 0 for OFF events after it darkens.
    """
    period_us = MICROSECONDS / cycles.hz
    place = (trains.t - cycles.start_us[p]) / period_us
    cycle = np.floor(place).astype(np.int64)
    since_us = (place - cycle) * period_us
    belongs = (trains.is_on == bool(p)) & (since_us < period_us / 2)
    belongs &= (cycle >= 0) & (cycle < cycles.number)
    belongs &= since_us < _burst_end_us(since_us[belongs], period_us / 2)
    follows = np.zeros(len(cycle), np.bool_)
    follows[1:] = belongs[1:] & belongs[:-1] & (np.diff(trains.pixel) == 0)
    follows[1:] &= np.diff(cycle) == 0
    return Bursts(trains.pixel[belongs], cycle[belongs], since_us[belongs], follows[belongs])


def _burst_end_us(since_us: Float64Array, half_us: float) -> float:
    """From when on most events of a half are noise, whose rate is that of its second half, µs."""
    noise_per_us = np.count_nonzero(since_us >= half_us / 2) / (half_us / 2)
    edges = np.geomspace(half_us / END_RANGE, half_us, END_BINS)
    per_us = np.histogram(since_us, edges)[0] / np.diff(edges)
    busy = np.flatnonzero(per_us > MOST_NOISE * noise_per_us)
    return float(edges[busy[-1] + 1]) if busy.size else half_us
