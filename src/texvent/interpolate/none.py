"""No intermediate frames: events are simulated from the source frames alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import ClassVar

from texvent.config import InterpolateConfig
from texvent.video import Frame, FrameStream


class NoInterpolator:
    """Adds no frames (ablation of Eq. 4)."""

    bytes_per_pixel: ClassVar[int] = 0

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # the arguments of every interpolator; not used here

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """No frames."""
        del first, second, times_us
        return iter(())
