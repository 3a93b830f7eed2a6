"""Brightness, bandwidth and noise rate of the `physical` model at an intensity, on the GPU."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, cast

import numpy as np
import triton
import triton.language as tl

from texvent.errors import ConfigError
from texvent.simulation.gpu.blocks_triton import HIGHEST
from texvent.simulation.gpu.elementary_triton import exponential, natural_log
from texvent.simulation.gpu.kernel_types import Tensor
from texvent.simulation.gpu.launch import to_device
from texvent.simulation.physical import circuit
from texvent.simulation.physical.circuit import InputFrames, linearize
from texvent.simulation.physical.config import NoiseCurve, PhysicalConfig, parse_noise_curve
from texvent.simulation.random.poisson_noise import Float64Array

GAMMA, BALANCE, CUTOFF_PER_LEVEL, MOST_CURRENT, ON_FRACTION, TWICE_HIGHEST, REFRACTORY_US = range(7)
"""Places in a row of `PhysicalRules.numbers`; `TWICE_HIGHEST` is twice the highest rate of the
noise curve."""
NUMBERS = 7
"""Entries of a row."""
TABLE = 3 * 256
"""Entries of `PhysicalRules.bytes` of a clip."""


class PhysicalRules(NamedTuple):
    """The options of the model, on the device; in a kernel those of its clip, by `rules_of`."""

    numbers: Tensor
    """[B, NUMBERS] float64, because Triton rounds a plain number to float32."""
    bytes: Tensor
    """[B, 3, 256] float64: brightness, cutoff frequency and noise rate at a byte."""
    curve: Tensor
    """[3, points] float64, of the noise curve: levels, logarithms of the rates, and slopes."""
    points: int
    """Points of the noise curve."""
    is_coded: int
    """1 where luma is not linear already."""
    is_limited: int
    """1 where photoreceptors have a bandwidth."""


def make_rules(configs: Sequence[PhysicalConfig], device: Any) -> PhysicalRules:
    """The rules of the options of each clip.

    Raises:
        ConfigError: clips differ in what a launch has once.
    """
    alike: dict[str, set[object]] = {
        "noise_curve": {config.noise_curve for config in configs},
        "gamma, 1 or not,": {config.gamma == 1 for config in configs},
        "cutoff_hz, 0 or not,": {config.cutoff_hz == 0 for config in configs},
    }
    for name, values in alike.items():
        if len(values) > 1:
            raise ConfigError(f"{name} must be the same for all clips of a batch")
    curve = parse_noise_curve(configs[0].noise_curve)
    logs = np.log(curve.rates_hz)
    slopes = np.append(np.diff(logs) / np.diff(curve.levels), 0.0)
    numbers, tables = zip(*(_constants_of(config, curve) for config in configs), strict=True)
    return PhysicalRules(
        to_device(np.stack(numbers), device),
        to_device(np.stack(tables), device),
        to_device(np.stack((curve.levels, logs, slopes)), device),
        len(logs),
        int(configs[0].gamma != 1.0),
        int(configs[0].cutoff_hz > 0),
    )


def _constants_of(config: PhysicalConfig, curve: NoiseCurve) -> tuple[Float64Array, Float64Array]:
    """`numbers` and `bytes` of a clip."""
    black = np.zeros((1, 1), np.uint8)
    light = InputFrames(
        black,
        gamma=config.gamma,
        balance=config.balance,
        cutoff_hz=config.cutoff_hz,
        cutoff_limit_hz=config.cutoff_limit_hz,
    ).until(black)
    gamma, balance, cutoff_per_level, most_current = light.optics
    rates = curve.rate_at(linearize(np.arange(256.0), gamma))
    numbers = np.empty(NUMBERS)
    numbers[[GAMMA, BALANCE]] = gamma, balance
    numbers[[CUTOFF_PER_LEVEL, MOST_CURRENT]] = cutoff_per_level, most_current
    numbers[ON_FRACTION], numbers[TWICE_HIGHEST] = config.noise_on_fraction, 2.0 * curve.highest_hz
    numbers[REFRACTORY_US] = config.refractory_period_us
    return numbers, np.stack((*cast("Any", light.table), rates))


_GAMMA, _BALANCE = tl.constexpr(GAMMA), tl.constexpr(BALANCE)
_CUTOFF_PER_LEVEL, _MOST_CURRENT = tl.constexpr(CUTOFF_PER_LEVEL), tl.constexpr(MOST_CURRENT)
_NUMBERS, _TABLE = tl.constexpr(NUMBERS), tl.constexpr(TABLE)
_WHITE, _ALMOST_BLACK = tl.constexpr(circuit.WHITE), tl.constexpr(circuit.ALMOST_BLACK)


@triton.jit
def rules_of(rules: tl.tuple, clip: tl.tensor) -> tl.tuple:
    """The rules of a clip."""
    return PhysicalRules(
        rules.numbers + clip * _NUMBERS,
        rules.bytes + clip * _TABLE,
        rules.curve,
        rules.points,
        rules.is_coded,
        rules.is_limited,
    )


@triton.jit
def _linearize(intensity: tl.tensor, rules: tl.tuple) -> tl.tensor:
    """See `circuit.linearize`; float64. 0 for intensities that are refused after the pass."""
    is_good = (intensity >= 0) & (intensity <= HIGHEST)
    level = tl.where(is_good, intensity, 0.0).to(tl.float64)
    if rules.is_coded:
        gamma = tl.load(rules.numbers + _GAMMA)
        level = exponential(gamma * natural_log((level + _ALMOST_BLACK) / _WHITE)) * _WHITE
    return level


@triton.jit
def brightness_of(intensity: tl.tensor, rules: tl.tuple) -> tl.tuple:
    """Brightness and cutoff frequency; see `circuit.brightness_and_cutoff`. Bytes have a table."""
    if intensity.dtype == tl.int32:
        brightness = tl.load(rules.bytes + intensity)
        cutoff = tl.load(rules.bytes + 256 + intensity)
    else:
        current = tl.load(rules.numbers + _BALANCE) + _linearize(intensity, rules)
        brightness = natural_log(current)
        current = tl.minimum(current, tl.load(rules.numbers + _MOST_CURRENT))
        cutoff = tl.load(rules.numbers + _CUTOFF_PER_LEVEL) * current
    return brightness, cutoff


@triton.jit
def noise_rate_of(intensity: tl.tensor, rules: tl.tuple) -> tl.tensor:
    """Noise events per second; see `config.NoiseCurve.rate_at`. Bytes have a table."""
    if intensity.dtype == tl.int32:
        rate = tl.load(rules.bytes + 512 + intensity)
    else:
        level = _linearize(intensity, rules)
        logs, slopes = rules.curve + rules.points, rules.curve + 2 * rules.points
        log_rate = tl.zeros(level.shape, tl.float64) + tl.load(logs)
        for point in range(rules.points):
            after = level - tl.load(rules.curve + point)
            here = tl.load(slopes + point) * after + tl.load(logs + point)
            log_rate = tl.where(after >= 0, here, log_rate)
        rate = exponential(log_rate)
    return rate
