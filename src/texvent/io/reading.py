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
from texvent.errors import ConfigError, FileFormatError, InputError, shown, warn
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
LEAST_DOUBTED = 100
"""Fewer events say nothing of their unit."""
MOMENT_US, SHORT_US, LONG_US = 20_000, 100_000, 1_000_000_000
"""Recordings are rarely shorter, or longer ..."""
SPARSE_HZ, FASTEST_HZ = 10_000, 100_000_000
"""... at a lower rate, and never denser."""
SAMPLE_TIMES, SAMPLES = 4096, 4


@dataclass(frozen=True, kw_only=True)
class ReadOptions:
    """Options of reading; each is for files that do not say it themselves."""

    size: SensorSize | None = None
    """Sensor size, pixels."""
    time_unit: TimeUnit | None = None
    """Unit of the times of text, npz, npy and HDF5."""
    columns: tuple[str, ...] | None = None
    """Columns in the order of the file (`t`, `x`, `y`, `p`; other words are skipped), or each with
    its name: `t=stamp`."""
    stream: str | None = None
    """Recording of a file of several: group, topic or number of the camera."""
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


def texts_of(value: Any) -> list[str]:
    """Texts of an attribute, which has one or several."""
    every = np.ravel(value).tolist()
    return [one.decode("latin-1") if isinstance(one, bytes) else str(one) for one in every]


def unit_in_words(word: object) -> TimeUnit | None:
    """Unit of an attribute: "ns", "microseconds", b"s" and the like; None of others."""
    text = "".join(texts_of(word)[:1]).partition(" since ")[0]  # netCDF's
    prefixes = {"nanosec": "ns", "microsec": "us", "millisec": "ms", "second": "s"}
    long = next((unit for start, unit in prefixes.items() if text.lower().startswith(start)), text)
    return unit_in_name(f"t_{long}")[1]


def stated_or_given(path: Path, stated: TimeUnit | None, options: ReadOptions) -> TimeUnit | None:
    """The unit that the caller gives, else the one that the file states.

    Warns:
        TexventWarning: they differ.
    """
    given = options.time_unit
    if given and stated and given != stated:
        warn(f"{path} states its times in {stated}; they are read as {given}, as asked")
    return given or stated


def sample_of(array: Any, count: int) -> NDArray[Any]:
    """Rows from all over an array: its beginning, its end and places between, [at most 8192]."""
    if count <= 2 * SAMPLE_TIMES:
        return np.asarray(array[:count])
    last, step = count - SAMPLE_TIMES // SAMPLES, (count - SAMPLE_TIMES) // SAMPLES
    starts = [*range(SAMPLE_TIMES, last, step), last]
    parts = [array[start : start + SAMPLE_TIMES // SAMPLES] for start in starts]
    return np.concatenate([np.asarray(one) for one in (array[:SAMPLE_TIMES], *parts)])


def guess_unit(times: NDArray[Any]) -> TimeUnit:
    """Unit of times whose file does not state it: µs of whole numbers, s of fractions.

    Args:
        times: [n] from all over the file: seconds may begin with many zeros.
    """
    is_whole = times.dtype.kind != "f" or bool((times == np.rint(times)).all())
    return "us" if is_whole and len(times) else "s"


def to_microseconds(
    path: Path, times: NDArray[Any], unit: TimeUnit, *, is_guessed: bool = False
) -> NDArray[np.int64]:
    """Times in µs: whole numbers rounded down, fractions to the nearest.

    Dates and spans of NumPy have a unit of their own.

    Raises:
        FileFormatError: they are too large to be times in this unit, or no numbers; or they are
            guessed to be µs, and have fractions.
    """
    per_second = PER_SECOND[unit]
    if times.dtype.kind in "mM" and not np.isnat(times).any():
        return times.astype(f"{times.dtype.kind}8[us]").astype(np.int64)
    if times.dtype.kind == "f":
        times_us = times.astype(np.float64) * (MICROSECONDS / per_second)
        if not (np.abs(times_us) < LARGEST_FLOAT).all():
            raise FileFormatError(f"{path} holds times that are no numbers of {unit}")
        if is_guessed and unit == "us":
            refuse_fractions(path, times_us)
        return np.rint(times_us).astype(np.int64)
    if times.dtype.kind not in "biu":
        raise FileFormatError(f"{path} holds times that are no numbers")
    if not are_times(times, unit).all():
        raise FileFormatError(f"{path} holds times beyond 2^63 µs, as numbers of {unit}")
    whole = times.astype(np.int64, copy=False)
    if per_second <= MICROSECONDS:
        return whole * (MICROSECONDS // per_second) if per_second < MICROSECONDS else whole
    return whole // (per_second // MICROSECONDS)


def are_times(values: NDArray[Any], unit: TimeUnit) -> NDArray[np.bool_]:
    """Mask of values that can be times in a unit, as `to_microseconds` takes them."""
    if values.dtype.kind in "mM":
        return np.asarray(~np.isnat(values))
    in_us = MICROSECONDS / PER_SECOND[unit]
    if values.dtype.kind == "f":
        return np.asarray(np.abs(values.astype(np.float64) * in_us) < LARGEST_FLOAT)
    if values.dtype.kind not in "biu":
        return np.zeros(len(values), np.bool_)
    largest = ((1 << 63) - 1) // max(1, int(in_us))
    return np.asarray((values <= largest) & (values >= -largest))


def refuse_fractions(path: Path, times: NDArray[np.float64]) -> None:
    """Refuse fractions among times that were taken for whole µs.

    Raises:
        TimeUnitError: there are some.
    """
    if (times != np.rint(times)).any():
        raise TimeUnitError(
            f"{path}: most of its times are whole numbers, and some have fractions; give "
            "time_unit (--time-unit s, ms or us)"
        )


def check_precision(path: Path, times: NDArray[Any], unit: TimeUnit) -> None:
    """Warn of times in a type that has not kept the µs.

    Args:
        path: the file, for messages.
        times: the last ones, which are the coarsest.
        unit: of them.
    """
    if times.dtype.kind == "f" and times.size and np.isfinite(times).all():
        step_us = float(np.spacing(np.abs(times).max())) * MICROSECONDS / PER_SECOND[unit]
        if step_us > 1:
            warn(
                f"{path}: its times are {times.dtype}, which at the end keeps steps of "
                f"{step_us:.2g} µs only; store times as whole numbers or float64"
            )


def check_rate(
    path: Path, count: int, times_us: NDArray[np.int64], unit: TimeUnit, *, is_all: bool = True
) -> None:
    """Refuse times whose unit was guessed and cannot be meant.

    Args:
        path: the file.
        count: number of events.
        times_us: of events from all over the file; a few wrong ones and pauses say nothing.
        unit: as guessed.
        is_all: whether they are all events of the file.

    Raises:
        TimeUnitError: the mean rate is below that of a quiet sensor, or no clock shows such times.

    Warns:
        TexventWarning: another unit is as likely.
    """
    if min(count, len(times_us)) < LEAST_EVENTS:
        return
    usual = _without_outliers(np.sort(times_us.astype(np.float64)))
    first_us, last_us = float(usual[0]), float(usual[-1])
    gaps = np.sort(np.diff(usual))
    span_us = last_us - first_us
    busy_us = min(float(gaps[: -_few(len(gaps))].mean()) * count, span_us)
    rate = count * MICROSECONDS / max(busy_us, 1)
    if rate >= LEAST_HZ and last_us <= LATEST_GUESSED_US:
        other = _as_likely(count, span_us, busy_us, unit) if is_all else None
        if other is not None:
            seconds = span_us / MICROSECONDS
            meant = seconds * PER_SECOND[unit] / PER_SECOND[other]
            warn(
                f"{path}: its times, which have no unit, are taken as {unit}: {count:,} events in "
                f"{seconds:.3g} s; if they last {meant:.3g} s, give time_unit (--time-unit {other})"
            )
        return
    finer = [one for one in PER_SECOND if PER_SECOND[one] > PER_SECOND[unit]]
    likely = [one for one in finer if rate * PER_SECOND[one] / PER_SECOND[unit] >= LIKELY_HZ]
    probable = f"they are probably {likely[0]}: " if likely else ""
    name = likely[0] if likely else "s, ms, us or ns"
    raise TimeUnitError(
        f"{path}: its times read as {unit} make {count:,} events in {span_us / MICROSECONDS:,.0f} "
        f"s from {first_us / MICROSECONDS:,.0f} s on, {rate:.2g} per second; {probable}give "
        f"time_unit (--time-unit {name})"
    )


def warn_of_strays(path: Path, times_us: NDArray[np.int64]) -> None:
    """Warn of a few times that are very far from all others, which a repair would drop."""
    if len(times_us) < LEAST_EVENTS:
        return
    ordered = np.sort(times_us.astype(np.float64))
    usual = _without_outliers(ordered)
    beyond_us = max(usual[0] - ordered[0], ordered[-1] - usual[-1])
    if beyond_us > LONG_US:
        warn(
            f"{path}: a few of its times are {beyond_us / MICROSECONDS:,.0f} s from all others; "
            "if they are wrong, repair=True (--repair) drops them"
        )


def _few(count: int) -> int:
    """Number of values that may be outliers: a hundredth, at least one."""
    return max(count // 100, 1)


def _without_outliers(ordered: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values in order without those that are further from most than most are from each other."""
    low, high = ordered[_few(len(ordered))], ordered[-1 - _few(len(ordered))]
    return np.asarray(ordered[(ordered >= 2 * low - high) & (ordered <= 2 * high - low)])


def _as_likely(count: int, span_us: float, busy_us: float, unit: TimeUnit) -> TimeUnit | None:
    """Another unit of times that were guessed, if a recording of this span and rate is unusual."""
    if count < LEAST_DOUBTED or span_us <= 0:
        return None
    rate = count * MICROSECONDS / max(busy_us, 1)
    if busy_us > LONG_US and rate < SPARSE_HZ:
        return {"s": "ms", "us": "ns"}.get(unit)  # type: ignore[return-value]
    usual_hz = LIKELY_HZ if span_us < MOMENT_US else 10 * LIKELY_HZ
    is_short = span_us < SHORT_US and rate >= 1000 * usual_hz
    if unit != "us" or not (is_short or rate > FASTEST_HZ):
        return None
    return "ms" if span_us >= SHORT_US / 1000 else "s"


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
