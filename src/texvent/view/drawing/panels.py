"""Layout of frame, events, caption, legend, boxes and arrows in one image."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from texvent.frames import FrameStream
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import (
    Image,
    blank,
    draw_arrow,
    draw_box,
    draw_frame,
    draw_label,
    draw_text,
    enlarge,
    fit_text,
    text_width,
)
from texvent.view.drawing.palettes import Colour, Palette

if TYPE_CHECKING:
    from texvent.ground_truth import Box, GroundTruth


def title_of(metadata: Mapping[str, Any]) -> str:
    """Title of a recording: its prompt, else the name of its source, else nothing."""
    for key in ("prompt", "title", "source", "input"):
        value = metadata.get(key)
        if isinstance(value, Mapping):
            # A run stores what it knows of a video; its file or folder is called "source" again.
            value = Path(str(value.get("source") or "")).name
        if isinstance(value, str) and value.strip():
            return " ".join(value.split())
    return ""


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
    """Boxes and arrows over an image, in pixels of the sensor."""

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
        height = max(6, min(10, image.shape[1] // 64))
        for box in self.boxes:
            corner = box.x0 * factor, box.y0 * factor
            draw_label(image, box.class_name, corner, BOX_COLOUR, height=height)


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


LEAST_CONTRAST = 16
"""Least difference of a legend's colours from their ground, levels."""
TARGET_WIDTH = 1280.0
MAX_FACTOR = 10
GAP = 2
SURROUND: Colour = (24, 26, 31)
CAPTION_INK: Colour = (236, 238, 242)
FAINT_INK: Colour = (160, 166, 176)


@dataclass(frozen=True)
class PanelLayout:
    """Places of the panels, for one sensor size; width and height are even, as H.264 needs."""

    size: SensorSize
    palette: Palette
    side_by_side: bool = True
    target_width: float = TARGET_WIDTH
    """Small sensors are enlarged by a whole factor until the image is about this wide, pixels."""

    @property
    def factor(self) -> int:
        """Whole-number enlargement of the panels."""
        across = self.size.width * (2 if self.side_by_side else 1)
        down = self.size.height
        # A tall sensor is limited by its height, so that the image fits a screen.
        wanted = min(self.target_width / across, 0.75 * self.target_width / down)
        return max(1, min(MAX_FACTOR, round(wanted)))

    @property
    def text_height(self) -> int:
        """Height of capitals in the caption, pixels."""
        return max(7, min(13, self.panels_width // 64))

    @property
    def caption_height(self) -> int:
        """Height of the caption, pixels; it makes the whole height even."""
        height = 3 * self.text_height
        return height + (height + self.size.height * self.factor) % 2

    @property
    def panels_width(self) -> int:
        """Width of the panels together, pixels."""
        panel = self.size.width * self.factor
        return 2 * panel + GAP if self.side_by_side else panel

    @property
    def width(self) -> int:
        """Width of the whole image, pixels, even."""
        return self.panels_width + self.panels_width % 2

    @property
    def height(self) -> int:
        """Height of the whole image, pixels, even."""
        return self.size.height * self.factor + self.caption_height

    def compose(
        self,
        frame: Image | None,
        events: Image,
        *,
        title: str,
        facts: str,
        annotations: Annotations | None = None,
    ) -> Image:
        """The whole image.

        Args:
            frame: RGB image of the sensor's size, [H, W, 3], or None if there is none.
            events: RGB image of the events, [H, W, 3].
            title: title; cut if it is too long.
            facts: time and counts, at the right of the caption.
            annotations: drawn over both panels.

        Returns:
            [height, width, 3] uint8.
        """
        image = blank(self.width, self.height, SURROUND)
        top, panel = self.caption_height, self.size.width * self.factor
        bottom = top + self.size.height * self.factor
        if self.side_by_side:
            if frame is not None:
                image[top:bottom, :panel] = self._panel(frame, annotations, "smooth")
            left = panel + GAP
        else:
            left = 0
        image[top:bottom, left : left + panel] = self._panel(events, annotations, "blocks")
        self._caption(image, title, facts)
        return image

    def _panel(
        self, image: Image, annotations: Annotations | None, how: Literal["smooth", "blocks"]
    ) -> Image:
        large = enlarge(image, self.factor, how=how)
        if annotations is None:
            return large
        # A factor of 1 returns the caller's own array, which must not be drawn on.
        large = large.copy()
        annotations.draw(large, self.factor)
        return large

    def _caption(self, image: Image, title: str, facts: str) -> None:
        """Title left, facts and legend right; what does not fit is left out, title first."""
        height = self.text_height
        baseline = (self.caption_height + height) // 2
        margin = height
        legend = draw_legend(self.palette, height)
        right = self.width - legend.shape[1]
        if right >= 0:
            image[: legend.shape[0], right : right + legend.shape[1]] = legend
        else:
            right = self.width
        facts_width = text_width(facts, height)
        if right - facts_width - margin >= 0:
            right -= facts_width + margin
            draw_text(image, facts, right, baseline, height=height, colour=FAINT_INK)
        room = right - 3 * margin
        shown = fit_text(title, height, room) if room > 4 * margin else ""
        if shown:
            draw_text(image, shown, margin, baseline, height=height, colour=CAPTION_INK)


def draw_legend(palette: Palette, text_height: int) -> Image:
    """Legend of ON, OFF and their mixture, a strip with the palette's background.

    A mixture that looks like the background is left out.

    Args:
        palette: the colours.
        text_height: height of capitals, pixels.

    Returns:
        [3 text_height, about 20 text_height, 3] uint8.
    """
    height = 3 * text_height
    square = text_height + 2
    entries = [("ON", palette.on), ("OFF", palette.off), ("both", palette.both)]
    grounds = zip(palette.both, palette.background, strict=True)
    if max(abs(one - other) for one, other in grounds) < LEAST_CONTRAST:
        entries.pop()
    words = [text_width(word, text_height) for word, _ in entries]
    gap = max(3, text_height // 2)
    strip_width = sum(words) + len(words) * (square + gap + text_height) + 2 * text_height
    strip = blank(strip_width, height, SURROUND)
    pad = max(2, text_height // 2)
    draw_box(strip, pad, pad, strip_width - 2 * pad, height - 2 * pad, palette.background)
    x = pad + text_height
    for (word, colour), word_width in zip(entries, words, strict=True):
        draw_box(strip, x, (height - square) // 2, square, square, colour)
        x += square + gap
        baseline = (height + text_height) // 2
        draw_text(strip, word, x, baseline, height=text_height, colour=palette.ink)
        x += word_width + text_height
    return np.ascontiguousarray(strip)
