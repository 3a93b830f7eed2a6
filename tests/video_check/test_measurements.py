"""Measurements of short clips, by their definitions."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest

from texvent.frames import Frame
from texvent.pairs.time_jump import is_jump
from texvent.video_check.measurements import measure_video, neighbour_correlation


def clip(random: np.random.Generator) -> list[Frame]:
    """Up to nine small frames, equal, alike or not, at times that may be irregular."""
    shape = random.integers(2, 7, 2)
    number = random.integers(1, 10)
    images = [random.uniform(0, 255, shape)]
    for _ in range(number - 1):
        images.append(images[-1] + random.choice([0, 0.01, 1, 30]) * random.normal(size=shape))
    images = [one + random.choice([0, 0, 8]) * (-1) ** i for i, one in enumerate(images)]
    steps = random.choice(
        [20_000, 20_900, 22_100, 40_000, 90_000_000], number, p=[0.5, 0.2, 0.1, 0.1, 0.1]
    )
    return [
        Frame(np.clip(image, 0, 255).astype(np.float32), int(t_us))
        for image, t_us in zip(images, np.cumsum(steps), strict=True)
    ]


def rank(values: np.ndarray, percent: float) -> float:
    """Smallest value, to 1/16, that so many per cent do not exceed."""
    steps = np.sort(np.minimum(np.floor(16 * values.ravel()), 4095)) / 16
    return float(steps[max(0, int(np.ceil(len(steps) * percent / 100)) - 1)])


def other_steps(steps: Sequence[int]) -> list[int]:
    """The steps that one is compared with: all, or the smaller one of two."""
    return [*steps] if len(steps) > 2 else sorted(steps)[: len(steps) - 1]


def defined(frames: list[Frame]) -> dict[str, float]:
    levels = np.stack([frame.luma for frame in frames]).astype(float)
    means = levels.mean(axis=(1, 2))
    jitter = [
        min(abs(here - before), abs(here - after)) if (here > before) == (here > after) else 0.0
        for before, here, after in zip(means, means[1:], means[2:], strict=False)
    ] or [0.0]
    change = [float(abs(b - a).mean()) for a, b in pairwise(levels)] or [0.0]
    steps = np.diff([frame.t_us for frame in frames]).tolist()
    fps = 0.0
    if steps:
        usual = float(np.median(steps))
        is_regular = all(abs(step - usual) <= max(0.1 * usual, 1_500) for step in steps)
        fps = 1e6 / (float(np.mean(steps)) if is_regular else usual)
    jumps = [step for step in steps if is_jump(step, other_steps(steps))]
    return {
        "frames": len(frames),
        "fps": fps,
        "flicker": np.percentile(jitter, 75),
        "flash": max(jitter),
        "motion": np.percentile(levels.max(axis=0) - levels.min(axis=0), 99),
        "correlation": np.median([neighbour_correlation(one) for one in levels[::4]]),
        "bright_end": rank(levels, 95),
        "dark_end": rank(levels, 5),
        "still_share": np.mean([one < 0.02 for one in change]),
        "jumps": len(jumps),
        "longest_jump_s": max(jumps, default=0) / 1e6,
    }


def test_measurements_are_those_of_their_definitions() -> None:
    random = np.random.default_rng(5)
    for _ in range(120):
        frames = clip(random)
        found, expected = measure_video(frames), defined(frames)
        for name, value in expected.items():
            assert found[name] == pytest.approx(value, rel=1e-4, abs=2e-4), name
