"""Small pairs of frames with motion that is known."""

import numpy as np
from tests.interpolate.motion.reference import View

from texvent.frames import Frame, MotionVectors

HEIGHT, WIDTH = 12, 14
BACKGROUND_M, OBJECT_M = 20.0, 4.0


def field(x: float, y: float) -> np.ndarray:
    """The same vector everywhere."""
    return np.full((HEIGHT, WIDTH, 2), (x, y), np.float32)


def texture(shift_x: float = 0.0, shift_y: float = 0.0) -> np.ndarray:
    """A smooth pattern, moved."""
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    x, y = x - shift_x, y - shift_y
    return 120 + 50 * np.sin(0.6 * x + 0.2 * y) + 40 * np.cos(0.5 * y)


def coverage(left: float, right: float) -> np.ndarray:
    """How much of each pixel an upright bar covers, [H, W]; pixel k reaches from k − ½ to k + ½."""
    x = np.arange(WIDTH)
    share = np.clip(np.minimum(right, x + 0.5) - np.maximum(left, x - 0.5), 0.0, 1.0)
    return np.tile(share, (HEIGHT, 1))


def bar_frame(left: float, right: float, level: float = 40.0, behind: float = 160.0) -> np.ndarray:
    """A dark upright bar before a plain background, its edges mixed in linear light."""
    share = coverage(left, right)
    light = share * (level / 255) ** 2.2 + (1 - share) * (behind / 255) ** 2.2
    return 255 * light ** (1 / 2.2)


def bar_pair(start: float = 4.0, step: float = 2.5, wide: float = 4.0) -> tuple[Frame, Frame]:
    """The bar in two frames, 1,000 µs apart, `step` px further in the second."""
    frames = []
    for index in range(2):
        left = start + index * step
        inside = coverage(left, left + wide) >= 0.5
        depth = np.where(inside, OBJECT_M, BACKGROUND_M).astype(np.float32)
        vectors = np.where(inside[..., None], np.float32([step, 0.0]), np.float32([0.0, 0.0]))
        vectors = vectors.astype(np.float32)
        motion = MotionVectors(
            forward=vectors if index == 0 else None,
            backward=-vectors if index else None,
            depth=depth,
        )
        frames.append(
            Frame(bar_frame(left, left + wide).astype(np.float32), 1000 * index, motion=motion)
        )
    return frames[0], frames[1]


def views(first: Frame, second: Frame) -> tuple[View, View]:
    """A pair as the reference reads it."""
    start, stop = first.motion, second.motion
    assert start is not None
    assert stop is not None
    result = []
    for frame, motion, vectors in (
        (first, start, start.forward),
        (second, stop, stop.backward),
    ):
        bend = None
        if motion.forward is not None and motion.backward is not None:
            bend = (motion.forward + motion.backward).astype(np.float64)
        order = np.minimum(np.log(motion.depth.astype(np.float64)), 30.0)
        result.append(View(frame.luma.astype(np.float64), order, vectors.astype(np.float64), bend))
    return result[0], result[1]
