"""Deflicker: divide fast changes of the global gain out of the frames of generated video.

Text-to-video models change the brightness of a whole frame by a few percent from frame to frame. A
pixel model then fires everywhere, and Eq. 4 counts more frames. Real fades are slow, so the fast
part of the gain is divided out and the slow part stays.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from texvent.brightness import Float64Array
from texvent.frames import UINT16_PER_LEVEL, Frame
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.transfer import Transfer

SIDE_CELLS = 64
"""Frames are compared as means over cells, at most this many along the longer side."""
DARK, BRIGHT = 8.0, 247.0
"""Levels outside this range are clipped or noise: they do not follow a gain."""
DARK_LIGHT = 0.6
"""The same for linear light, which nothing clips: what `DARK` codes, on the 0..255 scale."""
LEAST_USED = 0.05
"""Share of the cells that must be inside that range."""
CELLS_MOVING_TOGETHER = 16
"""Neighbouring cells change alike when something moves, so this many count as one sample."""
SIGNIFICANT = 2.5
"""A median of at least this many standard errors is a gain; motion alone stays below."""
MEDIAN_ERROR = 1.86
"""Standard error of a median, in median absolute deviations, times the root of the samples:
1.2533 / 0.6745 for a normal distribution."""
PASSED_SHARE = 0.2
"""Share of a lasting change that passes per frame: a real fade lags by five frames."""
TOLERANCE = 0.002
"""Corrections below this (log units) are left out, so that steady frames pass untouched."""


def steady_frames(frames: Iterator[Frame]) -> Iterator[Frame]:
    """The frames with fast changes of their global gain divided out.

    The gain restarts at a cut or a flash.

    Yields:
        One frame per frame, same time and kind: the frame itself where no correction is needed,
        else its pixels times one number, float32, 0..255 scale.
    """
    previous: Frame | None = None
    gain = followed = 0.0
    for frame in frames:
        if previous is not None:
            if detect_scene_change(previous, frame) is not SceneChange.NONE:
                gain = followed = 0.0
            else:
                gain += global_gain(previous, frame)
            followed += PASSED_SHARE * (gain - followed)
        previous = frame
        yield _scaled(frame, followed - gain)


def global_gain(first: Frame, second: Frame) -> float:
    """The gain of the whole frame from one frame to the next, log units.

    Returns:
        The median of ln(I₂ / I₁) over cells; 0 if motion alone may explain it, or too few cells can
        be used.
    """
    earlier, later = _cells(first), _cells(second)
    dark, bright = (DARK_LIGHT, math.inf) if first.transfer is Transfer.LINEAR else (DARK, BRIGHT)
    used = (earlier > dark) & (earlier < bright) & (later > dark) & (later < bright)
    if used.mean() < LEAST_USED:
        return 0.0
    ratio = np.log(later[used] / earlier[used])
    gain = float(np.median(ratio))
    samples = max(1.0, ratio.size / CELLS_MOVING_TOGETHER)
    error = MEDIAN_ERROR * float(np.median(np.abs(ratio - gain))) / math.sqrt(samples)
    return gain if abs(gain) >= SIGNIFICANT * error else 0.0


def _cells(frame: Frame) -> Float64Array:
    luma = frame.luma
    side = max(1, -(-max(luma.shape) // SIDE_CELLS))
    side = min(side, *luma.shape)
    rows, columns = luma.shape[0] // side, luma.shape[1] // side
    cells = luma[: rows * side, : columns * side].reshape(rows, side, columns, side)
    return np.asarray(cells.mean(axis=(1, 3), dtype=np.float64))


def _scaled(frame: Frame, log_factor: float) -> Frame:
    if abs(log_factor) < TOLERANCE:
        return frame
    factor = math.exp(log_factor)
    if frame.pixels.dtype == np.uint16:
        factor /= UINT16_PER_LEVEL
    pixels = np.asarray(frame.pixels * np.float64(factor), dtype=np.float32)
    return replace(frame, pixels=pixels)
