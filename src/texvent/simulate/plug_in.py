"""Simulators of other packages: checked when they are loaded, and watched while they run."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from texvent.errors import TexventError, one_line
from texvent.events import COLUMN_TYPES, EventStream
from texvent.pairs.frame_pair import FramePair
from texvent.simulate.stepping import with_advance
from texvent.video import Frame

CONTRACT = "see texvent/simulate/protocol.py and texvent.check_simulator"


def check_simulator_class(kind: Any, name: str) -> None:
    """Refuse a class that lacks what a run reads of it; nothing of it is called.

    Args:
        kind: the class.
        name: what messages call it.

    Raises:
        TexventError: an attribute is missing or of the wrong kind; the message names it.
    """
    if not isinstance(kind, type):
        raise broken(name, f"is a {type(kind).__name__}, not a class")
    problems = _missing_methods(kind)
    config_type = getattr(kind, "config_type", None)
    if not (isinstance(config_type, type) and dataclasses.is_dataclass(config_type)):
        problems.append(f"has config_type {config_type!r:.40}; it must be a frozen dataclass")
        config_type = None
    presets = getattr(kind, "presets", None)
    wanted = "config_type" if config_type is None else config_type.__name__
    if not (isinstance(presets, Mapping) and presets):
        problems.append(f"has presets {presets!r:.40}; they must be name → {wanted}")
    elif config_type is not None:
        problems += [
            f"has preset {preset!r:.40}, which is no {wanted}"
            for preset, config in presets.items()
            if not (isinstance(preset, str) and isinstance(config, config_type))
        ][:1]
    if problems:
        raise broken(name, "; it ".join(problems))


def _missing_methods(kind: type) -> list[str]:
    """What a class must define besides `config_type` and `presets`, if it does not."""
    problems = []
    if not any(callable(getattr(kind, method, None)) for method in ("step", "advance")):
        problems.append("has neither step(frame) nor advance(pair)")
    if not callable(getattr(kind, "reset", None)):
        problems.append("has no reset()")
    return problems


def broken(name: str, problem: str) -> TexventError:
    """The error for a plug-in that breaks the contract of simulators."""
    return TexventError(f"simulator {name!r} {problem}; {CONTRACT}")


@contextmanager
def reporting(name: str, what: str) -> Iterator[None]:
    """Name the plug-in in whatever goes wrong inside of it."""
    try:
        yield
    except (TexventError, MemoryError):
        raise
    except Exception as error:
        text = one_line(error)
        raise broken(name, f"failed in {what} ({type(error).__name__}: {text})") from error


class WatchedPlugIn:
    """A simulator of another package whose packets are checked as they come."""

    contrast_threshold: float
    balance: float

    def __init__(self, build: Callable[[], Any], name: str) -> None:
        """Build the simulator.

        Raises:
            TexventError: it cannot be built, or does not say what Eq. 4 counts with.
        """
        self._name = name
        with reporting(name, "its construction"):
            self._simulator = with_advance(build())
            self.contrast_threshold = float(self._simulator.contrast_threshold)
            self.balance = float(self._simulator.balance)
        self._last_us: int | None = None

    def __getattr__(self, name: str) -> Any:
        return getattr(self._simulator, name)

    def reset(self) -> None:
        """Forget all frames."""
        self._last_us = None
        with reporting(self._name, "reset"):
            self._simulator.reset()

    def step(self, frame: Frame) -> EventStream:
        """One frame; the packet is checked."""
        with reporting(self._name, "step"):
            packet = self._simulator.step(frame)
        self._check(frame, packet)
        return packet

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """One pair; every packet is checked."""
        return self._checked(lambda: self._simulator.advance(pair), "advance")

    def finish(self) -> Iterator[tuple[Frame, EventStream]]:
        """What the simulator still owes; every packet is checked."""
        return self._checked(self._simulator.finish, "finish")

    def _checked(
        self, make: Callable[[], Iterable[Any]], what: str
    ) -> Iterator[tuple[Frame, EventStream]]:
        with reporting(self._name, what):
            steps = iter(make())
        while True:
            with reporting(self._name, what):
                step = next(steps, None)
                if step is None:
                    return
                frame, packet = step
            self._check(frame, packet)
            yield frame, packet

    def _check(self, frame: Any, packet: Any) -> None:
        """Refuse a packet outside of `[t of the frame before, t of this frame)`."""
        name = self._name
        if not (isinstance(frame, Frame) and isinstance(packet, EventStream)):
            kinds = f"{type(frame).__name__} and {type(packet).__name__}"
            raise broken(name, f"gave {kinds}; it must give a Frame and an EventStream")
        if packet.size != frame.size:
            raise broken(name, f"gave events of {packet.size} for frames of {frame.size}")
        start_us, self._last_us = self._last_us, frame.t_us
        if not len(packet):
            return
        if start_us is None:
            raise broken(name, f"gave {len(packet):,} events for the first frame; it has none")
        check_columns(packet, name)
        first, last = int(packet.t.min()), int(packet.t.max())
        if first < start_us or last >= frame.t_us:
            raise broken(
                name,
                f"gave events from {first} to {last} µs for the interval from {start_us} to "
                f"{frame.t_us} µs, whose end does not belong to it",
            )


def check_columns(packet: EventStream, name: str) -> None:
    """Refuse a packet whose columns are not those of events in order.

    Raises:
        TexventError: wrong types or values, or events out of order.
    """
    for column, values in packet.columns().items():
        if values.dtype != COLUMN_TYPES[column]:
            wanted = np.dtype(COLUMN_TYPES[column])
            raise broken(name, f"gave {column} as {values.dtype}; it must be {wanted}")
        if len(values) != len(packet):
            raise broken(name, f"gave {len(values)} values of {column} for {len(packet)} events")
    limits = {"x": packet.size.width, "y": packet.size.height, "p": 2, "label": 2}
    for column, values in packet.columns().items():
        if column in limits and int(values.max()) >= limits[column]:
            allowed = f"0..{limits[column] - 1}"
            raise broken(name, f"gave {column} up to {int(values.max())}; {allowed} is allowed")
    if np.any(packet.t[1:] < packet.t[:-1]):
        raise broken(name, "gave a packet whose times decrease")
