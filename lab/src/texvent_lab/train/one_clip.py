"""One clip as the whole source of the training stream."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import MICROSECONDS
from texvent.training import Clip
from texvent.training import EventStream as TrainingStream
from texvent.training.draws import RANGES


@dataclass(frozen=True)
class OneClip:
    """A `ClipSource` of one clip."""

    clip: Clip
    known_truth: tuple[str, ...] = ()

    def __len__(self) -> int:
        return 1

    def name(self, index: int) -> str:
        """Name of the clip in messages."""
        return f"clip {index} of {self.clip.times_us[-1] / MICROSECONDS:g} s"

    def read(self, index: int, truth: Any, most_bytes: int) -> Clip:
        """The clip."""
        del index, truth, most_bytes
        return self.clip


def streamed_events(
    frames: NDArray[np.uint8],
    times_us: NDArray[np.int64],
    randomize: str,
    seed: int,
    **ranges: Any,
) -> EventStream:
    """Events of a whole clip with pixels as the stream draws them; nothing else is drawn.

    Args:
        frames: [N, H, W] luma, coded with gamma 2.2.
        times_us: of each, µs; events have the same clock.
        randomize: name of the stream's ranges, of `texvent.training.draws.RANGES`.
        seed: of the draws.
        **ranges: in place of some of those.
    """
    motionless: Any = {"speed": (1, 1), "pause": (0.0, 0.0), "flip": 0.0}
    still = dataclasses.replace(RANGES[randomize], **motionless, **ranges)
    height, width = frames.shape[1:]
    stream = TrainingStream(
        OneClip(Clip(frames, times_us)),
        batch=1,
        frames=1,
        frames_per_grid=len(frames) - 1,
        size=(width, height),
        outputs=("events",),
        randomize=still,
        seed=seed,
        rank=0,
        world=1,
    )
    found: Any = next(iter(stream)).events
    columns = (np.asarray(getattr(found, name)).astype(np.int64) for name in "xytp")
    x, y, t_us, p = columns
    return EventStream.from_columns(x, y, t_us + int(times_us[0]), p, size=found.sizes[0])
