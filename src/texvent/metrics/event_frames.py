"""EF-MSE, EF-PSNR, EF-SSIM, EF-LPIPS: event frames at the frame rate, compared as images."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import install_command
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.metrics.image_measures import decibels, mean_squared_error, structural_similarity
from texvent.metrics.lpips import Lpips, find_lpips_weights, lpips_distance, read_lpips_weights
from texvent.metrics.protocol import UNDEFINED, Metric, count_windows, occupied_windows
from texvent.represent.event_frame import event_frame

Float64Array = NDArray[np.float64]
Similarity: TypeAlias = Callable[[Float64Array, Float64Array], float]


@dataclass(frozen=True, kw_only=True)
class EventFrameMetric(Metric):
    """A metric of event frames."""

    blind_to = "times inside a frame; how many events a pixel fired"

    fps: Fraction = Fraction(24)
    """Event frames per second."""

    def _mean(
        self,
        predicted: EventStream,
        reference: EventStream,
        similarity: Similarity,
        *,
        empty: float,
    ) -> float:
        """Mean of `similarity` over frames; a frame empty in both streams scores `empty`."""
        frames = count_windows(predicted, reference, self.fps)
        if not frames:
            return UNDEFINED
        values = [
            similarity(*(event_frame(events, "polarity").astype(np.float64) for events in window))
            for window in occupied_windows(predicted, reference, self.fps)
        ]
        return (sum(values) + empty * (frames - len(values))) / frames


class EventFrameMse(EventFrameMetric):
    """Mean squared difference of the frames `(sign(Σ±1) + 1)/2`, which hold 0, 0.5 or 1.

    Frames begin at multiples of 1/fps and run from the first event of both streams to the last.
    NaN if both streams are empty.
    """

    name = "ef_mse"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        return self._mean(predicted, reference, mean_squared_error, empty=0.0)


class EventFramePsnr(EventFrameMetric):
    """Peak signal-to-noise ratio `−10 log10(EF-MSE)`; infinite for equal frames."""

    name = "ef_psnr"
    unit = "dB"
    better = "higher"
    range = (0.0, float("inf"))

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        mse = EventFrameMse(fps=self.fps)(predicted, reference)
        return decibels(mse)


class EventFrameSsim(EventFrameMetric):
    """Structural similarity of the frames; NaN for sensors with a side below 11 px."""

    name = "ef_ssim"
    better = "higher"
    range = (-1.0, 1.0)

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        return self._mean(predicted, reference, structural_similarity, empty=1.0)


@dataclass(frozen=True, kw_only=True)
class EventFrameLpips(EventFrameMetric):
    """LPIPS of the frames, as grey images; NaN for sensors with a side below 31 px.

    Deviation: the network was trained on photographs; frames of three values are none, so the
        number compares simulators with each other, not with figures for photographs.
    """

    name = "ef_lpips"
    range = (0.0, float("inf"))

    weights: Path | None = None
    """File of LPIPS's weights; default: those that `texvent weights pull lpips` fetched."""

    def missing(self) -> str | None:
        """As `Metric.missing`."""
        try:
            self._weights_file()
        except InputError as error:
            return str(error)
        if find_spec("torch") is None:
            return f"torch is not installed; install it with: {install_command('texvent[torch]')}"
        return None

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        network = Lpips(read_lpips_weights(self._weights_file()))

        def distance(a: Float64Array, b: Float64Array) -> float:
            return lpips_distance(a, b, network)

        return self._mean(predicted, reference, distance, empty=0.0)

    def _weights_file(self) -> Path:
        return self.weights or find_lpips_weights()
