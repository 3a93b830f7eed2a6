"""`texvent dataset export DIR --format NAME -o OUT`: a data set in another layout."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import ConfigError

DESCRIPTION = f"""Write the samples of a data set in another layout: {", ".join(LAYOUTS)}. What a
layout cannot hold is said. A stopped export goes on when it is run again.

  texvent dataset export cars --format hdf5 -o cars-h5       one file per sample, with everything
  texvent dataset export cars --format n-imagenet --variant paper -o N_Imagenet"""


@dataclass(frozen=True, kw_only=True)
class ExportOptions:
    """What to write, and where."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}

    folder: Path = REQUIRED
    """Folder of the data set."""
    format: str = "hdf5"
    """Name of the layout."""
    out: Path | None = None
    """Folder to write."""
    variant: str | None = None
    """Which variant; needed where there are several."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": ExportOptions()},
        prog="texvent dataset export",
        description=DESCRIPTION,
    )
    if options.out is None:
        raise ConfigError("export needs the folder to write; name it with -o")
    dataset = StoredDataset.open(options.folder)
    done = export(dataset, options.format, options.out, variant=options.variant)
    kept = f" ({done.kept:,} were there)" if done.kept else ""
    write_out(f"{options.out}: {done.samples:,} samples as {options.format}{kept}\n")
    for doubt in done.doubts:
        write_out(f"note: {doubt}\n")
    return 0
