"""A small thing that moves too far for the search of patches, such as a ball of 8 px by 12 px.

Coarse levels do not show it, and on fine ones it is out of reach. So it is looked for once both
flows are known on a level, in what the motion around does not explain:

1. *Around.* The flow of the surroundings is the median over a large window.
2. *Missed.* Pixels that change along it belong to the thing, or to what it covers and uncovers.
3. *Shift.* The detail of both images in these pixels is correlated at every shift. The best one
   counts if it is well above all others.
4. *Pixels.* A missed pixel whose flow is not confirmed by the other direction takes the shift if
   its surroundings agree there, and the other image says the same. What the thing covers or
   uncovers takes the flow of the surroundings.
"""

from __future__ import annotations

import math
from types import ModuleType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.definitions import MARGIN, Floats, size_of
from texvent.pairs.shift_correlation import detail

MOST_SIDE = 400
"""Longer side of the level on which things are looked for, at most, px."""
GRID, WINDOW = 16, 5
"""Surroundings: flow at this many places along the longer side, median over 5×5 of them."""
MISSED = 24.0
"""Difference to the surroundings' motion from which a pixel is missed, of 255 levels."""
MOST_MISSED = 0.2
"""Where a larger share is missed, no small thing explains it."""
LEAST_SHIFT = 4
"""Shorter shifts, px, are left to the search."""
AGREEMENT, AHEAD = 0.3, 1.1
"""Least correlation of the shift, and how far above the next one it must be."""
FITS = 0.3
"""A pixel takes the shift if its surroundings (3×3) change by less than this share of what they
change by along the surroundings' motion."""
BORDER = 3
"""Pixels around a thing that may have its flow, or what it covers, by mistake."""

Mask = NDArray[np.bool_]


class Way(NamedTuple):
    """One direction of a pair on a level."""

    start: Floats
    stop: Floats
    flow: Floats
    around: Floats
    """[2, H, W] flow of the surroundings."""
    change: Floats
    """[H, W] of brightness along it, levels."""

    @property
    def missed(self) -> Mask:
        """Pixels that the surroundings' motion does not explain."""
        return np.abs(self.change) > MISSED


def level_of_things(pyramid: list[Floats]) -> int:
    """Number of the level on which things are looked for."""
    sizes = [max(size_of(level)) for level in pyramid]
    return next((k for k, side in enumerate(sizes) if side <= MOST_SIDE), len(sizes) - 1)


def follow_fast_thing(
    start: Floats, stop: Floats, flows: tuple[Floats, Floats], kernels: ModuleType
) -> tuple[Floats, Floats]:
    """Both flows of a level, with the motion of a small fast thing where there is one.

    Args:
        start: level of the one image.
        stop: level of the other.
        flows: from one to the other and back, [2, H, W] px.
        kernels: `flow_reference` or `flow_cpu`.
    """
    ahead = _look(start, stop, flows[0], kernels)
    if not 0 < ahead.missed.mean() <= MOST_MISSED:
        return flows
    back = _look(stop, start, flows[1], kernels)
    shift = _find_shift(ahead, back)
    if shift is None:
        return flows
    ways, shifts = (ahead, back), (shift, -shift)
    is_open = _unconfirmed(ahead, *flows, kernels), _unconfirmed(back, *flows[::-1], kernels)
    fits = [_fits(*each) for each in zip(ways, shifts, is_open, strict=True)]
    things = [
        _filled(_confirmed_by(one, other, each))
        for one, other, each in zip(fits, fits[::-1], shifts, strict=True)
    ]
    near = _dilated(things[0] | things[1], BORDER)
    found = []
    for way, each, thing, open_pixels in zip(ways, shifts, things, is_open, strict=True):
        flow = np.where(near & open_pixels, way.around, way.flow)
        found.append(np.where(thing, each[:, np.newaxis, np.newaxis], flow))
    return found[0], found[1]


def _look(start: Floats, stop: Floats, flow: Floats, kernels: ModuleType) -> Way:
    around = surroundings(flow)
    return Way(start, stop, flow, around, kernels.change_along(start, stop, around))


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


def _find_shift(ahead: Way, back: Way) -> Floats | None:
    """The shift of what is missed, (x, y) px, if one is well above all others."""
    one, other = (np.where(way.missed, detail(_image(way.start)), 0) for way in (ahead, back))
    reach = [side // 3 for side in one.shape]
    shape = tuple(_fast_length(side + most) for side, most in zip(one.shape, reach, strict=True))
    spectra = [np.fft.rfft2(image.astype(np.float32), shape) for image in (one, other)]
    product = np.fft.irfft2(spectra[1] * np.conj(spectra[0]), shape)
    agreement = product[np.ix_(*(np.arange(-most, most + 1) for most in reach))]
    agreement = agreement / (np.sqrt((one**2).sum() * (other**2).sum()) + 1.0)
    held = agreement.copy()
    _clear(held, reach[0], reach[1], LEAST_SHIFT)
    row, column = np.unravel_index(int(held.argmax()), held.shape)
    best = float(held[row, column])
    _clear(held, int(row), int(column), LEAST_SHIFT)
    if best < max(AGREEMENT, AHEAD * float(held.max())):
        return None
    x = column - reach[1] + _vertex(agreement[row, :], int(column))
    y = row - reach[0] + _vertex(agreement[:, column], int(row))
    return np.array([x, y], np.float32)


def _fast_length(least: int) -> int:
    """The next length for which Fourier transforms are fast."""
    length = least
    while math.gcd(length, 2**16 * 3**8 * 5**5) != length:
        length += 1
    return length


def _image(level: Floats) -> NDArray[np.float64]:
    return level[0, MARGIN:-MARGIN, MARGIN:-MARGIN].astype(np.float64)


def _clear(agreement: NDArray[np.float64], row: int, column: int, reach: int) -> None:
    rows, columns = (slice(max(at - reach, 0), at + reach + 1) for at in (row, column))
    agreement[rows, columns] = -1.0


def _vertex(values: NDArray[np.float64], at: int) -> float:
    """Where a parabola through a peak and its neighbours is highest, −0.5..0.5."""
    if not 0 < at < len(values) - 1:
        return 0.0
    before, here, after = values[at - 1 : at + 2]
    bend = before - 2.0 * here + after
    return float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5)) if bend < 0 else 0.0


def _unconfirmed(way: Way, flow: Floats, other: Floats, kernels: ModuleType) -> Mask:
    """Pixels whose flow the other direction contradicts, or along which brightness changes."""
    height, width = size_of(way.start)
    y, x = np.mgrid[:height, :width]
    column = np.floor(x + flow[0] + 0.5).astype(np.intp)
    row = np.floor(y + flow[1] + 0.5).astype(np.intp)
    is_inside = (column >= 0) & (row >= 0) & (column < width) & (row < height)
    back = other[:, np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
    error2, length2 = ((flow + back) ** 2).sum(axis=0), (flow**2).sum(axis=0)
    change = kernels.change_along(way.start, way.stop, np.ascontiguousarray(flow))
    unconfirmed: Mask = ~is_inside | (error2 > 0.02 * length2 + 0.5) | (np.abs(change) > MISSED)
    return unconfirmed


def _fits(way: Way, shift: Floats, is_open: Mask) -> Mask:
    """Missed pixels whose surroundings agree with the other image at the shift."""
    height, width = size_of(way.start)
    fits = np.zeros((height, width), np.bool_)
    y, x = np.nonzero(way.missed & is_open)
    to_x, to_y = x + shift[0], y + shift[1]
    is_inside = (to_x >= 1) & (to_y >= 1) & (to_x < width - 2) & (to_y < height - 2)
    y, x = y[is_inside], x[is_inside]
    near = _window(way.start, y, x, 4)
    has_detail = near.max(axis=0) - near.min(axis=0) >= MISSED
    y, x = y[has_detail], x[has_detail]
    left, top = int(np.floor(shift[0])), int(np.floor(shift[1]))
    u, v = shift[0] - left, shift[1] - top
    upper, lower = (
        (1 - u) * _window(way.stop, y + row, x + left, 1)
        + u * _window(way.stop, y + row, x + left + 1, 1)
        for row in (top, top + 1)
    )
    error = np.abs((1 - v) * upper + v * lower - _window(way.start, y, x, 1)).sum(axis=0)
    padded = np.pad(np.abs(way.change), 1)
    before = sum(padded[y + i, x + j] for i in range(3) for j in range(3))
    fits[y, x] = error < FITS * before
    return fits


def _window(level: Floats, y: NDArray[np.intp], x: NDArray[np.intp], reach: int) -> Floats:
    """Levels around pixels, [(2 · reach + 1)², n]."""
    steps = range(-reach, reach + 1)
    return np.stack([level[0, y + MARGIN + i, x + MARGIN + j] for i in steps for j in steps])


def _confirmed_by(one: Mask, other: Mask, shift: Floats) -> Mask:
    """Pixels that, shifted, meet pixels of the other image, within one."""
    y, x = np.nonzero(one)
    row, column = y + int(np.rint(shift[1])), x + int(np.rint(shift[0]))
    is_met = np.pad(_dilated(other, 1), 1)[
        np.clip(row, -1, one.shape[0]) + 1, np.clip(column, -1, one.shape[1]) + 1
    ]
    confirmed = np.zeros_like(one)
    confirmed[y[is_met], x[is_met]] = True
    return confirmed


def _filled(thing: Mask) -> Mask:
    """The pixels of a thing without gaps, and its soft edge."""
    for least in (5, 5, 2):
        padded = np.pad(thing, 1).astype(np.int8)
        rows = padded[:-2] + padded[1:-1] + padded[2:]
        thing = thing | (rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:] >= least)
    return thing


def _dilated(mask: Mask, reach: int) -> Mask:
    """The mask and all pixels within `reach` rows and columns of it."""
    for _ in range(reach):
        padded = np.pad(mask, 1)
        rows = padded[:-2] | padded[1:-1] | padded[2:]
        mask = rows[:, :-2] | rows[:, 1:-1] | rows[:, 2:]
    return mask
