"""Videos that measurements simulate: a texture that moves, and noise of any length."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np

from texvent.frames import Frame, Video
from texvent.sensor import SensorSize

PICTURES = 16


class LongVideo:
    """Noise of 16 pictures again and again, made as it is read."""

    fps, is_live = Fraction(25), False

    def __init__(self, size: SensorSize, frame_count: int) -> None:
        """So many frames."""
        self.size, self.frame_count = size, frame_count
        self.metadata: dict[str, Any] = {}

    def __iter__(self) -> Iterator[Frame]:
        """The frames, 40 ms apart."""
        shape = (PICTURES, *self.size.shape)
        pictures = np.random.default_rng(0).integers(90, 130, shape, np.uint8)
        for index in range(self.frame_count):
            yield Frame(pictures[index % PICTURES].copy(), 40_000 * index)


def moving_texture(size: SensorSize, count: int) -> Video:
    """Colour noise of 8 px that moves by 3 px per frame, at 25 frames per second."""
    height, width = size.shape
    random = np.random.default_rng(0)
    cells = random.integers(40, 200, (height // 8 + 2, (width + 3 * count) // 8 + 2, 3))
    wide = np.kron(cells, np.ones((8, 8, 1), np.int64)).astype(np.uint8)
    frames = [wide[:height, 3 * index : 3 * index + width] for index in range(count)]
    return Video(np.stack(frames), [40_000 * index for index in range(count)])
