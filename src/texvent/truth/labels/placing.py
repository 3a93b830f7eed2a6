"""Labels of a video placed on its events: at the times of frames, in pixels of the sensor."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from texvent.capture.fit_to_sensor import fit_place
from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD
from texvent.truth.labels.labels import Labels
from texvent.video import MICROSECONDS, frame_time_us

SIDES = ("x", "y", "w", "h")


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedLabels:
    """Labels of a clip, and what places them."""

    labels: Labels
    picture: SensorSize
    """Size of the video's frames before they are fitted to the sensor."""
    fit: str
    """As `texvent.capture.fit_to_sensor.fit_pixels` fits them."""
    rate_hz: Fraction | None = None
    """Boxes per second, interpolated along tracks from one labelled frame to the next; None: those
    of the labelled frames."""
    is_whole: bool = True
    """Whether the clip has all frames of the video, not only the first."""

    def boxes(
        self, times_us: NDArray[np.int64], size: SensorSize, classes: Mapping[str, int]
    ) -> tuple[NDArray[np.void], NDArray[np.int64]]:
        """Boxes on the clock and in the pixels of the events.

        Args:
            times_us: of the frames of the clip, µs.
            size: of the sensor, pixels.
            classes: name of a label → class id; labels of other names are left out.

        Returns:
            [k] records of `BOX_RECORD`, those that the sensor sees; and the times at which they are
            known, µs.

        Raises:
            InputError: labels of more frames than there are, of pictures of another size, or
                outside of them.
        """
        labels, frames = self.labels, self.labels.frames
        boxes = labels.inside(self.picture)
        if self.is_whole and int(frames[-1]) >= len(times_us):
            raise InputError(
                f"{labels.path} labels frame {frames[-1]} (from 0), and the video has "
                f"{len(times_us)} frames; give the video that was labelled"
            )
        numbers = np.array([classes.get(name, -1) for name in labels.names])
        is_wanted = numbers[boxes["class_id"]] >= 0
        boxes = boxes[is_wanted & (boxes["frame"] < len(times_us))]
        boxes["class_id"] = numbers[boxes["class_id"]]
        frames = frames[frames < len(times_us)]
        timed = np.empty(len(boxes), BOX_RECORD)
        for name in BOX_RECORD.names or ():
            timed[name] = times_us[boxes["frame"]] if name == "t" else boxes[name]
        known = times_us[frames]
        if self.rate_hz is not None:
            known, timed = _at_rate(timed, known, int(times_us[0]), self.rate_hz)
        return self._fitted(timed, size), known

    def _fitted(self, boxes: NDArray[np.void], size: SensorSize) -> NDArray[np.void]:
        """The boxes in pixels of the sensor; those that are cut away are left out."""
        scale, shift = fit_place(self.picture, size, self.fit)
        for axis, (start, side) in enumerate((("x", "w"), ("y", "h"))):
            begin = boxes[start] * scale[axis] + shift[axis]
            end = np.clip(begin + boxes[side] * scale[axis], 0, size[axis])
            boxes[start] = np.clip(begin, 0, size[axis])
            boxes[side] = end - boxes[start]
        return boxes[(boxes["w"] > 0) & (boxes["h"] > 0)]


def _at_rate(
    boxes: NDArray[np.void], known: NDArray[np.int64], start_us: int, rate_hz: Fraction
) -> tuple[NDArray[np.int64], NDArray[np.void]]:
    """Boxes at instants of a regular clock that begins at `start_us`, linear along tracks.

    A track is followed from one labelled frame to the next where both show it.

    Args:
        boxes: by time.
        known: times of labelled frames, µs.
        start_us: first tick of the clock, µs.
        rate_hz: ticks per second.
    """
    if not len(known):
        return known, boxes
    ends = (int(t_us) - start_us for t_us in (known[0], known[-1]))
    first, last = (int(one * rate_hz / MICROSECONDS) for one in ends)
    ticks = np.array([frame_time_us(k, rate_hz, start_us) for k in range(first, last + 2)])
    ticks = ticks[(ticks >= known[0]) & (ticks <= known[-1])]
    parts = [np.empty(0, BOX_RECORD)]
    for before, after in pairwise(known.tolist()):
        is_last = after == known[-1]
        inside = ticks[(ticks >= before) & ((ticks < after) | (is_last & (ticks == after)))]
        parts += _between(boxes[boxes["t"] == before], boxes[boxes["t"] == after], inside)
    if len(known) == 1:
        parts += [boxes[boxes["t"] == tick] for tick in ticks]
    return ticks, np.concatenate(parts)


def _between(
    before: NDArray[np.void], after: NDArray[np.void], ticks: NDArray[np.int64]
) -> Iterator[NDArray[np.void]]:
    """Boxes at instants between two labelled frames; what only one of them shows is at it alone."""
    _, old, new = np.intersect1d(before["track_id"], after["track_id"], return_indices=True)
    for tick in ticks.tolist():
        if len(before) and tick == before["t"][0]:
            yield before
        elif len(after) and tick == after["t"][0]:
            yield after
        elif len(old):
            moved = before[old].copy()
            begin, end = int(before["t"][0]), int(after["t"][0])
            share = (tick - begin) / (end - begin)
            for name in SIDES:
                moved[name] += (after[new][name] - moved[name]) * share
            moved["t"] = tick
            yield moved
