"""Changed copies of recordings for N-ImageNet's recipe: cut, reversed, mirrored and shifted.

`texvent.Augment` is for recipes of one's own. This one draws as N-ImageNet's program does, from one
generator per sample; the edits themselves are those of `texvent.transform`.
"""

from __future__ import annotations

import numpy as np

from texvent.events import EventStream
from texvent.transform.edits import flip, reverse_time, shift, start_at_zero
from texvent_lab.train.classification.config import Augmentation


def augment(
    events: EventStream, augmentation: Augmentation, chance: np.random.Generator
) -> EventStream:
    """A copy that is reversed, mirrored and shifted as chance decides.

    Source: the program of J. Kim et al., "N-ImageNet", ICCV 2021 (its shift is 20 px).
    """
    flips_time, flips_x = chance.random(2) < 0.5
    dx, dy = chance.integers(-augmentation.shift, augmentation.shift + 1, 2)
    if augmentation.flip_time and flips_time:
        events = start_at_zero(reverse_time(events))
    if augmentation.flip_x and flips_x:
        events = flip(events, "x")
    return shift(events, int(dx), int(dy))


def take_run(events: EventStream, count: int | None, chance: np.random.Generator) -> EventStream:
    """A random run of so many events, or all if there are no more."""
    if count is None or len(events) <= count:
        return events
    first = int(chance.integers(len(events) - count + 1))
    return events[first : first + count]
