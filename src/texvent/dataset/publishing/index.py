"""Parquet index of all samples: place in the shards, caption, settings.

A sample can be read with it alone: open the shard, seek `x_offset`, read `x_bytes` bytes: a .npy.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.dataset.generation.sample import COLUMNS
from texvent.dataset.reading.stored_dataset import StoredDataset, StoredShard
from texvent.dataset.reading.stored_events import read_sample_facts
from texvent.io.atomic import atomic_file

INDEX_FILE = "index.parquet"
ROWS = 20_000
"""Rows of a row group."""
FIELDS = {
    "key": ("string", "Name of the sample; its members in the shard begin with it"),
    "clip": ("string", "Name of the video; the samples of all variants of it share this"),
    "variant": ("string", "Way in which the video was simulated; the folder of its shards"),
    "split": ("string", "Split; all videos of a prompt lie in one"),
    "shard": ("string", "Path of the tar in the data set"),
    "label": ("string", "Class, if there are any"),
    "class_number": ("int32", "Place of the class in alphabetical order"),
    "caption": ("string", "What the video shows, in words"),
    "seed": ("int64", "Seed of the simulation"),
    "simulator": ("string", "Model of the event camera"),
    "width": ("int32", "Width of the sensor, pixels"),
    "height": ("int32", "Height of the sensor, pixels"),
    "events": ("int64", "Number of events"),
    "duration_us": ("int64", "From the first frame of the video to the last, microseconds"),
    "warnings": ("strings", "What was doubtful when it was made, such as words not understood"),
    **{
        f"{name}_{what}": ("int64", f"{text} of the array {name} in the shard, a .npy file")
        for name in COLUMNS
        for what, text in (("offset", "Where the content begins"), ("bytes", "Length"))
    },
    "shard_sha256": ("string", "sha256 of the shard"),
}
"""Column → its type and what it holds."""


def write_index(dataset: StoredDataset) -> Path:
    """Write the index of all complete shards; equal shards give equal bytes.

    Raises:
        MissingDependencyError: pyarrow is not installed.
        OutputError: it cannot be written.
        FileFormatError: a record is damaged.
    """
    arrow, parquet = (require(name, extra="dataset") for name in ("pyarrow", "pyarrow.parquet"))
    schema = _schema(arrow)
    path = dataset.folder / INDEX_FILE
    with (
        atomic_file(path, overwrite=True) as part,
        parquet.ParquetWriter(part, schema, compression="zstd") as writer,
    ):
        rows: list[dict[str, Any]] = []
        for row in index_rows(dataset):
            rows.append(row)
            if len(rows) == ROWS:
                writer.write_table(arrow.Table.from_pylist(rows, schema))
                rows = []
        if rows:
            writer.write_table(arrow.Table.from_pylist(rows, schema))
    return path


def _schema(arrow: Any) -> Any:
    types = {"string": arrow.string(), "strings": arrow.list_(arrow.string()),
             "int32": arrow.int32(), "int64": arrow.int64()}  # fmt: skip
    return arrow.schema([(name, types[kind]) for name, (kind, _) in FIELDS.items()])


def index_rows(dataset: StoredDataset) -> Iterator[dict[str, Any]]:
    """A row for each sample, in the order of variants, splits and shards."""
    numbers = {label: number for number, label in enumerate(dataset.labels)}
    for variant in dataset.variants:
        simulator = dataset.simulator_of(variant)
        for shard in dataset.shards(variant):
            yield from _rows_of(shard, simulator, numbers)


def _rows_of(
    shard: StoredShard, simulator: str | None, numbers: dict[str, int]
) -> Iterator[dict[str, Any]]:
    for sample in shard.samples:
        places = {
            f"{name}_{what}": sample.members[f"{name}.npy"][position]
            for name in COLUMNS
            for position, what in enumerate(("offset", "bytes"))
        }
        yield {
            "key": sample.key,
            "clip": sample.clip,
            "variant": shard.record.variant,
            "split": shard.record.split,
            "shard": shard.place,
            "label": sample.label,
            "class_number": None if sample.label is None else numbers.get(sample.label),
            "caption": sample.prompt,
            "seed": sample.seed,
            "simulator": simulator or read_sample_facts(shard.path, sample).get("simulator"),
            "width": sample.width,
            "height": sample.height,
            "events": sample.events,
            "duration_us": sample.duration_us,
            "warnings": list(sample.warnings),
            **places,
            "shard_sha256": shard.record.sha256,
        }
