"""DVS-Voltmeter's pixel model: the voltage is a Brownian motion with drift.

Source: S. Lin, Y. Ma, Z. Guo, B. Wen, "DVS-Voltmeter: stochastic process-based event simulator
for dynamic vision sensors", ECCV 2022. docs/simulators/voltmeter.md gives the equations and
the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal, NamedTuple

import numpy as np

from texvent.config import check_choices, check_range
from texvent.errors import ConfigError, shown
from texvent.simulation.packets import FrameInterval, SortedEvents, check_event_number
from texvent.simulation.random.draws import Purpose, draw_uniforms
from texvent.simulation.random.mismatch import sensor_key
from texvent.simulation.streaming import IntensityArray, StreamingSimulator


class Constants(NamedTuple):
    """Constants of drift and diffusion: intensities 0..255, times in µs, voltages in thresholds."""

    k1: float
    """Gain: events per unit of relative change of light, ΔL / (L + k2)."""
    k2: float
    """Dark offset of the light, in levels of 0..255."""
    k3: float
    """Photon noise: its share of the diffusion is k3 √L / (L + k2), per √µs."""
    k4: float
    """Leakage: constant drift, thresholds per µs."""
    k5: float
    """Parasitic photocurrent: drift per level of light, thresholds per µs."""
    k6: float
    """Leakage noise: constant diffusion, per √µs."""

    def __str__(self) -> str:
        return " ".join(map(repr, self))


RANGES = {
    "k1": (1e-3, 1e3),
    "k2": (0.1, 1e6),
    "k3": (0.0, 0.1),
    "k4": (-0.01, 0.01),
    "k5": (-1e-4, 1e-4),
    "k6": (0.0, 0.1),
}
"""Lowest and highest value of every constant."""


def parse_constants(text: str) -> Constants:
    """The constants that a text such as "5.265 20 1e-4 1e-7 5e-9 1e-5" holds.

    Raises:
        ConfigError: it is no list of six numbers, or one is out of range.
    """
    try:
        constants = Constants(*map(float, text.replace(",", " ").split()))
    except (ValueError, TypeError):
        raise ConfigError(
            f"constants is {shown(text)}; it must be the six numbers k1 to k6, such as "
            f"'{VoltmeterConfig.constants}'"
        ) from None
    for name, (low, high) in RANGES.items():
        check_range(name, getattr(constants, name), low, high)
    return constants


@dataclass(frozen=True, kw_only=True)
class VoltmeterConfig:
    """Options of the DVS-Voltmeter pixel model; the default constants are the DAVIS346's.

    Raises:
        ConfigError: a constant is out of range.

    Example:
        >>> from texvent.pixel_models import VoltmeterConfig
        >>> VoltmeterConfig(constants="5.265 20 0 0 0 0").k.k1
        5.265
    """

    constants: str = "5.265 20 1e-4 1e-7 5e-9 1e-5"
    """k1 to k6 of the publication: gain, dark offset, photon noise, leakage, parasitic
    photocurrent, leakage noise."""
    initial_phase: Literal["random", "zero"] = "random"
    """Voltages at the first frame: anywhere up to the next leak event (random), or all zero (zero),
    which makes equal pixels leak in unison."""

    def __post_init__(self) -> None:
        parse_constants(self.constants)
        check_choices(self)

    @property
    def k(self) -> Constants:
        """The constants as numbers."""
        return parse_constants(self.constants)


PRESETS: Mapping[str, VoltmeterConfig] = {
    "davis346": VoltmeterConfig(),
    "davis240": VoltmeterConfig(constants="4.424 23 2e-4 1e-7 5e-8 1e-5"),
    "peer-common": VoltmeterConfig(initial_phase="zero"),
}
"""Name → options."""


class VoltmeterSimulator(StreamingSimulator[VoltmeterConfig]):
    """DVS-Voltmeter on video frames; see `simulation.protocol.Simulator`.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> from texvent.pixel_models import VoltmeterConfig, VoltmeterSimulator
        >>> quiet = VoltmeterConfig(constants="5.265 20 0 0 0 0")
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
        return 1.0 / self.config.k.k1

    @property
    def balance(self) -> float:
        """`k2`, on the 0..255 scale."""
        return self.config.k.k2

    def _begin(self, intensity: IntensityArray) -> None:
        from texvent.simulation.voltmeter.voltage import new_voltage  # brings Numba

        self._seen, self._constants = intensity.copy(), self.config.k
        displacement = np.zeros(intensity.shape)
        if self.config.initial_phase == "random":
            leak = self._constants.k4 + self._constants.k5 * intensity.astype(np.float64)
            y, x = np.ogrid[: intensity.shape[0], : intensity.shape[1]]
            chance = draw_uniforms(sensor_key(self._seed), y, x, Purpose.PHASE.draw())
            displacement = np.sign(leak) * chance
        self._voltage = new_voltage(displacement)
        self._begin_us = self._last_us

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        from texvent.simulation.voltmeter.first_passage import find_first_passages  # brings Numba
        from texvent.simulation.voltmeter.voltage import FirstPassageInput, most_passages

        if intensity.dtype != self._seen.dtype:
            # Frames of two types: from now on all are float32, which holds 8-bit levels exactly.
            self._seen = self._seen.astype(np.float32, copy=False)
            intensity = intensity.astype(np.float32, copy=False)
        light = FirstPassageInput(self._seen, intensity, self._constants)
        check_event_number(most_passages(light, interval.duration_us))
        return find_first_passages(light, self._voltage, interval, self._begin_us)
