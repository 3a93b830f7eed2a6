"""Measure the noise of a sensor: how often pixels fire where nothing changes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.calibrate.estimates import Estimate, Float64Array, bootstrap
from texvent.calibrate.recording import CalibrationRecording, TimeSpan
from texvent.frames import MICROSECONDS, Frame
from texvent.represent.event_frame import count_events
from texvent.simulation.physical.circuit import linearize
from texvent.simulation.physical.config import NoiseCurve

EDGES = (0, 2, 5, 10, 20, 30, 45, 70, 100, 140, 190, 256)
"""Ranges of linear intensity, levels 0..255, whose pixels are counted together."""
LEAK_FROM = 30
"""Intensity from which noise is rare enough to see the leak, levels."""
STILL_LEVELS, STILL_SHARE = 1.5, 0.02
"""A pixel is still if all of its neighbourhood, in the frame before, this one and the next, lies
within 1.5 levels plus 2 % of its intensity, once 3×3 means have averaged out the frames' noise; or
if each pixel of its neighbourhood stays that close to its own mean for a second."""
NEIGHBOURHOOD = np.ones((5, 5), np.uint8)
"""Pixels around one: motion that comes from farther away within a frame is seen too late."""
STATIC_US, STATIC_FRAMES = 1_000_000, 10
"""Time for which a textured neighbourhood must not change for its pixel to be still, µs, and in how
many frames at least this must be seen: three frames do not tell a slow edge from none."""
LEAST_EXPOSURE_S = 20.0
"""Pixel-seconds that a range needs to count."""
LEAST_RANGES = 2
"""Ranges that make a curve."""

BoolArray = NDArray[np.bool_]


class MeasuredNoise(NamedTuple):
    """Noise and leak of still pixels."""

    curve: NoiseCurve
    """Noise, ON and OFF together, by intensity."""
    leak_rate_hz: float
    """ON events per pixel and second that no OFF events match."""
    ends: Float64Array
    """[2, points + 1] lower and upper ends of the 95 % intervals of the rates and of the leak."""

    def estimates(self) -> tuple[Estimate, ...]:
        """The noise at each level and the leak, with their intervals."""
        names = [f"noise at level {level:g}" for level in self.curve.levels]
        values = [*self.curve.rates_hz.tolist(), self.leak_rate_hz]
        return tuple(
            Estimate(name, value, low, high, "1/(px s)")
            for name, value, low, high in zip(
                [*names, "leak_rate_hz"], values, *self.ends.tolist(), strict=True
            )
        )


def measure_noise(
    recording: CalibrationRecording, span: TimeSpan, *, gamma: float, on_fraction: float = 0.5
) -> MeasuredNoise | None:
    """Noise and leak of still pixels.

    A leak makes ON events only, so noise follows from the OFF events, and the leak is what is left
    of the ON events of bright pixels.

    Args:
        recording: frames and events.
        span: which part.
        gamma: exponent that makes the frames linear.
        on_fraction: share of ON among noise events, below 1; a recording at rest gives it.

    Returns:
        The noise, or None if fewer than two ranges of intensity had still pixels for long enough.
    """
    edges = np.array(EDGES)
    size = len(edges) - 1
    rows = []
    for now, (start_us, stop_us), still in _still_pixels(recording, span, gamma):
        group = np.digitize(now[still], edges) - 1
        exposure = (stop_us - start_us) / MICROSECONDS * np.bincount(group, minlength=size)
        events = count_events(recording.events.cut(start_us, stop_us))
        counts = [np.bincount(group, weights=events[p][still], minlength=size) for p in (0, 1)]
        rows.append([exposure, *counts])
    if not rows:
        return None
    parts = np.array(rows)
    exposure = parts[:, 0].sum(axis=0)
    known = exposure >= LEAST_EXPOSURE_S
    if known.sum() < LEAST_RANGES:
        return None
    parts, middle = parts[:, :, known], ((edges[:-1] + edges[1:]) / 2)[known]
    bright = edges[:-1][known] >= LEAK_FROM

    def estimate(weights: Float64Array) -> Float64Array:
        exposure, off, on = np.einsum("f,fkr->kr", weights, parts)
        return _rates_and_leak(exposure, off, on, bright, on_fraction)

    values = estimate(np.ones(len(parts)))
    ends = bootstrap(estimate, (len(parts),))
    # Without an event, a rate of 3 per exposure would have shown one in 95 % of all cases.
    least = np.append(3 / (1 - on_fraction) / exposure[known], 0.0)
    ends[1] = np.maximum(ends[1], least)
    # What stands for no event in the value is no evidence of noise.
    ends[0, :-1][parts[:, 1].sum(axis=0) == 0] = 0.0
    return MeasuredNoise(
        NoiseCurve(np.minimum(middle, 255.0), values[:-1]), float(values[-1]), ends
    )


def _rates_and_leak(
    exposure: Float64Array,
    off: Float64Array,
    on: Float64Array,
    bright: BoolArray,
    on_fraction: float,
) -> Float64Array:
    """Noise rates of all ranges, then the leak, [ranges + 1]."""
    exposure = np.maximum(exposure, 1e-9)
    noise_per_off = 1 / (1 - on_fraction)
    surplus_hz = (on - (noise_per_off - 1) * off)[bright] / exposure[bright]
    # The median: one range in which something flickered or moved does not decide.
    leak_hz = max(float(np.median(surplus_hz)), 0.0) if bright.any() else 0.0
    return np.append(noise_per_off * _rates(off, exposure), leak_hz)


def _rates(counts: Float64Array, exposure: Float64Array) -> Float64Array:
    """Counts over exposure, above 0 also where nothing was counted.

    There, half an event stands for none, and the mean rate of all ranges for what a short exposure
    cannot tell: `0.5 / (exposure + 0.5 / mean)`.
    """
    mean = max(float(counts.sum()), 0.5) / float(exposure.sum())
    return np.where(counts > 0, counts / exposure, 0.5 / (exposure + 0.5 / mean))


def _still_pixels(
    recording: CalibrationRecording, span: TimeSpan, gamma: float
) -> Iterator[tuple[Float64Array, tuple[int, int], BoolArray]]:
    """Intensity, interval and still pixels of the frames of a span that have two neighbours."""
    for window in _windows(recording, span):
        times = [frame.t_us for frame in window]
        seen = [linearize(frame.luma, gamma) for frame in window]
        own = np.mean(seen, axis=0)
        # 3×3 means, edges repeated, average out the frames' noise.
        blurred = (cv2.blur(one, (3, 3), borderType=cv2.BORDER_REPLICATE) for one in seen)
        light = [np.asarray(one, np.float64) for one in blurred]
        static = find_static_pixels(light)
        for i in range(1, len(window) - 1):
            still = find_still_pixels(light[i], light[i - 1 : i + 2]) | static
            # Near an edge, the mean of neighbours is not what the pixel sees.
            yield np.where(static, own, light[i]), (times[i], times[i + 1]), still


def _windows(recording: CalibrationRecording, span: TimeSpan) -> Iterator[list[Frame]]:
    """The frames of a span, a second at a time; neighbouring windows share two frames."""
    window: list[Frame] = []
    for frame in recording.frames:
        if not span.start_us <= frame.t_us < span.stop_us:
            continue
        window.append(frame)
        if frame.t_us - window[0].t_us >= STATIC_US:
            yield window
            window = window[-2:]
    if len(window) > 2:
        yield window


def find_static_pixels(frames: list[Float64Array]) -> BoolArray:
    """Pixels around which time changes nothing, whatever the texture, [H, W].

    A camera at rest has them, and they are many more than those of `find_still_pixels`.

    Args:
        frames: linear intensity, levels 0..255, [H, W]; none is static in fewer than ten.
    """
    if len(frames) < STATIC_FRAMES:
        return np.zeros(frames[0].shape, np.bool_)
    mean = np.mean(frames, axis=0)
    tolerance = STILL_LEVELS + STILL_SHARE * mean
    static = np.ones(mean.shape, np.bool_)
    for frame in frames:
        static &= np.abs(frame - mean) <= tolerance
    return np.asarray(cv2.erode(static.astype(np.uint8), NEIGHBOURHOOD), np.bool_)


def find_still_pixels(now: Float64Array, frames: list[Float64Array]) -> BoolArray:
    """Pixels around which neither space nor time changes anything, [H, W].

    Args:
        now: linear intensity that the others are compared with, levels 0..255, [H, W].
        frames: this frame and its neighbours in time.
    """
    tolerance = STILL_LEVELS + STILL_SHARE * now
    still = np.ones(now.shape, np.bool_)
    for frame in frames:
        still &= cv2.dilate(frame, NEIGHBOURHOOD) - now <= tolerance
        still &= now - cv2.erode(frame, NEIGHBOURHOOD) <= tolerance
    return still
