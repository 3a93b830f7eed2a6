"""The pixel circuits of the `physical` model as a Triton kernel.

A program owns a block of pixels of one clip and goes through all intervals of a call with their
state in registers: once to count the events, once more to write them. Pixels that may fire advance
in linear segments, event by event, as lanes of the CPU's kernel do; see `..simd_steps`.
"""

from __future__ import annotations

from typing import NamedTuple

import triton
import triton.language as tl

from texvent.simulation.gpu.blocks_triton import (
    count_bad,
    find_cell,
    own_pixels,
    pack_event,
    read,
    read_share,
    skip_frames,
)
from texvent.simulation.gpu.elementary_triton import decay_and_gain, exponential
from texvent.simulation.gpu.kernel_types import Tensor
from texvent.simulation.physical import simd_lanes, simd_steps
from texvent.simulation.physical.gpu import light
from texvent.simulation.physical.gpu.arrivals import FILLER, PackedArrivals
from texvent.simulation.physical.gpu.crossing_triton import NEGLIGIBLE, find_crossings
from texvent.simulation.physical.gpu.light import brightness_of, rules_of

_CUTOFF_PER_LEVEL = tl.constexpr(light.CUTOFF_PER_LEVEL)
_MOST_CURRENT = tl.constexpr(light.MOST_CURRENT)
_REFRACTORY_US = tl.constexpr(light.REFRACTORY_US)
_SETTLED, _STRAIGHT = tl.constexpr(simd_lanes.SETTLED), tl.constexpr(simd_steps.STRAIGHT)
_FEWEST_PER_LOG = tl.constexpr(simd_steps.FEWEST_PER_LOG)
_MOST_PER_LOG = tl.constexpr(simd_steps.MOST_PER_LOG)
_LEAK_SHARE = tl.constexpr(simd_steps.LEAK_SHARE)
_FILLER = tl.constexpr(FILLER)


class CircuitTensors(NamedTuple):
    """The pixels of all clips; [B, area] each."""

    threshold_on: Tensor
    """Float32, log units, as are the next two."""
    threshold_off: Tensor
    leak: Tensor
    """Log units per µs."""
    output: Tensor
    """See `circuit.CircuitState`; float64."""
    level: Tensor
    """The same; before the first interval, how far below the brightness it begins."""
    since_us: Tensor
    """The same; int64."""
    noise: PackedArrivals | None
    """Noise of a call."""


@triton.jit
def scan_circuit(
    frames: tl.tuple,
    intervals: tl.tuple,
    rules: tl.tuple,
    state: tl.tuple,
    tally: tl.tuple,
    words: tl.tensor,
    ALIGN: tl.constexpr,
    BLOCK: tl.constexpr,
) -> None:
    """Find the events of every interval.

    Args:
        frames: `kernel_types.FrameLayout`.
        intervals: `kernel_types.Intervals`.
        rules: `light.PhysicalRules`.
        state: `CircuitTensors`; brought up to date in pass 2.
        tally: `kernel_types.PassCounts`.
        words: [n] int64, see `blocks_triton.pack_event`; None for pass 1, which counts.
        ALIGN: see `kernel_types.Call`.
        BLOCK: pixels of a program.
    """
    clip, at, inside, home, pixels = own_pixels(frames, ALIGN, BLOCK)
    rules = rules_of(rules, clip)
    refractory_us = tl.load(rules.numbers + _REFRACTORY_US)
    on, off, leak, output, level, since_us, number = _load_pixels(state, home, inside)
    arrival = _read_arrival(state.noise, number, at, inside)
    last = read(frames.previous + home, inside)
    bad = count_bad(last, inside)
    before, cutoff = brightness_of(last, rules)
    for interval in range(frames.intervals):
        segment = clip * frames.intervals + interval
        start_us = tl.load(intervals.start_us + segment)
        duration_us = tl.load(intervals.duration_us + segment)
        axis_us = start_us + tl.load(intervals.origin_us + segment)
        last = read(pixels + skip_frames(frames, interval, ALIGN), inside)
        now, cutoff_now = brightness_of(last, rules)
        if read_share(intervals, segment) == 1:
            output = before
            level = before - level
            since_us = tl.zeros([BLOCK], tl.int64) + start_us
        cell = find_cell(tally, segment)
        place = tl.load(cell) if tally.bad is None else tl.full([], 0, tl.int64)
        output, level, since, number, arrival, place = _advance_interval(
            (at, inside, frames.area),
            (before, now, cutoff, cutoff_now),
            (on, off, leak, refractory_us),
            (output, level, (since_us - start_us).to(tl.float64), number, arrival, place),
            (axis_us, duration_us),
            (rules, state.noise, words),
        )
        since_us = start_us + since.to(tl.int64)
        if tally.bad is not None:
            tl.store(cell, place)
            bad += count_bad(last, inside)
        before, cutoff = now, cutoff_now
    if tally.bad is not None:
        tl.atomic_add(tally.bad, tl.sum(bad))
    else:
        _store_pixels(state, (output, level, since_us), home, inside)


@triton.jit
def _store_pixels(state: tl.tuple, pixels: tl.tuple, home: tl.tensor, inside: tl.tensor) -> None:
    """Bring output, level and time of the last event up to date."""
    output, level, since_us = pixels
    tl.store(state.output + home, output, mask=inside)
    tl.store(state.level + home, level, mask=inside)
    tl.store(state.since_us + home, since_us, mask=inside)


@triton.jit
def _load_pixels(state: tl.tuple, home: tl.tensor, inside: tl.tensor) -> tl.tuple:
    """The items of `CircuitTensors`, and the numbers of the first noise events."""
    on = tl.load(state.threshold_on + home, mask=inside, other=1.0).to(tl.float64)
    off = tl.load(state.threshold_off + home, mask=inside, other=1.0).to(tl.float64)
    leak = tl.load(state.leak + home, mask=inside, other=0.0).to(tl.float64)
    output = tl.load(state.output + home, mask=inside, other=0.0)
    level = tl.load(state.level + home, mask=inside, other=0.0)
    since_us = tl.load(state.since_us + home, mask=inside, other=0)
    number = tl.zeros(home.shape, tl.int64)
    if state.noise is not None:
        number = tl.load(state.noise.first + home, mask=inside, other=0)
    return on, off, leak, output, level, since_us, number


@triton.jit
def _read_arrival(noise: tl.tuple, number: tl.tensor, at: tl.tensor, where: tl.tensor) -> tl.tensor:
    """Time of a noise event on the common axis, µs, times 2, plus its polarity."""
    if noise is not None:
        word = tl.load(noise.words + number, mask=where, other=_FILLER)
        arrival = word - at.to(tl.int64) * noise.axis_us * 2
    else:
        arrival = number + _FILLER
    return arrival


@triton.jit
def _is_quiet(light: tl.tuple, pixel: tl.tuple, state: tl.tuple, duration: tl.tensor) -> tl.tensor:
    """Whether pixels cannot fire but by noise; see `..circuit_kernel`."""
    before, now, _, _ = light
    on, off, leak, _ = pixel
    output, level, since = state
    high = tl.maximum(output, tl.maximum(before, now))
    low = tl.minimum(output, tl.minimum(before, now))
    # Pixels held in reset have level NaN, and may fire.
    return (high - level + leak * (duration - since) < on) & (level - low < off)


@triton.jit
def _follow(light: tl.tuple, lag: tl.tensor, duration: tl.tensor, rules: tl.tuple) -> tl.tensor:
    """Lag of the photoreceptors at the end of an interval, if nothing fires."""
    before, now, cutoff, cutoff_now = light
    if rules.is_limited:
        decay, gain = decay_and_gain((cutoff + cutoff_now) * 0.5 * duration)
        lag = decay * lag + gain * (now - before)
    else:
        lag = tl.zeros(lag.shape, tl.float64)
    return lag


@triton.jit
def _advance_interval(
    own: tl.tuple,
    light: tl.tuple,
    pixel: tl.tuple,
    state: tl.tuple,
    span: tl.tuple,
    shared: tl.tuple,
) -> tl.tuple:
    """Advance pixels through an interval: as if none fired, or segment by segment.

    Args:
        own: numbers of the pixels, which of them exist, and the area.
        light: brightness at both ends, cutoff at both.
        pixel: thresholds, leak and refractory period.
        state: output; level; release since the start of the interval; number and `_read_arrival`
            of the next noise event; place of the next event.
        span: start on the common axis, and duration, µs.
        shared: rules, noise, words.

    Returns:
        The state at the end.
    """
    output, level, since, number, arrival, place = state
    before, now, cutoff, _ = light
    duration = span[1].to(tl.float64)
    lag = before - output
    final_lag = _follow(light, lag, duration, shared[0])
    is_quiet = _is_quiet(light, pixel, (output, level, since), duration)
    active = own[1] & ((is_quiet == 0) | ((arrival >> 1) < span[0] + span[1]))
    if tl.max(active.to(tl.int32)) > 0:
        count, length, growth = _cut_into_segments(light, duration)
        current, index, here = exponential(before), tl.full([], 0.0, tl.float64), active
        while tl.max(here.to(tl.int32)) > 0:
            begin = index * length
            index += 1.0
            end = tl.where(index == count, duration, index * length)
            ahead = current * growth
            lag_ahead, cutoff_ahead, base, slope, transient, omega, kept = _enter_segment(
                light, (lag, cutoff, current, ahead), (begin, length, duration), shared[0]
            )
            line = (base, slope, transient, omega, kept)
            level, since, number, arrival, place = _advance_segment(
                (own[0], here, own[2]), line, pixel, (level, since, number, arrival, place),
                (span[0], span[1], begin, end), shared,
            )  # fmt: skip
            lag, cutoff = tl.where(here, lag_ahead, lag), tl.where(here, cutoff_ahead, cutoff)
            current = tl.where(here, ahead, current)
            here = here & (index < count)
        final_lag = tl.where(active, lag, final_lag)
    output = now - tl.where(tl.abs(final_lag) < _SETTLED, 0.0, final_lag)
    return output, level, since, number, arrival, place


@triton.jit
def _advance_segment(
    own: tl.tuple,
    line: tl.tuple,
    pixel: tl.tuple,
    state: tl.tuple,
    span: tl.tuple,
    shared: tl.tuple,
) -> tl.tuple:
    """Fire every event of pixels on a segment.

    Args:
        own: numbers of the pixels, which of them are on the segment, and the area.
        line: output of their photoreceptors, see `_enter_segment`.
        pixel: as of `_advance_interval`.
        state: that of `_advance_interval` without the output.
        span: that of `_advance_interval`, and begin and end of the segment.
        shared: rules, noise, words.
    """
    at, going, area = own
    level, since, number, arrival, place = state
    axis_us, duration_us, begin, end = span
    _, noise, words = shared
    now = begin
    while tl.max(going.to(tl.int32)) > 0:
        lost = going & (since > now) & _comes_before(arrival, since, axis_us)
        while tl.max(lost.to(tl.int32)) > 0:
            number += lost.to(tl.int64)
            arrival = tl.where(lost, _read_arrival(noise, number, at, lost), arrival)
            lost = lost & _comes_before(arrival, since, axis_us)
        now = tl.where((since > now) & (since <= end), since, now)
        going = going & (since <= now)
        curve, level = _start_step(line, (level, since), pixel, (now, begin, end), going)
        wait, rises = find_crossings(curve, pixel[0], pixel[1])
        crossing, arrival_us = now + wait, (arrival >> 1) - axis_us
        comes = tl.where(arrival_us < duration_us, arrival_us.to(tl.float64), float("inf"))
        going = going & (tl.minimum(crossing, comes) <= end)
        now = tl.where(going, tl.minimum(crossing, comes), now)
        by_noise = comes <= crossing
        after = tl.floor(now)
        fired = going.to(tl.int32)
        if words is not None:
            is_leak = rises & (pixel[2] * (now - since) >= pixel[0] * _LEAK_SHARE)
            is_on = tl.where(by_noise, arrival & 1, rises.to(tl.int64))
            t = axis_us + tl.minimum(after.to(tl.int64), duration_us - 1)
            word = pack_event(t, at, is_on, (by_noise | is_leak).to(tl.int64), area)
            tl.store(words + place + tl.cumsum(fired, 0) - 1, word, mask=going)
        place += tl.sum(fired)
        used = going & by_noise
        number += used.to(tl.int64)
        arrival = tl.where(used, _read_arrival(noise, number, at, used), arrival)
        # Held in reset for the refractory period.
        level = tl.where(going, float("nan"), level)
        since = tl.where(going, after + pixel[3], since)
    return level, since, number, arrival, place


@triton.jit
def _comes_before(arrival: tl.tensor, time: tl.tensor, axis_us: tl.tensor) -> tl.tensor:
    """Whether a noise event comes before a time since the start of the interval."""
    return (arrival >> 1) < axis_us + time.to(tl.int64)


@triton.jit
def _cut_into_segments(light: tl.tuple, duration: tl.tensor) -> tl.tuple:
    """Segments of the interval, their duration, and the factor of intensity on each."""
    before, now, cutoff, cutoff_now = light
    angle, rise = tl.maximum(cutoff, cutoff_now) * duration, now - before
    fewest, most = tl.abs(rise) * _FEWEST_PER_LOG, tl.abs(rise) * _MOST_PER_LOG + 1.0
    count = tl.ceil(tl.minimum(tl.maximum(angle, fewest), most))
    count = tl.where(angle > 0, tl.maximum(count, 1.0), 1.0)
    return count, duration / count, exponential(rise / count)


@triton.jit
def _enter_segment(light: tl.tuple, start: tl.tuple, times: tl.tuple, rules: tl.tuple) -> tl.tuple:
    """Photoreceptors on the next segment: `base + slope · now − transient`; see `..simd_steps`."""
    before, now, _, _ = light
    lag, cutoff, here, ahead = start
    begin, length, duration = times
    input_slope = (now - before) / duration
    if rules.is_limited:
        per_level = tl.load(rules.numbers + _CUTOFF_PER_LEVEL)
        most = tl.load(rules.numbers + _MOST_CURRENT)
        mean = (here + ahead) * (1 / 6) + tl.sqrt(here * ahead) * (2 / 3)
        omega = per_level * tl.minimum(mean, most)
        cutoff_ahead = per_level * tl.minimum(ahead, most)
        angle = omega * length
        kept, gain = decay_and_gain(angle)
        is_straight = angle < _STRAIGHT
        bend = (cutoff_ahead - cutoff) / omega * 0.5
        curl = (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle)
        curl = tl.where(is_straight, 0.0, curl)
        lag_ahead = lag * kept + input_slope * length * (gain - bend * curl)
        drop = input_slope - cutoff * lag
        divisor = tl.where(is_straight, 1.0, angle - 1.0 + kept)
        transient = tl.where(is_straight, 0.0, (lag_ahead - lag - drop * length) / divisor)
        drop = tl.where(is_straight, (lag_ahead - lag) / length, drop + omega * transient)
        slope = input_slope - drop
        base = before + input_slope * begin - (lag - transient) - slope * begin
    else:
        lag_ahead, cutoff_ahead, omega, transient = lag * 0.0, cutoff, cutoff, lag * 0.0
        base, slope, kept = before, input_slope, tl.full(lag.shape, 1.0, tl.float64)
    return lag_ahead, cutoff_ahead, base, slope, transient, omega, kept


@triton.jit
def _start_step(
    line: tl.tuple, state: tl.tuple, pixel: tl.tuple, times: tl.tuple, where: tl.tensor
) -> tl.tuple:
    """The change from now on, as `find_crossings` takes it, and the level."""
    base, slope, transient, omega, kept = line
    level, since = state
    on, off, leak, _ = pixel
    now, begin, end = times
    left = exponential(-omega * (now - begin))
    transient = transient * left
    is_negligible = tl.abs(transient) <= tl.minimum(on, off) * NEGLIGIBLE
    transient = tl.where(is_negligible, 0.0, transient)
    output = base + slope * now - transient
    level = tl.where(where & (level != level), output, level)
    change = tl.where(where, output - level + leak * (now - since), 0.0)
    return (change, slope + leak, transient, omega, end - now, kept / left), level
