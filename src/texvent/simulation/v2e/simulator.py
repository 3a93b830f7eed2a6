"""v2e's pixel model: lin-log, photoreceptor bandwidth, mismatch, leak, shot noise, refractory.

Source: Y. Hu, S.-C. Liu, T. Delbruck, "v2e: from video frames to realistic DVS events", CVPRW
2021, and the options its program documents. docs/simulators/v2e.md gives the equations and where
this model departs from the program: event times above all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

from texvent.simulation.packets import FrameInterval, SortedEvents
from texvent.simulation.random.mismatch import smaller_threshold
from texvent.simulation.streaming import IntensityArray, StreamingSimulator
from texvent.simulation.v2e.config import LINEAR_BELOW, PRESETS, V2eConfig


class V2eSimulator(StreamingSimulator[V2eConfig]):
    """v2e on video frames; see `simulation.protocol.Simulator`.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> from texvent.pixel_models import V2eSimulator
        >>> simulator = V2eSimulator(V2eSimulator.presets["peer-common"])
        >>> len(simulator.step(Frame(np.array([[40]], np.uint8), t_us=0)))
        0
        >>> events = simulator.step(Frame(np.array([[60]], np.uint8), t_us=1000))
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))  # ln(60 / 40) = 0.4055
        [(493, 1), (986, 1)]
    """

    config_type: ClassVar[type] = V2eConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 190
    benefits_from_denser_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, V2eConfig]] = PRESETS
    frame_bound_presets: ClassVar[frozenset[str]] = frozenset({"noisy"})

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return smaller_threshold(self.config)

    @property
    def balance(self) -> float:
        """The α whose logarithm is as steep at black as the lin-log curve."""
        return LINEAR_BELOW / math.log(LINEAR_BELOW)

    def _begin(self, intensity: IntensityArray) -> None:
        from texvent.simulation.v2e.pixels import V2ePixels  # brings Numba

        self._pixels = V2ePixels(self.config, self._seed, intensity, self._last_us)

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        return self._pixels.advance(intensity, interval)
