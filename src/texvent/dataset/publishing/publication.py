"""What stands in a published data set besides its shards: the same whenever it is published."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.contents.made_set import MadeSet
from texvent.dataset.contents.statistics import SetStatistics
from texvent.dataset.publishing.card import CARD_FILE, card_text
from texvent.dataset.publishing.croissant import CROISSANT_FILE, croissant_text
from texvent.dataset.publishing.index import write_index
from texvent.dataset.publishing.notice import Notice
from texvent.errors import InputError, OutputError, warn
from texvent.io.atomic import atomic_file

MOST_NAMED = 3


@dataclass(frozen=True)
class Published:
    """What was written."""

    files: tuple[Path, ...]
    statistics: SetStatistics
    missing: int
    """Shards that are not there."""


def publish(made: MadeSet, notice: Notice, *, partial: bool = False) -> Published:
    """Write the index, the card and the Croissant description; equal shards give equal bytes.

    Args:
        made: the data set.
        notice: what its author says of it.
        partial: whether shards may be missing.

    Raises:
        InputError: shards are missing.
        OutputError: a file cannot be written, or the card is another's.
        MissingDependencyError: pyarrow is not installed.
    """
    missing = made.missing()
    statistics = SetStatistics.of(made)
    if missing and not partial:
        raise InputError(
            f"{len(missing)} shards are missing, such as {', '.join(missing[:MOST_NAMED])}; make "
            "them (texvent dataset make), or publish what there is with --partial"
        )
    if not statistics.total.samples:
        raise InputError(f"{made.folder} holds no samples to publish")
    card = made.folder / CARD_FILE
    if card.exists() and notice.MARK not in card.read_text("utf-8", errors="replace"):
        raise OutputError(
            f"{card} was not written by texvent; move it away, or put its text into a file and "
            "give that with --notes"
        )
    if not notice.license_of(made):
        warn("no licence is stated, so others may not use the data set; state one with --license")
    index = write_index(made)
    text = {
        card: card_text(made, statistics, notice, missing=len(missing)),
        made.folder / CROISSANT_FILE: croissant_text(made, statistics, notice, index),
    }
    for path, content in text.items():
        with atomic_file(path, overwrite=True) as part:
            part.write_text(content, encoding="utf-8")
    return Published((index, *text), statistics, len(missing))
