"""Events moved back along their motion, and this motion in colours."""

from __future__ import annotations

import cv2
import numpy as np

from texvent.represent.contrast_maximisation import Float64Array
from texvent.view.drawing.canvas import Image

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
