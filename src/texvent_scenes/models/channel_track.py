"""Tracks of the channels of a body over time, as Fourier series and as key values.

A channel is a number or a row of numbers, such as `lean` or `right.hand`. In a table it is written
by its numbers; each may be a series instead:

    [mean, amplitude, rate_hz, phase, amplitude, rate_hz, phase, ...]

which is mean + amplitude sin(2 pi (rate t + phase)) + ...; phases are in cycles, and a last phase
of 0 may be left out. `keys` holds channels as values at instants instead, between which they run
smoothly; a channel that has both is their sum. "arms" and "legs" are channels of both sides.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

Key = tuple[float, tuple[float, ...]]
"""A time, s, and the values then."""
ROWS = frozenset({"hips", "tool", "hand", "elbow", "swing", "foot", "knee", "bent", "shift", "aim"})
"""Last words of the channels that are rows of numbers; others are one number."""
_DIRECTIONS: Mapping[str, tuple[float, ...]] = {"down": (-0.2, 0.5, -1.0), "out": (-0.3, 1.0, -0.5)}
"""Name of a direction in which an elbow usually points → forward, outward, up."""
SIDES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {"arms": ("left", "right"), "legs": ("left_leg", "right_leg"), "tool": ("right.tool",)}
)
"""First word of channels → those that they are; what a table says of one side goes before."""
Series = tuple[float, ...]
Numbers = tuple[float, ...]
Values = dict[str, Numbers]
"""Channel → its numbers at an instant."""


@dataclass(frozen=True)
class KeyTrack:
    """Channels with values at the same instants."""

    channels: tuple[tuple[str, int], ...]
    """Names, and how many numbers each has."""
    keys: tuple[Key, ...]
    period_s: float = 0.0
    """0 = happens once."""

    def at(self, time_s: float, *, once: bool) -> Values:
        """Values of the channels; `once` keeps the last ones after the last key."""
        numbers = follow_keys(time_s, self.keys, 0.0 if once else self.period_s)
        found, start = {}, 0
        for name, count in self.channels:
            found[name] = numbers[start : start + count]
            start += count
        return found


@dataclass(frozen=True)
class ChannelTrack:
    """Channels of a body over time."""

    series: Mapping[str, tuple[Series, ...]]
    keyed: tuple[KeyTrack, ...] = ()

    @cached_property
    def _steady(self) -> Values:
        """Channels that are the same at all times."""
        rest = (name for name in self.series if name not in self._moving)
        return {name: tuple(one[0] for one in self.series[name]) for name in rest}

    @cached_property
    def _moving(self) -> Mapping[str, tuple[Series, ...]]:
        return {name: row for name, row in self.series.items() if any(len(one) > 1 for one in row)}

    def at(self, time_s: float, *, once: bool = False) -> Values:
        """Values of all channels.

        Args:
            time_s: the instant; of what happens about an instant of contact, from that on.
            once: whether what repeats happens only once.
        """
        found = dict(self._steady)
        for name, rows in self._moving.items():
            found[name] = tuple(_sum_up(one, time_s) for one in rows)
        for track in self.keyed:
            for name, numbers in track.at(time_s, once=once).items():
                other = found.get(name, (0.0,) * len(numbers))
                found[name] = tuple(a + b for a, b in zip(numbers, other, strict=True))
        return found


def _sum_up(series: Series, time_s: float) -> float:
    total = series[0]
    for start in range(1, len(series), 3):
        amplitude, rate_hz, phase = series[start : start + 3]
        total += amplitude * math.sin(2.0 * math.pi * (rate_hz * time_s + phase))
    return total


def read_track(row: Mapping[str, Any]) -> ChannelTrack:
    """A track of a table: its channels, and those under `keys`, one table or several."""
    own = {name: value for name, value in row.items() if name != "keys"}
    series = {name: tuple(map(_series, _numbers(name, value))) for name, value in _channels(own)}
    tables = row.get("keys", [])
    tables = [tables] if isinstance(tables, Mapping) else tables
    return ChannelTrack(series, tuple(_read_keys(table) for table in tables))


def _read_keys(table: Mapping[str, Any]) -> KeyTrack:
    channels, columns = [], []
    for name, values in _channels(table):
        if name in ("at_s", "period_s"):
            continue
        rows = [_numbers(name, value) for value in values]
        channels.append((name, len(rows[0])))
        columns.append(rows)
    keys = tuple(
        (float(time_s), tuple(float(number) for row in rows for number in row))
        for time_s, *rows in zip(table["at_s"], *columns, strict=True)
    )
    return KeyTrack(tuple(channels), keys, float(table.get("period_s", 0.0)))


def _channels(table: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Names with dots and values of a table and the tables in it; each side by its own name."""
    named = dict(_named(table))
    for name, value in named.items():
        first, dot, last = name.partition(".")
        own = [f"{side}{dot}{last}" for side in SIDES.get(first, (first,))]
        yield from ((one, value) for one in own if one == name or one not in named)


def _named(table: Mapping[str, Any], parent: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        if isinstance(value, Mapping):
            yield from _named(value, f"{parent}{name}.")
        else:
            yield f"{parent}{name}", value


def _numbers(channel: str, value: Any) -> list[Any]:
    if channel.rsplit(".", 1)[-1] not in ROWS:
        return [value]
    return list(_DIRECTIONS[value] if isinstance(value, str) else value)


def _series(value: Any) -> Series:
    numbers = [float(one) for one in (value if isinstance(value, list) else [value])]
    return tuple(numbers) + (0.0,) * (-(len(numbers) - 1) % 3)


def ease(time_s: float, start_s: float, stop_s: float) -> float:
    """0 up to `start_s`, 1 from `stop_s` on, with zero slope at both."""
    share = min(max((time_s - start_s) / (stop_s - start_s), 0.0), 1.0)
    return share * share * (3.0 - 2.0 * share)


def follow_keys(time_s: float, keys: Sequence[Key], period_s: float = 0.0) -> tuple[float, ...]:
    """Values that pass through keys with a continuous slope, and do not overshoot them much.

    Cubic Hermite curves with Catmull-Rom slopes, which are level at the extremes.

    Args:
        time_s: the instant.
        keys: times in rising order with their values.
        period_s: length of one cycle, which starts at the first key; 0 = happens once, and the
            first and last values hold before and after.

    Returns:
        The values at that instant.
    """
    if period_s > 0.0:
        time_s = keys[0][0] + (time_s - keys[0][0]) % period_s
    elif time_s <= keys[0][0]:
        return keys[0][1]
    elif time_s >= keys[-1][0]:
        return keys[-1][1]
    index = bisect_right([key[0] for key in keys], time_s) - 1
    before, here, there, after = (_key(keys, index + step, period_s) for step in (-1, 0, 1, 2))
    span = there[0] - here[0]
    s = (time_s - here[0]) / span
    slopes = zip(_slope(here, before, there), _slope(there, here, after), strict=True)
    return tuple(
        (1.0 + 2.0 * s) * (1.0 - s) ** 2 * b
        + s * (1.0 - s) ** 2 * span * start
        + s * s * (3.0 - 2.0 * s) * c
        + s * s * (s - 1.0) * span * stop
        for b, c, (start, stop) in zip(here[1], there[1], slopes, strict=True)
    )


def _key(keys: Sequence[Key], index: int, period_s: float) -> Key:
    """A key; beyond the ends the cycle's, or a still one at the end's value."""
    count = len(keys)
    if period_s > 0.0:
        time_s, values = keys[index % count]
        return time_s + period_s * (index // count), values
    if index < 0:
        # Mirrored, so that the slope at the end is zero.
        return 2.0 * keys[0][0] - keys[1][0], keys[1][1]
    if index >= count:
        return 2.0 * keys[-1][0] - keys[-2][0], keys[-2][1]
    return keys[index]


def _slope(here: Key, before: Key, after: Key) -> tuple[float, ...]:
    """Slopes of the values at a key: none where a value turns round or stays."""
    span = after[0] - before[0]
    return tuple(
        (c - a) / span if (b - a) * (c - b) > 0.0 else 0.0
        for a, b, c in zip(before[1], here[1], after[1], strict=True)
    )


def flattened(values: Values) -> dict[str, float]:
    """Channels with one number each: of rows of numbers "shift.0", "shift.1" ..."""
    return {
        name if len(numbers) == 1 else f"{name}.{index}": number
        for name, numbers in values.items()
        for index, number in enumerate(numbers)
    }


def blend(first: Values, second: Values, share: float) -> Values:
    """Between two postures: the first at share 0, the second at 1; what one lacks is 0 there."""
    share = min(max(share, 0.0), 1.0)
    found: Values = {}
    for name in {**first, **second}:
        there = second.get(name) or (0.0,) * len(first[name])
        here = first.get(name) or (0.0,) * len(there)
        found[name] = tuple(a + share * (b - a) for a, b in zip(here, there, strict=True))
    return found
