"""Texvent's pixel model on the GPU: its options, its state, and which kernels it launches."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import numpy as np

from texvent._require import require
from texvent.simulation.gpu.intervals import Float64Array, Span
from texvent.simulation.gpu.kernel_types import Call, Records, Tensor
from texvent.simulation.gpu.launch import (
    BRIGHTNESS_LAUNCH,
    EXTRA,
    LAUNCH,
    LEVELS_LAUNCH,
    RECORD_BLOCK,
    make_records,
    segment_grid,
    to_device,
)
from texvent.simulation.gpu.passes import GpuPixels
from texvent.simulation.texvent.brightness_cache import CacheSchedule
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.gpu import rules, scan_triton


class TexventPixels(GpuPixels[TexventConfig]):
    """The pixels of a batch of clips under Eqs. 5 and 7."""

    def __init__(self, config: TexventConfig, seeds: Sequence[int]) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options.
            seeds: one per clip.
        """
        self._tracks_intensity = rules.tracks_intensity(config)
        super().__init__(config, LEVELS_LAUNCH if self._tracks_intensity else BRIGHTNESS_LAUNCH)
        self._schedules = [CacheSchedule(config.cache, config.residual_decay_hz) for _ in seeds]

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

    def shares(self, span: Span) -> Float64Array:
        """See `GpuPixels` and `CacheSchedule`."""
        shares = _pass_frames(copy.deepcopy(self._schedules), span)
        if span.is_new:
            shares[:, 0] = 1.0
        return shares

    def advance(self, span: Span) -> None:
        """Move the schedules on, once the events of the frames are there."""
        _pass_frames(self._schedules, span)

    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        if not self._tracks_intensity:
            return scan_triton.scan_brightness, self._rules, self._reference
        # Exact: float32 holds every byte.
        self._reference = self._reference.to(call.frames.pixels.dtype)
        return scan_triton.scan_levels, self._rules, self._reference

    def records(self, count: int, words: Tensor) -> Records:
        """See `GpuPixels`."""
        return make_records(count, self._reference, has_order=self.config.multi_event)

    def timestamp(self, call: Call, records: Records, ends: Tensor, words: Tensor) -> None:
        """Give every record its time; see `scan_triton.timestamp_events`."""
        torch = require("torch", extra=EXTRA)
        grid = segment_grid(call, len(records.pixel), RECORD_BLOCK)
        extremes = None
        if self.config.timestamp_rule == "eq7":
            extremes = torch.empty(call.segments, 2, dtype=torch.float64, device=words.device)
            extremes[:, 0], extremes[:, 1] = torch.inf, -torch.inf
            scan_triton.find_extremes[grid](
                call.frames, self._rules, records, ends, extremes, BLOCK=RECORD_BLOCK, **LAUNCH
            )
        scan_triton.timestamp_events[grid](
            call.frames,
            call.intervals,
            self._rules,
            records,
            (ends, extremes),
            words,
            TIMESTAMP_RULE=rules.TIMESTAMP_RULES[self.config.timestamp_rule],
            BLOCK=RECORD_BLOCK,
            **LAUNCH,
        )


def _pass_frames(schedules: Sequence[CacheSchedule], span: Span) -> Float64Array:
    """The share of every interval, [B, T]; the schedules of the clips move on."""
    shares = np.empty(span.start_us.shape)
    for clip, schedule in enumerate(schedules):
        starts = zip(span.start_us[clip].tolist(), span.from_source[clip].tolist(), strict=True)
        shares[clip] = [schedule.pass_frame(t, is_source=source) for t, source in starts]
    return shares
