"""Augmentations that move events over the sensor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from texvent.config import check_range
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import MAX_SIDE
from texvent.transform.orientation import Axes, flip, rotate, shift
from texvent.transform.packets import move_events
from texvent.transform.region import Region, crop


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
    """Whether the region lies in the middle; otherwise every place is as likely."""

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
