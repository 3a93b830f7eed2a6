"""Memory of a run whose frames stay on a device, early and at its end: it must not grow."""

from __future__ import annotations

import resource
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from texvent.extending import require
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation.gpu.launch import EXTRA
from texvent.simulation.gpu.support import RunDevice
from texvent_lab.measure.films import LongVideo
from texvent_lab.measure.speed.timing import rounded


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
