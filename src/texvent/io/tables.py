"""Events in named arrays or columns, known by their names: text, npz, npy, HDF5, Parquet.

A recording is four arrays of one group (`events/x`, `xs`, `x_pos` …), one array of records with
such fields, an array [n, 4] whose order is certain, or `xy` [n, 2] beside times and polarities.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, shown
from texvent.io.block_codec import TimedRows
from texvent.io.block_writer import Columns
from texvent.io.polarity import PolarityCode
from texvent.io.reading import (
    ReadOptions,
    TimeUnit,
    are_times,
    check_precision,
    check_rate,
    guess_unit,
    sample_of,
    stated_or_given,
    to_microseconds,
    unit_in_name,
    warn_of_strays,
)
from texvent.io.repair import UNREADABLE_US

Array: TypeAlias = Any
"""A data set or an array in a file: it has shape and dtype, and a slice reads rows of it."""
SPELLINGS = {
    "t": ("t", "ts", "timestamp", "timestamps", "time", "times", "stamp"),
    "x": ("x", "xs", "x_pos"),
    "y": ("y", "ys", "y_pos"),
    "p": ("p", "ps", "pol", "polarity", "polarities", "on", "is_on", "polarity_on"),
}
"""Column → its names, in lower case, without `events_` before and a unit after them."""
PAIRS = ("xy", "xys")
"""Names of an array [n, 2] of x and y."""
MORE_KINDS = {"t": "mM", "p": "SU"}
"""Column → kinds of NumPy that it may have besides numbers: spans and dates, words."""
SAMPLE_ROWS = 4096
TABLE_OPTIONS = ("time_unit", "columns", "stream")
"""Options of reading that files of named columns take."""


def spelled(name: str) -> tuple[str | None, TimeUnit | None]:
    """The column that a name means, and the unit that it states.

    Example:
        >>> spelled("Timestamp [us]"), spelled("events_xy"), spelled("frame")
        (('t', 'us'), ('xy', None), (None, None))
    """
    for whole in (name.strip().lower(), unit_in_name(name)[0]):
        text = re.sub(r"^.*events?_", "", whole)
        for column, spellings in {**SPELLINGS, "xy": PAIRS}.items():
            if text in spellings:
                return column, unit_in_name(name)[1] if column == "t" else None
    return None, None


def find_columns(path: Path, names: Iterable[str]) -> dict[str, str]:
    """t, x, y, p → the name that a file with columns of these names gives each.

    Raises:
        FileFormatError: a column is missing or there twice; the message says what is accepted.
    """
    names, found = list(names), {}
    for column, spellings in SPELLINGS.items():
        matching = [name for name in names if spelled(name)[0] == column]
        if len(matching) != 1:
            what = f"{len(matching)} columns" if matching else "no column"
            raise FileFormatError(
                f"{path} has {what} {column!r} (it has: {shown(', '.join(names) or 'none')}); "
                f"texvent reads columns t, x, y, p; {column} may be called "
                f"{' or '.join(spellings[1:4])}; or give columns (--columns {column}=NAME,...)"
            )
        found[column] = matching[0]
    return found


class Column(NamedTuple):
    """Place of a column."""

    array: str
    """Name of the array."""
    part: int | str | None = None
    """Number of the column in an array [n, k], or field of records; None: the array alone."""

    def is_numeric(self, array: Array, more: str = "") -> bool:
        """Whether an array has numbers at this place, or values of `more` kinds of NumPy."""
        shape, dtype = array.shape, array.dtype
        if isinstance(self.part, int):
            return len(shape) == 2 and self.part < shape[1] and dtype.kind in "biuf"
        if len(shape) != 1 and (len(shape) != 2 or 1 not in shape):
            return False
        kind = dtype if self.part is None else (dtype.fields or {}).get(self.part, (None,))[0]
        return kind is not None and kind.kind in "biuf" + more

    def of(self, rows: NDArray[Any]) -> NDArray[Any]:
        """The column of some rows, [n]."""
        if isinstance(self.part, int):
            return rows[:, self.part]
        return (rows if self.part is None else rows[self.part]).reshape(-1)


class RowVector:
    """An array [1, n] as [n]."""

    def __init__(self, array: Array) -> None:
        self._array, self.shape, self.dtype = array, array.shape[1:], array.dtype

    def __getitem__(self, rows: slice) -> NDArray[Any]:
        """The values of a slice."""
        return np.asarray(self._array[0, rows])


def time_offset(path: Path, stored: Any) -> NDArray[Any]:
    """`t_offset` of a file, which is added to its times, in their unit, [1].

    Raises:
        FileFormatError: it is not one number.
    """
    if stored.size != 1 or stored.dtype.kind not in "iuf":
        raise FileFormatError(f"{path}: t_offset must be one number; it is {shown(stored[()])}")
    value = np.asarray(stored[()]).reshape(-1)
    return value if value.dtype.kind == "f" else value.astype(np.int64)


@dataclass(frozen=True)
class EventTable:
    """The arrays of one recording."""

    name: str
    """Group or array, as `--stream` names it."""
    columns: Mapping[str, Column]
    """x, y, t, p → place."""
    unit: TimeUnit | None = None
    """Unit of the times, where the file states it."""
    extra: Mapping[str, str] = field(default_factory=dict)
    """label, instance, class_id → array, where the file has them."""

    @property
    def arrays(self) -> tuple[str, ...]:
        """Names of its arrays, each once."""
        named = (column.array for column in self.columns.values())
        return tuple(dict.fromkeys((*named, *self.extra.values())))

    def check(self, path: Path, arrays: Mapping[str, Array]) -> None:
        """Refuse arrays that do not fit together.

        Raises:
            FileFormatError: one is missing, or shapes or types are wrong.
        """
        for name, column in self.columns.items():
            array = arrays.get(column.array)
            if array is None:
                raise FileFormatError(f"{path} has no {column.array!r}")
            if not column.is_numeric(array, MORE_KINDS.get(name, "")):
                raise FileFormatError(
                    f"{path}: {column.array} is {shown(array.dtype)} of shape "
                    f"{shown(array.shape)}; it must hold numbers, one row per event"
                )
        lengths = {name: self._column(arrays, name).shape[0] for name in self.arrays}
        if len(set(lengths.values())) != 1:
            raise FileFormatError(f"{path}: the columns of events differ in length: {lengths}")

    def _column(self, arrays: Mapping[str, Array], name: str) -> Array:
        """An array with one row per event, also if it is one row, as MATLAB's columns are."""
        array, is_alone = arrays[name], Column(name) in self.columns.values()
        is_row = is_alone and len(array.shape) == 2 and array.shape[0] == 1
        return RowVector(array) if is_row else array

    def rows(
        self,
        path: Path,
        arrays: Mapping[str, Array],
        options: ReadOptions,
        *,
        offset: NDArray[Any] | None = None,
        block: int,
    ) -> TimedRows:
        """The events of checked arrays.

        Args:
            path: the file, for messages.
            arrays: name → array.
            options: the unit of time, where the file does not state it.
            offset: added to all times, in their unit; [1].
            block: events of a packet.

        Raises:
            FileFormatError: the times cannot be meant in the unit that they seem to have, or the
                polarities are of no code.
        """
        arrays = {name: self._column(arrays, name) for name in self.arrays}
        in_time = arrays[self.columns["t"].array]
        count, of_time = in_time.shape[0], self.columns["t"].of
        is_known = self.unit is not None or options.time_unit is not None
        samples = {
            "t": of_time(np.asarray(in_time[-1:]) if is_known else sample_of(in_time, count)),
            "p": self.columns["p"].of(sample_of(arrays[self.columns["p"].array], count)),
        }
        values = ColumnValues(path, count, samples, self.unit, options, offset)
        own = dict(self.extra)
        if "label" in own and not (sample_of(arrays[own["label"]], count) <= 1).all():
            del own["label"]  # classes of another program

        def read(start: int, stop: int) -> Columns:
            parts = {name: np.asarray(arrays[name][start:stop]) for name in self.arrays}
            stored = {name: column.of(parts[column.array]) for name, column in self.columns.items()}
            return {**values.columns(stored), **{name: parts[own[name]] for name in own}}

        def time_us(index: int) -> int:
            return int(values.times_us(of_time(np.asarray(in_time[index : index + 1])))[0])

        return TimedRows(count, time_us, read, block)


class ColumnValues:
    """Values of stored columns as those of events: unit and code of polarity are judged once.

    Args:
        path: the file, for messages.
        count: number of events.
        samples: times t and polarities p from all over the file, from the first to the last; of
            times whose unit is known the last is enough.
        stated: unit of the times, where the file states it.
        options: the unit, where it does not.
        offset: added to all times, in their unit; [1].

    Raises:
        FileFormatError: the times cannot be meant in the unit that they seem to have, or the
            polarities are of no code.
    """

    def __init__(
        self,
        path: Path,
        count: int,
        samples: Mapping[str, NDArray[Any]],
        stated: TimeUnit | None,
        options: ReadOptions,
        offset: NDArray[Any] | None = None,
    ) -> None:
        known = stated_or_given(path, stated, options)
        times = samples["t"][are_times(samples["t"], known or "us")]
        self._path, self._is_guessed, self._offset_us = path, known is None, 0
        self._repairs = options.repair
        self._unit = known or guess_unit(times)
        times = times[are_times(times, self._unit)]
        if offset is not None:
            self._offset_us = int(to_microseconds(path, offset, self._unit)[0])
        self._code = PolarityCode(path, samples["p"], is_repaired=options.repair)
        check_precision(path, times[-1:], self._unit)
        if self._is_guessed:
            times_us = self.times_us(times)
            check_rate(path, count, times_us, self._unit)
            if not options.repair:
                warn_of_strays(path, times_us)

    def times_us(self, stored: NDArray[Any]) -> NDArray[np.int64]:
        """Times, µs."""
        found = to_microseconds(self._path, stored, self._unit, is_guessed=self._is_guessed)
        return found + self._offset_us if self._offset_us else found

    def columns(self, stored: Mapping[str, NDArray[Any]]) -> Columns:
        """x, y, t and p of some rows; in repair those that are none get the time of no event."""
        is_sound = self._are_sound(stored) if self._repairs else np.ones(1, bool)
        if not is_sound.all() and is_sound.any():
            at = np.where(is_sound, np.arange(len(is_sound)), is_sound.argmax())
            found = self._all_sound({name: one[at] for name, one in stored.items()})
            return {**found, "t": np.where(is_sound, found["t"], UNREADABLE_US)}
        return self._all_sound(stored)

    def _are_sound(self, stored: Mapping[str, NDArray[Any]]) -> NDArray[np.bool_]:
        sound = are_times(stored["t"], self._unit) & self._code.are_likely(stored["p"])
        return sound & are_whole(stored["x"]) & are_whole(stored["y"])

    def _all_sound(self, stored: Mapping[str, NDArray[Any]]) -> Columns:
        pixels = {name: whole_numbers(self._path, stored[name]) for name in "xy"}
        p, t = self._code.binary(stored["p"]), self.times_us(stored["t"])
        return {**pixels, "p": p, "t": t}


def are_whole(values: NDArray[Any]) -> NDArray[np.bool_]:
    """Mask of values that are whole numbers that pixels may have."""
    if values.dtype.kind != "f":
        return np.ones(len(values), bool)
    return np.asarray((np.abs(values, dtype=np.float64) < 2**31) & (values == np.rint(values)))


def whole_numbers(path: Path, values: NDArray[Any]) -> NDArray[Any]:
    """Pixels or polarities as integers, of any type they are stored as.

    Raises:
        FileFormatError: they are no whole numbers.
    """
    if values.dtype.kind in "biu":
        return values
    if values.dtype.kind != "f" or not are_whole(values).all():
        raise FileFormatError(f"{path} holds x, y or p that are not whole numbers")
    return values.astype(np.int64)
