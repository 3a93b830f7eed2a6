"""SENPI's pixel model: photons to voltage, at most one event per pixel and frame.

Source: J. L. Greene et al., "A PyTorch-enabled tool for synthetic event camera data generation and
algorithm development", SPIE 2025, and the parameters that its program documents.
docs/simulators/senpi.md gives the equation and the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from texvent.config import check_range
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.random.mismatch import LOWEST_THRESHOLD
from texvent.simulation.streaming import IntensityArray, StreamingSimulator

DARKEST = 1
"""Level of 0..255 up to which all pixels count as equally dark; the lowest voltage is its."""


@dataclass(frozen=True, kw_only=True)
class SenpiConfig:
    """Options of the SENPI pixel model; the defaults are those of its program, noise per second.

    Raises:
        ConfigError: an option is out of range.

    Example:
        >>> from texvent.pixel_models import SenpiConfig
        >>> SenpiConfig(noise_rate_hz=0.0).refractory_period_us
        50
    """

    contrast_threshold_on: float = 0.9616
    """Rise of ln(photons) that fires an ON event. The default is the program's 0.1, in its unit of
    ln(15000)."""
    contrast_threshold_off: float = 0.9616
    """Fall of ln(photons) that fires an OFF event."""
    noise_rate_hz: float = 1.2
    """Noise events per pixel and second; the program's 0.05 per frame, at 24 frames per second."""
    refractory_period_us: int = 50
    """Time after an event in which a change cannot fire the pixel; it is kept for later."""

    def __post_init__(self) -> None:
        for name in ("contrast_threshold_on", "contrast_threshold_off"):
            check_range(name, getattr(self, name), LOWEST_THRESHOLD, 10.0)
        check_range("noise_rate_hz", self.noise_rate_hz, 0.0, 1e4)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)


PRESETS: Mapping[str, SenpiConfig] = {
    "default": SenpiConfig(),
    "peer-common": SenpiConfig(
        contrast_threshold_on=0.2,
        contrast_threshold_off=0.2,
        noise_rate_hz=0.0,
        refractory_period_us=0,
    ),
}
"""Name → options."""


class SenpiSimulator(StreamingSimulator[SenpiConfig]):
    """SENPI on video frames; see `simulation.protocol.Simulator`.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> from texvent.pixel_models import SenpiSimulator
        >>> simulator = SenpiSimulator(SenpiSimulator.presets["peer-common"])
        >>> len(simulator.step(Frame(np.array([[40]], np.uint8), t_us=0)))
        0
        >>> events = simulator.step(Frame(np.array([[90]], np.uint8), t_us=1000))
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))  # once, however large
        [(999, 1)]
    """

    config_type: ClassVar[type] = SenpiConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 60
    presets: ClassVar[Mapping[str, SenpiConfig]] = PRESETS
    frame_bound_presets: ClassVar[frozenset[str]] = frozenset(PRESETS)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return min(self.config.contrast_threshold_on, self.config.contrast_threshold_off)

    @property
    def balance(self) -> float:
        """1: the logarithm of `1 + I` is about as steep at black as that of `max(I, 1)`."""
        return float(DARKEST)

    def _begin(self, intensity: IntensityArray) -> None:
        from texvent.simulation.senpi.pixels import SenpiPixels  # brings Numba

        self._pixels = SenpiPixels(self.config, np.maximum(intensity, DARKEST))

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        return self._pixels.advance(np.maximum(intensity, DARKEST), interval)
