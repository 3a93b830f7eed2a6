"""Scores of reconstructed images against frames."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.frames import Frame
from texvent_lab.reconstruct.image_measures import Measures

GreyImage: TypeAlias = NDArray[np.floating]
"""[H, W], 0..1."""

TOLERANCE_US = 1_000
"""An image and a frame further apart in time are not compared, µs; EVREAL has 1 ms."""
WHITE = 255.0


@dataclass(frozen=True, kw_only=True)
class ImageScores:
    """Values frame by frame."""

    t_us: Sequence[int]
    """Times of the frames, µs."""
    values: Mapping[str, Sequence[float]]
    """Measure → one value per frame; NaN where it is undefined."""

    def mean(self, measure: str) -> float:
        """Mean over the frames where it is defined; NaN if there are none."""
        defined = [one for one in self.values[measure] if not math.isnan(one)]
        return float(np.mean(defined)) if defined else math.nan


class ScoreCollector:
    """Collects the values of one source of images, frame by frame."""

    def __init__(
        self, measures: Measures, *, span_us: tuple[int, int] | None = None, skip: int = 0
    ) -> None:
        """A collector without values.

        Args:
            measures: what to compute.
            span_us: first and last time that counts, µs, both included; None counts all.
            skip: how many images at the start do not count.
        """
        self._measures = measures.chosen
        self._span_us = span_us
        self._skip = skip
        self._seen = 0
        self._times: list[int] = []
        self._values: dict[str, list[float]] = {one.name: [] for one in measures.chosen}

    def add(self, t_us: int, image: GreyImage, true: GreyImage) -> None:
        """Compare an image with the true one, both 0..1, if it counts.

        Raises:
            InputError: their sizes differ.
        """
        self._seen += 1
        is_outside = self._span_us is not None and not (
            self._span_us[0] <= t_us <= self._span_us[1]
        )
        if self._seen <= self._skip or is_outside:
            return
        if image.shape != true.shape:
            raise InputError(
                f"the image at {t_us} µs is {image.shape[1]}x{image.shape[0]}, the frame "
                f"{true.shape[1]}x{true.shape[0]}"
            )
        self._times.append(t_us)
        a, b = (np.clip(one.astype(np.float64), 0.0, 1.0) for one in (image, true))
        for measure in self._measures:
            self._values[measure.name].append(measure.compare(a, b))

    def scores(self) -> ImageScores:
        """The values collected so far.

        Raises:
            InputError: nothing counted.
        """
        if not self._times:
            raise InputError(
                "no reconstructed image counts: none has a frame within 1 ms in the part that is "
                "scored; choose another part, or check that frames and events share a clock"
            )
        return ImageScores(t_us=self._times, values=self._values)


def score_images(
    images: Iterable[tuple[int, GreyImage]], frames: Iterable[Frame], collector: ScoreCollector
) -> ImageScores:
    """Compare images with the frames of the same time.

    Args:
        images: (time in µs, image) in time order.
        frames: the true frames in time order.
        collector: an empty one, which says what counts.

    Raises:
        InputError: the sizes differ, or no image counts that has a frame.
    """
    for t_us, image, true in _pair(images, frames):
        collector.add(t_us, image, true)
    return collector.scores()


def true_image(frame: Frame) -> GreyImage:
    """A frame as images are compared: luma, 0..1, [H, W] float64."""
    return frame.luma.astype(np.float64) / WHITE


def pool_scores(parts: Iterable[ImageScores]) -> ImageScores:
    """The frames of several recordings together, so that each frame counts the same."""
    scores = list(parts)
    return ImageScores(
        t_us=[t_us for one in scores for t_us in one.t_us],
        values={
            name: [value for one in scores for value in one.values[name]]
            for name in scores[0].values
        },
    )


def _pair(
    images: Iterable[tuple[int, GreyImage]], frames: Iterable[Frame]
) -> Iterator[tuple[int, GreyImage, GreyImage]]:
    """Each image that has a frame within the tolerance, with that frame."""
    later = iter(frames)
    frame = next(later, None)
    for t_us, image in images:
        while frame is not None and frame.t_us < t_us - TOLERANCE_US:
            frame = next(later, None)
        if frame is None:
            return
        if frame.t_us <= t_us + TOLERANCE_US:
            yield t_us, image, true_image(frame)
