"""The `physical` pixel model: a DVS pixel from linear light to the readout.

Per frame interval, for every pixel:

1. intensity I = 255 · (luma / 255)^gamma, brightness L = ln(α + I), a straight line between
   frames;
2. the photoreceptor follows L as a first-order low-pass whose cutoff grows with I;
3. the change since the last reset, leak included, fires where and when it crosses a threshold of
   the pixel; every event resets the pixel;
4. noise events come at a rate that depends on intensity, and reset the pixel too;
5. with `scan_period_ns`, events wait for a scan of the columns.

Rates are per second and the low-pass is integrated exactly, so neither the frame rate nor the
number of intermediate frames changes what is simulated.
docs/simulators/physical.md gives the equations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import ClassVar

from texvent.networks import describe_file
from texvent.simulation.packets import FrameInterval, SortedEvents, UnsortedEvents
from texvent.simulation.physical.cameras import CAMERAS, PRESETS
from texvent.simulation.physical.circuit import WHITE
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.threshold_map import read_threshold_map
from texvent.simulation.streaming import IntensityArray, StreamingSimulator


class PhysicalSimulator(StreamingSimulator[PhysicalConfig]):
    """A DVS pixel on video frames; see `simulation.protocol.Simulator`.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> from texvent.pixel_models import PhysicalSimulator
        >>> simulator = PhysicalSimulator(PhysicalSimulator.presets["clean"])
        >>> dark, bright = np.array([[100]], np.uint8), np.array([[160]], np.uint8)
        >>> len(simulator.step(Frame(dark, t_us=0)))  # nothing to compare with yet
        0
        >>> events = simulator.step(Frame(bright, t_us=1000))  # I: 32.5 → 91.5, L rises by 0.870
        >>> events.t.tolist(), events.polarity.tolist()
        ([229, 459, 689, 919], [1, 1, 1, 1])
    """

    config_type: ClassVar[type] = PhysicalConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 206
    benefits_from_denser_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, PhysicalConfig]] = PRESETS
    known_constants: ClassVar[Mapping[str, tuple[str, ...]]] = {
        name: tuple(one.option for one in camera.constants) for name, camera in CAMERAS.items()
    }
    """Preset of a camera → its options that have a source."""

    @staticmethod
    def provenance(config: PhysicalConfig) -> dict[str, str]:
        """Name and sha256 of the threshold map, if there is one; stored with the events.

        Raises:
            InputError: there is no such file.
            FileFormatError: it is no threshold map.
        """
        if config.threshold_map is None:
            return {}
        read_threshold_map(config.threshold_map)
        return describe_file(config.threshold_map)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold divided by gamma: what Eq. 4 should count with, log units.

        Eq. 4 looks at gamma-coded frames, where the logarithm is smaller by that factor.
        """
        config = self.config
        return min(config.contrast_threshold_on, config.contrast_threshold_off) / config.gamma

    @property
    def balance(self) -> float:
        """The gamma-coded level of the balance: with it, Eq. 4 sees about the model's changes."""
        return WHITE * math.pow(self.config.balance / WHITE, 1.0 / self.config.gamma)

    def _begin(self, intensity: IntensityArray) -> None:
        from texvent.simulation.physical.pixels import PhysicalPixels  # brings Numba

        self._pixels = PhysicalPixels(self.config, self._seed, intensity, self._last_us)

    def _advance(
        self, intensity: IntensityArray, interval: FrameInterval
    ) -> UnsortedEvents | SortedEvents:
        return self._pixels.advance(intensity, interval)
