"""A small recording of a sensor whose options are known."""

import dataclasses

import numpy as np
import pytest

from texvent.calibrate.recording import CalibrationRecording
from texvent.config import InterpolateConfig
from texvent.events import EventStream
from texvent.frames import Video
from texvent.simulation.physical.cameras import PRESETS
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator

TRUTH = dataclasses.replace(
    PRESETS["default"],
    gamma=1.0,
    contrast_threshold=0.31,
    on_off_ratio=1.3,
    balance=20.0,
    cutoff_hz=100.0,
    noise_scale=0.0,
    leak_rate_hz=0.0,
)


def moving_blobs(count: int = 90, shape=(24, 32), fps: int = 60) -> Video:
    """Linear frames, 1 to about 200 levels, with a wave of every size moving through."""
    y, x = np.mgrid[: shape[0], : shape[1]]
    frames = []
    for i in range(count):
        wave = np.sin(0.55 * (x - 0.9 * i)) + np.sin(0.4 * (y + 0.5 * i)) + np.cos(0.25 * (x + i))
        frames.append(np.exp(2.8 + 0.8 * wave).astype(np.float32))
    return Video(np.stack(frames), [round(i * 1e6 / fps) for i in range(count)])


def record(frames: Video, config: PhysicalConfig, seed: int = 77) -> CalibrationRecording:
    """Frames with the events that a sensor makes of them."""
    sensor = PhysicalSimulator(config, seed=seed)
    events = EventStream.concat([sensor.step(frame) for frame in frames])
    return CalibrationRecording(frames, events, InterpolateConfig(interpolate="none"))


@pytest.fixture(scope="session")
def recording() -> CalibrationRecording:
    return record(moving_blobs(), TRUTH)
