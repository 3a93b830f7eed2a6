"""Random augmentation of recordings for training: dropping, space, time, and their composition."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

import numpy as np

from texvent._registry import AUGMENTATIONS
from texvent.config import check_range, check_whole
from texvent.errors import ConfigError, InputError, shown
from texvent.events import EventStream
from texvent.options.parts import make_part
from texvent.options.values import plain
from texvent.sensor import MAX_SIDE
from texvent.transform.edits import (
    Axes,
    Region,
    crop,
    flip,
    flip_polarity,
    reverse_time,
    rotate,
    shift,
)
from texvent.transform.packets import check_stream, move_events, note_edit


class Augmentation(Protocol):
    """A frozen dataclass; its fields are its options."""

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """A changed copy, its times between the first and the last one of `events`.

        Args:
            events: the sample.
            chance: a generator for this sample and step alone.

        Raises:
            InputError: the augmentation does not fit the sensor.
        """
        ...


@dataclass(frozen=True, kw_only=True)
class DropEvents:
    """Drops every event with the same probability, which is drawn once per sample."""

    most: float = 0.5
    """Highest probability; the lowest is 0."""

    def __post_init__(self) -> None:
        check_range("most", self.most, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        probability = chance.random() * self.most
        return events[chance.random(len(events)) >= probability]


@dataclass(frozen=True, kw_only=True)
class DropTime:
    """Drops all events of one span of time."""

    most: float = 0.5
    """Longest span, as a share of the time from the first to the last event."""

    def __post_init__(self) -> None:
        check_range("most", self.most, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        length, place = chance.random(2)
        if not len(events):
            return events
        whole = int(events.t[-1]) + 1 - int(events.t[0])
        span = round(whole * self.most * length)
        start = int(events.t[0]) + math.floor(place * (whole - span + 1))
        return events[(events.t < start) | (events.t >= start + span)]


@dataclass(frozen=True, kw_only=True)
class DropArea:
    """Drops all events of one rectangle, of the same proportions as the sensor."""

    most: float = 0.3
    """Largest side, as a share of the sensor's."""

    def __post_init__(self) -> None:
        check_range("most", self.most, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        share, *places = chance.random(3).tolist()
        sides = [round(side * self.most * share) for side in events.size]
        x, y = (
            math.floor(place * (whole - side + 1))
            for place, whole, side in zip(places, events.size, sides, strict=True)
        )
        inside = (events.x >= x) & (events.x < x + sides[0])
        inside &= (events.y >= y) & (events.y < y + sides[1])
        return events[~inside]


@dataclass(frozen=True, kw_only=True)
class FlipX:
    """Exchanges left and right."""

    probability: float = 0.5
    """Of doing so."""

    axes: ClassVar[Axes] = "x"

    def __post_init__(self) -> None:
        check_range("probability", self.probability, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        return flip(events, self.axes) if chance.random() < self.probability else events


@dataclass(frozen=True, kw_only=True)
class FlipY(FlipX):
    """Exchanges top and bottom."""

    axes: ClassVar[Axes] = "y"


@dataclass(frozen=True, kw_only=True)
class Rotate:
    """Turns by 0, 90, 180 or 270 degrees, each as likely.

    Quarter turns exchange width and height; with `square_only`, sensors that are not square are
    turned by 0 or 180 degrees, so that samples keep their size.
    """

    square_only: bool = True
    """Whether quarter turns are for square sensors only."""

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        is_square = events.size.width == events.size.height
        step = 1 if is_square or not self.square_only else 2
        return rotate(events, 90 * step * int(chance.integers(4 // step)))


@dataclass(frozen=True, kw_only=True)
class Shift:
    """Moves all events by the same whole pixels; those that leave the sensor are lost."""

    pixels: int = 10
    """Largest distance along each axis, either way."""

    def __post_init__(self) -> None:
        check_range("pixels", self.pixels, 0, MAX_SIDE)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        dx, dy = chance.integers(-self.pixels, self.pixels + 1, 2).tolist()
        return shift(events, dx, dy)


@dataclass(frozen=True, kw_only=True)
class Crop:
    """A region of the sensor, anywhere or in its centre; its corner becomes (0, 0)."""

    width: int
    """Of the region, pixels."""
    height: int
    """Of the region, pixels."""
    centre: bool = False
    """Whether the region is in the middle; otherwise every place is as likely."""

    def __post_init__(self) -> None:
        check_range("width", self.width, 1, MAX_SIDE)
        check_range("height", self.height, 1, MAX_SIDE)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        free = events.size.width - self.width, events.size.height - self.height
        if min(free) < 0:
            raise InputError(
                f"crop is {self.width}x{self.height} and the events are of {events.size}; it must "
                "not be larger than the sensor"
            )
        x, y = (side // 2 if self.centre else int(chance.integers(side + 1)) for side in free)
        return crop(events, Region(x, y, self.width, self.height))


@dataclass(frozen=True, kw_only=True)
class JitterSpace:
    """Moves every event on its own, by normal distances rounded to whole pixels.

    Events that leave the sensor are lost.
    """

    sd_pixels: float = 1.0
    """Standard deviation along each axis."""

    def __post_init__(self) -> None:
        check_range("sd_pixels", self.sd_pixels, 0.0, 1000.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        moves = np.rint(chance.normal(0.0, self.sd_pixels, (2, len(events)))).astype(np.int64)
        return move_events(events, events.x + moves[0], events.y + moves[1], events.size)


@dataclass(frozen=True, kw_only=True)
class JitterTime:
    """Moves every event on its own, by a normal time rounded to whole µs, and sorts them again.

    No event moves before the first or after the last time of the sample. Events of one µs stay in
    the order they had.
    """

    sd_us: float = 100.0
    """Standard deviation, µs."""

    def __post_init__(self) -> None:
        check_range("sd_us", self.sd_us, 0.0, 1e9)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        if not len(events):
            return events
        moves = np.rint(chance.normal(0.0, self.sd_us, len(events))).astype(np.int64)
        t = np.clip(events.t + moves, events.t[0], events.t[-1])
        order = np.argsort(t, kind="stable")
        columns = {**events.columns(), "t": t}
        moved = {name: column[order] for name, column in columns.items()}
        return EventStream(**moved, size=events.size, metadata=events.metadata)


@dataclass(frozen=True, kw_only=True)
class FlipPolarity:
    """Exchanges ON and OFF of all events."""

    probability: float = 0.5
    """Of doing so."""

    def __post_init__(self) -> None:
        check_range("probability", self.probability, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        return flip_polarity(events) if chance.random() < self.probability else events


@dataclass(frozen=True, kw_only=True)
class ReverseTime:
    """Plays the sample backwards, ON and OFF exchanged; see `edits.reverse_time`."""

    probability: float = 0.5
    """Of doing so."""

    def __post_init__(self) -> None:
        check_range("probability", self.probability, 0.0, 1.0)

    def apply(self, events: EventStream, chance: np.random.Generator) -> EventStream:
        """See `Augmentation`."""
        return reverse_time(events) if chance.random() < self.probability else events


MAX_SEED = 2**63 - 1


@dataclass(frozen=True)
class Augment:
    """A function from samples to changed copies.

    What happens to a sample depends on seed, epoch and number alone, not on what was drawn before:
    the same for any order and any number of workers. Streams that have metadata note under `edits`
    what was done to them.

    Raises:
        ConfigError: unknown name or option of a step, or a value out of range.

    Example:
        >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size=(8, 6))
        >>> augment = Augment(["flip-x:probability=1", "drop-events:most=0.2"], seed=1)
        >>> augment(events, number=7).x.tolist()
        [4, 3]
    """

    steps: Sequence[str | Augmentation]
    """In order: names of `AUGMENTATIONS`, with options as in "shift:pixels=5", or instances."""
    seed: int = 0
    """0..2⁶³−1."""

    def __post_init__(self) -> None:
        check_whole("seed", self.seed, 0, MAX_SEED)
        if isinstance(self.steps, str) or not isinstance(self.steps, Iterable):
            raise ConfigError(f"steps is {shown(self.steps)}; give a list, such as ['flip-x']")
        steps = tuple(
            make_part(AUGMENTATIONS, step, {}) if isinstance(step, str) else step
            for step in self.steps
        )
        for step in steps:
            if isinstance(step, type) or not callable(getattr(step, "apply", None)):
                raise ConfigError(
                    f"{shown(step)} is no augmentation; give a name "
                    f"({', '.join(AUGMENTATIONS.names())}) or an object with apply(events, chance)"
                )
        object.__setattr__(self, "steps", steps)

    def __call__(self, events: EventStream, number: int = 0, *, epoch: int = 0) -> EventStream:
        """The changed copy of a sample.

        Args:
            events: the sample.
            number: index within an epoch, 0 or more.
            epoch: which pass over the samples, 0 or more.

        Raises:
            ConfigError: a number that is not whole, or below 0.
            InputError: no stream; or a step does not fit the sensor, such as a crop larger than it.
        """
        check_stream(events, "Augment")
        check_whole("number", number, 0, MAX_SEED)
        check_whole("epoch", epoch, 0, MAX_SEED)
        given = events
        for place, step in enumerate(self.steps):
            key = np.random.SeedSequence(int(self.seed), spawn_key=(int(epoch), int(number), place))
            events = step.apply(events, np.random.Generator(np.random.PCG64(key)))  # type: ignore[union-attr]
        if not given.metadata:
            return events.with_metadata({})
        note = {"augment": self.description, "number": int(number), "epoch": int(epoch)}
        return note_edit(events, given, **note)

    @property
    def description(self) -> dict[str, Any]:
        """Seed and steps with all of their options, as they are stored with events."""
        return {
            "seed": int(self.seed),
            "steps": [_describe(step) for step in self.steps],
        }


def _describe(step: object) -> dict[str, Any]:
    """A step's class and options."""
    options = plain(step) if dataclasses.is_dataclass(step) else {}
    return {"step": type(step).__name__, **options}
