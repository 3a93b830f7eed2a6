"""Events per CPU-second of every representation.

    python -m texvent_lab.measure.representations [--device cpu]

The slice holds random events of 50 ms on a 640×480 sensor. With `--device`, tensors on that device
are measured instead, from events that are there already; on a GPU, time on the clock.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.extending import REPRESENTATIONS, require
from texvent.represent.array_ops import Events
from texvent.represent.named import represent
from texvent.represent.tensors import EventTensors
from texvent.sensor import SensorSize

VGA = SensorSize(640, 480)
SLICE_US = 50_000
REPEATS = 5


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Measure all representations.")
    parser.add_argument("--events", type=int, default=1_000_000)
    parser.add_argument("--device", help="measure torch on this device, such as cpu or cuda")
    arguments = parser.parse_args()
    events: Events = random_events(arguments.events)
    if arguments.device:
        events = EventTensors.of(random_events(arguments.events), arguments.device)
    print(f"{arguments.events:,} events, {VGA}, {arguments.device or 'NumPy'}")
    for name in REPRESENTATIONS.names():
        seconds = measure(partial(represent, name, events), arguments.device)
        print(f"{name:20} {arguments.events / seconds / 1e6:7.1f} million events per second")


def random_events(count: int) -> EventStream:
    """Events at random places and times of one slice."""
    rng = np.random.default_rng(1)
    x, y, p = (rng.integers(0, side, count) for side in (*VGA, 2))
    t = np.sort(rng.integers(0, SLICE_US, count))
    return EventStream.from_columns(x, y, t, p, size=VGA)


def measure(call: Callable[[], Any], device: str | None) -> float:
    """Least seconds of CPU, or of the clock on a GPU, after one call that does not count."""
    is_gpu = device is not None and device != "cpu"
    clock = time.perf_counter if is_gpu else time.process_time
    wait = require("torch", extra="torch").cuda.synchronize if is_gpu else lambda: None
    call()
    taken = []
    for _ in range(REPEATS):
        wait()
        begin = clock()
        call()
        wait()
        taken.append(clock() - begin)
    return min(taken)


if __name__ == "__main__":
    main()
