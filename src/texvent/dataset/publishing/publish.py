"""Publication: index, card and description of a data set."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.publishing.card import CARD_FILE, PublicationInfo, card_text
from texvent.dataset.publishing.croissant import CROISSANT_FILE, croissant_text
from texvent.dataset.publishing.index import write_index
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.dataset.statistics import DatasetStatistics
from texvent.errors import InputError, OutputError, warn
from texvent.io.atomic import atomic_file

MOST_NAMED = 3


@dataclass(frozen=True)
class Published:
    """Files and counts of a publication."""

    files: tuple[Path, ...]
    statistics: DatasetStatistics
    missing: int
    """Shards that are not there."""


def publish(dataset: StoredDataset, info: PublicationInfo, *, partial: bool = False) -> Published:
    """Write the index, the card and the Croissant description; equal shards give equal bytes.

    Args:
        dataset: the data set.
        info: author, licence, notes.
        partial: whether shards may be missing.

    Raises:
        InputError: shards are missing.
        OutputError: a file cannot be written, or the card is another's.
        MissingDependencyError: pyarrow is not installed.
    """
    missing = dataset.missing()
    statistics = DatasetStatistics.of(dataset)
    if missing and not partial:
        raise InputError(
            f"{len(missing)} shards are missing, such as {', '.join(missing[:MOST_NAMED])}; make "
            "them (texvent dataset make), or publish what there is with --partial"
        )
    if not statistics.total.samples:
        raise InputError(f"{dataset.folder} holds no samples to publish")
    card = dataset.folder / CARD_FILE
    if card.exists() and info.MARK not in card.read_text("utf-8", errors="replace"):
        raise OutputError(
            f"{card} was not written by texvent; move it away, or put its text into a file and "
            "give that with --notes"
        )
    if not info.license_of(dataset):
        warn("no licence is stated, so others may not use the data set; state one with --license")
    index = write_index(dataset)
    text = {
        card: card_text(dataset, statistics, info, missing=len(missing)),
        dataset.folder / CROISSANT_FILE: croissant_text(dataset, statistics, info, index),
    }
    for path, content in text.items():
        with atomic_file(path, overwrite=True) as part:
            part.write_text(content, encoding="utf-8")
    return Published((index, *text), statistics, len(missing))
