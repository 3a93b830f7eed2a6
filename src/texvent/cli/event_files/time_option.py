"""`--time START,STOP`: the part of a recording that a command works on."""

from __future__ import annotations

from texvent.errors import ConfigError, shown
from texvent.event_packets import EventPackets
from texvent.options.values import parse_fraction
from texvent.time_range import END_OF_TIME_US
from texvent.transform.edits import keep_time
from texvent.video import MICROSECONDS


def keep_time_range(events: EventPackets, text: str | None) -> EventPackets:
    """The events of the part that `text` names; without one all of them.

    Raises:
        ConfigError: it is not two numbers.
        InputError: the stop is not after the start, or the recording lies elsewhere.
    """
    return events if text is None else keep_time(events, *parse_time_range(text))


def parse_time_range(text: str) -> tuple[int, int]:
    """`START,STOP` in seconds as µs, exactly; either may be left out.

    Example:
        >>> parse_time_range("0.5,9007199254.740993")
        (500000, 9007199254740993)

    Raises:
        ConfigError: it is not two numbers.
    """
    words = [word.strip() for word in text.split(",")]
    try:
        if len(words) != 2:
            raise ValueError(text)
        start = round(parse_fraction(words[0]) * MICROSECONDS) if words[0] else 0
        stop = round(parse_fraction(words[1]) * MICROSECONDS) if words[1] else END_OF_TIME_US
    except (ValueError, ZeroDivisionError) as error:
        raise ConfigError(
            f"time is {shown(text)}; give START,STOP in seconds, such as 0.5,2 or 0.5, or ,2"
        ) from error
    return start, stop
