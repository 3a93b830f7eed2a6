"""Runs of several clips of one size as one batch of a device, each at its own pace."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, TypeAlias

import numpy as np

from texvent._require import require
from texvent.errors import TexventError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.pairs.on_device import batches_on
from texvent.runtime.devices import EXTRA, Device, Tensor, explain_device_memory
from texvent.simulation.gpu.engine import GpuSimulator
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.streaming import make_packet

FRAMES_AT_ONCE = 8
"""Frames of each clip in a call, at least, unless one ends."""
Take: TypeAlias = Callable[[int, Frame, EventStream], bool]
"""Takes the next dense frame of a clip, by its number, and the packet that ends there; False: no
more of that clip is wanted."""


class _Ahead:
    """Dense frames of one clip that wait for those of others."""

    def __init__(self, pairs: Iterable[FramePair], device: Device) -> None:
        self._batches = (batch for pair in pairs for batch in batches_on(pair, device))
        self.frames: list[Frame] = []
        self.levels: Tensor = None
        self.is_ended = self.has_failed = False

    def fill(self) -> None:
        """Draw until there are enough, or no more."""
        torch = require("torch", extra=EXTRA)
        while not self.is_ended and len(self.frames) < FRAMES_AT_ONCE:
            try:
                batch = next(self._batches, None)
            except TexventError:
                self.has_failed = True
                self.end()
                return
            if batch is None:
                self.is_ended = True
                return
            frames, levels = batch
            parts = [levels] if not self.frames else [self.levels[-len(self.frames) :], levels]
            if len({one.dtype for one in parts}) > 1:
                parts = [one.float() for one in parts]
            self.frames = self.frames + frames
            self.levels = torch.cat(parts)

    def take(self, count: int) -> tuple[list[Frame], Tensor, list[int]]:
        """The next frames, their levels and times; after the end the last one, on and on."""
        taken, self.frames = self.frames[:count], self.frames[count:]
        times_us = [frame.t_us for frame in taken]
        if taken:
            at = len(self.levels) - len(self.frames) - len(taken)
            levels = self.levels[at : at + count]
            self._last_us = times_us[-1]
        else:
            levels = self.levels[-1:].expand(count, -1, -1)
            times_us = [self._last_us + 1 + index for index in range(count)]
            self._last_us = times_us[-1]
        return taken, levels, times_us

    def end(self) -> None:
        """Draw no more."""
        self.frames, self.is_ended = [], True


def advance_together(
    config: Any,
    seeds: Sequence[int],
    clips: Sequence[Iterable[FramePair]],
    device: Device,
    take: Take,
) -> list[int]:
    """Simulate clips as one batch; each gives the packets that it gives alone.

    Args:
        config: options of the pixel model, of all clips.
        seeds: one per clip.
        clips: pairs of frames of each, all of one size.
        device: torch.device of the kernels.
        take: called with the frames of each clip in order.

    Returns:
        Numbers of clips that broke off: their frames could not be read or made.

    Raises:
        InputError: a frame cannot be used, or the frames do not fit into the device's memory.
    """
    ahead = [_Ahead(one, device) for one in clips]
    begun, kernels = list(enumerate(ahead)), None
    while True:
        with explain_device_memory(device, f"{len(clips)} clips at once"):
            for _, one in begun:
                one.fill()
            counts = [len(one.frames) for _, one in begun if one.frames]
            if not counts:
                return [number for number, one in enumerate(ahead) if one.has_failed]
            is_first = kernels is None
            if kernels is None:
                begun = [(number, one) for number, one in begun if one.frames]
                own = [seeds[number] for number, _ in begun]
                kernels = GpuSimulator(config, seed=own, is_scale_known=True)
            packets = _step(kernels, [one for _, one in begun], min(counts), is_first)
        for (number, one), made in zip(begun, packets, strict=True):
            if not all(take(number, frame, packet) for frame, packet in made):
                one.end()


def _step(
    kernels: GpuSimulator, waiting: Sequence[_Ahead], count: int, is_first: bool
) -> list[list[tuple[Frame, EventStream]]]:
    """The next frames of every clip, with their packets; none of clips that have ended."""
    torch = require("torch", extra=EXTRA)
    frames, levels, times_us = zip(*(one.take(count) for one in waiting), strict=True)
    if len({one.dtype for one in levels}) > 1:
        levels = tuple(one.float() for one in levels)
    is_source = [[frame.is_source for frame in taken] or [False] * count for taken in frames]
    events = kernels.step(torch.stack(levels), np.array(times_us), np.array(is_source))
    made = []
    for number, taken in enumerate(frames):
        packets: Iterator[EventStream] = events.packets(number) if taken else iter(())
        if is_first and taken:
            span = FrameInterval(taken[0].t_us, taken[0].t_us, np.uint64(0))
            empty = make_packet(UnsortedEvents.none(), span, events.size)
            packets = iter([empty, *packets])
        made.append(list(zip(taken, packets, strict=True)))
    return made
