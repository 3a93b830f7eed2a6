"""How sensors read their pixels out: ties, rows and columns in recordings, and by the arbiters.

    python -m texvent_lab.measure.readout_order

Each recording is described as it is; with its times moved at random, which keeps its scene and
its load but no trace of its readout; and with these events read by an arbiter of `physical`.
docs/simulators/physical.md has the table. Needs the recordings of `texvent data pull`.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from texvent.data.pull import pull
from texvent.events import EventStream
from texvent.io.files import open_events
from texvent.simulate.packets import UnsortedEvents
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.physical.readout import Arbiter

SECONDS = 1.0
"""How much of a recording is read, s."""


class Sensor(NamedTuple):
    """A recording and how its sensor is read out."""

    name: str
    data: str
    file: str
    size: tuple[int, int] | None
    spread_us: int
    """By how much times are moved at most."""
    options: dict[str, Any]
    """Of the arbiter; none where there is nothing to model."""


SENSORS = (
    Sensor("DVXplorer", "dvxplorer", "data_sample.aedat4", None, 1000, {"arbiter": "scan"}),
    Sensor("DAVIS240C", "slider_depth", "events.txt", (240, 180), 100, {"arbiter": "rows"}),
    Sensor(
        "Gen3",
        "gen3",
        "evt2.raw",
        (640, 480),
        100,
        {"arbiter": "rows", "arbiter_row_ns": 150, "arbiter_event_ns": 10},
    ),
    Sensor("EVK4", "evk4", "evt3.raw", None, 100, {}),
    Sensor("DAVIS346", "davis346", "test_data.aedat4", None, 100, {}),
)


def main() -> None:
    """Print the table."""
    print("| recording | events/s | tied | row shared | column shared | 99.9 % of row runs |")
    print("|---|---|---|---|---|---|")
    for sensor in SENSORS:
        for name, events, size in variants(sensor):
            print(f"| {sensor.name}, {name} | {describe(events, size[0])} |")


def variants(sensor: Sensor) -> Iterator[tuple[str, UnsortedEvents, tuple[int, int]]]:
    """The recorded events, in the order of the file; without a readout; and with an arbiter."""
    path = pull(sensor.data)
    whole = open_events(find_file(path, sensor.file), size=sensor.size).collect()
    recorded = whole.cut(int(whole.t[0]), int(whole.t[0] + SECONDS * 1e6))
    size = (recorded.size.width, recorded.size.height)
    fired = in_file_order(recorded)
    yield "recorded", fired, size
    spread = np.random.default_rng(0).integers(0, sensor.spread_us + 1, len(fired.t))
    moved = fired._replace(t=fired.t + spread)
    moved = moved.take(np.lexsort((moved.pixel, moved.t)))
    yield "times moved", moved, size
    if sensor.options:
        config = PhysicalConfig(**sensor.options)
        first_us = int(moved.t[0])
        arbiter = Arbiter(config, first_us=first_us, shape=(size[1], size[0]))
        read = arbiter.read(moved, int(moved.t[-1]) + 10_000)
        place = read.pixel % size[0] if sensor.options["arbiter"] == "scan" else read.pixel
        yield "arbiter", read.take(np.lexsort((place, read.t))), size


def find_file(path: Path, name: str) -> Path:
    """The file of that name where a recording was pulled to."""
    return path if path.is_file() else path / name


def in_file_order(events: EventStream) -> UnsortedEvents:
    """The events of a stream, as they are."""
    pixel = events.y.astype(np.int64) * events.size.width + events.x
    return UnsortedEvents.signal(pixel, events.t.astype(np.int64), events.p)


def describe(events: UnsortedEvents, width: int) -> str:
    """The columns of the table."""
    t, (y, x) = events.t, np.divmod(events.pixel, width)
    is_tie = np.diff(t) == 0
    is_tied = np.concatenate([[False], is_tie]) | np.concatenate([is_tie, [False]])
    ends = np.flatnonzero(np.concatenate([np.diff(y) != 0, [True]]))
    runs = np.diff(np.concatenate([[-1], ends]))
    return " | ".join(
        (
            f"{len(t) / (t[-1] - t[0]) * 1e6:,.0f}",
            f"{is_tied.mean():.2f}",
            f"{(np.diff(y)[is_tie] == 0).mean():.2f}",
            f"{(np.diff(x)[is_tie] == 0).mean():.2f}",
            f"{np.percentile(runs, 99.9):.0f}",
        )
    )


if __name__ == "__main__":
    main()
