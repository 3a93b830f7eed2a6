"""A video that shows the truth: boxes and arrows, flow, depth, and events by object."""

from __future__ import annotations

from contextlib import ExitStack
from fractions import Fraction
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.truth.source import Snapshot
from texvent.video import PREVIEW_MARK, Frame
from texvent.view.atomic_output import AtomicOutput
from texvent.view.drawing.canvas import Image, blank, draw_label, enlarge, tile
from texvent.view.drawing.event_image import frame_image
from texvent.view.drawing.palettes import Colour
from texvent.view.drawing.panels import ARROW_US, Annotations, flow_arrows
from texvent.view.video.encoder import VideoEncoder

PANEL_WIDTH = 640
GAP = 2
SURROUND: Colour = (24, 26, 31)
UNKNOWN: Colour = (70, 72, 78)
LABEL: Colour = (236, 238, 242)
HUES = 180
"""OpenCV's hues."""
GOLDEN = 0.618034
"""Hues of consecutive ids differ by this share of the circle."""
FULL_SPEED_PERCENTILE = 99.0
"""Of the pixels that move, those faster than this share have full colour."""
SHADE = 0.3
"""Strength of an object's area behind its events."""


class OverlayVideo(AtomicOutput):
    """Writes the video frame by frame; each is shown until the next.

    Args:
        path: an .mp4 file.
        size: of the frames, pixels.
        fps: nominal rate of the frames, if it is known.
    """

    def __init__(self, path: Path, *, size: SensorSize, fps: Fraction | None) -> None:
        super().__init__()
        self._size = size
        self._factor = max(1, min(6, round(PANEL_WIDTH / size.width)))
        width, height = (2 * side * self._factor + GAP for side in size)
        rate = fps or Fraction(30)
        self._encoder = VideoEncoder(
            path, width=width, height=height, fps=rate, comment=PREVIEW_MARK, overwrite=True
        )
        self._first_us: int | None = None

    def _open(self, stack: ExitStack) -> None:
        stack.enter_context(self._encoder)

    def _complete(self) -> None:
        """The encoder is complete by itself."""

    def show(
        self, frame: Frame, truth: Snapshot, events: EventStream, ids: NDArray[np.int32] | None
    ) -> None:
        """Add a frame.

        Args:
            frame: the frame.
            truth: its ground truth.
            events: those before it, back to the frame before.
            ids: their instances.
        """
        self._first_us = frame.t_us if self._first_us is None else self._first_us
        image = compose(frame, truth, events, ids, self._factor)
        self._encoder.write(image, frame.t_us - self._first_us)


def compose(
    frame: Frame,
    truth: Snapshot,
    events: EventStream,
    ids: NDArray[np.int32] | None,
    factor: int,
) -> Image:
    """Four panels, `factor` times as large as the frame; arguments as `OverlayVideo.show`."""
    size = frame.size
    photo = enlarge(frame_image(frame), factor, how="smooth")
    Annotations(truth.boxes, _arrows(truth)).draw(photo, factor)
    flow = flow_image(truth.flow.vectors) if truth.flow is not None else blank(*size, UNKNOWN)
    depth = depth_image(truth.depth) if truth.depth is not None else blank(*size, UNKNOWN)
    maps = [flow, depth, events_image(truth.instance, events, ids)]
    panels = [photo, *(enlarge(one, factor, how="blocks") for one in maps)]
    names = ("frame, boxes, flow", "flow (colour: direction)", "depth (bright: near)", "events")
    for panel, name in zip(panels, names, strict=True):
        draw_label(panel, name, (0, 0), LABEL)
    return tile(panels, 2, SURROUND, gap=GAP)


def flow_image(flow: NDArray[np.float32]) -> Image:
    """Flow as colours: hue shows the direction, strength the speed; grey where it is not known."""
    is_known = np.isfinite(flow).all(axis=2)
    x, y = np.where(is_known, flow[..., 0], 0.0), np.where(is_known, flow[..., 1], 0.0)
    speed, angle = np.hypot(x, y), np.arctan2(y, x) / (2.0 * np.pi) % 1.0
    moving = speed[speed > 0.0]
    full = max(float(np.percentile(moving, FULL_SPEED_PERCENTILE)), 1.0) if moving.size else 1.0
    image = _coloured(angle, np.sqrt(np.minimum(speed / full, 1.0)))
    image[~is_known] = UNKNOWN
    return image


def depth_image(depth: NDArray[np.float32]) -> Image:
    """Depth as grey levels of its logarithm: white is the nearest, black the farthest and the sky.

    Args:
        depth: [H, W] m.
    """
    is_known = np.isfinite(depth) & (depth > 0.0)
    grey = np.zeros(depth.shape, dtype=np.uint8)
    if is_known.any():
        logarithm = np.log(depth[is_known])
        near, far = logarithm.min(), logarithm.max()
        share = (far - logarithm) / max(float(far - near), 1e-6)
        grey[is_known] = np.rint(20.0 + 235.0 * share)
    return np.repeat(grey[..., None], 3, axis=2)


def events_image(
    instance: NDArray[np.int32] | None, events: EventStream, ids: NDArray[np.int32] | None
) -> Image:
    """Events in the colours of their objects, over the areas of the objects; white without one."""
    image = blank(*events.size, SURROUND)
    if instance is not None:
        image = np.where(
            (instance > 0)[..., None], (SHADE * _id_colours(instance)).astype(np.uint8), image
        )
    if ids is not None and len(events):
        image[events.y, events.x] = _id_colours(ids)
    return image


def _id_colours(ids: NDArray[np.int32]) -> NDArray[np.uint8]:
    """[..., 3] RGB of ids; 0 is white."""
    shape = ids.shape
    flat = np.atleast_2d(ids)
    colours = _coloured(flat * GOLDEN % 1.0, np.where(flat > 0, 0.8, 0.0))
    colours[flat == 0] = 255
    return colours.reshape(*shape, 3)


def _coloured(hue: NDArray[Any], saturation: NDArray[Any]) -> Image:
    """RGB of hues and saturations in 0..1, [H, W], at full brightness."""
    full = np.full(hue.shape, 255.0)
    hsv = np.stack([hue * (HUES - 1), saturation * 255.0, full], axis=2)
    return np.asarray(cv2.cvtColor(np.rint(hsv).astype(np.uint8), cv2.COLOR_HSV2RGB))


def _arrows(truth: Snapshot) -> NDArray[np.float32] | None:
    if truth.flow is None:
        return None
    share = ARROW_US / max(truth.flow.to_us - truth.t_us, 1)
    return flow_arrows(truth.flow.vectors * np.float32(share))
