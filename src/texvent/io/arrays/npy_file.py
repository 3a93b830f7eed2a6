"""A .npy file whose length is known only at its end, and one that is read row by row."""

from __future__ import annotations

import math
import os
import tokenize
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.lib import format as npy_format
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.input_checks import reporting_damage

HEADER_BYTES, RECORD_HEADER_BYTES = 128, 512
"""The header's text is padded to this, so that the number of rows fits in whatever it is."""
NPY_DAMAGE = (
    *(OSError, ValueError, TypeError, EOFError, SyntaxError, OverflowError, MemoryError),
    *(RecursionError, UserWarning, tokenize.TokenError),
)
"""NumPy raises any of these on a damaged file."""
_MAGIC = b"\x93NUMPY\x01\x00"


@contextmanager
def growing_array(
    path: Path, *, dtype: str | np.dtype[np.void], is_live: bool = False
) -> Iterator[Callable[[NDArray[np.generic]], None]]:
    """A .npy file, [n], to which the function given appends; a type with names makes records.

    If it is live, the file is whole after every append, even if the process is killed.
    """
    kind = np.dtype(dtype)
    row_count = 0
    with path.open("wb") as file:

        def write_header() -> None:
            facts = {
                "descr": npy_format.dtype_to_descr(kind),
                "fortran_order": False,
                "shape": (row_count,),
            }
            space = HEADER_BYTES if kind.names is None else RECORD_HEADER_BYTES
            length = space - len(_MAGIC) - 2
            text = f"{facts}".ljust(length - 1) + "\n"
            file.write(_MAGIC + length.to_bytes(2, "little") + text.encode("ascii"))

        def append(rows: NDArray[np.generic]) -> None:
            nonlocal row_count
            file.write(np.ascontiguousarray(rows, dtype=kind).data)
            row_count += len(rows)
            if is_live:
                file.flush()  # the rows first: the header never promises more than there are
                file.seek(0)
                write_header()
                file.flush()
                file.seek(0, os.SEEK_END)

        write_header()
        yield append
        file.seek(0)
        write_header()


class StoredArray:
    """The array of a .npy file, of which rows are read when they are asked for.

    Not mapped into memory: a mapped file that shrinks ends the process by a bus error.

    Raises:
        FileFormatError: it is damaged, cut off, or holds Python objects.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with reporting_damage(path, "a NumPy array", NPY_DAMAGE), path.open("rb") as file:
            shape, self._is_fortran, self.dtype = read_header(file)
            self._start = file.tell()
            stored = os.fstat(file.fileno()).st_size - self._start
            held = math.prod(shape) * self.dtype.itemsize
            file.seek(min(max(held, 0), stored), os.SEEK_CUR)
            has_more = file.read(len(_MAGIC)).startswith(_MAGIC[:6])
        self.shape: tuple[int, ...] = shape
        if self.dtype.hasobject or self.dtype.itemsize == 0:
            raise FileFormatError(f"{path} holds {self.dtype}, not numbers")
        if has_more:
            raise FileFormatError(
                f"{path} holds several arrays, one after the other; np.load reads them one by one "
                "from an open file: write them to one array"
            )
        if min(shape, default=0) < 0 or held > stored:
            raise FileFormatError(
                f"{path} states the shape {shown(shape)}, and has {stored} bytes for it; the file "
                "was cut off"
            )

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return len(self.shape)

    def __len__(self) -> int:
        return self.shape[0]

    def __iter__(self) -> Iterator[NDArray[Any]]:
        """The rows, one by one."""
        return (self.rows(index, index + 1)[0] for index in range(len(self)))

    def __getitem__(self, rows: slice) -> NDArray[Any]:
        """As `rows`, by a slice of step 1."""
        start, stop, _ = rows.indices(len(self))
        return self.rows(start, stop)

    def rows(self, start: int, stop: int) -> NDArray[Any]:
        """A copy of the rows from `start` to `stop`, or to the end.

        Raises:
            FileFormatError: the file has become shorter since it was opened.
        """
        if self._is_fortran and self.ndim > 1:
            return self._read_whole()[start:stop]
        stop = min(stop, len(self))
        values = math.prod(self.shape[1:])
        wanted = max(stop - start, 0) * values
        with self.path.open("rb") as file:
            offset = self._start + start * values * self.dtype.itemsize
            file.seek(offset)
            found = np.fromfile(file, self.dtype, wanted)
        if len(found) < wanted:
            raise FileFormatError(f"{self.path} became shorter while it was read; read it again")
        return found.reshape(-1 if values else max(stop - start, 0), *self.shape[1:])

    def _read_whole(self) -> NDArray[Any]:
        """An array stored column by column, whose rows are spread over the file."""
        with reporting_damage(self.path, "a NumPy array", NPY_DAMAGE):
            whole: NDArray[Any] = np.load(self.path, allow_pickle=False)
        return whole


def read_header(file: IO[bytes]) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Shape, whether columns are stored one after another, and type of an open .npy file."""
    version = npy_format.read_magic(file)
    with warnings.catch_warnings():
        # Files of Python 2 are read all the same.
        warnings.simplefilter("ignore", UserWarning)
        if version == (1, 0):
            return npy_format.read_array_header_1_0(file)
        if version == (2, 0):
            return npy_format.read_array_header_2_0(file)
    raise ValueError(f"version {version} of the format is not known")
