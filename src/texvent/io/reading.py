"""Options of reading: facts that files leave out, which of their recordings is read, repair."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent.sensor import SensorSize, SizeLike, as_size

TimeUnit: TypeAlias = Literal["s", "ms", "us", "ns"]
"""Unit in which times are stored."""
PER_SECOND: dict[TimeUnit, int] = {"s": 1, "ms": 1000, "us": 1_000_000, "ns": 1_000_000_000}
MICROSECONDS = PER_SECOND["us"]
LARGEST_FLOAT = 1 << 51
"""Up to here float64 keeps every µs of seconds (71 years)."""
LEAST_HZ, LEAST_EVENTS = 5, 20
"""So many events at a lower mean rate are no recording in this unit: a quiet sensor gives more."""
LIKELY_HZ = 10
LATEST_GUESSED_US = 1 << 52
"""Later times since 1970 (142 years) are none of this unit."""
SAMPLE_TIMES = 4096


@dataclass(frozen=True, kw_only=True)
class ReadOptions:
    """How to read a file; each is for files that do not say it themselves."""

    size: SensorSize | None = None
    """Sensor size, pixels."""
    time_unit: TimeUnit | None = None
    """Unit of the times of text, npz, npy and HDF5."""
    columns: tuple[str, ...] | None = None
    """Columns in the order of the file (`t`, `x`, `y`, `p`; other words are skipped), or each with
    its name: `t=stamp`."""
    stream: str | None = None
    """Which recording of a file of several: group, topic or number of the camera."""
    repair: bool = False
    """Whether damage is repaired and counted instead of refused."""

    @property
    def names(self) -> dict[str, str]:
        """Column → its name in the file, of `columns` in the form `t=stamp`."""
        pairs = (word.partition("=") for word in self.columns or () if "=" in word)
        return {column.strip(): name.strip() for column, _, name in pairs}

    @property
    def order(self) -> tuple[str, ...] | None:
        """Columns in the order of the file, of `columns` in the form `t`, `x`, `y`, `p`."""
        return None if self.columns is None or self.names else self.columns


def read_options(
    *,
    size: SizeLike | None = None,
    time_unit: str | None = None,
    columns: str | Sequence[str] | None = None,
    stream: str | None = None,
    repair: bool = False,
) -> ReadOptions:
    """Checked options.

    Raises:
        ConfigError: an unknown unit, or columns without one of x, y, t and p.
    """
    units = get_args(TimeUnit)
    if time_unit is not None and time_unit not in units:
        raise ConfigError(f"time_unit is {shown(time_unit)}; {suggest(time_unit, units)}")
    words = columns.split(",") if isinstance(columns, str) else columns
    named = None if words is None else tuple(str(word).strip() for word in words)
    if named is not None:
        keys = [word.partition("=")[0].strip() for word in named]
        mixed = len({"=" in word for word in named}) > 1
        if mixed or any(keys.count(name) != 1 for name in "txyp"):
            raise ConfigError(
                f"columns is {shown(','.join(named))}; give t, x, y and p once each, in the order "
                "of the file (x,y,p,t) or with their names in it (t=stamp,x=col,y=row,p=pol)"
            )
    return ReadOptions(
        size=None if size is None else as_size(size),
        time_unit=time_unit,  # type: ignore[arg-type]  # one of them, as checked above
        columns=named,
        stream=None if stream is None else str(stream),
        repair=repair,
    )


def unit_in_name(name: str) -> tuple[str, TimeUnit | None]:
    """A column's name without the unit that it states, and the unit.

    Example:
        >>> unit_in_name("Timestamp [us]"), unit_in_name("t_ns"), unit_in_name("ts")
        (('timestamp', 'us'), ('t', 'ns'), ('ts', None))
    """
    match = re.fullmatch(r"(.+?)\s*[\[(_](s|sec|ms|us|µs|ns)[\])]?", name.strip().lower())
    if match is None:
        return name.strip().lower(), None
    units: dict[str, TimeUnit] = {"s": "s", "sec": "s", "ms": "ms", "us": "us", "µs": "us"}
    return match[1], units.get(match[2], "ns")


def unit_in_words(word: object) -> TimeUnit | None:
    """Unit of an attribute: "ns", "microseconds", b"s" and the like; None of others."""
    text = word.decode("latin-1") if isinstance(word, bytes) else str(word)
    prefixes = {"nanosec": "ns", "microsec": "us", "millisec": "ms", "second": "s"}
    long = next((unit for start, unit in prefixes.items() if text.lower().startswith(start)), text)
    return unit_in_name(f"t_{long}")[1]


def guess_unit(times: NDArray[Any]) -> TimeUnit:
    """Unit of times whose file does not state it: µs of whole numbers, s of fractions."""
    sample = times[:SAMPLE_TIMES]
    is_whole = sample.dtype.kind in "iu" or bool((sample == np.rint(sample)).all())
    return "us" if is_whole and len(sample) else "s"


def to_microseconds(path: Path, times: NDArray[Any], unit: TimeUnit) -> NDArray[np.int64]:
    """Times in µs: whole numbers rounded down, fractions to the nearest.

    Raises:
        FileFormatError: they are too large to be times in this unit.
    """
    per_second = PER_SECOND[unit]
    if times.dtype.kind == "f":
        times_us = times.astype(np.float64) * (MICROSECONDS / per_second)
        if not (np.abs(times_us) < LARGEST_FLOAT).all():
            raise FileFormatError(f"{path} holds times that are no numbers of {unit}")
        return np.rint(times_us).astype(np.int64)
    if times.dtype.kind == "u" and times.size and int(times.max()) >= 1 << 63:
        raise FileFormatError(f"{path} holds times beyond 2^63 {unit}")
    whole = times.astype(np.int64, copy=False)
    if per_second <= MICROSECONDS:
        return whole * (MICROSECONDS // per_second) if per_second < MICROSECONDS else whole
    return whole // (per_second // MICROSECONDS)


def check_rate(path: Path, count: int, range_us: tuple[int, int], unit: TimeUnit) -> None:
    """Refuse times whose unit was guessed and cannot be meant.

    Raises:
        TimeUnitError: the mean rate is below that of a quiet sensor, or no clock shows such times.
    """
    span_us = range_us[1] - range_us[0]
    is_slow = count * MICROSECONDS < LEAST_HZ * span_us
    if count < LEAST_EVENTS or not (is_slow or range_us[1] > LATEST_GUESSED_US):
        return
    rate = count * MICROSECONDS / max(span_us, 1)
    finer = [one for one in PER_SECOND if PER_SECOND[one] > PER_SECOND[unit]]
    likely = [one for one in finer if rate * PER_SECOND[one] / PER_SECOND[unit] >= LIKELY_HZ]
    probable = f"they are probably {likely[0]}: " if likely else ""
    name = likely[0] if likely else "s, ms, us or ns"
    raise TimeUnitError(
        f"{path}: its times read as {unit} make {count:,} events in {span_us / MICROSECONDS:,.0f} "
        f"s from {range_us[0] / MICROSECONDS:,.0f} s on, {rate:.2g} per second; {probable}give "
        f"time_unit (--time-unit {name})"
    )


class TimeUnitError(FileFormatError):
    """Times whose unit the file does not state cannot be meant in the one they seem to have."""


class SeveralRecordingsError(InputError):
    """A file holds several recordings and none was chosen."""

    def __init__(self, path: Path, streams: Sequence[str]) -> None:
        super().__init__(
            f"{path} holds {len(streams)} recordings: {', '.join(streams)}; choose one as stream "
            f"(--stream {streams[0]})"
        )
        self.streams = tuple(streams)


class UnknownLayoutError(FileFormatError):
    """A file of named arrays holds no events by names that are known."""

    def __init__(self, path: Path, holds: Sequence[str]) -> None:
        listed = ", ".join(holds[:4]) + (f" and {len(holds) - 4} more" if len(holds) > 4 else "")
        super().__init__(
            f"{path} holds no events by names that texvent knows ({listed or 'nothing at all'}); "
            "give --columns t=NAME,x=NAME,y=NAME,p=NAME, or --columns t,x,y,p --stream NAME of an "
            "array [n, 4]"
        )
        self.holds = tuple(holds)


def choose(path: Path, streams: Sequence[str], wanted: str | None) -> int:
    """Number of the recording that is read.

    Args:
        path: the file.
        streams: names of its recordings, one or more.
        wanted: a name, the end of one after "/", or a number from 0 on; None: the only one.

    Raises:
        SeveralRecordingsError: there are several and none is chosen.
        InputError: there is none of this name.
    """
    if wanted is None:
        if len(streams) > 1:
            raise SeveralRecordingsError(path, streams)
        return 0
    name = wanted.strip("/")
    for number, stream in enumerate(streams):
        if name == stream.strip("/"):
            return number
    ends = [at for at, stream in enumerate(streams) if f"/{stream}".endswith(f"/{name}")]
    if len(ends) == 1:
        return ends[0]
    if name.isdecimal() and int(name) < len(streams):
        return int(name)
    raise InputError(f"{path} has no stream {shown(wanted)}; {suggest(wanted, tuple(streams))}")
