"""Layouts of events in named arrays: data sets of HDF5 files, arrays of archives and folders.

A layout says in which arrays the columns are, in which unit times count, and what is added to
them. A further family of files is one more `EventLayout`; `texvent.io.hdf5.native.LAYOUTS` lists
those of HDF5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.block_codec import TimedRows
from texvent.io.protocol import Columns

MICROSECONDS = 1_000_000
Array: TypeAlias = Any
"""A data set or an array in a file: it has shape and dtype, and a slice reads rows of it."""
LARGEST_FLOAT = 1 << 51
"""Up to here float64 keeps every µs of seconds (71 years)."""


class Column(NamedTuple):
    """Place of a column."""

    array: str
    """Name of the array."""
    part: int | str | None = None
    """Number of the column in an array [n, k], or field of records; None: the array alone."""

    def kind_in(self, array: Array, width: int) -> str:
        """Kind of its numbers in an array of so many columns, as `dtype.kind`; "" if not there."""
        if isinstance(self.part, int):
            return str(array.dtype.kind) if array.shape[1:] == (width,) else ""
        if not array.shape or array.shape[1:] not in ((), (1,)):
            return ""
        if self.part is None:
            return str(array.dtype.kind)
        fields = array.dtype.fields or {}
        return str(fields[self.part][0].kind) if self.part in fields else ""

    def of(self, rows: NDArray[Any]) -> NDArray[Any]:
        """The column of some rows, [n]."""
        if isinstance(self.part, int):
            return rows[:, self.part]
        return (rows if self.part is None else rows[self.part]).reshape(-1)


@dataclass(frozen=True)
class EventLayout:
    """Where files of one family keep x, y, t and p.

    Whole times are rounded down to µs, times in float64 to the nearest µs.
    """

    name: str
    """As messages say it."""
    columns: Mapping[str, Column]
    """x, y, t, p → place."""
    per_second: int = MICROSECONDS
    """Units of time in a second."""
    offset: str | None = None
    """Name of a single value, µs, that is added to the times where it is there."""

    @property
    def arrays(self) -> tuple[str, ...]:
        """Names of its arrays, each once."""
        return tuple(dict.fromkeys(column.array for column in self.columns.values()))

    def check(self, path: Path, arrays: Mapping[str, Array]) -> None:
        """Refuse arrays that do not fit together.

        Args:
            path: the file, for messages.
            arrays: those of `self.arrays`, and others of one value per event.

        Raises:
            FileFormatError: one is missing, or shapes or types are wrong.
        """
        missing = [name for name in self.arrays if name not in arrays]
        if missing:
            raise FileFormatError(f"{path} has no {missing[0]!r}, which {self.name} has")
        for column in self.columns.values():
            array = arrays[column.array]
            width = sum(1 for one in self.columns.values() if one.array == column.array)
            if column.kind_in(array, width) not in (*"biuf",):
                raise FileFormatError(
                    f"{path}: {column.array} is {shown(array.dtype)} of shape "
                    f"{shown(array.shape)}; {self.name} has numbers there, one row per event"
                )
        lengths = {name: array.shape[0] for name, array in arrays.items()}
        if len(set(lengths.values())) != 1:
            raise FileFormatError(f"{path}: the columns of events differ in length: {lengths}")

    def rows(
        self, path: Path, arrays: Mapping[str, Array], *, offset_us: int = 0, block: int
    ) -> TimedRows:
        """The events of checked arrays; arrays that no column names are columns themselves."""
        others = [name for name in arrays if name not in self.arrays]

        def times(rows: NDArray[Any]) -> NDArray[np.int64]:
            times_us = self._to_us(path, self.columns["t"].of(np.asarray(rows)))
            return times_us + offset_us if offset_us else times_us

        def read(start: int, stop: int) -> Columns:
            parts = {name: np.asarray(array[start:stop]) for name, array in arrays.items()}
            columns = {
                name: column.of(parts[column.array]) for name, column in self.columns.items()
            }
            whole = {name: whole_numbers(path, columns[name]) for name in "xyp"}
            extra = {name.rpartition("/")[2]: parts[name] for name in others}
            return {**whole, **extra, "t": times(parts[self.columns["t"].array])}

        in_time = arrays[self.columns["t"].array]

        def time_of(index: int) -> int:
            return int(times(in_time[index : index + 1])[0])

        return TimedRows(in_time.shape[0], time_of, read, block)

    def _to_us(self, path: Path, times: NDArray[Any]) -> NDArray[np.int64]:
        if times.dtype.kind == "f":
            times_us = times.astype(np.float64) * (MICROSECONDS / self.per_second)
            if not (np.abs(times_us) < LARGEST_FLOAT).all():
                raise FileFormatError(f"{path} holds times that are not seconds")
            return np.rint(times_us).astype(np.int64)
        whole = times.astype(np.int64, copy=False)
        if self.per_second == MICROSECONDS:
            return whole
        if self.per_second < MICROSECONDS:
            return whole * (MICROSECONDS // self.per_second)
        return whole // (self.per_second // MICROSECONDS)


def whole_numbers(path: Path, values: NDArray[Any]) -> NDArray[Any]:
    """Pixels or polarities as integers, of any type they are stored as.

    Raises:
        FileFormatError: they are no whole numbers.
    """
    if values.dtype.kind != "f":
        return values
    if not (np.abs(values) < 2**31).all() or (values != np.rint(values)).any():
        raise FileFormatError(f"{path} holds x, y or p that are not whole numbers")
    return values.astype(np.int64)
