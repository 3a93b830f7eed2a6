"""Samples per second that training reads from a data set, by texvent and by other libraries.

    python -m texvent_lab.measure.dataset_loading [--samples 256] [--events 20000] [--workers 0 1 2]
                                         [--repeats 7] [--json FILE]

It needs torch and webdataset: pip install 'texvent[torch,loaders]'.

One set of random events is written four ways: as the shards of `texvent dataset make` (which
webdataset reads too), one HDF5 per clip, and one HDF5 of all clips. Every loader is a torch
DataLoader with the same batches, workers and collation, and gives the same tensors; what others
decode is not checked, and webdataset reads only the members it needs and does not shuffle, while
texvent checks every event and shuffles all samples. Without a representation a batch holds the
events themselves; with it, a voxel grid of each sample.

A pass reads all samples once. Passes of all loaders alternate; the first of each, which starts
workers and fills the page cache, is not counted. Ratios are taken within a repeat; their median
and quartiles are printed: of the time on the clock, and of CPU time of all processes, which other
programs on the machine disturb less.
"""

from __future__ import annotations

import argparse
import functools
import hashlib
import json
import os
import platform
import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np

import texvent.dataset
from texvent.dataset.generation.sample import SimulatedClip, sample_members
from texvent.dataset.generation.shards import (
    MADE,
    SampleRecord,
    ShardRecord,
    TarShardWriter,
    write_record,
)
from texvent.events import EventStream
from texvent.extending import require
from texvent.represent.named import represent_window
from texvent.sensor import SensorSize

SIZE = SensorSize(346, 260)
DURATION_US = 1_000_000
REPRESENTATION = "voxel-e2vid"
BASE = "webdataset"
COLUMNS = "xytp"
Passes = Mapping[str, list[tuple[float, float]]]


@dataclass(frozen=True)
class Written:
    """The set in all its forms."""

    folder: Path
    keys: tuple[str, ...]
    events: int

    @property
    def shards(self) -> list[str]:
        """Paths of the tars."""
        return sorted(str(path) for path in (self.folder / "set" / "paper").glob("*.tar"))


def random_events(seed: int, count: int) -> EventStream:
    """`count` events ± 50 %."""
    chance = np.random.default_rng(seed)
    number = int(count * chance.uniform(0.5, 1.5))
    t = np.sort(chance.integers(0, DURATION_US, number))
    x, y, p = (chance.integers(0, end, number) for end in (SIZE.width, SIZE.height, 2))
    return EventStream.from_columns(x, y, t, p, size=SIZE)


def write_all(folder: Path, samples: int, events: int, per_shard: int = 32) -> Written:
    """Write the set as shards, as HDF5 files and as one HDF5 file."""
    (folder / "clips").mkdir()
    (folder / "set" / "paper").mkdir(parents=True)
    keys, total = [], 0
    with h5py.File(folder / "all.h5", "w") as whole:
        for begin in range(0, samples, per_shard):
            made = {
                f"{number:016x}": random_events(number, events)
                for number in range(begin, min(begin + per_shard, samples))
            }
            write_shard(folder / "set", begin // per_shard, made)
            for key, stream in made.items():
                with h5py.File(folder / "clips" / f"{key}.h5", "w") as clip:
                    for file, prefix in ((clip, ""), (whole, f"{key}/")):
                        for name in COLUMNS:
                            file[f"{prefix}{name}"] = stored_column(stream, name)
            keys += list(made)
            total += sum(map(len, made.values()))
    return Written(folder, tuple(keys), total)


def stored_column(events: EventStream, name: str) -> Any:
    """A column with the type that shards store it with."""
    column = getattr(events, name)
    return column.astype(np.uint32) if name == "t" else column


def write_shard(folder: Path, number: int, made: Mapping[str, EventStream]) -> None:
    """A shard with its record, as `texvent dataset make` writes it, without previews."""
    path = folder / "paper" / f"train-{number:06d}.tar"
    records = []
    with path.open("wb") as file:
        writer = TarShardWriter(file)
        for key, events in made.items():
            facts = {"prompt": "a red car drives left", "key": key, "settings": {"fps": 30}}
            sample = SimulatedClip(events, 0, DURATION_US, len(events))
            members = sample_members(sample, facts, class_number=0, preview=False)
            records.append(
                SampleRecord(
                    key=key, clip=key, status=MADE, seed=0, label="car", events=len(events),
                    duration_us=DURATION_US, width=SIZE.width, height=SIZE.height,
                    members=writer.add(key, members),
                )
            )  # fmt: skip
        writer.close()
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    write_record(
        path,
        ShardRecord(
            name=path.stem, split="train", variant="paper", identity="", sha256=digest,
            bytes=path.stat().st_size, samples=tuple(records), seconds=0.0,
        ),
    )  # fmt: skip


def sample_of(columns: Mapping[str, Any], is_represented: bool) -> dict[str, Any]:
    """What a peer's columns become: events, or their voxel grid; nothing is checked."""
    x, y, t, p = (columns[name] for name in COLUMNS)
    events = EventStream.unchecked(x, y, t.astype(np.int64), p, size=SIZE, label=None)
    if not is_represented:
        return {"events": events, "class_number": 0}
    grid = represent_window(REPRESENTATION, events, (0, DURATION_US))
    return {"representation": grid, "class_number": 0}


class ClipFiles:
    """One HDF5 per clip, as a map-style dataset."""

    def __init__(self, written: Written, is_represented: bool) -> None:
        self.written, self.is_represented = written, is_represented

    def __len__(self) -> int:
        return len(self.written.keys)

    def __getitem__(self, number: int) -> dict[str, Any]:
        path = self.written.folder / "clips" / f"{self.written.keys[number]}.h5"
        with h5py.File(path, "r") as file:
            columns = {name: file[name][:] for name in COLUMNS}
        return sample_of(columns, self.is_represented)


class OneFile:
    """One HDF5 of all clips, as a map-style dataset; opened once per worker."""

    def __init__(self, written: Written, is_represented: bool) -> None:
        self.written, self.is_represented = written, is_represented
        self.file: Any = None

    def __len__(self) -> int:
        return len(self.written.keys)

    def __getitem__(self, number: int) -> dict[str, Any]:
        if self.file is None:
            self.file = h5py.File(self.written.folder / "all.h5", "r")
        group = self.file[self.written.keys[number]]
        return sample_of({name: group[name][:] for name in COLUMNS}, self.is_represented)


def columns_of_tar(sample: Mapping[str, Any], is_represented: bool) -> dict[str, Any]:
    """A sample that webdataset decoded."""
    return sample_of({name: sample[f"{name}.npy"] for name in COLUMNS}, is_represented)


def is_needed(name: str) -> bool:
    """Whether webdataset reads a member."""
    return name.endswith(".npy")


def make_loaders(
    written: Written, *, workers: int, batch_size: int, is_represented: bool
) -> dict[str, Any]:
    """Name → an object that gives the batches of a pass each time it is iterated."""
    from texvent.dataset.loading.torch_loader import collate

    data = require("torch.utils.data", extra="torch")
    wds: Any = require("webdataset", extra="loaders")
    options: dict[str, Any] = {"num_workers": workers, "collate_fn": collate}
    if workers:
        options |= {"persistent_workers": True, "multiprocessing_context": "fork"}
    sized = {"batch_size": batch_size, **options}
    samples = texvent.dataset.open(written.folder / "set")
    if is_represented:
        samples = samples.represented(REPRESENTATION)
    tars = wds.WebDataset(
        written.shards, shardshuffle=False, select_files=is_needed, empty_check=False
    ).decode()
    tars = tars.map(functools.partial(columns_of_tar, is_represented=is_represented))
    return {
        "texvent, Loader": samples.loader(
            batch_size=batch_size, shuffle=True, workers=workers, start_method="fork"
        ),
        "texvent, shards in sequence": samples.loader(
            batch_size=batch_size, shuffle=True, shuffle_buffer=100, workers=workers,
            start_method="fork",
        ),
        BASE: data.DataLoader(tars.batched(batch_size, collation_fn=collate), **{
            **{name: one for name, one in options.items() if name != "collate_fn"},
            "batch_size": None,
        }),
        "h5py, a file per clip": data.DataLoader(
            ClipFiles(written, is_represented), shuffle=True, **sized
        ),
        "h5py, one file": data.DataLoader(
            OneFile(written, is_represented), shuffle=True, **sized
        ),
    }  # fmt: skip


def cpu_seconds() -> float:
    """CPU time of this process and the worker processes that run."""
    ticks = 0
    for task in Path("/proc/self/task").iterdir():
        for child in (task / "children").read_text().split():
            fields = Path(f"/proc/{child}/stat").read_text().rpartition(")")[2].split()
            ticks += int(fields[11]) + int(fields[12])
    return time.process_time() + ticks / os.sysconf("SC_CLK_TCK")


def timed_pass(batches: Any, samples: int) -> tuple[float, float]:
    """Seconds and CPU-seconds of a pass; it must hold every sample once."""
    started, used, count = time.perf_counter(), cpu_seconds(), 0
    for batch in batches:
        count += len(batch["class_number"])
    if count != samples:
        raise SystemExit(f"a pass gave {count} of {samples} samples")
    return time.perf_counter() - started, cpu_seconds() - used


def measure(
    written: Written, *, workers: int, batch_size: int, repeats: int, is_represented: bool
) -> Passes:
    """Name → seconds and CPU-seconds of each pass."""
    loaders = make_loaders(
        written, workers=workers, batch_size=batch_size, is_represented=is_represented
    )
    seconds: dict[str, list[tuple[float, float]]] = {name: [] for name in loaders}
    for repeat in range(repeats + 1):
        for name, loader in loaders.items():
            taken = timed_pass(loader, len(written.keys))
            if repeat:
                seconds[name].append(taken)
    return seconds


def quartiles(values: Any) -> tuple[float, float, float]:
    """Lower quartile, median, upper quartile."""
    low, middle, high = np.percentile(values, (25, 50, 75)).tolist()
    return low, middle, high


def rows_of(written: Written, passes: Passes) -> Iterator[dict[str, Any]]:
    """A row per loader; ratios are how many times as fast as webdataset."""
    base = np.array(passes[BASE])
    for name, one in passes.items():
        ratios = base / np.array(one)
        seconds, cpu_s = np.median(one, axis=0).tolist()
        yield {
            "loader": name,
            "samples_per_s": len(written.keys) / seconds,
            "events_per_s": written.events / seconds,
            "cpu_ms_per_sample": 1e3 * cpu_s / len(written.keys),
            "ratio": quartiles(ratios[:, 0]),
            "cpu_ratio": quartiles(ratios[:, 1]),
        }


def line_of(row: Mapping[str, Any]) -> str:
    """A row of a Markdown table."""
    ratios = (
        f"{middle:.2f} ({low:.2f} to {high:.2f})"
        for low, middle, high in (row["ratio"], row["cpu_ratio"])
    )
    return (
        f"| {row['loader']} | {row['workers']} | {'yes' if row['is_represented'] else 'no'} | "
        f"{row['samples_per_s']:,.0f} | {row['events_per_s'] / 1e6:.1f} | "
        f"{row['cpu_ms_per_sample']:.2f} | {' | '.join(ratios)} |"
    )


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--events", type=int, default=20_000)
    parser.add_argument("--batch-size", type=int, default=16)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--workers", type=int, nargs="*", default=[0, 1, 2])
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        written = write_all(Path(scratch), arguments.samples, arguments.events)
        print(f"{len(written.keys)} samples, {written.events:,} events; {platform.machine()}")
        print("| loader | workers | voxel grid | samples/s | M events/s | CPU ms per sample | "
              "times webdataset, clock | times webdataset, CPU |")  # fmt: skip
        print("|---|---|---|---|---|---|---|---|")
        for is_represented in (False, True):
            for workers in arguments.workers:
                passes = measure(
                    written,
                    workers=workers,
                    batch_size=arguments.batch_size,
                    repeats=arguments.repeats,
                    is_represented=is_represented,
                )
                for row in rows_of(written, passes):
                    row |= {"workers": workers, "is_represented": is_represented}
                    rows.append(row)
                    print(line_of(row), flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
