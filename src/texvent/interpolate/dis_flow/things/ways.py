"""Both directions of a pair on a level; what its things share: surroundings, masks, the check."""

from __future__ import annotations

from types import ModuleType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.confirmation import Flows
from texvent.interpolate.dis_flow.definitions import CHANGED, Floats, Mask

GRID, WINDOW = 16, 5
"""Surroundings: flow at this many places along the longer side, median over 5×5 of them."""
BORDER = 3
"""Pixels around a thing that may have its flow, or what it covers, by mistake. The check looks as
far around these."""
MOST_CHANGE = 96.0
"""A larger change of brightness counts as this in the check, levels: it is an edge elsewhere, not
worse."""


class Way(NamedTuple):
    """One direction of a pair on a level."""

    start: Floats
    stop: Floats
    around: Floats
    """[2, H, W] flow of the surroundings."""
    change: Floats
    """[H, W] of brightness along it, levels."""

    @property
    def missed(self) -> Mask:
        """Pixels that the surroundings' motion does not explain."""
        return np.abs(self.change) > CHANGED


Ways = tuple[Way, Way]


def look(start: Floats, stop: Floats, flow: Floats, kernels: ModuleType) -> Way:
    """A direction, whose surroundings are told by its flow."""
    around = surroundings(flow)
    return Way(start, stop, around, kernels.change_along(start, stop, around))


def surroundings(flow: Floats) -> Floats:
    """The median flow around each pixel, [2, H, W], in steps of some pixels."""
    _, height, width = flow.shape
    step = max(2, round(max(height, width) / GRID))
    first = [min(step // 2, side - 1) for side in (height, width)]
    places = flow[:, first[0] :: step, first[1] :: step]
    padded = np.pad(places, ((0, 0), (WINDOW // 2,) * 2, (WINDOW // 2,) * 2), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (WINDOW, WINDOW), axis=(1, 2))
    median = np.median(windows.reshape(*places.shape, WINDOW**2), axis=-1)
    rows = np.minimum(np.arange(height) // step, places.shape[1] - 1)
    columns = np.minimum(np.arange(width) // step, places.shape[2] - 1)
    return np.ascontiguousarray(median[:, rows][:, :, columns], np.float32)


def unexplained(
    ways: Ways, flows: Flows, is_open: tuple[Mask, Mask], near: Mask, kernels: ModuleType
) -> NDArray[np.float64]:
    """What flows leave unexplained in some pixels: change of brightness, and pixels, levels."""
    total, count = 0.0, 0
    for way, flow, mask, other in zip(ways, flows, is_open, is_open[::-1], strict=True):
        change = np.abs(kernels.change_along(way.start, way.stop, np.ascontiguousarray(flow)))
        change[covered(flow, mask, other)] = CHANGED
        total += float(np.minimum(change[near], np.float32(MOST_CHANGE)).sum(dtype=np.float64))
        count += int(mask[near].sum())
    return np.array([total, total + CHANGED * count])


def covered(flow: Floats, is_open: Mask, is_open_there: Mask) -> Mask:
    """Pixels at whose place the other image shows something that comes from elsewhere.

    Args:
        flow: [2, H, W] px.
        is_open: [H, W], whether the flow of each pixel is not confirmed.
        is_open_there: [H, W], the same of the other image.
    """
    height, width = is_open.shape
    y, x = np.nonzero(is_open)
    column = np.floor(x + flow[0, y, x] + np.float32(0.5)).astype(np.intp)
    row = np.floor(y + flow[1, y, x] + np.float32(0.5)).astype(np.intp)
    is_inside = (column >= 0) & (row >= 0) & (column < width) & (row < height)
    found = np.zeros_like(is_open)
    found[y[is_inside], x[is_inside]] = ~is_open_there[row[is_inside], column[is_inside]]
    return found


def confirmed_by(one: Mask, other: Mask, shift: Floats) -> Mask:
    """Pixels that, shifted, meet pixels of the other image, within one."""
    y, x = np.nonzero(one)
    row, column = y + int(np.rint(shift[1])), x + int(np.rint(shift[0]))
    is_met = np.pad(dilated(other, 1), 1)[
        np.clip(row, -1, one.shape[0]) + 1, np.clip(column, -1, one.shape[1]) + 1
    ]
    confirmed = np.zeros_like(one)
    confirmed[y[is_met], x[is_met]] = True
    return confirmed


def filled(thing: Mask, least: tuple[int, ...]) -> Mask:
    """A mask and, again and again, pixels with at least so many of its pixels among 3×3."""
    for count in least:
        padded = np.pad(thing, 1).astype(np.int8)
        rows = padded[:-2] + padded[1:-1] + padded[2:]
        thing = thing | (rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:] >= count)
    return thing


def dilated(mask: Mask, reach: int) -> Mask:
    """The mask and all pixels within `reach` rows and columns of it."""
    for _ in range(reach):
        padded = np.pad(mask, 1)
        rows = padded[:-2] | padded[1:-1] | padded[2:]
        mask = rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:]
    return mask
