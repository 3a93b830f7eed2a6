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
    given = f"the range from {_shown(start_us)} to {_shown(stop_us)} µs"
    text = f"{given} is empty" if start_us == stop_us else describe_outside(start_us, stop_us, seen)
    if start_us < stop_us and _fits_as_seconds(start_us, stop_us, seen):
        meant = f"{_shown(start_us * 1e6)} to {_shown(stop_us * 1e6)}"
        text = f"{text or f'{given} is tiny'}; times are µs: did you mean {meant}?"
    if text is not None:
        warn(text)


def describe_outside(
    start_us: float, stop_us: float, seen: SeenTimes, unit: str = "µs"
) -> str | None:
    """Say so if a range holds no time of the recording.

    Example:
        >>> describe_outside(5e6, 6e6, SeenTimes(0, 400_000), "s")
        'no event from 5 to 6 s: the recording runs from 0 to 0.399999 s'
    """
    if stop_us > seen.first_us and (start_us < seen.end_us or not seen.is_whole):
        return None
    first, last = _shown(seen.first_us, unit), _shown(seen.end_us - 1, unit)
    runs = f"runs from {first} to {last} {unit}" if seen.is_whole else f"begins at {first} {unit}"
    return (
        f"no event from {_shown(start_us, unit)} to {_shown(stop_us, unit)} {unit}: the recording "
        f"{runs}"
    )


def _fits_as_seconds(start_us: float, stop_us: float, seen: SeenTimes) -> bool:
    """Whether the recording has the range, but for a tenth of its length, if it is in seconds."""
    start, stop = start_us * 1e6, stop_us * 1e6
    if not seen.is_whole:
        # The end is not known: only fractions of a µs are surely none.
        is_whole = start_us == round(start_us) and stop_us == round(stop_us)
        return start >= seen.first_us and not is_whole and stop_us - start_us < SHORTEST_US
    margin = (seen.end_us - seen.first_us) / 10
    is_inside = seen.first_us - margin <= start and stop <= seen.end_us + margin
    return is_inside and start < seen.end_us and stop > seen.first_us


def _shown(t_us: float, unit: str = "µs") -> str:
    """A time as Python or the command line takes it; no unit."""
    if t_us == END_OF_TIME_US:
        return "the end"
    value = t_us / _UNITS[unit]
    if abs(value) < 1e15 and abs(value - round(value)) < 1e-6 * max(abs(value), 1e-6):
        return f"{round(value):_}"
    return f"{value:g}"
