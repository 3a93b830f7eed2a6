"""DVS-Voltmeter's pixel model: the voltage is a Brownian motion with drift.

Source: S. Lin, Y. Ma, Z. Guo, B. Wen, "DVS-Voltmeter: stochastic process-based event simulator
for dynamic vision sensors", ECCV 2022. docs/simulators/voltmeter.md gives the equations and
the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from texvent.simulation.packets import FrameInterval, SortedEvents, check_event_number
from texvent.simulation.random.draws import Purpose, draw_uniforms
from texvent.simulation.random.mismatch import sensor_key
from texvent.simulation.streaming import IntensityArray, StreamingSimulator
from texvent.simulation.voltmeter.config import PRESETS, VoltmeterConfig


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
