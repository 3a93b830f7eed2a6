"""DVS-Voltmeter's pixel model: the voltage is a Brownian motion with drift.

Source: S. Lin, Y. Ma, Z. Guo, B. Wen, "DVS-Voltmeter: stochastic process-based event simulator
for dynamic vision sensors", ECCV 2022. docs/simulators/voltmeter.md gives the equations and
the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from texvent.config import check_choices, check_range
from texvent.simulate.packets import FrameInterval, SortedEvents, check_event_number
from texvent.simulate.random.draws import Purpose, draw_uniforms
from texvent.simulate.random.mismatch import sensor_key
from texvent.simulate.streaming import IntensityArray, StreamingSimulator


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
    initial_phase: Literal["random", "zero"] = "random"
    """Voltages at the first frame: anywhere up to the next leak event (random), or all zero (zero),
    which makes equal pixels leak in unison."""

    def __post_init__(self) -> None:
        check_range("k1", self.k1, 1e-3, 1e3)
        check_range("k2", self.k2, 0.1, 1e6)
        check_range("k3", self.k3, 0.0, 0.1)
        check_range("k4", self.k4, -0.01, 0.01)
        check_range("k5", self.k5, -1e-4, 1e-4)
        check_range("k6", self.k6, 0.0, 0.1)
        check_choices(self)


PRESETS: Mapping[str, VoltmeterConfig] = {
    "davis346": VoltmeterConfig(),
    "davis240": VoltmeterConfig(k1=4.424, k2=23.0, k3=2e-4, k5=5e-8),
    "peer-common": VoltmeterConfig(initial_phase="zero"),
}
"""Name → options."""


class VoltmeterSimulator(StreamingSimulator[VoltmeterConfig]):
    """DVS-Voltmeter on video frames; see `simulate.protocol.Simulator`.

    Example:
        >>> from texvent.video import Frame
        >>> quiet = VoltmeterConfig(k3=0, k4=0, k5=0, k6=0)
        >>> simulator = VoltmeterSimulator(quiet)
        >>> len(simulator.step(Frame(np.array([[90]], np.uint8), t_us=0)))
        0
        >>> events = simulator.step(Frame(np.array([[130]], np.uint8), t_us=1000))
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))  # 5.265 * 40 / 130 = 1.62
        [(617, 1)]
    """

    config_type: ClassVar[type] = VoltmeterConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 60
    benefits_from_denser_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, VoltmeterConfig]] = PRESETS

    @property
    def contrast_threshold(self) -> float:
        """`1 / k1`: the relative change of one event."""
        return 1.0 / self.config.k1

    @property
    def balance(self) -> float:
        """`k2`, on the 0..255 scale."""
        return self.config.k2

    def _begin(self, intensity: IntensityArray) -> None:
        from texvent.simulate.voltmeter.first_passage import (  # brings Numba
            Constants,
            new_voltage,
        )

        config = self.config
        self._seen = intensity.copy()
        self._constants = Constants(
            config.k1, config.k2, config.k3, config.k4, config.k5, config.k6
        )
        displacement = np.zeros(intensity.shape)
        if config.initial_phase == "random":
            leak = config.k4 + config.k5 * intensity.astype(np.float64)
            y, x = np.ogrid[: intensity.shape[0], : intensity.shape[1]]
            chance = draw_uniforms(sensor_key(self._seed), y, x, Purpose.PHASE.draw())
            displacement = np.sign(leak) * chance
        self._voltage = new_voltage(displacement)
        self._begin_us = self._last_us

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        from texvent.simulate.voltmeter.first_passage import (  # brings Numba
            FirstPassageInput,
            find_first_passages,
            most_passages,
        )

        if intensity.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen = self._seen.astype(np.float32, copy=False)
            intensity = intensity.astype(np.float32, copy=False)
        light = FirstPassageInput(self._seen, intensity, self._constants)
        check_event_number(most_passages(light, interval.duration_us))
        return find_first_passages(light, self._voltage, interval, self._begin_us)
