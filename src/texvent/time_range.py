"""Ranges of time as users give them: impossible ones are refused, doubtful ones are said."""

from __future__ import annotations

import math
from numbers import Real
from typing import Any, NamedTuple

from texvent.errors import InputError, warn

END_OF_TIME_US = 2**63 - 1
SHORTEST_US = 100
"""Fractions that span less than this are seconds."""
_UNITS = {"µs": 1, "s": 1_000_000}
_SCALES = (1e6, 1e3, 1e-6, 1e-3)
"""Times given in seconds or milliseconds where µs are meant, and the other way round."""


class SeenTimes(NamedTuple):
    """Times of a recording, µs, as far as it was read."""

    first_us: int
    end_us: int
    """The last time + 1."""
    is_whole: bool = True
    """Whether the recording ends there."""


def check_time_range(start_us: float, stop_us: float) -> None:
    """Refuse what is no range.

    Raises:
        InputError: a time is not a number, or the stop lies before the start.
    """
    times: dict[str, Any] = {"start": start_us, "stop": stop_us}
    for name, value in times.items():
        if not isinstance(value, Real) or math.isnan(value):
            raise InputError(f"the {name} of the range is {value!r:.60}; give a time in µs")
    if start_us > stop_us:
        raise InputError(
            f"the range from {_shown(start_us)} to {_shown(stop_us)} µs is reversed; its stop "
            f"must come after its start: {_shown(stop_us)}, {_shown(start_us)}"
        )


def warn_of_doubtful_range(start_us: float, stop_us: float, seen: SeenTimes) -> None:
    """Warn if a range lies outside of the recording, or looks like seconds.

    Warns:
        TexventWarning: the recording's times, and the range that is probably meant.
    """
    if start_us == stop_us:
        warn(f"the range from {_shown(start_us)} to {_shown(stop_us)} µs is empty")
        return
    text = describe_outside(start_us, stop_us, seen)
    if text is None and _looks_like_seconds(start_us, stop_us, seen):
        text = (
            f"the range from {_shown(start_us)} to {_shown(stop_us)} µs is a tiny part of the "
            f"recording; times are µs: did you mean {_shown(start_us * 1e6)} to "
            f"{_shown(stop_us * 1e6)}?"
        )
    if text is not None:
        warn(text)


def describe_outside(
    start_us: float, stop_us: float, seen: SeenTimes, unit: str = "µs"
) -> str | None:
    """Say so if a range holds no time of the recording, and which one is probably meant.

    Example:
        >>> describe_outside(5e6, 6e6, SeenTimes(0, 400_000), "s")
        'no event from 5 to 6 s: the recording runs from 0 to 0.399999 s'
        >>> describe_outside(0.1, 0.3, SeenTimes(500, 400_000)).partition("; ")[2]
        'times are µs: did you mean 100_000 to 300_000?'
    """
    if stop_us > seen.first_us and (start_us < seen.end_us or not seen.is_whole):
        return None
    first, last = _shown(seen.first_us, unit), _shown(seen.end_us - 1, unit)
    runs = f"runs from {first} to {last} {unit}" if seen.is_whole else f"begins at {first} {unit}"
    text = (
        f"no event from {_shown(start_us, unit)} to {_shown(stop_us, unit)} {unit}: the recording "
        f"{runs}"
    )
    is_open, span = stop_us == END_OF_TIME_US, seen.end_us - seen.first_us
    for scale in _SCALES if seen.is_whole else _SCALES[:1]:
        start, stop = start_us * scale, seen.end_us if is_open else stop_us * scale
        is_tiny = scale < 1 and stop - start < span / 100
        if _lies_inside(start, stop, seen) and not is_tiny:
            meant = f"{_shown(start, unit)} to {_shown(stop_us if is_open else stop, unit)}"
            return f"{text}; times are {unit}: did you mean {meant}?"
    return text


def _looks_like_seconds(start_us: float, stop_us: float, seen: SeenTimes) -> bool:
    """True if the recording has the time in seconds; of unknown length, if it is a fraction."""
    if seen.is_whole:
        return _lies_inside(start_us * 1e6, stop_us * 1e6, seen)
    is_fraction = start_us != round(start_us) or stop_us != round(stop_us)
    return is_fraction and stop_us - start_us < SHORTEST_US


def _lies_inside(start_us: float, stop_us: float, seen: SeenTimes) -> bool:
    """True if a range of a µs or more lies in the recording, but for a tenth of its length."""
    if not seen.is_whole:
        return start_us >= seen.first_us
    span = seen.end_us - seen.first_us
    is_inside = seen.first_us - span / 10 <= start_us and stop_us <= seen.end_us + span / 10
    overlaps = start_us < seen.end_us and stop_us > seen.first_us
    return is_inside and overlaps and stop_us - start_us >= 1


def _shown(t_us: float, unit: str = "µs") -> str:
    """A time as Python or the command line takes it; no unit."""
    if t_us == END_OF_TIME_US:
        return "the end"
    value = t_us / _UNITS[unit]
    if abs(value) < 1e15 and abs(value - round(value)) < 1e-6 * max(abs(value), 1e-6):
        return f"{round(value):_}"
    return f"{value:g}"
