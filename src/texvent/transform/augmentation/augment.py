"""Augmentations one after the other, drawn by seed, epoch and number of the sample."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from texvent._registry import AUGMENTATIONS
from texvent.config import check_whole
from texvent.errors import ConfigError, shown
from texvent.events import EventStream
from texvent.options.parts import make_part
from texvent.options.values import plain
from texvent.transform.augmentation.protocol import Augmentation
from texvent.transform.packets import check_stream, note_edit

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
            number: tells it from the others of an epoch, 0 or more.
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
