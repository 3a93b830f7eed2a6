"""ESIM's pixel model: log intensity runs in straight lines, every threshold crossing is an event.

Source: H. Rebecq, D. Gehrig, D. Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
and D. Gehrig et al., "Video to events: recycling video datasets for event cameras", CVPR 2020,
which runs it on video frames. docs/simulators.md gives the equations and the deviations.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from texvent.config import check_range
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.simulation.packets import FrameInterval, SortedEvents
from texvent.simulation.random.mismatch import (
    Float64Array,
    check_nominal_thresholds,
    smaller_threshold,
)
from texvent.simulation.streaming import IntensityArray, StreamingSimulator

WHITE = 255.0


@dataclass(frozen=True, kw_only=True)
class EsimConfig:
    """Options of the ESIM pixel model; the defaults are those of VID2E.

    Raises:
        ConfigError: an option is out of range.

    Example:
        >>> from texvent.pixel_models import EsimConfig
        >>> config = EsimConfig(contrast_threshold_on=0.3)
        >>> config.contrast_threshold, config.balance
        (0.2, 0.255)
    """

    contrast_threshold_on: float = 0.2
    """Rise of ln(I/255 + log eps) that fires an ON event."""
    contrast_threshold_off: float = 0.2
    """Fall of ln(I/255 + log eps) that fires an OFF event."""
    threshold_sigma: float = 0.0
    """Standard deviation of both thresholds, log units; they are drawn again for every pixel and
    frame, as ESIM describes it, and are at least 0.01."""
    log_eps: float = 1e-3
    """Added to intensities on the 0..1 scale before the logarithm, above 0."""
    refractory_period_us: int = 0
    """Time after an event in which the pixel cannot fire; crossings in it are lost."""

    def __post_init__(self) -> None:
        check_nominal_thresholds(self)
        check_range("log_eps", self.log_eps, 1e-9, 1.0)
        check_range("refractory_period_us", self.refractory_period_us, 0, 10**9)

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units: δ that Eq. 4 should count with."""
        return smaller_threshold(self)

    @property
    def balance(self) -> float:
        """`255 · log_eps`, the α with which Eq. 4's logarithm is the model's own."""
        return WHITE * self.log_eps


class EsimSimulator(StreamingSimulator[EsimConfig]):
    """ESIM on video frames; see `simulation.protocol.Simulator`.

    A pair whose intermediate frames would be moved by optical flow is computed without drawing
    them where few pixels may fire; the events are the same.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> from texvent.pixel_models import EsimConfig, EsimSimulator
        >>> simulator = EsimSimulator(EsimConfig(contrast_threshold_on=0.5))
        >>> dark, bright = np.array([[50]], np.uint8), np.array([[200]], np.uint8)
        >>> len(simulator.step(Frame(dark, t_us=0)))  # nothing to compare with yet
        0
        >>> events = simulator.step(Frame(bright, t_us=1000))  # ln(200.255 / 50.255) = 1.3825
        >>> list(zip(events.t.tolist(), events.polarity.tolist()))
        [(361, 1), (723, 1)]
    """

    config_type: ClassVar[type] = EsimConfig
    takes_linear: ClassVar[bool] = True
    bytes_per_pixel: ClassVar[int] = 90
    benefits_from_denser_frames: ClassVar[bool] = True
    presets: ClassVar[Mapping[str, EsimConfig]] = {
        "default": EsimConfig(),
        "peer-common": EsimConfig(),
    }

    @property
    def contrast_threshold(self) -> float:
        """The smaller threshold, log units."""
        return self.config.contrast_threshold

    @property
    def balance(self) -> float:
        """`255 · log_eps`: with it, Eq. 4's logarithm is the model's own."""
        return self.config.balance

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Events between two frames; see `simulation.protocol.Simulator.advance`."""
        is_drawn = pair.first is None or self.config.threshold_sigma > 0
        if is_drawn or pair.motion.flows is None:
            yield from super().advance(pair)
            return
        segments = self._pixels.fuse(pair)
        self._enter(pair.second)
        for frame, fired in zip(pair.undrawn_frames, segments, strict=True):
            x, y, t, p, label = fired
            yield frame, EventStream.unchecked(x, y, t, p, size=pair.second.size, label=label)

    def _begin(self, intensity: IntensityArray) -> None:
        from texvent.simulation.esim.pixels import EsimPixels  # brings Numba

        self._pixels = EsimPixels(self.config, intensity)

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> SortedEvents:
        return self._pixels.advance(intensity, interval)


def log_intensity(intensity: IntensityArray, log_eps: float) -> Float64Array:
    """Log intensity `ln(I / 255 + ε)` that ESIM compares.

    Args:
        intensity: 0..255 scale, any shape, uint8 or float.
        log_eps: ε, above 0.

    Returns:
        Of the same shape, float64.
    """
    if intensity.dtype == np.uint8:
        table = np.log(np.arange(256) / WHITE + log_eps)
        return np.asarray(table.take(intensity))
    return np.asarray(np.log(intensity / np.float64(WHITE) + log_eps))
