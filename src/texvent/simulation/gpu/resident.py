"""A pixel model as a run uses it, with frames and state on a device: only events come down."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.pairs.on_device import batches_on, luma_on
from texvent.runtime.devices import Device, Tensor, explain_device_memory
from texvent.simulation.gpu.engine import GpuSimulator
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.protocol import Simulator
from texvent.simulation.streaming import make_packet


class ResidentSimulator:
    """A simulator on a device; see `simulation.protocol.Simulator`.

    The host waits twice in a pair of frames: for the number of events, and for the events.
    """

    def __init__(self, model: Simulator, config: Any, seed: int, device: Device) -> None:
        """A simulator that has seen no frame.

        Args:
            model: the same on the CPU, which says what Eq. 4 and warnings ask of it.
            config: its options.
            seed: its seed.
            device: torch.device of the kernels.
        """
        self._model, self._device = model, device
        self._kernels = GpuSimulator(config, seed=seed, is_scale_known=True)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._model, name)

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        self._kernels.reset()

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Events between two frames; see `simulation.protocol.Simulator.advance`."""
        with explain_device_memory(self._device, pair.second.size):
            batches = batches_on(pair, self._device)
        while True:
            # Not around the yield: errors of the caller are not those of the device.
            with explain_device_memory(self._device, pair.second.size):
                batch = next(batches, None)
                if batch is None:
                    return
                packets = self._packets(*batch, pair)
            yield from packets

    def finish(self) -> Iterator[tuple[Frame, EventStream]]:
        """Nothing: every frame was answered at once."""
        yield from ()

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`; none for the first frame."""
        ((_, packet),) = self._packets([frame], luma_on(frame, self._device)[None])
        return packet

    def _packets(
        self, frames: list[Frame], levels: Tensor, pair: FramePair | None = None
    ) -> list[tuple[Frame, EventStream]]:
        times_us = [frame.t_us for frame in frames]
        is_source = [frame.is_source for frame in frames]
        try:
            events = self._kernels.step(levels[None], times_us, is_source)
        except InputError:
            for _ in pair.between if pair is not None else ():
                pass  # what made the frames knows better what is wrong with them
            raise
        packets = list(events.packets(0))
        if len(packets) < len(frames):  # the first frame of the stream
            span = FrameInterval(times_us[0], times_us[0], np.uint64(0))
            packets.insert(0, make_packet(UnsortedEvents.none(), span, events.size))
        return list(zip(frames, packets, strict=True))
