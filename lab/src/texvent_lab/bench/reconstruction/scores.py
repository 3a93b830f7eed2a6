"""Scores and pictures of reconstructed images, also with noise added to the events."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent.metrics.image_measures import Measures
from texvent.video import Frame
from texvent.view.drawing.canvas import Image, blank, draw_text, png_bytes
from texvent_lab.bench.real.recording import FrameRecording
from texvent_lab.reconstruct.reconstructor import Intensity

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
        """What was collected.

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


TITLE_PX, MARGIN_PX = 11, 6
PAPER, INK = (236, 238, 242), (38, 42, 50)
TRUE = "frames"


class ReconstructionGrid:
    """Collects images while they are made: a row per source of events, a column per instant.

    Call it with (recording, source, time in µs, image), as `ReconstructionScorer.on_image` is.
    """

    def __init__(self, recording: FrameRecording, times_us: Sequence[int]) -> None:
        """An empty grid with the true frames in its first row.

        Args:
            recording: whose images are kept.
            times_us: instants to show, µs; each shows the first frame at or after it.
        """
        self._name = recording.name
        frames = {}
        wanted = sorted(times_us)
        for frame in recording.frames:
            if wanted and frame.t_us >= wanted[0]:
                frames[frame.t_us] = true_image(frame)
                wanted = [t_us for t_us in wanted if t_us > frame.t_us]
        self._rows: dict[str, dict[int, Intensity]] = {TRUE: frames}

    def __call__(self, recording: str, source: str, t_us: int, image: Intensity) -> None:
        """Keep the image if it belongs to the grid."""
        if recording == self._name and t_us in self._rows[TRUE]:
            self._rows.setdefault(source, {})[t_us] = image

    def png(self) -> bytes:
        """The grid as a PNG file."""
        times = list(self._rows[TRUE])
        height, width = self._rows[TRUE][times[0]].shape
        step_y, step_x = height + TITLE_PX + 2 * MARGIN_PX, width + MARGIN_PX
        whole = blank(len(times) * step_x + MARGIN_PX, len(self._rows) * step_y + MARGIN_PX, PAPER)
        for row, (source, images) in enumerate(self._rows.items()):
            top = row * step_y + MARGIN_PX
            draw_text(whole, source, MARGIN_PX, top + TITLE_PX, height=TITLE_PX - 1, colour=INK)
            top += TITLE_PX + MARGIN_PX
            for column, t_us in enumerate(times):
                left = column * step_x + MARGIN_PX
                if t_us in images:
                    whole[top : top + height, left : left + width] = _grey(images[t_us])
        return png_bytes(whole, level=9)


def _grey(image: Intensity) -> Image:
    levels = np.rint(np.clip(image, 0.0, 1.0) * 255.0).astype(np.uint8)
    return np.repeat(levels[..., None], 3, axis=2)
