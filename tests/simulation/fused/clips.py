"""Small clips, drawn and fused."""

from typing import Any

import numpy as np

from texvent._registry import INTERPOLATORS
from texvent.frames import Video
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.settings.resolution import resolve
from texvent.simulation.build import build_simulator

FRAME_US = 40_000


def panning(
    count: int = 3, size: tuple[int, int] = (72, 40), step: float = 2.3, dtype: Any = np.uint8
) -> Video:
    """A texture of many waves that moves right by `step` px a frame, with a resting dark corner."""
    width, height = size
    rng = np.random.default_rng(4)
    y, x = np.mgrid[:height, :width].astype(np.float64)
    frames = np.full((count, height, width), 110.0)
    for _ in range(12):
        length, angle, phase = rng.uniform(7, 30), rng.uniform(0, np.pi), rng.uniform(0, 6)
        for index in range(count):
            along = (x - step * index) * np.cos(angle) + y * np.sin(angle)
            frames[index] += 25 * np.sin(2 * np.pi * along / length + phase)
    frames[:, :10, :20] = 12.5
    times = [1000 + FRAME_US * index for index in range(count)]
    return Video(np.clip(frames, 0, 255).astype(dtype), times)


def plan(video: Video, options: dict[str, Any]) -> Any:
    """Settings, a simulator, and a function that pairs the frames anew."""
    settings = resolve("simulate", options)
    config = settings.interpolate
    simulator = build_simulator(settings.run, settings.simulate)

    def pairs() -> Any:
        interpolator = INTERPOLATORS.load(config.interpolate)(config, video)
        policy = CountPolicy(
            config,
            video,
            interpolator,
            balance=simulator.balance,
            contrast_threshold=simulator.contrast_threshold,
        )
        return pair_frames(video, interpolator, config, policy)

    return settings, simulator, pairs


def readable(video: Video, options: dict[str, Any]) -> list[Any]:
    """Frames and packets of `step` on the drawn frames."""
    _, simulator, pairs = plan(video, options)
    return [(frame, simulator.step(frame)) for pair in pairs() for frame in pair.frames]


def fused(video: Video, options: dict[str, Any]) -> list[Any]:
    """Frames and packets of `advance`."""
    _, simulator, pairs = plan(video, options)
    return [step for pair in pairs() for step in simulator.advance(pair)]
