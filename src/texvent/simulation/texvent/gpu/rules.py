"""Texvent's options as the numbers and tables that its GPU kernels read."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.simulation.crossing.trigger_levels import trigger_factors
from texvent.simulation.gpu.kernel_types import Tensor
from texvent.simulation.random.draws import Purpose
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.pixel_memory import needs_levels

BALANCE, THRESHOLD, UP, DOWN = range(4)
"""Places in `TexventRules.numbers`."""
TIMESTAMP_RULES = {"eq7": 0, "random": 1, "linear": 2, "end": 3}
"""Numbers of the rules for times in the kernels."""
TIMESTAMP_DRAW = Purpose.TIMESTAMP.draw()
LEVELS = 256


class TexventRules(NamedTuple):
    """The options of the model, on the device."""

    numbers: Tensor
    """[4] float64, because Triton rounds a plain number to float32."""
    levels: Tensor
    """[256] int32: for a reference byte, the byte from which on it fires (low half), and the byte
    up to which it fires (high half, −1 for none)."""
    logs: Tensor
    """[256] float64: brightness of a byte."""
    is_step: int
    """1 where an event moves the reference by a threshold, 0 where it sets it."""
    multi_event: int
    """1 where a pixel fires once per threshold crossed."""


def list_numbers(config: TexventConfig) -> NDArray[np.float64]:
    """The values of `TexventRules.numbers`."""
    numbers = np.empty(4)
    numbers[BALANCE] = config.balance
    numbers[THRESHOLD] = config.contrast_threshold
    factors = trigger_factors(config.contrast_threshold, config.contrast_threshold)
    numbers[UP], numbers[DOWN] = factors
    return numbers


def byte_brightness(balance: float) -> NDArray[np.float64]:
    """Brightness of every byte, [256], as `balanced_log` computes it on the CPU."""
    return balanced_log(np.arange(LEVELS, dtype=np.uint8), balance)


def byte_trigger_levels(brightness: NDArray[np.float64], threshold: float) -> NDArray[np.int32]:
    """The values of `TexventRules.levels`: exactly where Eq. 5 fires, in float64.

    Args:
        brightness: of every byte, [256], increasing.
        threshold: δ, log units.
    """
    change = brightness[None, :] - brightness[:, None]
    low = (change <= -threshold).sum(axis=1) - 1
    high = LEVELS - (change >= threshold).sum(axis=1)
    return np.asarray((low << 16) | high, np.int32)


def tracks_intensity(config: Any) -> bool:
    """Whether a reference is always the intensity of an earlier frame, so that levels decide."""
    return not needs_levels(config) and not config.multi_event
