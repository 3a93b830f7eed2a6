"""The formats that are tested alike: which file, which sensor, which times they hold."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.sensor import SensorSize

METADATA = {"prompt": 'a "red" car 🚗\r\n#end <x> & % end', "seed": 0, "nested": {"a": [1, None]}}


@dataclass(frozen=True)
class FormatCase:
    """One format under test."""

    name: str
    file: str
    """Name of the file or folder; its extension is the format's."""
    largest: SensorSize
    """The largest sensor that is tried."""
    stop_us: int | None = None
    """Events lie before this time, µs; None: any time a recording can have."""
    extra: str | None = None
    """Module that the format needs and the default environment may lack."""
    is_exact_size: bool = False
    """True if no other sensor size can be written."""
    is_written: bool = True
    """False for formats that are only read."""
    keeps_metadata: bool = True

    @property
    def sensor(self) -> SensorSize:
        """A small sensor that the format holds."""
        return self.largest if self.is_exact_size else SensorSize(64, 48)


DAVIS = SensorSize(346, 260)
DVS = SensorSize(128, 128)
ANY = SensorSize(65_535, 65_535)
SHORT = SensorSize(32_768, 32_768)
ALL_CASES = (
    FormatCase("hdf5", "e.h5", ANY),
    FormatCase("npz", "e.npz", ANY),
    FormatCase("ecd", "e.txt", ANY),
    FormatCase("evt3", "e.raw", SensorSize(2048, 2048), 2**42),
    FormatCase("evt2", "e.raw", SensorSize(2048, 2048), 2**34, is_written=False),
    FormatCase("evt21", "e.raw", SensorSize(2048, 2048), 2**34, is_written=False),
    FormatCase("dat", "e.dat", SensorSize(16_384, 16_384), 2**32),
    FormatCase("aedat2", "e.aedat", DAVIS, 2**31, is_exact_size=True, is_written=False),
    FormatCase("aedat2-dvs128", "e.aedat", DVS, 2**31, is_exact_size=True, is_written=False),
    FormatCase("cifar10-dvs", "e.aedat", DVS, 2**31, is_exact_size=True, is_written=False),
    FormatCase("aedat3", "e.aedat", SHORT, is_written=False),
    FormatCase("aedat4", "e.aedat4", SHORT),
    FormatCase("es", "e.es", ANY, 2**36, is_written=False),
    FormatCase("csv", "e.csv", ANY),
    FormatCase("e2vid", "e.zip", ANY),
    FormatCase("n-imagenet", "e.npz", ANY),
    FormatCase("dsec", "e.h5", ANY),
    FormatCase("event-utils", "e.h5", SHORT, 2**51),
    FormatCase("parquet", "e.parquet", ANY, extra="pyarrow", is_written=False),
    FormatCase("rosbag1", "e.bag", ANY, 2**32 * 10**6),
    FormatCase("mcap", "e.mcap", SensorSize(2048, 2048), 2**42),
    FormatCase("rosbag2", "folder", ANY, 2**32 * 10**6, is_written=False),
    FormatCase("npy", "e.npy", ANY, is_written=False, keeps_metadata=False),
    FormatCase("esim", "folder", ANY, 2**63 // 1000, is_written=False),
    FormatCase("evreal", "folder", ANY, 2**51, is_written=False),
    FormatCase("prophesee-hdf5", "e.hdf5", SensorSize(2048, 2048), is_written=False),
    FormatCase("atis", "e.bin", SensorSize(256, 240), 2**23),
)
CASES = tuple(case for case in ALL_CASES if case.is_written)
CASE_OF = {case.name: case for case in ALL_CASES}


def random_events(
    count: int, size: SensorSize, *, span_us: int = 50_000, start_us: int = 0, seed: int = 3
) -> EventStream:
    rng = np.random.default_rng(seed)
    return EventStream(
        rng.integers(0, size.width, count),
        rng.integers(0, size.height, count),
        np.sort(rng.integers(start_us, start_us + span_us, count)),
        rng.integers(0, 2, count),
        size,
        METADATA,
    )


def at_times(times: list[int], size: SensorSize) -> EventStream:
    count = np.arange(len(times))
    return EventStream(
        count % size.width, count % size.height, np.array(times, np.int64), count % 2, size
    )


def corners(size: SensorSize) -> EventStream:
    right, bottom = size.width - 1, size.height - 1
    return EventStream.from_columns(
        [0, right, 0, right], [0, 0, bottom, bottom], [0, 1, 2, 3], [1, 0, 0, 1], size=size
    )


def recording(size: SensorSize) -> EventStream:
    """Ten packets of 10 ms, a silence that wraps small counters, and a few late events."""
    burst = random_events(20_000, size, span_us=100_000)
    late = random_events(500, size, span_us=5_000, start_us=3_000_000)
    return EventStream.concat([burst, late])


def assert_same(events: EventStream, x: Any, y: Any, t: Any, p: Any) -> None:
    """Another reader's columns are those of the events."""
    for name, theirs in zip("xytp", (x, y, t, p), strict=True):
        mine = getattr(events, name).astype(np.int64)
        np.testing.assert_array_equal(np.asarray(theirs).astype(np.int64), mine, err_msg=name)


STREAMS: dict[str, Callable[[FormatCase], EventStream]] = {
    "no event": lambda case: EventStream.empty(case.sensor, METADATA),
    "one event": lambda case: random_events(1, case.sensor),
    "equal times": lambda case: at_times([9] * 300, case.sensor),
    "largest coordinates": lambda case: corners(case.largest),
    "silences": lambda case: at_times(
        [0, 1, 126, 253, 381, 100_000, 1_000_000, 5_000_000, 8_388_607], case.sensor
    ),
    "more than one block": lambda case: random_events(70_000, case.sensor, span_us=2_000_000),
}
