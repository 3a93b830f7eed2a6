"""Texvent's pixel model on the GPU: its options, its state, and which kernels it launches."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import ConfigError
from texvent.simulate.gpu.device import EXTRA, LAUNCH
from texvent.simulate.gpu.intervals import Int64Array, Span
from texvent.simulate.gpu.kernel_types import (
    FORGET,
    KEEP,
    LEAK,
    Call,
    Records,
    Tensor,
)
from texvent.simulate.gpu.launch import (
    LaunchSize,
    make_records,
    segment_grid,
    to_device,
)
from texvent.simulate.gpu.pixels import GpuPixels
from texvent.simulate.random.draws import frame_keys
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.gpu import rules, scan_triton

_BLOCK = 512
LEVELS_LAUNCH = LaunchSize(128, 1)
"""One warp: nothing waits at a barrier, and a quiet one has little to do."""
BRIGHTNESS_LAUNCH = LaunchSize(512, 4)


class TexventPixels(GpuPixels[TexventConfig]):
    """The pixels of a batch of clips under Eqs. 5 and 7."""

    def __init__(self, config: TexventConfig, seeds: Sequence[int]) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options.
            seeds: one per clip.

        Raises:
            ConfigError: Gaussian noise, or a balance of 0.
        """
        if config.noise == "gaussian":
            raise ConfigError(
                "noise 'gaussian' draws a normal number for every pixel and frame, which backend "
                "gpu does not do; use noise 'adaptive', 'random' or 'none', or backend cpu"
            )
        if config.balance <= 0:
            raise ConfigError(
                "balance is 0, and backend gpu does not look for black pixels, which then have no "
                "logarithm; use a balance above 0, or backend cpu"
            )
        self._tracks_intensity = rules.tracks_intensity(config)
        super().__init__(
            config, seeds, LEVELS_LAUNCH if self._tracks_intensity else BRIGHTNESS_LAUNCH
        )
        self._pairs_seen = np.zeros((len(seeds), 1), np.int64)

    def begin(self, frames: Tensor) -> None:
        """See `GpuPixels`."""
        torch = require("torch", extra=EXTRA)
        dtype = frames.dtype if self._tracks_intensity else torch.float64
        # What it holds does not matter: the first interval forgets.
        self._reference = torch.zeros(frames.shape, dtype=dtype, device=frames.device)
        brightness = rules.byte_brightness(self.config.balance)
        levels = rules.byte_trigger_levels(brightness, self.config.contrast_threshold)
        self._rules = rules.TexventRules(
            to_device(rules.list_numbers(self.config), frames.device),
            to_device(levels, frames.device),
            to_device(brightness, frames.device),
            int(self.config.reset == "step"),
            int(self.config.multi_event),
        )

    def keys(self, span: Span) -> Int64Array:
        """See `GpuPixels`."""
        keys = [
            frame_keys(seed, times_us)
            for seed, times_us in zip(self._seeds, span.stop_us, strict=True)
        ]
        return np.stack(keys).view(np.int64)

    def policy(self, span: Span) -> Int64Array:
        """What references do before every interval, [B, T]; see `BrightnessCache`."""
        config, pair_starts = self.config, span.from_source
        policy = np.where(pair_starts & (config.cache == "leaky"), LEAK, KEEP)
        if config.cache == "none":
            forgets = np.ones_like(pair_starts)
        elif config.cache == "local":
            forgets = pair_starts.copy()
        else:
            pairs = self._pairs_seen + np.cumsum(pair_starts, axis=1)
            every = config.cache_reset_pairs
            forgets = pair_starts & (every > 0) & ((pairs - 1) % max(every, 1) == 0)
        if span.is_new:
            forgets[:, 0] = True
        return np.where(forgets, FORGET, policy)

    def advance(self, span: Span) -> None:
        """Count the pairs of source frames."""
        self._pairs_seen += span.from_source.sum(axis=1, keepdims=True)

    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        if not self._tracks_intensity:
            return scan_triton.scan_brightness, self._rules, self._reference
        # Exact: float32 holds every byte.
        self._reference = self._reference.to(call.frames.pixels.dtype)
        return scan_triton.scan_levels, self._rules, self._reference

    def records(self, count: int) -> Records:
        """See `GpuPixels`."""
        return make_records(count, self._reference, has_order=self.config.multi_event)

    def timestamp(self, call: Call, records: Records, ends: Tensor, words: Tensor) -> None:
        """Give every record its time; see `scan_triton.timestamp_events`."""
        torch = require("torch", extra=EXTRA)
        grid = segment_grid(call, len(records.pixel), _BLOCK)
        extremes = None
        if self.config.timestamp_rule == "eq7":
            extremes = torch.empty(call.segments, 2, dtype=torch.float64, device=words.device)
            extremes[:, 0], extremes[:, 1] = torch.inf, -torch.inf
            scan_triton.find_extremes[grid](
                call.frames, self._rules, records, ends, extremes, BLOCK=_BLOCK, **LAUNCH
            )
        scan_triton.timestamp_events[grid](
            call.frames,
            call.intervals,
            self._rules,
            records,
            (ends, extremes),
            words,
            TIMESTAMP_RULE=rules.TIMESTAMP_RULES[self.config.timestamp_rule],
            BLOCK=_BLOCK,
            **LAUNCH,
        )
