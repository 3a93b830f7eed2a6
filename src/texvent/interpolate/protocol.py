"""Protocol of interpolators."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from texvent.frames import Frame


class Interpolator(Protocol):
    """Makes the frames between two source frames.

    A class whose weights are a file of the user's may offer `provenance(config)`: facts about that
    file, to be stored with the events. One may also declare `bytes_per_pixel`, what it takes per
    pair of frames; see `run.prepare`.
    """

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterable[Frame]:
        """Intermediate luma frames at `times_us`, all strictly inside (first, second).

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs, strictly increasing.

        Returns:
            One frame per time, to be read once: [H, W] float32 on the 0..255 scale, never rounded
            to whole levels, with `is_source` False.
        """
        ...
