"""Frames to measure on: known densities, heavy motion, real video at 200 fps equivalent."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.frames import Frame, Video, frame_time_us
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.flow import FlowInterpolator
from texvent.interpolate.pairing import pair_frames
from texvent.sensor import SensorSize

Bytes = NDArray[np.uint8]

DARK, BRIGHT = 100, 173
"""Levels between which pixels jump: by ln(203 / 130) = 0.45 in the paper preset's balanced log, by
0.55 in a plain one: one event of the paper preset, about two of models with several."""
FRAME_US = 5_000
HEAVY_SIZE = SensorSize(346, 260)
HEAVY_FPS = Fraction(24)
HEAVY_GAMMA = 0.92
"""Brings the embedded heavy clip's mean |Δ ln I| to 0.27."""
EXCERPT = Path(__file__).parents[5] / "tests" / "clips" / "bigbuckbunny_excerpt.mp4"
DENSE_FPS = 200


def jumping_pixels(size: SensorSize, density: float, count: int) -> Bytes:
    """Frames in which a random share of the pixels jumps between two levels.

    Returns:
        [count, H, W]; from each frame to the next, forwards or backwards, about `density` of the
        pixels change.
    """
    rng = np.random.default_rng(0)
    bright = np.zeros(size.shape, np.bool_)
    frames = np.empty((count, *size.shape), np.uint8)
    for index in range(count):
        bright ^= rng.random(size.shape, np.float32) < density
        frames[index] = np.where(bright, BRIGHT, DARK)
    return frames


def to_and_fro(frames: Bytes) -> Iterator[Frame]:
    """The frames forwards, backwards and so on, without end, `FRAME_US` apart."""
    order = [*range(len(frames)), *range(len(frames) - 2, 0, -1)]
    for index, which in enumerate(itertools.cycle(order)):
        yield Frame(frames[which], index * FRAME_US)


def embedded_heavy_clip(size: SensorSize = HEAVY_SIZE, count: int = 9) -> Video:
    """Two textures that pan against each other, 5 px per frame: mean |Δ ln I| about 0.27."""
    rng = np.random.default_rng(7)
    height, width = size.shape
    step = 5
    far = _texture(rng, height, width + step * count)
    near = _texture(rng, height, width + step * count)
    mask = _texture(rng, height, width + step * count) > 0.55
    frames = np.empty((count, height, width), np.uint8)
    for index in range(count):
        left, right = step * index, step * (count - index)
        shown = np.where(
            mask[:, right : right + width],
            near[:, right : right + width],
            far[:, left : left + width],
        )
        frames[index] = np.rint(255.0 * shown**HEAVY_GAMMA)
    times = [frame_time_us(index, HEAVY_FPS) for index in range(count)]
    return Video(frames, times, HEAVY_FPS)


def _texture(rng: np.random.Generator, height: int, width: int) -> NDArray[np.float64]:
    """Smooth noise of 12 px grain, 0..1."""
    grain = 12
    coarse = rng.random((height // grain + 2, width // grain + 2))
    y, x = np.arange(height) / grain, np.arange(width) / grain
    top, left = y.astype(int), x.astype(int)
    fy, fx = (y - top)[:, None], (x - left)[None, :]
    rows = coarse[top] * (1 - fy) + coarse[top + 1] * fy
    return np.asarray(rows[:, left] * (1 - fx) + rows[:, left + 1] * fx)


def source_frames(path: Path, count: int) -> Video:
    """The first frames of a video, as they are decoded, in memory."""
    frames = list(itertools.islice(iter(open_frames(path, CaptureConfig())), count))
    return Video(np.stack([one.pixels for one in frames]), [one.t_us for one in frames])


def dense_video(source: Video, count: int) -> Video:
    """A video at 200 fps equivalent: flow interpolation between its frames, 8-bit grey.

    Rounded to 8 bits, because that is what all programs under test can read.
    """
    step_us = source.times_us[1] - source.times_us[0]
    between = round(step_us * DENSE_FPS / 1e6) - 1
    config = InterpolateConfig(fixed_count=max(0, between), detect_cuts=False)
    interpolator = FlowInterpolator(config, source)
    policy = CountPolicy(config, source, interpolator, balance=30.0, contrast_threshold=0.2)
    pairs = pair_frames(source, interpolator, config, policy)
    dense = (frame for pair in pairs for frame in pair.frames)
    frames = list(itertools.islice(dense, count))
    pixels = np.stack([np.rint(one.luma).astype(np.uint8) for one in frames])
    return Video(pixels, [one.t_us for one in frames], Fraction(DENSE_FPS))
