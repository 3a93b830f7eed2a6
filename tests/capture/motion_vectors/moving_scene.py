"""A film whose motion is known exactly: a textured square before a textured wall, both moving."""

import numpy as np

WIDTH, HEIGHT, FRAMES = 64, 48, 6
WALL_PX, SQUARE_PX = (1.5, -0.5), (-3.0, 2.0)
"""Motion per frame, x right and y down."""
SIDE, LEFT, TOP = 20, 30, 8
NEAR_M, FAR_M = 2.0, 9.0


def texture(x, y, phase):
    """Smooth, without period in sight: 0..255."""
    waves = np.sin(0.31 * x + phase) + np.sin(0.27 * y - 0.5 * phase)
    waves = waves + np.sin(0.19 * x + 0.23 * y + 2.0 * phase)
    return 127.5 + 40.0 * waves


def square_at(index):
    return LEFT + SQUARE_PX[0] * index, TOP + SQUARE_PX[1] * index


def is_square(index):
    row, column = np.mgrid[:HEIGHT, :WIDTH]
    left, top = square_at(index)
    return (column >= left) & (column < left + SIDE) & (row >= top) & (row < top + SIDE)


def frame(index):
    row, column = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    wall = texture(column - WALL_PX[0] * index, row - WALL_PX[1] * index, 0.3)
    left, top = square_at(index)
    square = texture(column - left, row - top, 1.7)
    return np.where(is_square(index), square, wall).astype(np.float32)


def forward(index):
    """[H, W, 2] px to the next frame."""
    mask = is_square(index)[..., None]
    return np.where(mask, np.float32(SQUARE_PX), np.float32(WALL_PX)).astype(np.float32)


def backward(index):
    return -forward(index)


def depth(index):
    return np.where(is_square(index), NEAR_M, FAR_M).astype(np.float32)


def instances(index):
    return np.where(is_square(index), 7, 0).astype(np.int32)


def stack(make, count=FRAMES):
    return np.stack([make(index) for index in range(count)])
