"""Streams and hand-made files for the formats of Prophesee."""

import struct
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(1280, 720)
HEADERS = {
    "evt2": "% evt 2.0\n% format EVT2;height=720;width=1280\n% end\n",
    "evt21": "% evt 2.1\n% format EVT21;endianness=little;height=720;width=1280\n% end\n",
    "evt3": "% evt 3.0\n% format EVT3;height=720;width=1280\n% end\n",
    "dat": "% Height 720\n% Version 2\n% Width 1280\n",
}
CODES = {"evt2": "I", "evt21": "Q", "evt3": "H", "dat": "Q"}
EXTENSIONS = {"evt2": ".raw", "evt21": ".raw", "evt3": ".raw", "dat": ".dat"}
FORMATS = ("evt3", "dat")
"""Formats that are written."""


def write_words(
    folder: Path, format: str, words: Sequence[int], *, header: str | None = None
) -> Path:
    """A file of words, little-endian, each as wide as the format's."""
    text = HEADERS[format] if header is None else header
    kind = b"\x0c\x08" if format == "dat" else b""
    path = folder / f"made{EXTENSIONS[format]}"
    path.write_bytes(text.encode() + kind + struct.pack(f"<{len(words)}{CODES[format]}", *words))
    return path


def events_of(events: EventStream) -> list[tuple[int, int, int, int]]:
    """x, y, t, p of each event."""
    columns = (events.x.tolist(), events.y.tolist(), events.t.tolist(), events.p.tolist())
    return list(zip(*columns, strict=True))


def at_times(*times: int, size: SensorSize = SIZE) -> EventStream:
    """One event per time, at different places."""
    index = np.arange(len(times))
    return EventStream(
        index * 37 % size.width,
        index * 11 % size.height,
        np.array(times, np.int64),
        index % 2,
        size,
        {"seed": 0},
    )


def row_bursts(count: int, seed: int = 0) -> EventStream:
    """Bursts of neighbours in a row at one time, the way an edge fires."""
    rng = np.random.default_rng(seed)
    start = rng.integers(0, 1200, count)
    x = (start[:, None] + np.arange(20)).ravel()
    y = np.repeat(rng.integers(0, 720, count), 20)
    t = np.repeat(np.sort(rng.integers(0, 40 * count, count)), 20)
    keep = rng.random(20 * count) < 0.6
    p = np.repeat(rng.integers(0, 2, count), 20)
    return EventStream(x[keep], y[keep], t[keep], p[keep], SIZE, {"seed": seed})


STREAMS: dict[str, Callable[[], EventStream]] = {
    "no event": lambda: EventStream.empty(SIZE, {"prompt": "nothing"}),
    "one event": lambda: at_times(7),
    "time zero": lambda: at_times(0, 0, 1),
    "equal times": lambda: at_times(*[9] * 100),
    "largest coordinates": lambda: EventStream.from_columns(
        [0, 2047, 2047, 2046],
        [2047, 0, 2047, 2047],
        [0, 1, 2, 2],
        [0, 1, 1, 0],
        size=SensorSize(2048, 2048),
    ),
    "silences around every counter": lambda: at_times(
        *(
            base + step
            for base in (64, 4096, 2**24, 2**24 + 2**23, 2**25, 5 * 2**24, 2**30, 2**31)
            for step in (-2, -1, 0, 1, 63, 64)
        )
    ),
    "a late start": lambda: at_times(3_600_000_000, 3_600_000_001),
    "bursts in rows": lambda: row_bursts(400),
    "more than one packet": lambda: row_bursts(30_000, seed=4),
}
LATE_STREAMS: dict[str, Callable[[], EventStream]] = {
    "times past 32 bits": lambda: at_times(2**32 - 1, 2**32, 2**32 + 1, 2**33),
    "a time past 34 bits": lambda: at_times(5, 2**34 + 1),
}
"""Times that DAT does not hold."""
