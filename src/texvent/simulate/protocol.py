"""What every event simulator offers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Protocol

from texvent.events import EventStream
from texvent.video import Frame


class Simulator(Protocol):
    """A pixel model: feed it frames, get the events between them.

    Built as `Simulator(config, seed=seed)`; the first frame decides the size. Random draws are
    keyed by (seed, frame, y, x), so neither threads nor chunk sizes nor backend change an event.

    A model may also declare `default_interpolate`, the interpolation it was made for, and one that
    must see later frames offers `steps`; see `look_ahead`. One whose weights are a file of the
    user's may offer `provenance(config)`: facts about that file, to be stored with the events.
    """

    config_type: ClassVar[type]
    """Frozen dataclass with the simulator's options."""
    presets: ClassVar[Mapping[str, Any]]
    """Name → config; every simulator has a default preset, listed first."""

    @property
    def contrast_threshold(self) -> float:
        """δ that Eq. 4 should count with, log units: the smallest one if there are several."""
        ...

    @property
    def balance(self) -> float:
        """α that Eq. 4 should count with, on the 0..255 scale."""
        ...

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        ...

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`; none for the first frame.

        Raises:
            InputError: another size than before, a time that does not increase, or an intensity
                that is NaN, infinite or negative.
        """
        ...
