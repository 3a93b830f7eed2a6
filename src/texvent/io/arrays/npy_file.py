"""A .npy file whose length is known only at its end."""

from __future__ import annotations

from contextlib import ExitStack
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


class NpyFile:
    """Appends rows to a .npy file.

    Args:
        path: the file.
        stack: closes it.
        dtype: type of the values.
        columns: values per row; None: the array has one dimension.
    """

    def __init__(
        self, path: Path, stack: ExitStack, *, dtype: str, columns: int | None = None
    ) -> None:
        self._file = stack.enter_context(path.open("wb"))
        self._dtype = np.dtype(dtype)
        self._columns = columns
        self._rows = 0
        self._write_header()

    def append(self, rows: NDArray[np.generic]) -> None:
        """Add rows, [n] or [n, columns]."""
        self._file.write(np.ascontiguousarray(rows, dtype=self._dtype).data)
        self._rows += len(rows)

    def finish(self) -> None:
        """Write how many rows there are."""
        self._file.seek(0)
        self._write_header()

    def _write_header(self) -> None:
        shape = (self._rows,) if self._columns is None else (self._rows, self._columns)
        facts = {"descr": self._dtype.str, "fortran_order": False, "shape": shape}
        length = HEADER_BYTES - len(_MAGIC) - 2
        text = f"{facts}".ljust(length - 1) + "\n"
        self._file.write(_MAGIC + length.to_bytes(2, "little") + text.encode("ascii"))


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
