"""What h5py says about a damaged file, as one clear error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from texvent.errors import FileFormatError, InputError, MissingDependencyError

HDF5_DAMAGE = (OSError, RuntimeError, KeyError, ValueError, TypeError, AttributeError, MemoryError)
"""h5py raises any of these on a damaged file."""


@contextmanager
def reporting_damage(path: Path) -> Iterator[None]:
    """Turn what h5py raises inside the block into a FileFormatError that names the file.

    Raises:
        FileFormatError: the file is damaged.
    """
    try:
        yield
    except (InputError, MissingDependencyError):
        raise
    except HDF5_DAMAGE as error:
        reason = " ".join(str(error).split())[:200]
        raise FileFormatError(f"{path} is damaged or not an HDF5 event file ({reason})") from error
