"""`texvent dataset publish DIR`: the card of a data set."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.dataset.publish import CARD_FILE, publish
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import InputError, one_line

DESCRIPTION = """Write the card that a data set is published with into its folder: README.md, with
what Hugging Face reads. Nothing is uploaded. Equal shards give equal files.

  texvent dataset publish cars --license cc-by-4.0
  hf upload NAME/cars cars --repo-type dataset --exclude "logs/*"      then, for the Hub"""


@dataclass(frozen=True, kw_only=True)
class PublishOptions:
    """Contents of the card besides the counts."""

    positional: ClassVar[tuple[str, ...]] = ("folder",)
    outputs: ClassVar[tuple[str, ...]] = ("folder",)

    folder: Path = REQUIRED
    """Folder of the data set."""
    license: str | None = None
    """Licence, such as cc-by-4.0; default: that of the specification."""
    notes: Path | None = None
    """A Markdown file whose text is added to the card."""
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
    statistics, missing = publish(
        StoredDataset.open(options.folder),
        license=options.license,
        notes=_text(options.notes),
        partial=options.partial,
    )
    total = statistics.total
    write_out(
        f"{options.folder / CARD_FILE}: {total.samples:,} samples in {total.shards:,} shards"
        f"{f'; {missing} shards are missing' if missing else ''}\n"
    )
    return 0


def _text(path: Path | None) -> str:
    if path is None:
        return ""
    try:
        return path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path} ({one_line(error)}); give a text file") from error
