"""The definition of the pixel circuit, in NumPy float64: pixels that may fire, event by event."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray
from tests.simulate.references.crossing_time import (
    NEGLIGIBLE,
    NEVER,
    BoolArray,
    ChangeCurve,
    time_to_threshold,
)
from tests.simulate.references.sorting import sort_events

from texvent.events import NOISE, SIGNAL
from texvent.simulate.kernels.elementary import decay_and_gain, exponential
from texvent.simulate.packets import SortedEvents, UnsortedEvents
from texvent.simulate.physical.circuit import (
    CircuitState,
    Float64Array,
    Int64Array,
    Luma,
    NoiseEvents,
    PhotoreceptorInput,
    brightness_and_cutoff,
)
from texvent.simulate.physical.lane_steps import (
    FEWEST_PER_LOG,
    LEAK_SHARE,
    MOST_PER_LOG,
    STRAIGHT,
)
from texvent.simulate.physical.lanes import SETTLED
from texvent.simulate.random.mismatch import PixelMismatch


def advance_pixels(
    light: PhotoreceptorInput,
    mismatch: PixelMismatch,
    state: CircuitState,
    noise: NoiseEvents,
    refractory_us: int,
    span_us: tuple[int, int],
) -> SortedEvents:
    """As `physical.circuit_kernel.advance_pixels`."""
    brightness, cutoff = _convert(light.before, light)
    brightness_stop, cutoff_stop = _convert(light.now, light)
    rise = brightness_stop - brightness
    light.before[:] = light.now
    may_fire = ~_cannot_fire(brightness, brightness_stop, mismatch, state, span_us[1])
    may_fire[noise.pixel] = True
    pixel = np.flatnonzero(may_fire)
    duration = float(span_us[1] - span_us[0])
    received = brightness, rise, cutoff, cutoff_stop
    active = _CircuitPixels.begin(pixel, received, mismatch, state, span_us)
    active.next_noise, active.noise_stop = np.searchsorted(noise.pixel, [pixel, pixel + 1])

    lag = brightness - state.output
    if light.optics.cutoff_per_level > 0:
        decay, gain = decay_and_gain((cutoff + cutoff_stop) * 0.5 * duration)
        lag = decay * lag + gain * rise
    else:
        lag[:] = 0.0
    finder = _EventFinder(noise, refractory_us, span_us)
    finished = finder.run(active, light)
    lag[finished.pixel] = finished.lag
    lag[np.abs(lag) < SETTLED] = 0.0
    state.output[:] = brightness_stop - lag
    state.level[finished.pixel] = finished.level
    state.since_us[finished.pixel] = span_us[0] + finished.since.astype(np.int64)
    return sort_events(finder.events(), span_us, light.shape)


def _convert(luma: Luma, light: PhotoreceptorInput) -> tuple[Float64Array, Float64Array]:
    """Brightness and cutoff frequency, from the table where there is one."""
    if light.table is not None:
        return light.table[0][luma], light.table[1][luma]
    return brightness_and_cutoff(luma.astype(np.float64), light.optics)


def _cannot_fire(
    before: Float64Array,
    now: Float64Array,
    mismatch: PixelMismatch,
    state: CircuitState,
    stop_us: int,
) -> BoolArray:
    """Pixels that cannot fire, [n]; a low-pass stays within the range of its output and its input.

    A pixel that is held in reset is not among them: its level is NaN.
    """
    low = np.minimum(state.output, np.minimum(before, now))
    high = np.maximum(state.output, np.maximum(before, now))
    drift = mismatch.leak.astype(np.float64) * (stop_us - state.since_us)
    rises = high - state.level + drift >= mismatch.threshold_on
    falls = state.level - low >= mismatch.threshold_off
    return ~(rises | falls | np.isnan(state.level))


@dataclass
class _CircuitPixels:
    """Pixels that may fire, during the interval; [n] each, times in µs since its start."""

    pixel: Int64Array
    on: Float64Array
    off: Float64Array
    leak: Float64Array
    brightness: Float64Array
    """Brightness at the start of the interval."""
    rise: Float64Array
    cutoff: Float64Array
    """ω on this segment."""
    cutoff_start: Float64Array
    """ω at its start."""
    offset_intensity: Float64Array
    """α + I at its start."""
    growth_ratio: Float64Array
    """Factor by which that grows on each segment."""
    segments: Float64Array
    segment: Float64Array
    """Number of this segment."""
    begin_us: Float64Array
    """Of this segment."""
    end: Float64Array
    """Of this segment."""
    now: Float64Array
    lag: Float64Array
    """At the end of this segment."""
    base: Float64Array
    """The output on this segment is `base + slope · now − transient`."""
    slope: Float64Array
    transient: Float64Array
    """At the start of this segment."""
    kept: Float64Array
    """What is left of it at the end, as a share."""
    level: Float64Array
    since: Float64Array
    next_noise: Int64Array
    """Its next noise event."""
    noise_stop: Int64Array
    """Where those of the next pixel begin."""

    @classmethod
    def begin(
        cls,
        pixel: Int64Array,
        received: tuple[Float64Array, Float64Array, Float64Array, Float64Array],
        mismatch: PixelMismatch,
        state: CircuitState,
        span_us: tuple[int, int],
    ) -> _CircuitPixels:
        """Some pixels at the start of the interval."""
        brightness, rise, cutoff, cutoff_stop = (column[pixel] for column in received)
        duration = float(span_us[1] - span_us[0])
        angle, size = np.maximum(cutoff, cutoff_stop) * duration, np.abs(rise)
        most = MOST_PER_LOG * size + 1.0
        segments = np.ceil(np.minimum(np.maximum(angle, FEWEST_PER_LOG * size), most))
        segments = np.where(angle > 0, np.maximum(segments, 1.0), 1.0)
        nothing, none = np.zeros(len(pixel)), np.zeros(len(pixel), np.int64)
        return cls(
            pixel=pixel,
            on=mismatch.threshold_on[pixel].astype(np.float64),
            off=mismatch.threshold_off[pixel].astype(np.float64),
            leak=mismatch.leak[pixel].astype(np.float64),
            brightness=brightness,
            rise=rise,
            cutoff=cutoff,
            cutoff_start=cutoff,
            offset_intensity=exponential(brightness),
            growth_ratio=exponential(rise / segments),
            segments=segments,
            segment=nothing - 1.0,
            begin_us=nothing.copy(),
            end=nothing.copy(),
            now=nothing.copy(),
            lag=brightness - state.output[pixel],
            base=brightness,
            slope=rise / duration,
            transient=nothing.copy(),
            kept=nothing + 1.0,
            level=state.level[pixel].copy(),
            since=(state.since_us[pixel] - span_us[0]).astype(np.float64),
            next_noise=none,
            noise_stop=none,
        )

    def only(self, chosen: BoolArray) -> _CircuitPixels:
        """Some of the pixels."""
        return _CircuitPixels(*(getattr(self, field.name)[chosen] for field in fields(self)))

    def put(self, chosen: BoolArray, other: _CircuitPixels) -> None:
        """Take over the state of some pixels."""
        for field in fields(self):
            getattr(self, field.name)[chosen] = getattr(other, field.name)

    def enter_segment(self, light: PhotoreceptorInput, duration: float) -> None:
        """Begin the next segment; docs/design.md says what is solved here."""
        self.segment = self.segment + 1.0
        length = duration / self.segments
        is_last = self.segment == self.segments - 1.0
        self.now, self.begin_us = self.segment * length, self.segment * length
        self.end = np.where(is_last, duration, (self.segment + 1.0) * length)
        per_level, input_slope = light.optics.cutoff_per_level, self.rise / duration
        if per_level == 0:
            self.lag = np.zeros(self.lag.shape)
            return
        ahead = self.offset_intensity * self.growth_ratio
        middle = np.sqrt(self.offset_intensity * ahead)
        mean = (self.offset_intensity + ahead) * (1 / 6) + middle * (2 / 3)
        most = light.optics.most_current
        cutoff, cutoff_stop = (per_level * np.minimum(one, most) for one in (mean, ahead))
        angle = cutoff * length
        kept, gain = decay_and_gain(angle)
        is_straight = angle < STRAIGHT
        bend = (cutoff_stop - self.cutoff_start) / cutoff * 0.5
        curl = np.where(is_straight, 0.0, (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle))
        lag, lag_stop = self.lag, self.lag * kept + input_slope * length * (gain - bend * curl)
        drop = input_slope - self.cutoff_start * lag
        remaining = np.where(is_straight, 1.0, angle - 1.0 + kept)
        self.transient = np.where(is_straight, 0.0, (lag_stop - lag - drop * length) / remaining)
        drop = np.where(is_straight, (lag_stop - lag) / length, drop + cutoff * self.transient)
        self.slope = input_slope - drop
        self.base = (
            self.brightness
            + input_slope * self.now
            - (lag - self.transient)
            - self.slope * self.now
        )
        self.cutoff, self.kept, self.lag = cutoff, kept, lag_stop
        self.cutoff_start, self.offset_intensity = cutoff_stop, ahead


class _EventFinder:
    """Advances pixels through an interval and collects their events."""

    def __init__(self, noise: NoiseEvents, refractory_us: int, span_us: tuple[int, int]) -> None:
        self._noise_after = np.append((noise.t - span_us[0]).astype(np.float64), NEVER)
        self._noise_p = np.append(noise.p, np.uint8(0))
        self._refractory_us = refractory_us
        self._span_us = span_us
        self._found: list[tuple[NDArray[np.int64], ...]] = []

    def events(self) -> UnsortedEvents:
        """The events found, by pixel, then in time."""
        nothing = np.empty(0, np.int64)
        columns = [np.concatenate([nothing, *parts]) for parts in zip(*self._found, strict=True)]
        if not columns:
            return UnsortedEvents.none()
        pixel, t, p, label = columns
        # Stable, so a pixel's events keep their order.
        order = np.argsort(pixel, kind="stable")
        kinds = p.astype(np.uint8), label.astype(np.uint8)
        return UnsortedEvents(pixel[order], t[order], kinds[0][order], kinds[1][order])

    def run(self, active: _CircuitPixels, light: PhotoreceptorInput) -> _CircuitPixels:
        """Advance every pixel to its next segment, event or release, until all are at the end."""
        duration = float(self._span_us[1] - self._span_us[0])
        active.enter_segment(light, duration)
        unfinished = np.ones(len(active.pixel), np.bool_)
        while unfinished.any():
            step = active.only(unfinished)
            reaches_end = self._advance(step)
            goes_on = reaches_end & (step.segment < step.segments - 1.0)
            into = step.only(goes_on)
            into.enter_segment(light, duration)
            step.put(goes_on, into)
            active.put(unfinished, step)
            unfinished[unfinished] = ~reaches_end | goes_on
        return active

    def _advance(self, active: _CircuitPixels) -> BoolArray:
        """Advance to the next event or the end of the segment; which pixels reached the end."""
        held = active.since > active.now
        while (passed := held & (self._next_noise(active) < active.since)).any():
            active.next_noise = active.next_noise + passed
        waits = held & (active.since > active.end)
        now = np.where(held & ~waits, active.since, active.now)
        left = exponential(-active.cutoff * (now - active.begin_us))
        transient = active.transient * left
        transient[np.abs(transient) <= NEGLIGIBLE * np.minimum(active.on, active.off)] = 0.0
        output = active.base + active.slope * now - transient
        active.level = np.where(np.isnan(active.level) & ~waits, output, active.level)
        change = np.where(waits, 0.0, output - active.level + active.leak * (now - active.since))
        remaining = active.end - now
        curve = ChangeCurve(
            change,
            active.slope + active.leak,
            transient,
            active.cutoff,
            remaining,
            active.kept / left,
        )
        wait, p = time_to_threshold(curve, active.on, active.off)
        crossing, arrival = now + wait, self._next_noise(active)
        event = np.minimum(crossing, arrival)
        fires = (event <= active.end) & ~waits
        active.now = np.where(fires, event, now)
        self._fire(active, fires, fires & (arrival <= crossing), p)
        return ~fires

    def _next_noise(self, active: _CircuitPixels) -> Float64Array:
        is_left = active.next_noise < active.noise_stop
        return np.where(is_left, self._noise_after[active.next_noise], NEVER)

    def _fire(
        self,
        active: _CircuitPixels,
        fires: BoolArray,
        by_noise: BoolArray,
        p: NDArray[np.uint8],
    ) -> None:
        start_us, stop_us = self._span_us
        p = np.where(by_noise, self._noise_p[active.next_noise], p)
        by_leak = (p == 1) & (active.leak * (active.now - active.since) >= LEAK_SHARE * active.on)
        label = np.where(by_noise | by_leak, NOISE, SIGNAL)
        after = np.floor(active.now)
        t = np.minimum(start_us + after.astype(np.int64), stop_us - 1)
        self._found.append((active.pixel[fires], t[fires], p[fires].astype(np.int64), label[fires]))
        active.next_noise = active.next_noise + by_noise
        # Set when the pixel is released: at once without a refractory period.
        active.level = np.where(fires, np.nan, active.level)
        # The refractory period: the pixel is held in reset until then.
        active.since = np.where(fires, after + self._refractory_us, active.since)
