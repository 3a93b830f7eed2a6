"""Events as images that a model of photographs can look at: drawn, or reconstructed."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.sensor import SensorSize
from texvent_lab.reconstruct.reconstructor import Reconstructor

Image: TypeAlias = NDArray[np.uint8]
"""[H, W, 3] RGB."""
View: TypeAlias = Callable[[EventStream], list[Image]]
"""A recording → images of it, at least one."""

PALETTE = "paper"
EVENTS_PER_PIXEL = 70_000 / (640 * 480)
"""Events in one drawn image; EventCLIP takes 70,000 of N-ImageNet's 640x480."""
SLICE_PER_PIXEL = 0.35
"""Most events that a network sees at once, as in E2VID's program."""
FEWEST_SLICES = 5
"""A recurrent network needs a few slices before its image is one."""


@dataclass(frozen=True)
class DrawnEvents:
    """Runs of events, spread over the recording, each drawn as an image: ON blue, OFF red on white.

    Source: EventCLIP (Wu 2023), which draws runs of a fixed number of events and averages what
    CLIP says of them. Deviations: colours by count up to a percentile; the runs are spread evenly.
    """

    images: int = 4
    """Most images of a recording."""
    events_per_image: int | None = None
    """Events of a run; None: 70,000 at 640x480, in proportion for other sensors."""

    def __call__(self, events: EventStream) -> list[Image]:
        """The images; one, and blank, where there are no events."""
        from texvent.view.drawing.event_image import draw_events  # brings OpenCV
        from texvent.view.drawing.palettes import get_palette

        palette = get_palette(PALETTE)
        return [draw_events(count_events(run), palette) for run in self.runs(events)]

    def runs(self, events: EventStream) -> list[EventStream]:
        """The events of each image."""
        length = self.events_per_image or max(1, round(EVENTS_PER_PIXEL * _pixels(events.size)))
        count = min(self.images, max(1, len(events) // length))
        starts = np.linspace(0, max(0, len(events) - length), count).astype(int)
        return [events[int(start) : int(start) + length] for start in starts]


@dataclass(frozen=True)
class ReconstructedImages:
    """Images that a published network makes of the events, from the second half of a recording."""

    reconstructor: Reconstructor
    images: int = 4
    """Most images of a recording."""

    def __call__(self, events: EventStream) -> list[Image]:
        """The images.

        Raises:
            InputError, FileFormatError: as `Reconstructor.reconstruct`.
        """
        slices = event_slices(events)
        made = [image for _, image in self.reconstructor.reconstruct_all(enumerate(slices))]
        late = made[len(made) // 2 :]
        chosen = np.unique(np.linspace(0, len(late) - 1, self.images).round().astype(int))
        return [_as_rgb(late[int(place)]) for place in chosen]


def event_slices(events: EventStream) -> list[EventStream]:
    """A recording in slices of as many events, which follow one another."""
    most = SLICE_PER_PIXEL * _pixels(events.size)
    count = max(FEWEST_SLICES, math.ceil(len(events) / most))
    bounds = np.linspace(0, len(events), count + 1).astype(int)
    return [events[int(begin) : int(end)] for begin, end in itertools.pairwise(bounds)]


def _pixels(size: SensorSize) -> int:
    return size.width * size.height


def _as_rgb(image: NDArray[np.float32]) -> Image:
    levels = np.rint(np.clip(image, 0, 1) * 255).astype(np.uint8)
    return np.repeat(levels[:, :, None], 3, axis=2)
