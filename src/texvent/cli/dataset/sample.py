"""`texvent dataset sample DIR`: some samples of a data set, to look at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.dataset.preview import choose_samples, write_sample_page
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import ConfigError

DESCRIPTION = """Look at some samples, drawn by chance: a page (HTML) with images, captions and all
facts.

  texvent dataset sample cars
  texvent dataset sample cars --variant paper --label bus -n 60 -o buses.html"""


@dataclass(frozen=True, kw_only=True)
class SampleOptions:
    """Which samples."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "count": "-n"}
    outputs: ClassVar[tuple[str, ...]] = ("folder", "out")

    folder: Path = REQUIRED
    """Folder of the data set."""
    out: Path | None = None
    """The page, .html. Default: samples.html in the folder."""
    count: int = 24
    """How many."""
    variant: str | None = None
    """Of this variant only."""
    split: str | None = None
    """Of this split only."""
    label: str | None = None
    """Of this class only."""
    seed: int = 0
    """Another draws others."""
    overwrite: bool = False
    """Replace files that exist."""

    def __post_init__(self) -> None:
        check_range("count", self.count, 1, 1000)


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": SampleOptions()},
        prog="texvent dataset sample",
        description=DESCRIPTION,
    )
    out = options.folder / "samples.html" if options.out is None else options.out
    if out.suffix.lower() not in (".html", ".htm"):
        raise ConfigError(f"out is {out}; name a page, .html")
    dataset = StoredDataset.open(options.folder)
    samples = choose_samples(
        dataset,
        options.count,
        variant=options.variant,
        split=options.split,
        label=options.label,
        seed=options.seed,
    )
    write_sample_page(dataset, samples, out, overwrite=options.overwrite)
    write_out(f"{len(samples)} samples of {dataset.name}: {out}\n")
    return 0
