"""What an augmentation offers."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from texvent.events import EventStream


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
