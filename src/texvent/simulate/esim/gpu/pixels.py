"""ESIM's pixel model on the GPU: its options, its state, and which kernels it launches."""

from __future__ import annotations

from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import ConfigError
from texvent.simulate.esim.gpu import crossings_triton
from texvent.simulate.esim.gpu.crossings_triton import (
    LOG_EPS,
    THRESHOLD_OFF,
    THRESHOLD_ON,
    EsimRules,
)
from texvent.simulate.esim.simulator import EsimConfig, log_intensity
from texvent.simulate.gpu.kernel_types import Call, Records, Tensor
from texvent.simulate.gpu.launch import (
    EXTRA,
    LAUNCH,
    RAMP_LAUNCH,
    RECORD_BLOCK,
    make_records,
    segment_grid,
    to_device,
)
from texvent.simulate.gpu.passes import GpuPixels


class EsimPixels(GpuPixels[EsimConfig]):
    """The pixels of a batch of clips under ESIM."""

    def __init__(self, config: EsimConfig) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options.

        Raises:
            ConfigError: thresholds that are drawn for every frame, or a refractory period.
        """
        if config.refractory_period_us > 0:
            raise ConfigError(
                f"refractory_period_us is {config.refractory_period_us}, which is not kept on a "
                "GPU; use 0"
            )
        if config.threshold_sigma > 0:
            raise ConfigError(
                f"threshold_sigma {config.threshold_sigma:g} draws two normal numbers for every "
                "pixel and frame, which is not done on a GPU; use 0"
            )
        super().__init__(config, RAMP_LAUNCH)

    def begin(self, frames: Tensor) -> None:
        """See `GpuPixels`."""
        torch = require("torch", extra=EXTRA)
        config, device = self.config, frames.device
        # What it holds does not matter: the first interval begins at its own start.
        self._reference = torch.zeros(frames.shape, dtype=torch.float64, device=device)
        numbers = np.empty(3)
        numbers[THRESHOLD_ON] = config.contrast_threshold_on
        numbers[THRESHOLD_OFF] = config.contrast_threshold_off
        numbers[LOG_EPS] = config.log_eps
        logs = log_intensity(np.arange(256, dtype=np.uint8), config.log_eps)
        self._rules = EsimRules(
            to_device(numbers, device),
            to_device(logs, device),
        )

    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        return crossings_triton.scan_ramp, self._rules, self._reference

    def records(self, count: int) -> Records:
        """See `GpuPixels`."""
        return make_records(count, self._reference, has_order=True)

    def timestamp(self, call: Call, records: Records, ends: Tensor, words: Tensor) -> None:
        """Give every record its time; see `crossings_triton.stamp_crossings`."""
        crossings_triton.stamp_crossings[segment_grid(call, len(records.pixel), RECORD_BLOCK)](
            call.frames,
            call.intervals,
            self._rules,
            records,
            ends,
            words,
            BLOCK=RECORD_BLOCK,
            **LAUNCH,
        )
