"""ESIM's options as the numbers and maps that its GPU kernels read."""

from __future__ import annotations

from typing import NamedTuple

from texvent.simulate.esim import simulator as config
from texvent.simulate.gpu.kernel_types import Tensor

THRESHOLD_ON, THRESHOLD_OFF, LOG_EPS = range(3)
"""Where each number lies in `EsimRules.numbers`."""
WHITE = config.WHITE


class EsimRules(NamedTuple):
    """The options of the model, on the device."""

    numbers: Tensor
    """[3] float64, because Triton rounds a plain number to float32."""
    logs: Tensor
    """[256] float64: log intensity of a byte."""
    threshold_on: Tensor
    """[B, area] float64 thresholds of every pixel, or None where all have the nominal one."""
    threshold_off: Tensor
    """[B, area] alike."""
    rests: Tensor
    """[1] int64, time after an event in which the pixel cannot fire, µs; None without one."""


class State(NamedTuple):
    """What a pixel remembers."""

    level: Tensor
    """[B, area] float64, reference log intensity."""
    fired_us: Tensor
    """[B, area] int64, time of its last event, µs; None without a refractory period."""
