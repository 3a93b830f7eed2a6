"""HDF5 files on disk: opening, checks of hostile files, packed chunks, notice of a full disk."""

from __future__ import annotations

import io
import math
import os
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent._require import install_command, require
from texvent.errors import FileFormatError, InputError, MissingDependencyError, shown
from texvent.io.block_writer import BlockWriter, WriteBlock
from texvent.io.input_checks import reporting_damage
from texvent.runtime.work.interrupts import delay_interrupts

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer, WriteableBuffer


HDF5_DAMAGE = (
    *(OSError, RuntimeError, KeyError, ValueError, TypeError, AttributeError, MemoryError),
    OverflowError,
)
"""h5py raises any of these on a damaged file."""
MAX_CHUNK_BYTES = 256 * 2**20
"""HDF5 unpacks whole chunks: larger ones would fill the memory."""


DEEPEST = 64
"""Groups within groups; recordings have three or four."""


@contextmanager
def open_hdf5(path: Path) -> Iterator[Any]:
    """An HDF5 file to read; what h5py raises inside the block names the file.

    Raises:
        FileFormatError: the file is damaged, leads to other files, or nests groups too deep.
        InputError: another program writes it.
    """
    with reporting_damage(path, "an HDF5 event file", HDF5_DAMAGE), _opened(path) as file:
        _check_links(file, path)
        yield file


def _opened(path: Path) -> Any:
    try:
        return h5py.File(path, "r")
    except OSError as error:
        if "lock file" not in str(error):
            raise
        raise InputError(
            f"{path} is open in another program, which may be writing it; close it there (if none "
            "has it open, the file system gives no locks: set HDF5_USE_FILE_LOCKING=FALSE)"
        ) from error


def _check_links(file: Any, path: Path) -> None:
    """Refuse links to other files, any of which the sender could name, and groups without end.

    HDF5 follows nested groups by recursion: at 50,000 the process ends without a word.
    """

    def is_refused(name: bytes, link: Any) -> str | None:
        if link.type not in (h5py.h5l.TYPE_HARD, h5py.h5l.TYPE_SOFT):
            return f"its {shown(name.decode(errors='replace'))} is a link to another file; copy"
        is_deep = name.count(b"/") >= DEEPEST
        return f"its groups are nested more than {DEEPEST} deep; copy" if is_deep else None

    found = file.id.links.visit(is_refused, info=True)
    if found is not None:
        raise FileFormatError(f"{path} is not read: {found} the events into a file of their own")


def check_claims(dataset: Any, path: Path) -> None:
    """Refuse a dataset that lies in other files, or would take too long or too much memory to read.

    HDF5 gives zeros where nothing is stored, so a file of 4 kB can claim 10^18 events; and a chunk
    of zeros shrinks to a thousandth.

    Raises:
        FileFormatError: more values are claimed than stored, or chunks are too large, or values
            are those of another file, any of which the sender could name.
    """
    if dataset.external or dataset.is_virtual:
        raise FileFormatError(
            f"{path}: the values of {dataset.name} are in other files, which are not read; "
            "h5repack copies them into one"
        )
    if dataset.chunks is None:
        stored = dataset.id.get_storage_size() // dataset.dtype.itemsize
    else:
        length = math.prod(dataset.chunks)
        if length * dataset.dtype.itemsize > MAX_CHUNK_BYTES:
            raise FileFormatError(
                f"{path}: {dataset.name} has chunks of {length * dataset.dtype.itemsize} bytes; "
                f"at most {MAX_CHUNK_BYTES}. If the file is sound, h5repack makes them smaller"
            )
        stored = dataset.id.get_num_chunks() * length
    if stored < dataset.size:
        raise FileFormatError(
            f"{path} is damaged: {dataset.name} claims {dataset.size} values and stores at most "
            f"{stored}"
        )


def check_filters(dataset: Any, path: Path) -> None:
    """Load hdf5plugin where a file, such as DSEC's, is compressed with a foreign filter.

    Raises:
        MissingDependencyError: it is not installed.
    """
    properties = dataset.id.get_create_plist()
    filters = [properties.get_filter(index)[0] for index in range(properties.get_nfilters())]
    if all(h5py.h5z.filter_avail(code) for code in filters):
        return
    try:
        require("hdf5plugin")
    except MissingDependencyError as error:
        raise MissingDependencyError(
            f"{path} is compressed with an HDF5 filter that h5py does not bring (blosc in DSEC "
            f"files); install it with: {install_command('texvent[blosc]')}"
        ) from error


class LinearColumn:
    """A data set [n] that stands for `scale * stored + offset`, whole numbers where it can."""

    def __init__(self, dataset: Any, scale: float, offset: float) -> None:
        is_whole = np.can_cast(dataset.dtype, np.int64) and abs(scale) == 1 and offset % 1 == 0
        self.shape, self.dtype = dataset.shape, np.dtype(np.int64 if is_whole else np.float64)
        self._dataset, self._terms = dataset, np.array([scale, offset]).astype(self.dtype)

    def __getitem__(self, rows: Any) -> NDArray[Any]:
        """The values of a slice."""
        scale, offset = self._terms
        return np.asarray(scale * np.asarray(self._dataset[rows]).astype(self.dtype) + offset)


def as_stated(dataset: Any, path: Path, last: int | None) -> Any:
    """A column by `scale_factor` and `add_offset`, netCDF's attributes.

    Args:
        dataset: h5py's.
        path: the file, for messages.
        last: the last pixel, of a coordinate that counts from the far side.

    Raises:
        FileFormatError: one is no number, or of several columns.
    """
    terms = []
    for name, default in (("scale_factor", 1), ("add_offset", 0)):
        stated = np.ravel(dataset.attrs.get(name, default))
        if stated.size != 1 or stated.dtype.kind not in "iuf" or not np.isfinite(stated).all():
            raise FileFormatError(f"{path}: {name} of {dataset.name} is {shown(stated.tolist())}")
        terms.append(float(stated[0]))
    scale, offset = terms if last is None else (-terms[0], last - terms[1])
    if (scale, offset) == (1, 0):
        return dataset
    if dataset.dtype.names or dataset.size != max(dataset.shape):
        raise FileFormatError(
            f"{path}: an attribute scales or turns {dataset.name}, which has several columns; "
            "write x, y, t and p as data sets of their own"
        )
    return LinearColumn(dataset, scale, offset)


LEVEL = 1
WINDOW_BITS = 15
MEMORY_LEVEL = 9


def append_chunks(dataset: Any, values: NDArray[Any]) -> None:
    """Append to a dataset that has whole chunks, and the filters shuffle and gzip.

    Args:
        dataset: one-dimensional h5py dataset; its length is a multiple of its chunks'.
        values: values to append; the last chunk is filled up with zeros beyond the dataset's end.
    """
    known, chunk = dataset.shape[0], dataset.chunks[0]
    dataset.resize((known + len(values),))
    for start in range(0, len(values), chunk):
        full = np.zeros(chunk, dataset.dtype)
        part = values[start : start + chunk]
        full[: len(part)] = part
        dataset.id.write_direct_chunk((known + start,), pack(full))


def pack(values: NDArray[Any]) -> bytes:
    """Values as HDF5's shuffle and deflate filters store them.

    Args:
        values: [n] contiguous, any type.

    Returns:
        A zlib stream of all first bytes, then all second bytes, and so on.
    """
    shuffled = np.ascontiguousarray(values.view(np.uint8).reshape(-1, values.itemsize).T)
    packer = zlib.compressobj(LEVEL, zlib.DEFLATED, WINDOW_BITS, MEMORY_LEVEL, zlib.Z_RLE)
    return packer.compress(shuffled.data) + packer.flush()


class DeferredErrorFile(io.FileIO):
    """An existing file that remembers the first failed write instead of raising it.

    HDF5 cannot be told that the disk is full: it keeps retrying when the file is closed, prints
    pages of errors and then crashes the process. Behind this file it never learns; the writer asks
    for `failure` after each batch and throws the file away. After a failure nothing more is
    written, and missing parts read as zeros.
    """

    def __init__(self, path: Path) -> None:
        super().__init__(path, "r+")
        self._length = os.fstat(self.fileno()).st_size
        self.failure: OSError | None = None
        """The first write that failed, if any."""

    def raise_failure(self) -> None:
        """Raise the failure so far.

        Raises:
            OSError: a write failed.
        """
        if self.failure is not None:
            raise self.failure

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        """Move to an offset from the start, the current position or the end."""
        if whence == os.SEEK_END:
            return super().seek(self._length + offset)
        return super().seek(offset, whence)

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Fill the buffer from the current position."""
        view = memoryview(buffer).cast("B")
        start = self.tell()
        wanted = max(0, min(len(view), self._length - start))
        found = super().readinto(view[:wanted])
        view[found:wanted] = bytes(wanted - found)
        super().seek(start + wanted)
        return wanted

    def write(self, buffer: ReadableBuffer) -> int:
        """Write all bytes at the current position; a failure is remembered, not raised."""
        view = memoryview(buffer).cast("B")
        end, written = self.tell() + len(view), 0
        try:
            while self.failure is None and written < len(view):
                written += os.write(self.fileno(), view[written:])
        except OSError as error:
            self.failure = error
        self._length = max(self._length, end)
        super().seek(end)
        return len(view)

    def truncate(self, size: int | None = None) -> int:
        """Set the file's length, by default to the current position."""
        self._length = self.tell() if size is None else size
        try:
            if self.failure is None:
                super().truncate(self._length)
        except OSError as error:
            self.failure = error
        return self._length


class Hdf5Writer(BlockWriter):
    """Keeps Ctrl-C out of HDF5's callbacks; see `delay_interrupts`."""

    def __enter__(self) -> Self:
        with delay_interrupts():
            return super().__enter__()

    def __exit__(self, *error: Any) -> None:
        with delay_interrupts():
            super().__exit__(*error)

    def _write_pending(self, write: WriteBlock, *, final: bool) -> None:
        with delay_interrupts():
            super()._write_pending(write, final=final)
