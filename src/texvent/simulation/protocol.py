"""The interface of every event simulator."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Protocol

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair


class Simulator(Protocol):
    """A pixel model: pairs of source frames in, packets of events out.

    Built as `Simulator(config, seed=seed)`; the first frame decides the size. Random draws are
    keyed by (seed, frame, y, x), so neither threads nor chunk sizes change an event.

    `stepping.SteppingSimulator` brings `advance` and `finish` to a model that has `step`. A model
    may also declare `default_interpolate`, the interpolation it was made for. One whose weights are
    a file of the user's may offer `provenance(config)`: facts about that file, stored with the
    events. It may declare `bytes_per_pixel`: memory that its pixels, its packets and the frames
    that wait for it take, measured on moving texture; `run.prepare` adds it up. It may declare
    `takes_linear` as True: then frames of linear light reach it as they are, and are gamma-coded
    before otherwise. It may declare `benefits_from_denser_frames` as True: then a pair in which
    objects move fast gets more frames than Eq. 4 asks for (`interpolate.count_policy`). It may
    declare `slow_change`, a text or None: why slow change may fire nothing, and the options that
    help, which `run.silence` says of a run that has lost its signal. It may declare
    `frame_bound_presets`: those whose published definition ties events to the source frames, so
    that the same motion gives other events at another frame rate; and `reference_fill_factor`, the
    fill factor at which its option `noise_scale` is that of its presets.
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

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Events between the two frames of a pair; pairs come in order.

        How is the model's choice: it may draw the intermediate frames and step through them, or
        compute single pixels where they may fire.

        Yields:
            The intermediate frames and the later frame of the pair, each with the packet of events
            that ends at it, as `step` has it. A model that must see later frames first may yield
            frames of earlier pairs.

        Raises:
            InputError: as `step`.
        """
        ...

    def finish(self) -> Iterator[tuple[Frame, EventStream]]:
        """Frames and packets that `advance` has held back, after the last pair."""
        ...

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`; none for the first frame.

        Raises:
            InputError: another size than before, a time that does not increase, or an intensity
                that is NaN, infinite or negative.
        """
        ...
