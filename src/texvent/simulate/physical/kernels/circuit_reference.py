"""The definition of the pixel circuit, in NumPy float64: all pixels that may fire, move by move."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from texvent.events import NOISE, SIGNAL
from texvent.simulate.backend.elementary import decay_and_gain, exponential
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.physical.kernels.circuit import (
    DARK_OFFSET,
    Float64Array,
    Int64Array,
    Light,
    Luma,
    NoiseEvents,
    Pixels,
    PixelState,
    ResetRules,
    light_of,
)
from texvent.simulate.physical.kernels.crossing_time import (
    NEGLIGIBLE,
    NEVER,
    BoolArray,
    Course,
    time_to_threshold,
)

LEAK_SHARE = 0.5
"""An ON event is noise if leakage made at least this share of its change."""
SETTLED = 2.0**-40
"""A lag below this, log units, is none, so that a pixel at rest is at rest."""
FEWEST_PER_LOG, MOST_PER_LOG = 2.0, 8.0
"""Pieces of an interval per log unit of brightness: on each the corner hardly changes. One per time
constant, but no fewer and, but for one, no more than these."""
STRAIGHT = 1e-3
"""A piece that is shorter, in time constants, is a straight line."""


def advance_pixels(
    light: Light,
    pixels: Pixels,
    state: PixelState,
    noise: NoiseEvents,
    rules: ResetRules,
    span_us: tuple[int, int],
) -> UnsortedEvents:
    """Every event between two frames; moves the state to the end of the interval.

    The output of a photoreceptor is a first-order low-pass of the brightness. The change since the
    last reset grows with it and with the leak. Where it reaches the ON threshold or falls to minus
    the OFF threshold, the pixel fires and is reset. A noise event fires at its own time. A pixel
    that fired is held in reset for the refractory period: its change is zero until its release.

    Args:
        light: over the interval; `before` becomes `now`.
        pixels: thresholds and leak rates.
        state: at the start; changed in place.
        noise: noise events, by pixel and then by time.
        rules: what an event does to its pixel.
        span_us: start (included) and stop (excluded), µs.

    Returns:
        The events by pixel, then in time; times rounded down, never the stop itself.
    """
    (bright, corner), (bright_now, corner_now) = _see(light.before, light), _see(light.now, light)
    rise = bright_now - bright
    light.before[:] = light.now
    calm = _is_calm(bright, bright_now, pixels, state, span_us[1])
    calm[noise.pixel] = False
    pixel = np.flatnonzero(~calm)
    duration = float(span_us[1] - span_us[0])
    walk = _Walk.begin(pixel, (bright, rise, corner, corner_now), pixels, state, span_us)
    walk.k, walk.last_k = np.searchsorted(noise.pixel, [pixel, pixel + 1])

    lag = bright - state.output
    if light.optics.corner_per_level > 0:
        decay, gain = decay_and_gain((corner + corner_now) * 0.5 * duration)
        lag = decay * lag + gain * rise
    else:
        lag[:] = 0.0
    fired = _Fired(noise, rules, span_us)
    finished = fired.run(walk, light)
    lag[finished.pixel] = finished.lag
    lag[np.abs(lag) < SETTLED] = 0.0
    state.output[:] = bright_now - lag
    state.level[finished.pixel] = finished.level
    state.since_us[finished.pixel] = span_us[0] + finished.since.astype(np.int64)
    return fired.events()


def _see(luma: Luma, light: Light) -> tuple[Float64Array, Float64Array]:
    """Brightness and corner frequency, from the table where there is one."""
    if light.table is not None:
        return light.table[0][luma], light.table[1][luma]
    return light_of(luma.astype(np.float64), light.optics)


def _is_calm(
    before: Float64Array, now: Float64Array, pixels: Pixels, state: PixelState, stop_us: int
) -> BoolArray:
    """Pixels that cannot fire, [n]; a low-pass never leaves the range of its output and its input.

    A pixel that is held in reset is not among them: its level is NaN.
    """
    low = np.minimum(state.output, np.minimum(before, now))
    high = np.maximum(state.output, np.maximum(before, now))
    drift = pixels.leak.astype(np.float64) * (stop_us - state.since_us)
    rises = high - state.level + drift >= pixels.threshold_on
    falls = state.level - low >= pixels.threshold_off
    return ~(rises | falls | np.isnan(state.level))


@dataclass
class _Walk:
    """Pixels on their way through the interval, [n] each; times are µs since its start."""

    pixel: Int64Array
    on: Float64Array
    off: Float64Array
    leak: Float64Array
    bright: Float64Array
    """Brightness at the start of the interval."""
    rise: Float64Array
    corner: Float64Array
    """ω on this piece."""
    corner_from: Float64Array
    """At the start of this piece."""
    glow: Float64Array
    """α + I then."""
    growth: Float64Array
    """By what factor it grows on each piece."""
    pieces: Float64Array
    piece: Float64Array
    """Number of this piece."""
    begin_us: Float64Array
    """Of this piece."""
    end: Float64Array
    """Of this piece."""
    now: Float64Array
    lag: Float64Array
    """At the end of this piece."""
    base: Float64Array
    """The output on this piece is `base + tilt · now − transient`."""
    tilt: Float64Array
    transient: Float64Array
    """At the start of this piece."""
    kept: Float64Array
    """What is left of it at the end, as a share."""
    level: Float64Array
    since: Float64Array
    k: Int64Array
    """Its next noise event."""
    last_k: Int64Array
    """Where those of the next pixel begin."""

    @classmethod
    def begin(
        cls,
        pixel: Int64Array,
        sight: tuple[Float64Array, Float64Array, Float64Array, Float64Array],
        pixels: Pixels,
        state: PixelState,
        span_us: tuple[int, int],
    ) -> _Walk:
        """Some pixels at the start of the interval."""
        bright, rise, corner, corner_now = (column[pixel] for column in sight)
        duration = float(span_us[1] - span_us[0])
        angle, size = np.maximum(corner, corner_now) * duration, np.abs(rise)
        most = MOST_PER_LOG * size + 1.0
        pieces = np.ceil(np.minimum(np.maximum(angle, FEWEST_PER_LOG * size), most))
        pieces = np.where(angle > 0, np.maximum(pieces, 1.0), 1.0)
        nothing, none = np.zeros(len(pixel)), np.zeros(len(pixel), np.int64)
        return cls(
            pixel=pixel,
            on=pixels.threshold_on[pixel].astype(np.float64),
            off=pixels.threshold_off[pixel].astype(np.float64),
            leak=pixels.leak[pixel].astype(np.float64),
            bright=bright,
            rise=rise,
            corner=corner,
            corner_from=corner,
            glow=exponential(bright),
            growth=exponential(rise / pieces),
            pieces=pieces,
            piece=nothing - 1.0,
            begin_us=nothing.copy(),
            end=nothing.copy(),
            now=nothing.copy(),
            lag=bright - state.output[pixel],
            base=bright,
            tilt=rise / duration,
            transient=nothing.copy(),
            kept=nothing + 1.0,
            level=state.level[pixel].copy(),
            since=(state.since_us[pixel] - span_us[0]).astype(np.float64),
            k=none,
            last_k=none,
        )

    def only(self, chosen: BoolArray) -> _Walk:
        """Some of the pixels."""
        return _Walk(*(getattr(self, field.name)[chosen] for field in fields(self)))

    def put(self, chosen: BoolArray, other: _Walk) -> None:
        """Take over the state of some pixels."""
        for field in fields(self):
            getattr(self, field.name)[chosen] = getattr(other, field.name)

    def enter_piece(self, light: Light, duration: float) -> None:
        """Begin the next piece; see docs/simulators.md for what is solved here."""
        self.piece = self.piece + 1.0
        length = duration / self.pieces
        is_last = self.piece == self.pieces - 1.0
        self.now, self.begin_us = self.piece * length, self.piece * length
        self.end = np.where(is_last, duration, (self.piece + 1.0) * length)
        per_level, slope = light.optics.corner_per_level, self.rise / duration
        if per_level == 0:
            self.lag = np.zeros(self.lag.shape)
            return
        ahead = self.glow * self.growth
        offset = DARK_OFFSET - light.optics.balance
        mean = (self.glow + ahead) * (1 / 6) + np.sqrt(self.glow * ahead) * (2 / 3)
        corner, corner_to = per_level * (mean + offset), per_level * (ahead + offset)
        angle = corner * length
        kept, gain = decay_and_gain(angle)
        is_straight = angle < STRAIGHT
        bend = (corner_to - self.corner_from) / corner * 0.5
        curl = np.where(is_straight, 0.0, (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle))
        lag, lag_to = self.lag, self.lag * kept + slope * length * (gain - bend * curl)
        drop = slope - self.corner_from * lag
        room = np.where(is_straight, 1.0, angle - 1.0 + kept)
        self.transient = np.where(is_straight, 0.0, (lag_to - lag - drop * length) / room)
        drop = np.where(is_straight, (lag_to - lag) / length, drop + corner * self.transient)
        self.tilt = slope - drop
        self.base = self.bright + slope * self.now - (lag - self.transient) - self.tilt * self.now
        self.corner, self.kept, self.lag = corner, kept, lag_to
        self.corner_from, self.glow = corner_to, ahead


class _Fired:
    """Sends pixels through an interval and collects their events."""

    def __init__(self, noise: NoiseEvents, rules: ResetRules, span_us: tuple[int, int]) -> None:
        self._noise_after = np.append((noise.t - span_us[0]).astype(np.float64), NEVER)
        self._noise_p = np.append(noise.p, np.uint8(0))
        self._rules = rules
        self._span_us = span_us
        self._found: list[tuple[NDArray[np.int64], ...]] = []

    def events(self) -> UnsortedEvents:
        """What was found, by pixel, then in time."""
        nothing = np.empty(0, np.int64)
        columns = [np.concatenate([nothing, *parts]) for parts in zip(*self._found, strict=True)]
        if not columns:
            return UnsortedEvents.none()
        pixel, t, p, label = columns
        # Stable, so a pixel's events keep their order.
        order = np.argsort(pixel, kind="stable")
        kinds = p.astype(np.uint8), label.astype(np.uint8)
        return UnsortedEvents(pixel[order], t[order], kinds[0][order], kinds[1][order])

    def run(self, walk: _Walk, light: Light) -> _Walk:
        """Move every pixel on by one piece, event or release at a time, until all are done."""
        duration = float(self._span_us[1] - self._span_us[0])
        walk.enter_piece(light, duration)
        moving = np.ones(len(walk.pixel), np.bool_)
        while moving.any():
            step = walk.only(moving)
            reaches_end = self._move(step)
            goes_on = reaches_end & (step.piece < step.pieces - 1.0)
            into = step.only(goes_on)
            into.enter_piece(light, duration)
            step.put(goes_on, into)
            walk.put(moving, step)
            moving[moving] = ~reaches_end | goes_on
        return walk

    def _move(self, walk: _Walk) -> BoolArray:
        """Up to the next event, or the end of the piece; returns who has reached it."""
        held = walk.since > walk.now
        while (passed := held & (self._next_noise(walk) < walk.since)).any():
            walk.k = walk.k + passed
        waits = held & (walk.since > walk.end)
        now = np.where(held & ~waits, walk.since, walk.now)
        left = exponential(-walk.corner * (now - walk.begin_us))
        transient = walk.transient * left
        transient[np.abs(transient) <= NEGLIGIBLE * np.minimum(walk.on, walk.off)] = 0.0
        output = walk.base + walk.tilt * now - transient
        walk.level = np.where(np.isnan(walk.level) & ~waits, output, walk.level)
        change = np.where(waits, 0.0, output - walk.level + walk.leak * (now - walk.since))
        room = walk.end - now
        course = Course(
            change, walk.tilt + walk.leak, transient, walk.corner, room, walk.kept / left
        )
        wait, p = time_to_threshold(course, walk.on, walk.off)
        crossing, arrival = now + wait, self._next_noise(walk)
        event = np.minimum(crossing, arrival)
        fires = (event <= walk.end) & ~waits
        walk.now = np.where(fires, event, now)
        self._fire(walk, fires, fires & (arrival <= crossing), p)
        return ~fires

    def _next_noise(self, walk: _Walk) -> Float64Array:
        return np.where(walk.k < walk.last_k, self._noise_after[walk.k], NEVER)

    def _fire(
        self,
        walk: _Walk,
        fires: BoolArray,
        by_noise: BoolArray,
        p: NDArray[np.uint8],
    ) -> None:
        start_us, stop_us = self._span_us
        p = np.where(by_noise, self._noise_p[walk.k], p)
        by_leak = (p == 1) & (walk.leak * (walk.now - walk.since) >= LEAK_SHARE * walk.on)
        label = np.where(by_noise | by_leak, NOISE, SIGNAL)
        after = np.floor(walk.now)
        t = np.minimum(start_us + after.astype(np.int64), stop_us - 1)
        self._found.append((walk.pixel[fires], t[fires], p[fires].astype(np.int64), label[fires]))
        walk.k = walk.k + by_noise
        resets = fires & (~by_noise | self._rules.by_noise)
        # What it is when the pixel is released, which without refractory period is at once.
        walk.level = np.where(resets, np.nan, walk.level)
        walk.since = np.where(resets, after + self._rules.refractory_us, walk.since)
