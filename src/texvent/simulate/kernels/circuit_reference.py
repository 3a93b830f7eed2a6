"""The definition of the pixel circuit, one pixel at a time, in float64."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from texvent.events import NOISE, SIGNAL
from texvent.simulate.firings import Firings
from texvent.simulate.kernels.circuit import (
    Arrivals,
    Drive,
    Pixels,
    PixelState,
    ResetRules,
    advance_quietly,
    bounds_of_change,
)

NEVER = math.inf
LONGEST_ANGLE = 0.5
"""Up to here the approximant of `answer_to_line` is used as it is."""
LEAK_SHARE = 0.5
"""An ON event is noise if leakage made at least this share of its change."""


def advance_pixels(
    drive: Drive,
    pixels: Pixels,
    state: PixelState,
    noise: Arrivals,
    rules: ResetRules,
    span_us: tuple[int, int],
) -> Firings:
    """Every event between two frames; moves the state to the end of the interval.

    The change grows with the photoreceptor's output and with the leak. Where it reaches the ON
    threshold or falls to minus the OFF threshold, the pixel fires and the change starts again from
    zero. A noise event fires at its own time. A pixel that fired is held in reset for the
    refractory period: its change is zero until it is released.

    Args:
        drive: brightness and photoreceptors over the interval.
        pixels: thresholds and leak rates.
        state: at the start; changed in place.
        noise: noise events, by pixel and then by time.
        rules: what an event does to its pixel.
        span_us: start (included) and stop (excluded), µs.

    Returns:
        The events by pixel, then in time; times rounded down, never the stop itself.
    """
    start_us, stop_us = span_us
    duration = stop_us - start_us
    low, high = bounds_of_change(drive, pixels, state, duration)
    active = (high >= pixels.threshold_on) | (-low >= pixels.threshold_off)
    active |= state.release_us > start_us
    active[noise.pixel] = True
    before = state.copied()
    state.take(advance_quietly(drive, pixels, state, duration))
    fired: list[tuple[int, float, int, int]] = []
    for i in np.flatnonzero(active).tolist():
        own = slice(*np.searchsorted(noise.pixel, [i, i + 1]))
        circuit = _Circuit(
            threshold_on=float(pixels.threshold_on[i]),
            threshold_off=float(pixels.threshold_off[i]),
            leak=float(pixels.leak[i]),
            rules=rules,
            change=float(before.change[i]),
            leaked=float(before.leaked[i]),
            release=float(before.release_us[i] - start_us),
            noise=list(zip((noise.t[own] - start_us).tolist(), noise.p[own].tolist(), strict=True)),
        )
        state.lag[i] = _run(circuit, drive, i, float(before.lag[i]), duration)
        state.change[i], state.leaked[i] = circuit.change, circuit.leaked
        state.release_us[i] = start_us + int(circuit.release)
        fired += [(i, *event) for event in circuit.fired]
    pixel, offset, p, label = np.array(fired, np.float64).reshape(-1, 4).T
    t = np.minimum(start_us + np.floor(offset).astype(np.int64), stop_us - 1)
    return Firings(pixel.astype(np.int64), t, p.astype(np.uint8), label.astype(np.uint8))


def _run(circuit: _Circuit, drive: Drive, i: int, lag: float, duration: int) -> float:
    """Send the pixel through the pieces of the interval; returns the lag at its end."""
    pieces = int(drive.pieces[i])
    length = duration / pieces
    rise = float(drive.rise[i]) / pieces
    glow, growth = float(drive.glow[i]), float(drive.growth[i])
    for piece in range(pieces):
        angle = drive.corner_per_level * (glow + drive.corner_level) * length
        glow *= growth
        decay, gain = answer_to_line(angle)
        new_lag = decay * lag + gain * rise
        slope = (rise - (new_lag - lag)) / length + circuit.leak
        end = duration if piece == pieces - 1 else (piece + 1) * length
        circuit.run_piece(piece * length, end, slope)
        lag = new_lag
    return lag


def answer_to_line(angle: float) -> tuple[float, float]:
    """`e^(−a)` and `(1 − e^(−a)) / a`; (0, 0), no lag, if nothing limits the bandwidth.

    By the Padé approximant [2/2] of e^(−a), whose error is below a⁵ / 720, so 1.4e-6 for a = 1/4:
    it needs no exponential, whose last bit differs between libraries. Above a = 1/2, by squaring
    that of a / 2ⁿ, which is 1/8 at most.
    """
    if angle == 0:
        return 0.0, 0.0
    short, squarings = angle, 0
    if angle > LONGEST_ANGLE:
        while short > LONGEST_ANGLE / 4:
            short *= 0.5
            squarings += 1
    even, odd = 1.0 + short * short / 12.0, short / 2.0
    decay = (even - odd) / (even + odd)
    if squarings == 0:
        return decay, 1.0 / (even + odd)
    for _ in range(squarings):
        decay *= decay
    return decay, (1.0 - decay) / angle


@dataclass
class _Circuit:
    """One pixel; times are µs since the start of the interval."""

    threshold_on: float
    threshold_off: float
    leak: float
    rules: ResetRules
    change: float
    leaked: float
    release: float
    noise: list[tuple[int, int]]
    fired: list[tuple[float, int, int]] = field(default_factory=list)

    def run_piece(self, now: float, end: float, slope: float) -> None:
        """Fire what there is to fire from `now` to `end` while the change grows by `slope`/µs."""
        while True:
            if self.release > now:
                self.change = self.leaked = 0.0
                while self.noise and self.noise[0][0] < self.release:
                    self.noise.pop(0)
                if self.release > end:
                    return
                now = self.release
            wait, p = self._time_to_threshold(slope)
            crossing = now + wait
            arrival = self.noise[0][0] if self.noise else NEVER
            event = min(crossing, arrival)
            if event > end:
                self._move(end - now, slope)
                return
            self._move(event - now, slope)
            now = event
            if arrival <= crossing:
                self._fire(now, self.noise.pop(0)[1], NOISE, resets=self.rules.by_noise)
            else:
                is_leak = p == 1 and self.leaked >= LEAK_SHARE * self.threshold_on
                self._fire(now, p, NOISE if is_leak else SIGNAL, resets=True)

    def _time_to_threshold(self, slope: float) -> tuple[float, int]:
        """Time until the change reaches a threshold at this slope, µs, and the polarity."""
        if self.change >= self.threshold_on:
            return 0.0, 1
        if -self.change >= self.threshold_off:
            return 0.0, 0
        if slope > 0:
            return (self.threshold_on - self.change) / slope, 1
        if slope < 0:
            return (-self.threshold_off - self.change) / slope, 0
        return NEVER, 0

    def _move(self, elapsed: float, slope: float) -> None:
        self.change += slope * elapsed
        self.leaked += self.leak * elapsed

    def _fire(self, now: float, p: int, label: int, *, resets: bool) -> None:
        self.fired.append((now, p, label))
        if resets:
            self.change = self.leaked = 0.0
            if self.rules.refractory_us > 0:
                self.release = float(math.floor(now) + self.rules.refractory_us)
