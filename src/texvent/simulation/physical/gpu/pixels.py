"""The `physical` model on the GPU: its options, its state, and the kernels it launches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from texvent._require import require
from texvent.simulation.gpu.intervals import Span
from texvent.simulation.gpu.kernel_types import Call, Tensor
from texvent.simulation.gpu.launch import CIRCUIT_LAUNCH, EXTRA, to_device
from texvent.simulation.gpu.passes import GpuPixels
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.drawn_sensor import draw_sensor
from texvent.simulation.physical.gpu.arrivals import NoiseProcess, draw_noise
from texvent.simulation.physical.gpu.circuit_triton import CircuitTensors, scan_circuit
from texvent.simulation.physical.gpu.light import make_rules


class PhysicalGpuPixels(GpuPixels[PhysicalConfig | Sequence[PhysicalConfig]]):
    """The pixels of a batch of clips under the `physical` model."""

    def __init__(
        self, config: PhysicalConfig | Sequence[PhysicalConfig], seeds: Sequence[int]
    ) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options, of all clips or of each.
            seeds: one per clip.
        """
        super().__init__(config, CIRCUIT_LAUNCH)
        if isinstance(config, PhysicalConfig):
            config = (config,) * len(seeds)
        self._configs = config
        self._seeds = seeds

    def begin(self, frames: Tensor) -> None:
        """See `GpuPixels`."""
        torch = require("torch", extra=EXTRA)
        shape, device = frames.shape, frames.device
        self._sensors = [
            draw_sensor(config, seed, shape[1:])
            for config, seed in zip(self._configs, self._seeds, strict=True)
        ]
        on, off, leak = (
            to_device(np.stack(column), device)
            for column in zip(*(one.mismatch for one in self._sensors), strict=True)
        )
        level = np.stack([np.broadcast_to(one.phase, shape[1:].numel()) for one in self._sensors])
        self._state = CircuitTensors(
            on,
            off,
            leak,
            torch.zeros(shape, dtype=torch.float64, device=device),
            to_device(level, device),
            torch.zeros(shape, dtype=torch.int64, device=device),
            None,
        )
        self._rules = make_rules(self._configs, device)
        self._processes = [
            NoiseProcess(
                to_device(np.stack([one.cumulative_hz for one in process]), device),
                process[0].stream,
                max(one.total_hz for one in process),
                is_thinned,
            )
            for process, is_thinned in (
                ([one.noise for one in self._sensors], True),
                ([one.hot for one in self._sensors], False),
            )
            if not all(one.is_silent for one in process)
        ]

    def prepare(self, call: Call, span: Span) -> None:
        """Draw the noise; see `GpuPixels`."""
        for sensor, longest_us in zip(self._sensors, span.duration_us.max(axis=1), strict=True):
            sensor.check_duration(int(longest_us) * 1e-6)
        noise = draw_noise(call, self._rules, self._processes, span.axis_us)
        self._state = self._state._replace(noise=noise)

    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        return scan_circuit, self._rules, self._state

    def records(self, count: int, words: Tensor) -> Tensor:
        """See `GpuPixels`: events have their times at once."""
        return words
