"""A .npy file whose length is known only at its end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.io.input_checks import reporting_damage

HEADER_BYTES = 128
"""The header's text is padded to this, so that the number of rows fits in whatever it is."""
NPY_DAMAGE = (OSError, ValueError, TypeError, EOFError, SyntaxError, OverflowError)
"""NumPy raises any of these on a damaged file."""
_MAGIC = b"\x93NUMPY\x01\x00"


@contextmanager
def growing_array(
    path: Path, *, dtype: str, columns: int | None = None
) -> Iterator[Callable[[NDArray[np.generic]], None]]:
    """A .npy file to which the function given appends rows, [n] or [n, columns].

    Args:
        path: the file.
        dtype: type of the values.
        columns: values per row; None: the array has one dimension.
    """
    kind = np.dtype(dtype)
    row_count = 0
    with path.open("wb") as file:

        def write_header() -> None:
            shape = (row_count,) if columns is None else (row_count, columns)
            facts = {"descr": kind.str, "fortran_order": False, "shape": shape}
            length = HEADER_BYTES - len(_MAGIC) - 2
            text = f"{facts}".ljust(length - 1) + "\n"
            file.write(_MAGIC + length.to_bytes(2, "little") + text.encode("ascii"))

        def append(rows: NDArray[np.generic]) -> None:
            nonlocal row_count
            file.write(np.ascontiguousarray(rows, dtype=kind).data)
            row_count += len(rows)

        write_header()
        yield append
        file.seek(0)
        write_header()


def map_array(path: Path) -> NDArray[np.generic]:
    """The array of a .npy file, mapped into memory, not read.

    Raises:
        FileFormatError: it is damaged, cut off, or holds Python objects.
    """
    with reporting_damage(path, "a NumPy array", NPY_DAMAGE):
        array: NDArray[np.generic] = np.load(path, mmap_mode="r", allow_pickle=False)
    if not isinstance(array, np.ndarray):
        raise FileFormatError(f"{path} is an archive, not a NumPy array")
    return array
