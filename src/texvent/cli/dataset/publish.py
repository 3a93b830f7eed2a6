"""`texvent dataset publish DIR`: the index, the card and the description of a data set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.dataset.publishing.card import PublicationInfo
from texvent.dataset.publishing.publish import publish
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import InputError, one_line

DESCRIPTION = """Write what a data set is published with, into its folder: index.parquet (one row
per sample), README.md (the card, with what Hugging Face reads) and croissant.json. Nothing is
uploaded. Equal shards give equal files, so it can be run again.

  texvent dataset publish cars --license cc-by-4.0 --creator "A. Author"
  hf upload NAME/cars cars --repo-type dataset --exclude "logs/*"      then, for the Hub"""


@dataclass(frozen=True, kw_only=True)
class PublishOptions:
    """What the card says besides what the shards tell."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    outputs: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder of the data set."""
    license: str | None = None
    """Licence, such as cc-by-4.0; default: that of the specification."""
    creator: str | None = None
    """Who made it."""
    url: str | None = None
    """Its page."""
    date: str | None = None
    """When it is published, such as 2026-11-21."""
    notes: Path | None = None
    """A Markdown file whose text stands in the card."""
    partial: bool = False
    """Publish although shards are missing."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data set": PublishOptions()},
        prog="texvent dataset publish",
        description=DESCRIPTION,
    )
    info = PublicationInfo(
        license=options.license,
        creator=options.creator,
        url=options.url,
        date=options.date,
        notes=_text(options.notes),
    )
    published = publish(StoredDataset.open(options.folder), info, partial=options.partial)
    names = ", ".join(path.name for path in published.files)
    total = published.statistics.total
    write_out(
        f"{options.folder}: {total.samples:,} samples in {total.shards:,} shards described in "
        f"{names}{f'; {published.missing} shards are missing' if published.missing else ''}\n"
    )
    return 0


def _text(path: Path | None) -> str:
    if path is None:
        return ""
    try:
        return path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path} ({one_line(error)}); give a text file") from error
