"""No intermediate frames: events are simulated from the source frames alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from texvent.config import InterpolateConfig
from texvent.video import Frame, FrameStream


class NoInterpolator:
    """Adds nothing (ablation of Eq. 4). `densify` asks it for no frame, whatever the change."""

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        del config, stream  # every interpolator is built alike; this one needs neither

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Nothing, whatever the times."""
        del first, second, times_us
        return iter(())
