"""Clips of the `physical` pixel model on a CPU: its simulator, and its events as arrays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.frames import Frame
from texvent.simulation.clips.arrays import (
    FoundEvents,
    MadeArrays,
    make_arrays,
    spread_events,
    words_of,
)
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator


def seed_of(key: np.uint64) -> int:
    """Seed of a clip's pixels and noise."""
    return int(key) >> 1


def simulate_physical(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    configs: Sequence[PhysicalConfig],
    keys: NDArray[np.uint64],
    outputs: ClipOutputs,
) -> ClipArrays:
    """Arrays of clips whose pixels have options of their own.

    Args:
        frames: [B, T + 1, H, W].
        times_us: [B, T + 1], as `pixels.check_clips` wants them.
        configs: [B] options.
        keys: [B] of `draws.frame_key`.
        outputs: what is made.

    Returns:
        NumPy arrays.
    """

    def run(clip: int, made: MadeArrays) -> NDArray[np.int64]:
        simulator = PhysicalSimulator(configs[clip], seed=seed_of(keys[clip]))
        return _run_clip(simulator, frames[clip], times_us[clip], outputs, made)

    return make_arrays(frames.shape, outputs, run)


def _run_clip(
    simulator: PhysicalSimulator,
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    outputs: ClipOutputs,
    made: MadeArrays,
) -> NDArray[np.int64]:
    _, height, width = frames.shape
    area, per, words = height * width, outputs.intervals_per_window, [np.empty(0, np.int64)]
    simulator.step(Frame(frames[0], int(times_us[0])))
    for first in range(0, len(frames) - 1, per):
        packets = [
            simulator.step(Frame(frames[at], int(times_us[at])))
            for at in range(first + 1, first + per + 1)
        ]
        opened_us = int(times_us[first])
        since_us = np.concatenate([(one.t - opened_us).astype(np.int32) for one in packets])
        cell = np.concatenate(
            [(one.y.astype(np.int32) * width + one.x) * 2 + one.p for one in packets]
        )
        found = FoundEvents(since_us, cell.astype(np.int32), np.array([0, len(cell)]))
        if outputs.events:
            words.append(words_of(found, opened_us, area))
        spread_events(found, area, first // per, made)
    return np.concatenate(words)
