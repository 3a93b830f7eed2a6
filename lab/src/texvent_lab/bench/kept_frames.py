"""Frames that a network interpolates, kept between the runs of a benchmark.

A benchmark simulates a recording dozens of times: to fit thresholds, and for rows that differ in
their pixels alone. The network then makes the frames of a pair once.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Hashable, Iterable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from functools import partial

from texvent.extending import INTERPOLATORS
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.pipeline import Simulation
from texvent.runtime.memory import usable_bytes
from texvent.simulation.protocol import Simulator


class FrameStore:
    """Intermediate frames by their pair; those that were read least recently make room."""

    def __init__(self, most_bytes: int) -> None:
        self._most_bytes, self._bytes = most_bytes, 0
        self._frames: dict[Hashable, list[Frame]] = {}

    def frames(self, key: Hashable, between: Iterable[Frame]) -> Iterator[Frame]:
        """The frames that are kept under a key, else those of `between`, which are kept."""
        if key not in self._frames:
            made = list(between)
            self._bytes += _count_bytes(made)
        else:
            made = self._frames.pop(key)
        self._frames[key] = made
        while self._bytes > self._most_bytes:
            self._bytes -= _count_bytes(self._frames.pop(next(iter(self._frames))))
        yield from made


def _count_bytes(frames: Iterable[Frame]) -> int:
    return sum(frame.pixels.nbytes for frame in frames)


STORE = FrameStore(usable_bytes() // (2 * (os.cpu_count() or 1)))
"""Share of this process; all cores together take half of the memory that may be used."""


class KeepingSimulation(Simulation):
    """A run that looks for its intermediate frames in `STORE`; its events are the same."""

    def begin(self, threads: ExitStack) -> tuple[Simulator, Iterator[FramePair]]:
        """See `Simulation.begin`."""
        simulator, pairs = super().begin(threads)
        config = self.settings.interpolate
        part = INTERPOLATORS.load(config.interpolate)
        if not hasattr(part, "provenance"):  # no network: its frames cost little
            return simulator, pairs
        network = (*sorted(part.provenance(config).items()), config.rife_flow)
        return simulator, map(partial(_keep, network), pairs)


def keep_frames(simulation: Simulation) -> Simulation:
    """The run as a `KeepingSimulation`."""
    return KeepingSimulation(**vars(simulation))


def _keep(network: Hashable, pair: FramePair) -> FramePair:
    if pair.first is None or not pair.times_us:
        return pair
    prints = tuple(map(_fingerprint, (pair.first, pair.second)))
    key = (network, prints, tuple(pair.times_us))
    return replace(pair, between=STORE.frames(key, pair.between))


def _fingerprint(frame: Frame) -> tuple[Hashable, ...]:
    digest = hashlib.blake2b(frame.pixels.tobytes()).digest()
    return frame.t_us, frame.transfer, frame.pixels.dtype.str, frame.pixels.shape, digest
