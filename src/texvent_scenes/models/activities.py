"""Activities of people, hands and animals: their words, and tracks of their motion.

The rows of `data/activities.toml`, `hand_gestures.toml` and `animal_activities.toml`. A track is
channels of a body over time, as Fourier series and as key values.

A channel is a number or a row of numbers, such as `lean` or `right.hand`. In a table it is written
by its numbers; each may be a series instead:

    [mean, amplitude, rate_hz, phase, amplitude, rate_hz, phase, ...]

which is mean + amplitude sin(2 pi (rate t + phase)) + ...; phases are in cycles, and a last phase
of 0 may be left out. `keys` holds channels as values at instants instead, between which they run
smoothly; a channel that has both is their sum.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from types import MappingProxyType
from typing import Any

from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import frozen, read_table

Key = tuple[float, tuple[float, ...]]
"""A time, s, and the values then."""
ROWS = frozenset({"hips", "tool", "hand", "elbow", "foot", "knee", "bent", "shift"})
"""Last words of the channels that are rows of numbers; others are one number."""
_DIRECTIONS: Mapping[str, tuple[float, ...]] = {"down": (-0.2, 0.5, -1.0), "out": (-0.3, 1.0, -0.5)}
"""Name of a direction in which an elbow usually points → forward, outward, up."""
Series = tuple[float, ...]
Values = dict[str, tuple[float, ...]]
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

    def at(self, time_s: float, *, once: bool = False) -> Values:
        """Values of all channels.

        Args:
            time_s: the instant; of what happens about an instant of contact, from that on.
            once: whether what repeats happens only once.
        """
        found: Values = {
            name: tuple(_sum_up(one, time_s) for one in numbers)
            for name, numbers in self.series.items()
        }
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


def _channels(table: Mapping[str, Any], parent: str = "") -> Iterator[tuple[str, Any]]:
    """Names with dots and values of a table and the tables in it."""
    for name, value in table.items():
        if isinstance(value, Mapping):
            yield from _channels(value, f"{parent}{name}.")
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


@dataclass(frozen=True)
class Activity:
    """One activity; its name is an `Motion.kind`."""

    words: tuple[str, ...] = ()
    """Verb phrases in their base form."""
    near: tuple[str, ...] = ()
    """Phrases of what it shows only nearly, which is reported: "play football" of a kick."""
    named: tuple[str, ...] = ()
    """Phrases that name it and do not begin with a verb: "peace sign"."""
    travels: bool = False
    """Whether the body goes from place to place."""
    is_sideways: bool = False
    """Whether it is best seen from the side."""
    is_done_seated: bool = False
    """Whether it is done just as well sitting: the hips do not move."""
    moves_as: str = ""
    """Name of the activity whose motion it has; "" = its own."""
    contact_s: float | None = None
    """Time of the contact in an act that has one, if the act is repeated, s."""


USUAL = "usual"
"""Name of the row of a table with the channels that an activity does not say."""


def _read(name: str) -> Mapping[str, Activity]:
    known = {one.name for one in fields(Activity)}
    return MappingProxyType(
        {
            activity: Activity(**{key: frozen(value) for key, value in row.items() if key in known})
            for activity, row in read_table(name).items()
            if activity != USUAL
        }
    )


def motion_of(table: str, activity: str) -> dict[str, Any]:
    """Motion of a row, or of the one that it moves as: the channels of a track."""
    known = {one.name for one in fields(Activity)} | {"props"}
    row = read_table(table).get(activity, {})
    row = read_table(table)[row["moves_as"]] if "moves_as" in row else row
    return {key: value for key, value in row.items() if key not in known}


@cache
def _find_track(table: str, activity: str) -> ChannelTrack:
    rows = read_table(table)
    usual = rows.get(USUAL, {})
    return read_track({**usual, **motion_of(table, activity if activity in rows else "stand")})


def flattened(values: Values) -> dict[str, float]:
    """Channels with one number each: of rows of numbers "shift.0", "shift.1" ..."""
    return {
        name if len(numbers) == 1 else f"{name}.{index}": number
        for name, numbers in values.items()
        for index, number in enumerate(numbers)
    }


def find_channels(table: str, pose: Pose) -> dict[str, float]:
    """Channels of the activity at a pose, perhaps between it and the one before.

    Args:
        table: that has the activity; of one that it does not have, the channels of "stand".
        pose: the instant.
    """
    found = flattened(_find_track(table, pose.activity).at(pose.time_s))
    if pose.before is None:
        return found
    earlier = find_channels(table, replace(pose, activity=pose.before, before=None))
    return {
        name: (1.0 - pose.share) * earlier.get(name, 0.0) + pose.share * found.get(name, 0.0)
        for name in {**earlier, **found}
    }


@cache
def list_channels(table: str) -> frozenset[str]:
    """All channels of a table of activities."""
    rows = read_table(table)
    poses = (Pose(0.0, 0.0, 0.0, activity) for activity in rows)
    return frozenset(name for pose in poses for name in find_channels(table, pose))


ACTIVITIES: Mapping[str, Activity] = _read("activities")
"""Activities of people: name → activity."""
HAND_GESTURES: Mapping[str, Activity] = _read("hand_gestures")
"""Gestures of hands: name → gesture."""
ANIMAL_ACTIVITIES: Mapping[str, Activity] = MappingProxyType(
    {name: one for name, one in _read("animal_activities").items() if one.words}
)
"""Activities of animals in place: name → activity."""
MOUTH_ACTIVITIES = frozenset(
    name for name in ANIMAL_ACTIVITIES if "down" in motion_of("animal_activities", name)
)
"""Those in which the mouth is at the ground, or at what is eaten."""

TRAVELLING = frozenset(name for name, one in ACTIVITIES.items() if one.travels)
"""Names of the activities that go from place to place."""
DONE_SEATED = frozenset(name for name, one in ACTIVITIES.items() if one.is_done_seated)
"""Activities that people also do sitting: torso, head and arms move, the hips do not."""
SINGLE_ACTS = frozenset(name for name, one in ACTIVITIES.items() if one.contact_s is not None)
"""Acts with one instant of contact."""
TO_AND_FROM_SEATS = frozenset({"sit down", "stand up"})
"""Activities that begin or end on a seat, or on the ground where there is none."""
ON_GROUND: Mapping[str, str] = MappingProxyType(
    {"sit": "sit on ground", "sit down": "sit down on ground", "stand up": "stand up from ground"}
)
"""Names of these activities, and of sitting, where there is no seat."""
SEATED = "sit and "
"""Begins the name of what is done sitting, as "sit and read"."""

DVS_GESTURES: Mapping[str, str] = MappingProxyType(
    {
        "hand clap": "clap",
        "right hand wave": "wave right",
        "left hand wave": "wave left",
        "right arm clockwise": "right arm clockwise",
        "right arm counter clockwise": "right arm counter-clockwise",
        "left arm clockwise": "left arm clockwise",
        "left arm counter clockwise": "left arm counter-clockwise",
        "arm roll": "arm roll",
        "air drums": "air drums",
        "air guitar": "air guitar",
        "other gestures": "other gesture",
    }
)
"""Class of DVS-Gesture (Amir et al., CVPR 2017) → activity."""

PERSON_NOUNS = frozenset(read_table("outfits")["people"])
"""Nouns whose models take every posture of `ACTIVITIES`."""
HAND_NOUNS = frozenset(read_table("people/hands"))
"""Nouns whose models take every posture of `HAND_GESTURES`."""
