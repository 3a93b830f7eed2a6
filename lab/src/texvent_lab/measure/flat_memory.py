"""Memory of a run whose frames stay on a device, early and at its end: it must not grow."""

from __future__ import annotations

import resource
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from texvent.extending import require
from texvent.frames import Frame
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation.gpu.launch import EXTRA
from texvent.simulation.gpu.support import RunDevice
from texvent_lab.measure.speed.timing import rounded

PICTURES = 16


class LongVideo:
    """Noise of 16 pictures again and again, made as it is read."""

    fps, is_live = Fraction(25), False

    def __init__(self, size: SensorSize, frame_count: int) -> None:
        """So many frames."""
        self.size, self.frame_count = size, frame_count
        self.metadata: dict[str, Any] = {}

    def __iter__(self) -> Iterator[Frame]:
        """The frames, 40 ms apart."""
        shape = (PICTURES, *self.size.shape)
        pictures = np.random.default_rng(0).integers(90, 130, shape, np.uint8)
        for index in range(self.frame_count):
            yield Frame(pictures[index % PICTURES].copy(), 40_000 * index)


def measure_memory(size: SensorSize, frames: int, chosen: RunDevice) -> Iterator[dict[str, Any]]:
    """Highest megabytes of the process, and those of the device's tensors, early and at the end.

    Args:
        size: of the frames.
        frames: how many; the first figures are those after a tenth of them.
        chosen: device of the run.
    """
    settings = resolve("simulate", {"interpolate": "none", "device": "cpu"})
    run = replace(video_to_events(LongVideo(size, frames), settings), device=chosen)
    torch, events, seen = require("torch", extra=EXTRA), 0, {}
    for index, (_, packet) in enumerate(run.steps()):
        events += len(packet)
        if index + 1 in (frames // 10, frames):
            on_device = torch.cuda.memory_allocated() if torch.cuda.is_available() else 0
            seen[str(index + 1)] = {
                "peak_mb": rounded(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3),
                "device_mb": rounded(on_device / 1e6),
            }
    yield {"size": str(size), "frames": frames, "events": events, "after": seen}
