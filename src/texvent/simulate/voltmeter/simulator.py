"""DVS-Voltmeter's pixel model: the voltage is a Brownian motion with drift.

Source: S. Lin, Y. Ma, Z. Guo, B. Wen, "DVS-Voltmeter: stochastic process-based event simulator
for dynamic vision sensors", ECCV 2022. docs/simulators.md gives the equations and the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.simulate.random.mismatch import sensor_key
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.simulate.voltmeter.kernels.first_passage import (
    Constants,
    Light,
    load_find_passages,
    new_voltage,
)


@dataclass(frozen=True, kw_only=True)
class VoltmeterConfig:
    """Constants of the DVS-Voltmeter pixel model, for intensities 0..255 and times in µs.

    The defaults are the DAVIS346's. Voltage is measured in thresholds.

    Raises:
        ConfigError: a constant is out of range.
    """

    k1: float = 5.265
    """Gain: events per unit of relative change of light, ΔL / (L + k2)."""
    k2: float = 20.0
    """Dark offset of the light, in levels of 0..255."""
    k3: float = 1e-4
    """Photon noise: its share of the diffusion is k3 √L / (L + k2), per √µs."""
    k4: float = 1e-7
    """Leakage: constant drift, thresholds per µs."""
    k5: float = 5e-9
    """Parasitic photocurrent: drift per level of light, thresholds per µs."""
    k6: float = 1e-5
    """Leakage noise: constant diffusion, per √µs."""
    start_voltage: Literal["random", "zero"] = "random"
    """Where pixels stand at the first frame: somewhere on the way to their next leak event
    (random), or all at rest (zero), which makes equal pixels leak in unison."""

    def __post_init__(self) -> None:
        check_range("k1", self.k1, 1e-3, 1e3)
        check_range("k2", self.k2, 0.1, 1e6)
        check_range("k3", self.k3, 0.0, 0.1)
        check_range("k4", self.k4, -0.01, 0.01)
        check_range("k5", self.k5, -1e-4, 1e-4)
        check_range("k6", self.k6, 0.0, 0.1)
        if self.start_voltage not in ("random", "zero"):
            raise ConfigError(f"start_voltage is {self.start_voltage!r}; allowed: random, zero")


class VoltmeterSimulator(StreamingSimulator[VoltmeterConfig]):
    """DVS-Voltmeter on video frames; see `simulate.protocol.Simulator`.

    Example:
        >>> from texvent.video import Frame
        >>> quiet = VoltmeterConfig(k3=0, k4=0, k5=0, k6=0)
        >>> simulator = VoltmeterSimulator(quiet, backend="reference")
        >>> len(simulator.step(Frame(np.array([[90]], np.uint8), t_us=0)))
        0
        >>> events = simulator.step(Frame(np.array([[130]], np.uint8), t_us=1000))
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))  # 5.265 * 40 / 130 = 1.62
        [(617, 1)]
    """

    config_type: ClassVar[type] = VoltmeterConfig
    presets: ClassVar[Mapping[str, VoltmeterConfig]] = {
        "davis346": VoltmeterConfig(),
        "davis240": VoltmeterConfig(k1=4.424, k2=23.0, k3=2e-4, k5=5e-8),
        "peer-common": VoltmeterConfig(start_voltage="zero"),
    }

    @property
    def contrast_threshold(self) -> float:
        """`1 / k1`: the relative change of one event."""
        return 1.0 / self.config.k1

    @property
    def balance(self) -> float:
        """`k2`, on the 0..255 scale."""
        return self.config.k2

    def _begin(self, intensity: IntensityArray) -> None:
        config = self.config
        self._seen = intensity.copy()
        self._constants = Constants(
            config.k1, config.k2, config.k3, config.k4, config.k5, config.k6
        )
        residual = np.zeros(intensity.shape)
        if config.start_voltage == "random":
            leak = config.k4 + config.k5 * intensity.astype(np.float64)
            y, x = np.ogrid[: intensity.shape[0], : intensity.shape[1]]
            chance = draw_uniforms(sensor_key(self._seed), y, x, Purpose.PHASE.draw())
            residual = np.sign(leak) * chance
        self._voltage = new_voltage(residual)
        self._begin_us = self._last_us

    def _advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        if intensity.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen = self._seen.astype(np.float32, copy=False)
            intensity = intensity.astype(np.float32, copy=False)
        light = Light(self._seen, intensity, self._constants)
        find_passages = load_find_passages(intensity.dtype, self._backend)
        return find_passages(light, self._voltage, interval, self._begin_us)
