"""ESIM's pixel model: log intensity runs in straight lines, every threshold crossing is an event.

Source: H. Rebecq, D. Gehrig, D. Scaramuzza, "ESIM: an open event camera simulator", CoRL 2018,
and D. Gehrig et al., "Video to events: recycling video datasets for event cameras", CVPR 2020,
which runs it on video frames. docs/simulators.md gives the equations and the deviations.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.packets import FrameInterval, SortedEvents
from texvent.simulation.streaming import IntensityArray, StreamingSimulator


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
