"""Events → an RGB image, scaled so that colours neither saturate nor vanish.

The motion by which events were moved back is drawn in colours too.
"""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.frames import UINT16_PER_LEVEL, Frame
from texvent.represent.contrast_maximisation import Float64Array
from texvent.transfer import WHITE, Transfer, encode_srgb
from texvent.view.drawing.canvas import Image
from texvent.view.drawing.palettes import Palette

UNKNOWN, FULL = (200, 200, 200), 95.0
WHEEL_SHARE = 5
"""The wheel is as wide as this part of the shorter side."""


def draw_flow(flow: Float64Array) -> Image:
    """Directions of a flow as hues, its speeds as strengths, with the wheel of these colours.

    Rest is white, full colour the speed that `FULL` percent of the known pixels stay below, unknown
    (NaN) is grey. In the bottom left corner is the wheel: the colour of a place of it is that of
    motion from its centre to there.

    Args:
        flow: [H, W, 2], px/s.

    Returns:
        [H, W, 3] RGB.
    """
    speed = np.hypot(flow[..., 0], flow[..., 1])
    known = speed[~np.isnan(speed)]
    image = _colours(flow / max(np.percentile(known, FULL) if known.size else 0.0, 1e-9))
    image[np.isnan(speed)] = UNKNOWN
    radius = min(speed.shape) // WHEEL_SHARE // 2
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    inside = np.hypot(x, y) <= radius
    corner = image[-2 * radius - 1 :, : 2 * radius + 1]
    corner[inside] = _colours(np.stack([x, y], axis=-1) / max(radius, 1))[inside]
    return image


def _colours(motion: Float64Array) -> Image:
    """RGB of motions, [H, W, 2]; from a length of 1 at full strength."""
    across, down = np.moveaxis(np.nan_to_num(motion).astype(np.float32), -1, 0)
    hue = np.degrees(np.arctan2(down, across)) % 360
    strength = np.clip(np.hypot(across, down), 0, 1)
    hsv = np.stack([hue, strength, np.ones_like(hue)], axis=-1)
    return np.rint(cv2.cvtColor(hsv, cv2.COLOR_HSV2RGB) * 255).astype(np.uint8)


CEILING_PERCENTILE = 95.0
"""Pixels with more events than this share of the active ones are shown at full strength."""
FAINTEST = 0.3
"""Least strength of an event, where others are many."""
STRENGTH_EXPONENT = 0.5
"""Below 1, so that pixels with few events stay easy to see."""


def count_ceiling(counts: NDArray[Any]) -> float:
    """Events per pixel that are shown at full strength: a high percentile over active pixels.

    A fixed ceiling makes short slices blank and long ones one solid colour; this one follows
    the data. It is at least 1.

    Args:
        counts: OFF and ON events per pixel, [2, H, W].
    """
    total = counts.sum(axis=0)
    active = total[total > 0]
    return max(1.0, float(np.percentile(active, CEILING_PERCENTILE))) if active.size else 1.0


def draw_events(counts: NDArray[Any], palette: Palette, *, ceiling: float | None = None) -> Image:
    """Counted events as an RGB image.

    Hue says which polarity (a pixel with both shows the mixture); strength says how many
    events, at least `FAINTEST`, full colour from `ceiling` on. Where a palette's background lies
    between its colours (v2e), as many ON as OFF look like none.

    Args:
        counts: OFF and ON events per pixel, [2, H, W] integers (`event_frame(…, "count")`).
        palette: the colours.
        ceiling: events per pixel at full strength; default: `count_ceiling(counts)`.

    Returns:
        [H, W, 3] uint8.
    """
    limit = count_ceiling(counts) if ceiling is None else max(1.0, ceiling)
    height, width = counts.shape[1:]
    image = np.empty((height, width, 3), dtype=np.uint8)
    image[:] = palette.background
    # Most pixels have no event, so only the active ones are computed.
    rows, columns = np.nonzero(counts[0] | counts[1])
    if rows.size == 0:
        return image
    off = counts[0, rows, columns].astype(np.float32)
    on = counts[1, rows, columns].astype(np.float32)
    total = off + on
    strength = np.clip((total / limit) ** STRENGTH_EXPONENT, FAINTEST, 1.0)
    share = (on / total)[:, None]
    on_colour, off_colour, background = (
        np.array(colour, dtype=np.float32)
        for colour in (palette.on, palette.off, palette.background)
    )
    colour = share * on_colour + (1 - share) * off_colour
    mixed = background + strength[:, None] * (colour - background)
    image[rows, columns] = np.rint(mixed).astype(np.uint8)
    return image


def frame_image(frame: Frame) -> Image:
    """A frame as 8-bit RGB, for display only: linear light is gamma-coded, and ends at white.

    Returns:
        [H, W, 3] uint8.
    """
    pixels = frame.pixels
    if pixels.dtype == np.uint16:
        pixels = pixels / np.float32(UINT16_PER_LEVEL)
    if frame.transfer is Transfer.LINEAR:
        pixels = encode_srgb(pixels / np.float32(WHITE))
    if pixels.dtype != np.uint8:
        pixels = np.rint(np.clip(pixels, 0, WHITE)).astype(np.uint8)
    if pixels.ndim == 2:
        pixels = np.repeat(pixels[:, :, None], 3, axis=2)
    return np.ascontiguousarray(pixels, dtype=np.uint8)
