"""One clip through the GPU backend, frame by frame from the host: what `backend="gpu"` runs."""

from __future__ import annotations

from typing import Any

import numpy as np

from texvent._require import require
from texvent.events import EventStream
from texvent.simulate.esim.simulator import EsimConfig
from texvent.simulate.gpu.device import EXTRA, default_device
from texvent.simulate.texvent.config import TexventConfig
from texvent.video import Frame


class FrameSteps:
    """A pixel model on the GPU that takes frames from the host and gives packets back.

    Every frame and every event crosses the bus. For frames made on the GPU, or several clips, use
    `GpuSimulator`.
    """

    def __init__(self, config: TexventConfig | EsimConfig, seed: int) -> None:
        """Prepare a clip that has seen no frame.

        Args:
            config: options of the model.
            seed: 0..2⁶³−1.

        Raises:
            ConfigError: there is no GPU, or an option only the CPU has.
            MissingDependencyError: torch or Triton is not installed.
        """
        self._device = default_device()
        from texvent.simulate.gpu.engine import GpuSimulator  # needs Triton, which is here by now

        self._simulator = GpuSimulator(config, seed=seed)

    def step(self, frame: Frame) -> EventStream:
        """Events between the frame before and this one; none for the first frame.

        Raises:
            InputError: an intensity is NaN, infinite or negative.
        """
        torch = require("torch", extra=EXTRA)
        luma: Any = np.array(frame.luma, order="C")
        frames = torch.from_numpy(luma).to(self._device)[None, None]
        events = self._simulator.step(frames, [frame.t_us], [frame.is_source])
        packet: EventStream = events.stream(0)
        return packet
