"""Table of samples for training: clips by number, cut into slices, as arrays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np

from texvent._registry import suggest
from texvent.config import check_range
from texvent.errors import ConfigError, InputError, shown
from texvent.events import EventStream
from texvent.represent.named import load_representation, represent_window
from texvent.sensor import SensorSize

Arrays: TypeAlias = dict[str, Any]
"""Arrays by name."""
Window: TypeAlias = tuple[int, int]
"""Start (included) and end (excluded), µs."""
Augmentation: TypeAlias = Callable[[EventStream, np.random.Generator], EventStream]
"""Gives a changed copy of events, by draws of the generator alone."""
Targets: TypeAlias = Callable[[Sequence[Window] | None], Arrays]
"""Gives the targets of a clip by name: of windows, or (None) of the whole clip."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SampleTable(ABC):
    """Samples by number. `make` gives the arrays of one, from any number of threads or processes.

    Raises:
        ConfigError: an unknown representation, option or target; two kinds of slices; or targets
            beside `augment`.
    """

    representation: str | None = None
    """Name of the representation; `texvent._registry.REPRESENTATIONS` lists them. None: the events
    themselves."""
    representation_options: Mapping[str, Any] = field(default_factory=dict)
    """Its options, such as `{"bins": 10}`. Those that name the window (`start_us`, `stop_us`,
    `at_us`) are filled in."""
    slice_us: int | None = None
    """Length of a slice, µs. A clip gives as many whole slices as it has, stacked along a first
    axis of time. None: the whole clip is one slice, without that axis."""
    slice_events: int | None = None
    """Events per slice, instead of `slice_us`."""
    targets: Sequence[str] = ()
    """Ground truth that `make` gives too."""
    augment: Augmentation | None = None
    """Changes the events of `make`, before they are sliced."""
    augment_seed: int = 0
    """Decides, with the epoch and the sample's number, what the generator of `augment` draws."""

    known_targets: ClassVar[tuple[str, ...]]

    def __post_init__(self) -> None:
        check_range("slice_us", self.slice_us, 1)
        check_range("slice_events", self.slice_events, 1)
        if self.slice_us is not None and self.slice_events is not None:
            raise ConfigError("give either slice_us or slice_events, the length of a slice")
        for target in self.targets:
            if target not in self.known_targets:
                raise ConfigError(
                    f"unknown target {shown(target)}; {suggest(target, self.known_targets)}"
                )
        if self.targets and self.augment is not None:
            raise ConfigError(
                "augment changes the events, and targets stay where they are; leave one of them "
                "out, and change both in the training loop"
            )
        sizes = self._sizes()  # refuses options of a simulation here, not in a worker process
        if self.representation is not None:
            load_representation(self.representation, self.representation_options)
            for size in sizes:
                self._part(EventStream.empty(size), (0, 1))
        elif self.representation_options:
            raise ConfigError("representation_options belong to a representation; name it")

    @property
    @abstractmethod
    def count(self) -> int:
        """Samples of one pass: all that are stored, or one per source."""

    @abstractmethod
    def seed_of(self, number: int) -> int:
        """Seed of the simulation of a sample."""

    def make(self, number: int, *, epoch: int = 0) -> Arrays:
        """Arrays of a sample by name, for training.

        Args:
            number: of the sample.
            epoch: which draws of `augment`.

        Returns:
            With slices, the first two have a first axis for them.

            * `representation`: see its own function. Without one, `events`: an EventStream, or a
              tuple of them, one for each slice.
            * `stop_us`: end of the slice, µs, int64; 1 µs after its last event with `slice_events`.
            * `number`, `seed`: of the sample.
            * The targets and facts that the class names.

        Raises:
            InputError: the source cannot be read, or the clip is shorter than one slice.
            ConfigError: a target that the source does not know, such as the depth of a video.
            IndexError, FileFormatError: a stored sample does not exist or is damaged.
        """
        number = self._checked(number)
        events, windows, targets_of = self._clip(number)
        if self.augment is not None:
            key = np.random.SeedSequence(self.augment_seed, spawn_key=(epoch, number))
            events = self.augment(events, np.random.default_rng(key))
        is_sliced = self.slice_us is not None or self.slice_events is not None
        slices = self._cut(events, windows, number) if is_sliced else [(events, windows[0])]
        parts = [self._part(*one) for one in slices]
        return {
            **(stack_windows(parts) if is_sliced else parts[0]),
            **targets_of([window for _, window in slices] if is_sliced else None),
            **self._facts(number),
            "number": number,
            "seed": self.seed_of(number),
        }

    def represented(
        self,
        representation: str | None = None,
        *,
        slice_us: int | None = None,
        slice_events: int | None = None,
        **options: Any,
    ) -> Self:
        """The same samples, which `make` turns into other arrays.

        Args:
            representation: its name; None: the events themselves.
            slice_us: as the field.
            slice_events: as the field.
            **options: of the representation, such as `bins=5`.

        Raises:
            ConfigError, InputError: as for the class.
        """
        return replace(
            self,
            representation=representation,
            representation_options=options,
            slice_us=slice_us,
            slice_events=slice_events,
        )

    def augmented(self, augment: Augmentation | None, *, seed: int = 0) -> Self:
        """The same samples, whose events `make` changes; None: unchanged.

        What happens to a sample depends on seed, epoch and number alone, in any order and in any
        worker.

        Args:
            augment: function of the events and a generator, such as
                `lambda events, chance: events.flip("x") if chance.random() < 0.5 else events`.
            seed: of the generators, 0 or more.

        Raises:
            ConfigError: the samples have targets, which `augment` would leave behind.
        """
        return replace(self, augment=augment, augment_seed=seed)

    def with_targets(self, *targets: str) -> Self:
        """The same samples, of which `make` gives these targets.

        Raises:
            ConfigError, InputError: unknown, not stored, or `augment` would leave them behind.
        """
        return replace(self, targets=targets)

    @abstractmethod
    def _checked(self, number: int) -> int:
        """The number, from 0, of a sample that there is."""

    @abstractmethod
    def _sizes(self) -> Iterable[SensorSize]:
        """Sensor sizes of the samples, as far as they are known."""

    @abstractmethod
    def _clip(self, number: int) -> tuple[EventStream, Sequence[Window], Targets]:
        """Events, whole windows of `slice_us` (without one: that of the clip), and targets."""

    @abstractmethod
    def _facts(self, number: int) -> Arrays:
        """Further facts that `make` gives."""

    def _part(self, events: EventStream, window: Window) -> Arrays:
        stop = {"stop_us": np.int64(window[1])}
        if self.representation is None:
            return {"events": events, **stop}
        name, options = self.representation, self.representation_options
        return {"representation": represent_window(name, events, window, **options), **stop}

    def _cut(
        self, events: EventStream, windows: Sequence[Window], number: int
    ) -> list[tuple[EventStream, Window]]:
        length = self.slice_events
        if length is None:
            return [(events.cut(*window), window) for window in windows]
        if len(events) < length:
            raise InputError(
                f"{'augment leaves' if self.augment else 'there are'} {len(events):,} events of "
                f"sample {number}, fewer than a slice of {length:,}; drop fewer, give shorter "
                "slices, or slice_us"
            )
        parts = [events[end - length : end] for end in range(length, len(events) + 1, length)]
        return [(part, (int(part.t[0]), int(part.t[-1]) + 1)) for part in parts]


def stack_windows(parts: Sequence[Mapping[str, Any]]) -> Arrays:
    """Arrays by name of several windows, along a first axis of time; others as tuples."""
    columns = {name: [part[name] for part in parts] for name in parts[0]}
    return {
        name: np.stack(one) if isinstance(one[0], np.ndarray | np.generic) else tuple(one)
        for name, one in columns.items()
    }
