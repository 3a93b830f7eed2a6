"""Boxes and optical flow drawn over an image."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.video import FrameStream
from texvent.view.drawing.canvas import Image, draw_arrow, draw_frame, draw_label
from texvent.view.drawing.palettes import Colour

if TYPE_CHECKING:
    from texvent.scenes.raycast.ground_truth import Box, GroundTruth

Overlay = Literal["none", "boxes", "flow", "both"]
ARROWS_ACROSS = 24
"""Arrows per image width."""
ARROW_US = 50_000
"""An arrow is as long as the motion in this time."""
SHORTEST_ARROW = 0.75
"""Pixels of the sensor; shorter ones are left out."""
BOX_COLOUR: Colour = (255, 176, 0)
FLOW_COLOUR: Colour = (0, 170, 90)


@runtime_checkable
class GroundTruthStream(FrameStream, Protocol):
    """Frames whose ground truth is known, such as the embedded generator's."""

    def ground_truth(self, t0_us: int, t1_us: int) -> GroundTruth:
        """Ground truth at `t0_us`, and the motion from there to `t1_us`."""
        ...


@dataclass(frozen=True, eq=False)
class Annotations:
    """What is drawn over an image, in pixels of the sensor."""

    boxes: tuple[Box, ...] = ()
    arrows: NDArray[np.float32] | None = None
    """[n, 4]: x, y of the tail, and the motion in `ARROW_US`."""

    def draw(self, image: Image, factor: int) -> None:
        """Draw into an image that is `factor` times as large as the sensor."""
        for x, y, dx, dy in [] if self.arrows is None else self.arrows * factor:
            draw_arrow(image, (x, y), (x + dx, y + dy), FLOW_COLOUR)
        for box in self.boxes:
            corners = (box.x0 * factor, box.y0 * factor, box.x1 * factor - 1, box.y1 * factor - 1)
            draw_frame(image, corners, BOX_COLOUR)
        # Labels last, so that no box is drawn over them.
        for box in self.boxes:
            draw_label(image, box.class_name, (box.x0 * factor, box.y0 * factor), BOX_COLOUR)


def annotations_at(video: GroundTruthStream, t_us: int, overlay: Overlay) -> Annotations:
    """Boxes and arrows at an instant.

    Args:
        video: frames with ground truth.
        t_us: the instant, µs.
        overlay: which of them.
    """
    truth = video.ground_truth(t_us, t_us + ARROW_US)
    return Annotations(
        boxes=truth.boxes if overlay in ("boxes", "both") else (),
        arrows=flow_arrows(truth.flow) if overlay in ("flow", "both") else None,
    )


def flow_arrows(flow: NDArray[np.float32]) -> NDArray[np.float32]:
    """Flow on a regular grid, where it is known and long enough to see."""
    height, width = flow.shape[:2]
    step = max(4, width // ARROWS_ACROSS)
    y, x = np.mgrid[step // 2 : height : step, step // 2 : width : step]
    motion = flow[y, x].reshape(-1, 2)
    tails = np.stack([x.ravel(), y.ravel()], axis=1) + np.float32(0.5)
    seen = np.nan_to_num(np.hypot(motion[:, 0], motion[:, 1])) >= SHORTEST_ARROW
    return np.concatenate([tails[seen], motion[seen]], axis=1).astype(np.float32)
