"""Events per CPU-second that event files are written and read at, by texvent and other programs.

    python -m texvent_lab.measure.codecs [--events 4000000] [--repeats 5] [--only evt3] [--json F]

Each row writes and reads one recording of random events over one second (the worst case for
formats that store differences), whole, through `save` and `open_events`; the file is read packet
by packet and every packet is checked, as in use. CPU time of all threads, including compression
and the system's part of the writing; the first run, which compiles, is not counted. Peers that
are installed read the same file, and write their own, in the same run: they decode into their own
containers.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import platform
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.io.files import open_events, save
from texvent.sensor import SensorSize

HD = SensorSize(1280, 720)
DAVIS = SensorSize(346, 260)
DVS = SensorSize(128, 128)
SPAN_US = 1_000_000


@dataclass(frozen=True)
class Case:
    """A format to measure."""

    format: str
    extension: str
    size: SensorSize = HD
    share: float = 1.0
    """Of the events: slow formats get fewer."""


@dataclass(frozen=True)
class Peer:
    """Another program that reads a format, and perhaps writes it."""

    package: str
    format: str
    read: Callable[[Any, str], Any]
    """From the imported package and a path."""
    write: Callable[[Any, Any, str], Any] | None = None
    """From the imported package, what `read` returned, and a path."""


CASES = (
    Case("evt2", ".raw"),
    Case("evt21", ".raw"),
    Case("evt3", ".raw"),
    Case("dat", ".dat"),
    Case("hdf5", ".h5"),
    Case("npz", ".npz"),
    Case("ecd", ".txt", share=0.1),
    Case("aedat4", ".aedat4"),
    Case("aedat4-none", ".aedat4"),
    Case("aedat4-zstd", ".aedat4"),
    Case("atis", ".bin", DVS),
    Case("dsec", ".h5"),
    Case("v2e", ".h5"),
    Case("n-imagenet", ".npz"),
    Case("rosbag1", ".bag"),
    Case("mcap", ".mcap"),
    Case("csv", ".csv", share=0.1),
    Case("e2vid", ".zip", share=0.1),
)


def read_with_aedat(aedat: Any, path: str) -> list[Any]:
    """Packets of an AEDAT4 file."""
    return list(aedat.Decoder(path))


def read_with_dv(dv: Any, path: str) -> list[Any]:
    """Batches of an AEDAT4 file."""
    recording = dv.io.MonoCameraRecording(path)
    batches = []
    while (batch := recording.getNextEventBatch()) is not None:
        batches.append(batch)
    return batches


def write_with_dv(dv: Any, batches: Any, path: str) -> None:
    """An AEDAT4 file of batches."""
    config = dv.io.MonoCameraWriter.EventOnlyConfig("benchmark", tuple(HD))
    writer = dv.io.MonoCameraWriter(path, config)
    for batch in batches:
        writer.writeEvents(batch)


PEERS = (
    Peer("aedat", "aedat4", read_with_aedat),
    Peer("aedat", "aedat4-none", read_with_aedat),
    Peer("dv_processing", "aedat4", read_with_dv, write_with_dv),
    Peer("dv_processing", "aedat4-none", read_with_dv),
    Peer("eventcv", "evt2", lambda eventcv, path: eventcv.load(path), lambda _, e, p: e.save(p)),
    Peer("eventcv", "evt3", lambda eventcv, path: eventcv.load(path)),
    Peer("eventcv", "dat", lambda eventcv, path: eventcv.load(path), lambda _, e, p: e.save(p)),
    Peer("eventcv", "hdf5", lambda eventcv, path: eventcv.load(path), lambda _, e, p: e.save(p)),
    Peer("eventcv", "npz", lambda eventcv, path: eventcv.load(path), lambda _, e, p: e.save(p)),
    Peer("evt3", "evt3", lambda evt3, path: evt3.decode_file(path)),
)


def make_events(count: int, size: SensorSize) -> EventStream:
    """Random events over one second."""
    rng = np.random.default_rng(0)
    return EventStream.from_columns(
        rng.integers(0, size.width, count),
        rng.integers(0, size.height, count),
        np.sort(rng.integers(0, SPAN_US, count)),
        rng.integers(0, 2, count),
        size=size,
    )


def measure(action: Callable[[], object], count: int, repeats: int) -> dict[str, float]:
    """Millions of events per CPU-second: median and interquartile range, after a warm-up."""
    action()
    rates = []
    for _ in range(repeats):
        start = time.process_time()
        action()
        rates.append(count / (time.process_time() - start) / 1e6)
    low, median, high = np.percentile(rates, (25, 50, 75))
    return {"median": round(float(median), 1), "iqr": round(float(high - low), 1)}


def measure_case(case: Case, count: int, repeats: int, folder: Path) -> Iterator[dict[str, Any]]:
    """A row for texvent, and one for each installed peer."""
    events = make_events(int(count * case.share), case.size)
    path = folder / f"{case.format}{case.extension}"

    def write() -> None:
        save(path, events, format=case.format, overwrite=True)

    def read() -> int:
        return sum(len(packet) for packet in open_events(path, format=case.format))

    row = {"format": case.format, "program": "texvent", "events": len(events)}
    row["write"] = measure(write, len(events), repeats)
    row["read"] = measure(read, len(events), repeats)
    row["bytes_per_event"] = round(bytes_of(path) / len(events), 2)
    yield row
    for peer in PEERS:
        if peer.format == case.format and importlib.util.find_spec(peer.package):
            yield measure_peer(peer, path, len(events), repeats)


def bytes_of(path: Path) -> int:
    """Length of a file, or of all files in a folder."""
    files = path.iterdir() if path.is_dir() else [path]
    return sum(file.stat().st_size for file in files)


def measure_peer(peer: Peer, path: Path, count: int, repeats: int) -> dict[str, Any]:
    """A row for another program, on the file texvent wrote."""
    package = importlib.import_module(peer.package)
    row: dict[str, Any] = {"format": peer.format, "program": peer.package, "events": count}
    row["read"] = measure(lambda: peer.read(package, str(path)), count, repeats)
    if peer.write is not None:
        loaded = peer.read(package, str(path))
        own = str(path.with_name(f"peer{path.suffix}"))
        writer = peer.write
        row["write"] = measure(lambda: writer(package, loaded, own), count, repeats)
        row["bytes_per_event"] = round(Path(own).stat().st_size / count, 2)
    return row


def _line(row: dict[str, Any]) -> str:
    def rate(side: str) -> str:
        return f"{row[side]['median']:8.1f} ({row[side]['iqr']:5.1f})" if side in row else " " * 16

    size = f"{row['bytes_per_event']:6.2f}" if "bytes_per_event" in row else ""
    return f"{row['format']:15} {row['program']:13} {rate('write')} {rate('read')} {size:>6}"


def main() -> None:
    """Print the table, and write it as JSON with --json."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--events", type=int, default=4_000_000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--only", nargs="+", metavar="FORMAT", help="measure only these formats")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the rows there too")
    options = parser.parse_args()
    rows = []
    print("M events per CPU-second: median (interquartile range)")
    print("format          program       write            read             B/event")
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            if options.only and case.format not in options.only:
                continue
            for row in measure_case(case, options.events, options.repeats, Path(folder)):
                print(_line(row), flush=True)
                rows.append(row)
    if options.json:
        machine = {"processor": platform.machine(), "python": platform.python_version()}
        text = json.dumps({"machine": machine, "rows": rows}, indent=1)
        options.json.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
