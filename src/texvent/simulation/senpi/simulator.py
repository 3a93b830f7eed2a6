"""SENPI's pixel model: photons to voltage, at most one event per pixel and frame.

Source: J. L. Greene et al., "A PyTorch-enabled tool for synthetic event camera data generation and
algorithm development", SPIE 2025, and the parameters that its program documents.
docs/simulators/senpi.md gives the equation and the deviations.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.senpi.config import PRESETS, SenpiConfig
from texvent.simulation.streaming import IntensityArray, StreamingSimulator

DARKEST = 1
"""Level of 0..255 up to which all pixels count as equally dark; the lowest voltage is its."""


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
