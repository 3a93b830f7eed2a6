"""`texvent dataset merge A B -o C`: several data sets as one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.dataset.merge import merge
from texvent.dataset.reading.stored_dataset import StoredDataset
from texvent.errors import ConfigError

DESCRIPTION = """Put data sets together in a new folder. Shards are linked (copied to another disk),
so this takes seconds and no room. Where classes differ they are numbered together, and shards are
written anew. Versions and settings may differ: every sample states its own. The result can be
verified, published and loaded, but not made further.

  texvent dataset merge cars dogs -o all"""


@dataclass(frozen=True, kw_only=True)
class MergeOptions:
    """What to put together."""

    positional: ClassVar[tuple[str, ...]] = ("folders",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}

    folders: tuple[Path, ...] = REQUIRED
    """Folders of the data sets."""
    out: Path | None = None
    """Folder of the new one."""
    name: str | None = None
    """Its name; default: that of the folder."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments,
        {"data sets": MergeOptions()},
        prog="texvent dataset merge",
        description=DESCRIPTION,
    )
    if options.out is None:
        raise ConfigError("merge needs the folder to write; name it with -o")
    sources = [StoredDataset.open(folder) for folder in options.folders]
    merged = merge(sources, options.out.absolute(), name=options.name)
    how = f", {merged.rewritten:,} of them with new class numbers" if merged.rewritten else ""
    write_out(
        f"{options.out}: {merged.samples:,} samples of {len(sources)} data sets in "
        f"{merged.shards:,} shards{how}\n"
    )
    return 0
