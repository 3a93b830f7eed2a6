from __future__ import annotations

import cv2
import numpy as np
import pytest

from texvent.video import Frame
from texvent.view.page.sample import STRIP_WIDTH, FrameStrip


def frame(index: int, width: int = 8) -> Frame:
    return Frame(np.full((6, width, 3), index % 256, dtype=np.uint8), index * 1000)


@pytest.mark.parametrize("count", [1, 4, 5, 8, 9, 100])
def test_kept_frames_are_evenly_spread_and_never_too_many(count: int) -> None:
    strip = FrameStrip(limit=4)
    for index in range(count):
        strip.append(frame(index))
    times = [t for t, _ in strip.images]
    assert strip.seen == count
    assert min(count, 2) <= len(times) <= 4
    assert times[0] == 0
    steps = np.diff(times)
    assert len(set(steps.tolist())) <= 1, "one stride"
    assert times[-1] + (steps[0] if len(steps) else 1000) >= (count - 1) * 1000, "up to the end"


def test_intermediate_frames_are_left_out() -> None:
    strip = FrameStrip()
    strip.append(Frame(np.zeros((6, 8)), 5, is_source=False))
    assert (strip.seen, strip.images) == (0, [])


def test_large_frames_are_made_small_and_keep_their_shape() -> None:
    strip = FrameStrip()
    strip.append(Frame(np.full((600, 2 * STRIP_WIDTH, 3), 90, dtype=np.uint8), 0))
    image = cv2.imdecode(np.frombuffer(strip.images[0][1], np.uint8), cv2.IMREAD_COLOR)
    assert image.shape == (300, STRIP_WIDTH, 3)
    assert abs(image.mean() - 90) < 2
