"""Noise addition (Eq. 6) on the GPU: Poisson tables from the host, draws on the device."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import triton

from texvent._require import require
from texvent.simulate.gpu.device import EXTRA, LAUNCH
from texvent.simulate.gpu.intervals import Int64Array, Span
from texvent.simulate.gpu.kernel_types import (
    DARK_BELOW,
    ON_FRACTION,
    Call,
    NoiseRules,
    Tensor,
)
from texvent.simulate.gpu.launch import to_device
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.gpu.noise_triton import draw_noise
from texvent.simulate.texvent.noise import poisson_cumulative
from texvent.simulate.texvent.pixel_memory import NOISE_BLOCK

_CELLS = 512
"""Draws of a program at a time."""
_MOST_DRAWS = 128
_NEVER = 2.0
"""Fills up tables of several lengths: above every uniform number."""


def noise_rules(config: TexventConfig, span: Span, frames: Tensor) -> tuple[NoiseRules, Int64Array]:
    """How noise is drawn in the intervals of a span.

    Args:
        config: options of the model.
        span: the intervals.
        frames: decides the device, and the type in which intensities are compared with σ.

    Returns:
        The rules, and which table each interval draws from, [B, T].
    """
    durations, row = np.unique(span.duration_us, return_inverse=True)
    tables = [
        poisson_cumulative(config.expected_noise(one * 1e-6) * NOISE_BLOCK)
        for one in durations.tolist()
    ]
    length = max(map(len, tables))
    cumulative = np.full((len(tables), length), _NEVER)
    for one, table in zip(cumulative, tables, strict=True):
        one[: len(table)] = table
    numbers = np.empty(2)
    numbers[ON_FRACTION] = config.noise_on_fraction
    # As NumPy compares: a float32 frame with a float32 number.
    is_float = frames.is_floating_point()
    numbers[DARK_BELOW] = np.float32(config.noise_intensity) if is_float else config.noise_intensity
    rules = NoiseRules(
        to_device(numbers, frames.device), to_device(cumulative, frames.device), length
    )
    return rules, row.reshape(span.duration_us.shape)


class NoiseDraw:
    """The noise of one call."""

    def __init__(self, call: Call, rules: NoiseRules, fired: Tensor | None) -> None:
        """Count it.

        Args:
            call: frames and intervals.
            rules: of `noise_rules`.
            fired: `PassCounts.fired`; None where noise falls on any pixel.
        """
        torch = require("torch", extra=EXTRA)
        self._call, self._rules, self._fired = call, rules, fired
        self._blocks = math.ceil(call.frames.area / NOISE_BLOCK)
        device = call.frames.pixels.device
        self._count = torch.empty(call.segments * self._blocks, dtype=torch.int32, device=device)
        self._launch(self._count, None)

    @property
    def per_block(self) -> Tensor:
        """Events by segment and noise block, [S · blocks] int32."""
        return self._count

    def write(self, starts: Tensor, words: Tensor) -> None:
        """Write the events down.

        Args:
            starts: [S · blocks] int64, where the events of each block begin in `words`.
            words: [n] int64.
        """
        self._launch(starts, words)

    def _launch(self, tally: Tensor, words: Any) -> None:
        draws = min(_MOST_DRAWS, triton.next_power_of_2(self._rules.length))
        lanes = _CELLS // draws
        grid = (math.ceil(self._blocks / lanes), self._call.segments)
        draw_noise[grid](
            self._call.frames,
            self._call.intervals,
            self._rules,
            self._fired,
            tally,
            words,
            LANES=lanes,
            DRAWS=draws,
            **LAUNCH,
        )
