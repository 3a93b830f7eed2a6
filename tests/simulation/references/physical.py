"""The definition of the pixel circuit: one pixel after the other, event by event."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tests.simulation.references.sorting import sort_events

from texvent.events import NOISE, SIGNAL
from texvent.runtime.jit import jit
from texvent.simulation.kernels import elementary
from texvent.simulation.kernels.compiled_elementary import decay_and_gain, exponential, natural_log
from texvent.simulation.packets import SortedEvents, UnsortedEvents
from texvent.simulation.physical.circuit import (
    CircuitState,
    Float64Array,
    Luma,
    NoiseEvents,
    PhotoreceptorConstants,
    PhotoreceptorInput,
    brightness_and_cutoff,
)
from texvent.simulation.physical.crossing_time import LAST_STEP, MOST_STEPS, NEGLIGIBLE, NEVER
from texvent.simulation.physical.simd_lanes import SETTLED
from texvent.simulation.physical.simd_steps import (
    FEWEST_PER_LOG,
    LEAK_SHARE,
    MOST_PER_LOG,
    STRAIGHT,
)
from texvent.simulation.random.mismatch import PixelMismatch


def advance_pixels(
    light: PhotoreceptorInput,
    mismatch: PixelMismatch,
    state: CircuitState,
    noise: NoiseEvents,
    refractory_us: int,
    span_us: tuple[int, int],
) -> SortedEvents:
    """As `physical.circuit_kernel.advance_pixels`."""
    before, cutoff = _convert(light.before, light)
    now, cutoff_stop = _convert(light.now, light)
    light.before[:] = light.now
    duration = float(span_us[1] - span_us[0])
    low = np.minimum(state.output, np.minimum(before, now))
    high = np.maximum(state.output, np.maximum(before, now))
    drift = mismatch.leak.astype(np.float64) * (span_us[1] - state.since_us)
    # A low-pass stays within the range of its output and its input; held pixels have level NaN.
    rises = high - state.level + drift >= mismatch.threshold_on
    may_fire = rises | (state.level - low >= mismatch.threshold_off) | np.isnan(state.level)
    may_fire[noise.pixel] = True
    lag = before - state.output
    if light.optics.cutoff_per_level > 0:
        decay, gain = elementary.decay_and_gain((cutoff + cutoff_stop) * 0.5 * duration)
        lag = decay * lag + gain * (now - before)
    else:
        lag[:] = 0.0
    found: list[tuple[int, ...]] = []
    for i in np.flatnonzero(may_fire):
        own = slice(*np.searchsorted(noise.pixel, [i, i + 1]))
        circuit = _Circuit(
            before[i], now[i] - before[i], cutoff[i], cutoff_stop[i], before[i] - state.output[i],
            *(np.float64(column[i]) for column in mismatch), state.level[i],
            float(state.since_us[i] - span_us[0]),
        )  # fmt: skip
        arrivals = (noise.t[own] - span_us[0]).astype(np.float64), noise.p[own]
        lag[i], state.level[i], since, events = _advance(
            circuit, arrivals, light.optics, duration, refractory_us
        )
        state.since_us[i] = span_us[0] + int(since)
        found += [(i, span_us[0] + after, p, label) for after, p, label in events]
    lag[np.abs(lag) < SETTLED] = 0.0
    state.output[:] = now - lag
    pixel, t, p, label = np.array(found, np.int64).reshape(-1, 4).T
    fired = UnsortedEvents(pixel, t, p.astype(np.uint8), label.astype(np.uint8))
    return sort_events(fired, span_us, light.shape)


def _convert(luma: Luma, light: PhotoreceptorInput) -> tuple[Float64Array, Float64Array]:
    """Brightness and cutoff frequency, from the table where there is one."""
    if light.table is not None:
        return light.table[0][luma], light.table[1][luma]
    return brightness_and_cutoff(luma.astype(np.float64), light.optics)


class _Circuit(NamedTuple):
    """A pixel at the start of the interval; times in µs since then."""

    brightness: float
    rise: float
    cutoff: float
    """ω at the start."""
    cutoff_stop: float
    """ω at the end."""
    lag: float
    on: float
    off: float
    leak: float
    level: float
    since: float


@jit(error_model="numpy")
def _advance(
    circuit: _Circuit,
    noise: tuple[Float64Array, NDArray[np.uint8]],
    optics: PhotoreceptorConstants,
    duration: float,
    refractory_us: int,
) -> tuple[float, float, float, list[tuple[int, int, int]]]:
    """Lag, level and release at the end of the interval; and events: µs, p and label."""
    brightness, rise, cutoff, cutoff_stop, lag, on, off, leak, level, since = circuit
    (arrivals, polarities), k = noise, 0
    size, angle = abs(rise), max(cutoff, cutoff_stop) * duration
    segments = math.ceil(min(max(angle, FEWEST_PER_LOG * size), MOST_PER_LOG * size + 1.0))
    segments = max(segments, 1) if angle > 0 else 1
    current, growth = exponential(brightness), exponential(rise / segments)
    length, line = duration / segments, (brightness, rise / duration, 0.0, cutoff, 1.0)
    events = [(0, 0, 0)][:0]
    for segment in range(segments):
        now = begin = segment * length
        end = duration if segment == segments - 1 else (segment + 1) * length
        if optics.cutoff_per_level == 0:
            lag = 0.0
        else:
            lag, cutoff, line = _enter_segment(
                (lag, cutoff, current, current * growth),
                (brightness + rise / duration * begin, rise / duration),
                (begin, length),
                optics,
            )
            current *= growth
        base, slope, transient, omega, kept = line
        while True:
            while since > now and k < arrivals.size and arrivals[k] < since:
                k += 1
            if since > end:
                break
            now = max(now, since)
            left = exponential(-omega * (now - begin))
            remaining = transient * left
            remaining = 0.0 if abs(remaining) <= NEGLIGIBLE * min(on, off) else remaining
            output = base + slope * now - remaining
            level = output if math.isnan(level) else level
            change = output - level + leak * (now - since)
            curve = ChangeCurve(change, slope + leak, remaining, omega, end - now, kept / left)
            wait, is_on = time_to_threshold(curve, on, off)
            crossing, arrival = now + wait, arrivals[k] if k < arrivals.size else NEVER
            now = min(crossing, arrival)
            if now > end:
                break
            is_noise = arrival <= crossing
            if is_noise:
                is_on = polarities[k] == 1
                k += 1
            is_noise |= is_on and leak * (now - since) >= LEAK_SHARE * on
            after = math.floor(now)
            last = int(duration) - 1
            events.append((min(int(after), last), int(is_on), NOISE if is_noise else SIGNAL))
            # The pixel is held in reset until its release, which sets the level.
            level, since = np.nan, float(after + refractory_us)
    return lag, level, since, events


@jit(error_model="numpy")
def _enter_segment(
    start: tuple[float, float, float, float],
    light: tuple[float, float],
    times: tuple[float, float],
    optics: PhotoreceptorConstants,
) -> tuple[float, float, tuple[float, float, float, float, float]]:
    """The output on a segment, `base + slope · now − transient`; docs/design.md has the solution.

    Returns:
        Lag and cutoff at the end; and base, slope, transient, cutoff, and the share that is left
        of the transient at the end.
    """
    (lag, cutoff_start, here, ahead), (brightness, input_slope) = start, light
    begin, length = times
    mean = (here + ahead) * (1 / 6) + math.sqrt(here * ahead) * (2 / 3)
    cutoff, cutoff_stop = (
        optics.cutoff_per_level * min(mean, optics.most_current),
        optics.cutoff_per_level * min(ahead, optics.most_current),
    )
    angle = cutoff * length
    kept, gain = decay_and_gain(angle)
    is_straight = angle < STRAIGHT
    bend = (cutoff_stop - cutoff_start) / cutoff * 0.5
    curl = 0.0 if is_straight else (angle - 2.0 + kept * (angle + 2.0)) / (angle * angle)
    lag_stop = lag * kept + input_slope * length * (gain - bend * curl)
    drop, transient = input_slope - cutoff_start * lag, 0.0
    if is_straight:
        drop = (lag_stop - lag) / length
    else:
        transient = (lag_stop - lag - drop * length) / (angle - 1.0 + kept)
        drop = drop + cutoff * transient
    slope = input_slope - drop
    base = brightness - (lag - transient) - slope * begin
    return lag_stop, cutoff_stop, (base, slope, transient, cutoff, kept)


class ChangeCurve(NamedTuple):
    """The change of a pixel from now on: `x + S u + D (1 − e^(−ω u))` after a time u."""

    change: float
    """x, now, log units."""
    slope: float
    """S, log units per µs."""
    transient: float
    """D, log units."""
    cutoff: float
    """ω, 1/µs."""
    duration: float
    """How long this lasts, µs."""
    kept: float
    """e^(−ω duration): what is left of the transient then."""


@jit(error_model="numpy")
def change_after(curve: ChangeCurve, u: float, kept: float) -> float:
    """The change after a time, when e^(−ω u) of the transient is left."""
    return curve.change + curve.slope * u + curve.transient * (1.0 - kept)


@jit(error_model="numpy")
def time_to_threshold(curve: ChangeCurve, on: float, off: float) -> tuple[float, bool]:
    """Time until the change reaches `on` or `−off`, µs, or `NEVER`; and whether it is ON.

    A curve has at most one extremum, and is monotonic on the arc before and after it.
    """
    change, slope, transient, cutoff, duration, kept = curve
    if change >= on or -change >= off:
        return 0.0, change >= on
    if abs(transient) <= NEGLIGIBLE * min(on, off):
        wait = ((on if slope > 0 else -off) - change) / slope if slope != 0 else NEVER
        return (NEVER if wait > duration else wait), slope > 0
    first = slope + cutoff * transient
    stop, left = duration, kept
    if first * slope < 0:
        ratio = -(cutoff * transient) / slope
        turn = natural_log(ratio) / cutoff
        if turn < duration:
            stop, left = turn, 1.0 / ratio
    level = change_after(curve, stop, left)
    rises = first > 0 if first != 0 else slope > 0
    if (level >= on) if rises else (-level >= off):
        target = on if rises else -off
        return _solve(curve, (0.0, stop), (1.0, left), (change, level), target), rises
    rises, last = slope > 0, change_after(curve, duration, kept)
    if stop < duration and ((last >= on) if rises else (-last >= off)):
        target = on if rises else -off
        return _solve(curve, (stop, duration), (left, kept), (level, last), target), rises
    return NEVER, rises


@jit(error_model="numpy")
def _solve(
    curve: ChangeCurve,
    times: tuple[float, float],
    kept: tuple[float, float],
    changes: tuple[float, float],
    target: float,
) -> float:
    """When a monotonic arc reaches the target: Halley's method.

    It starts from the time at which the line alone, or the transient alone, reaches the target:
    whichever changes more.
    """
    start, stop = times
    part = (target - changes[0]) / (changes[1] - changes[0])
    line, fall = stop - start, kept[0] - kept[1]
    if abs(curve.slope) * line >= abs(curve.transient) * fall:
        u = start + part * line
    else:
        u = -natural_log(kept[0] - part * fall) / curve.cutoff
    u = min(max(u, start), stop)
    for _ in range(MOST_STEPS):
        left = exponential(-curve.cutoff * u)
        excess = change_after(curve, u, left) - target
        decay_slope = curve.cutoff * curve.transient * left
        tangent = curve.slope + decay_slope
        newton = 2.0 * tangent * tangent
        denominator = newton + excess * (curve.cutoff * decay_slope)
        # Newton's step where Halley's would be more than twice as long.
        denominator = newton if 2.0 * denominator < newton else denominator
        step = 2.0 * excess * tangent / denominator if denominator > 0 else 0.0
        u = min(max(u - step, start), stop)
        if abs(step) * curve.cutoff <= LAST_STEP:
            break
    return u
