"""Do motion vectors fit the frames? Frames warped by them are compared with the real ones.

Every frame near the start is compared with its neighbour, once along the vectors as the given
convention means them, and once for every other way in which they could be meant. Vectors are never
corrected: where another meaning fits clearly better, the run is refused and the message says which.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.capture.motion_vectors.conventions import (
    UNITS,
    Convention,
    Direction,
    changes,
    scaled,
)

FloatArray = NDArray[np.float32]

MOST_SAMPLES = 20_000
"""Pixels of a frame that are compared, on a grid."""
FEWEST_SAMPLES = 50
"""Moving pixels that a decision needs."""
MOVING_PX = 0.5
"""Shorter vectors say nothing."""
KEPT = 0.8
"""Share of the pixels that counts, those with the smallest error: others may be hidden."""
CLEARLY_BETTER, LEAST_GAIN = 0.6, 1.0
"""Another meaning fits clearly better with an error below this share, and so many levels less."""
AS_GOOD = 1.1
"""Factor of the smallest error up to which the most likely meaning is named."""
HIGH, LITTLE_BETTER = 4.0, 0.8
"""Grey levels, and share of the error without vectors, from which on a warning is due."""


@dataclass(frozen=True, eq=False)
class Neighbours:
    """A frame, what is stored for it, and the frames around it."""

    luma: Mapping[str, FloatArray]
    """"here", and "forward" and "backward" where there is such a frame: [H, W], 0..255."""
    stored: Mapping[Direction, NDArray[np.generic]]
    """The field that belongs to this frame if it is meant in that direction."""


@dataclass(frozen=True)
class Verdict:
    """Misfit of vectors, in mean grey levels (0..255) over the pixels that move."""

    error: float
    """Misfit of the frames along the vectors."""
    still_error: float
    """Misfit of the frames as they are, without any vectors."""
    better: Convention | None = None
    """The meaning that fits clearly better, if there is one."""
    better_error: float = 0.0

    @property
    def is_high(self) -> bool:
        """Whether the vectors explain little of what changes between the frames."""
        return self.error > max(HIGH, LITTLE_BETTER * self.still_error)


def judge(
    frames: Sequence[Neighbours], convention: Convention, direction: Direction
) -> Verdict | None:
    """Fit of vectors to frames, and another meaning that would fit clearly better.

    Returns:
        The verdict; None where too little moves to tell.
    """
    given = replace(convention, direction=direction)
    samples = [_Samples.of(frame) for frame in frames]
    samples = [one for one in samples if one.knows(direction)]
    if not samples:
        return None
    said = [_follow(one, given) for one in samples]
    at_rest = [one.difference(direction, None) for one in samples]
    candidates = []
    for other in _alternatives(given):
        errors = [
            _errors(one, other, followed, still)
            for one, followed, still in zip(samples, said, at_rest, strict=True)
        ]
        own, theirs, still = (np.concatenate(part) for part in zip(*errors, strict=True))
        if own.size >= FEWEST_SAMPLES:
            candidates.append((other, _mean(own), _mean(theirs), _mean(still)))
    as_given = next((one for one in candidates if one[0] == given), None)
    if as_given is None and not candidates:
        return None
    _, given_error, _, still_error = as_given or candidates[0]
    best = _best(
        [
            (other, theirs)
            for other, own, theirs, still in candidates
            if theirs < CLEARLY_BETTER * own
            and own - theirs >= LEAST_GAIN
            and theirs < LITTLE_BETTER * still  # not only because it hardly moves anything
        ],
        given,
        direction,
    )
    return Verdict(given_error, still_error, *(best or (None, 0.0)))


def _best(
    candidates: list[tuple[Convention, float]], given: Convention, direction: Direction
) -> tuple[Convention, float] | None:
    """Candidate with the fewest changes, of those that fit about as well as the best."""
    if not candidates:
        return None
    limit = AS_GOOD * min(error for _, error in candidates) + 0.05
    close = [one for one in candidates if one[1] <= limit]
    return min(close, key=lambda one: (len(changes(given, one[0], direction)), one[1]))


def _alternatives(given: Convention) -> Iterator[Convention]:
    """The given meaning and others: direction, sign, y, unit or scale differ."""
    directions: tuple[Direction, ...] = ("forward", "backward")
    for direction, sign, is_y_up in itertools.product(directions, (1, -1), (False, True)):
        turned = replace(
            given,
            direction=direction,
            forward_sign=sign,
            backward_sign=sign,
            is_y_up=is_y_up,
        )
        if direction == given.direction and sign == given.sign(direction):
            turned = replace(
                turned, forward_sign=given.forward_sign, backward_sign=given.backward_sign
            )
        for unit in UNITS:
            yield replace(turned, unit=unit)
        for factor in (0.5, 2.0):
            yield replace(turned, scale=given.scale * factor)


@dataclass(frozen=True, eq=False)
class _Samples:
    """A frame on a grid of pixels."""

    frame: Neighbours
    rows: NDArray[np.intp]
    columns: NDArray[np.intp]

    @classmethod
    def of(cls, frame: Neighbours) -> _Samples:
        height, width = frame.luma["here"].shape
        stride = max(1, int(np.ceil(np.sqrt(height * width / MOST_SAMPLES))))
        rows, columns = np.mgrid[:height:stride, :width:stride].reshape(2, -1)
        return cls(frame, rows, columns)

    def knows(self, direction: Direction) -> bool:
        return direction in self.frame.luma and direction in self.frame.stored

    def along(self, convention: Convention) -> FloatArray:
        """The displacement of each sample, [n, 2], px."""
        direction = convention.direction
        stored = self.frame.stored[direction]
        height, width = self.frame.luma["here"].shape
        factor = width // stored.shape[1]
        here = stored[self.rows // factor, self.columns // factor]
        return scaled(here, convention, direction, (width, height), factor)

    def difference(self, direction: str, along: FloatArray | None) -> FloatArray:
        """Difference of the neighbour from this frame there, [n], grey levels.

        Places between pixels are interpolated, places outside take the nearest edge.
        """
        here, other = self.frame.luma["here"], self.frame.luma[direction]
        if along is None:
            seen = other[self.rows, self.columns]
        else:
            last_row, last_column = other.shape[0] - 1, other.shape[1] - 1
            x = np.clip(self.columns + along[:, 0], 0, last_column).astype(np.float32)[:, None]
            y = np.clip(self.rows + along[:, 1], 0, last_row).astype(np.float32)[:, None]
            warped = cv2.remap(other, x, y, cv2.INTER_LINEAR)
            seen = np.asarray(warped, np.float32)[:, 0]
        return np.asarray(np.abs(here[self.rows, self.columns] - seen), np.float32)


_Followed = tuple[FloatArray, FloatArray]


def _follow(samples: _Samples, meaning: Convention) -> _Followed:
    """Places where a meaning takes the samples, [n, 2] px, and the difference there."""
    along = samples.along(meaning)
    return along, samples.difference(meaning.direction, np.nan_to_num(along))


def _errors(
    samples: _Samples, other: Convention, said: _Followed, still: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Differences along both meanings and without vectors, at the samples that move in either."""
    if not samples.knows(other.direction):
        return (np.empty(0, np.float32),) * 3
    (along, differs), (along_other, differs_other) = said, _follow(samples, other)
    is_moving = (np.abs(along).max(-1) > MOVING_PX) | (np.abs(along_other).max(-1) > MOVING_PX)
    is_moving &= np.isfinite(along).all(-1) & np.isfinite(along_other).all(-1)
    return differs[is_moving], differs_other[is_moving], still[is_moving]


def _mean(errors: FloatArray) -> float:
    """Mean of the `KEPT` smallest errors."""
    kept = max(1, round(KEPT * errors.size))
    return float(np.partition(errors, kept - 1)[:kept].mean())
