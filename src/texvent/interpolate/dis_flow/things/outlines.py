"""Outlines of things that the search has found, such as a ball of 40 px by 20 px.

The search gives the motion of a thing to the ground beside it too, most of all to ground that the
thing covers in the other image, which nothing explains; and where a thing has one colour, its flow
is not precise. So things that move otherwise than their surroundings are drawn anew, one after the
other, in a window around each:

1. *Shift.* Of the confirmed pixels that the surroundings' motion does not explain, it is the flow
   that most of them have.
2. *Ground.* Its flow is the median over the confirmed pixels whose flow is not like the shift.
3. *Pixels.* A pixel belongs to the thing if brightness around it changes little along the shift,
   and less than along the ground's flow; where both fit alike, as inside one colour, if its own
   flow is like the shift. The other image must say the same.
4. *Precise shift.* Of some shifts near it the one along which the thing changes least counts, and
   the pixels are told again.
5. *Flows.* The thing and its soft edge take the shift. Pixels around it that are not confirmed, or
   whose flow is like the shift, take the ground's.
6. *Check.* As in `fast_things`, but no more may be unexplained than before: both directions of the
   search confirm this shift already. A thing that turns or grows has no such shift and stays as it
   is.
"""

from __future__ import annotations

from types import ModuleType
from typing import NamedTuple

import numpy as np

from texvent.interpolate.dis_flow.confirmation import Flows, both_unconfirmed
from texvent.interpolate.dis_flow.definitions import MARGIN, Floats, Mask
from texvent.interpolate.dis_flow.things.ways import (
    BORDER,
    MOST_CHANGE,
    Way,
    Ways,
    confirmed_by,
    dilated,
    filled,
    unexplained,
)

MOST_OUTLINES = 4
"""At most so many things per pair are drawn anew."""
LEAST_PIXELS = 12
"""A thing has at least so many confirmed pixels that the surroundings do not explain."""
OTHER2 = 2.0
"""Their flow differs from the surroundings' by at least this, px², squared."""
BIN = 2.0
"""Flows are counted in squares of this side, px."""
LIKE_PX, LIKE_RELATIVE = 3.0, 0.3
"""Flow is like a shift within this distance, px, and this share of its length."""
FITS = 22.0
"""Along its shift, brightness around a thing's pixel (3×3) changes by less on average, levels,"""
CLEARLY = 4.0
"""and by so much less than along the ground's flow, levels."""
DENSE = 0.1
"""They are at least this share of the pixels in the rectangle around them."""
AROUND = 12
"""The window reaches this far beyond the thing's places in both images, px."""
MOST_WINDOW = 110
"""Longest side of a window, px: larger things cost more than they gain."""
MOST_AT_BORDER = 0.02
"""Share of a thing's pixels that may lie at the border of the window."""
FINER = (1.0, 0.5, 0.25)
"""Steps to more precise shifts, px."""


class Part(NamedTuple):
    """A window of a pair."""

    start: Floats
    stop: Floats
    flows: Flows


def redraw_things(
    ways: Ways, flows: Flows, is_open: tuple[Mask, Mask], settled: Mask, kernels: ModuleType
) -> Flows:
    """Both flows of a level, with the things in them drawn anew where that explains no less.

    Args:
        ways: both directions.
        flows: from one image to the other and back, [2, H, W] px.
        is_open: pixels whose flow is not confirmed, [H, W] each.
        settled: [H, W], pixels that stay as they are.
        kernels: `flow_reference` or `flow_cpu`.
    """
    candidates = ways[0].missed & ~is_open[0] & ~settled
    candidates &= ((flows[0] - ways[0].around) ** 2).sum(axis=0) > OTHER2
    for _ in range(MOST_OUTLINES):
        found = _most_frequent(flows[0], candidates)
        if found is None:
            break
        shift, pixels = found
        candidates &= ~pixels
        window = _window(pixels, shift)
        if window is None:
            continue
        inside = (slice(None), *window)
        part = Part(
            _crop(ways[0].start, window),
            _crop(ways[0].stop, window),
            (_packed(flows[0][inside]), _packed(flows[1][inside])),
        )
        redrawn = _redraw(part, shift, kernels)
        if redrawn is not None:
            flows = flows[0].copy(), flows[1].copy()
            flows[0][inside], flows[1][inside] = redrawn
    return flows


def _most_frequent(flow: Floats, candidates: Mask) -> tuple[Floats, Mask] | None:
    """The flow that most candidates have, and those that have it, if they are enough."""
    y, x = np.nonzero(candidates)
    if len(y) < LEAST_PIXELS:
        return None
    seen = flow[:, y, x]
    bins = np.floor(seen / np.float32(BIN) + np.float32(0.5)).astype(np.intp)
    low = bins.min(axis=1)
    across = int(np.ptp(bins[0])) + 1
    counts = np.bincount((bins[1] - low[1]) * across + bins[0] - low[0])
    row, column = divmod(int(counts.argmax()), across)
    middle = np.array([[low[0] + column], [low[1] + row]], np.float32) * np.float32(BIN)
    has_it = ((seen - middle) ** 2).sum(axis=0) < np.float32((1.5 * BIN) ** 2)
    if has_it.sum() < LEAST_PIXELS:
        return None
    pixels = np.zeros_like(candidates)
    pixels[y[has_it], x[has_it]] = True
    return np.median(seen[:, has_it], axis=1).astype(np.float32), pixels


def _window(pixels: Mask, shift: Floats) -> tuple[slice, slice] | None:
    """Rows and columns around some pixels and the places they are shifted to, if they lie dense."""
    sides, slices = [], []
    for axis, step in ((1, shift[1]), (0, shift[0])):
        at = np.nonzero(pixels.any(axis=axis))[0]
        first, last = int(at[0]), int(at[-1])
        sides.append(last + 1 - first)
        # What the surroundings explain too, such as the middle of one colour, may lie outside.
        reach = AROUND + int(abs(step)) + sides[-1] // 2
        stop = min(last + 1 + reach, pixels.shape[1 - axis])
        slices.append(slice(max(0, first - reach), stop))
    is_dense = pixels.sum() >= DENSE * sides[0] * sides[1]
    is_small = all(one.stop - one.start <= MOST_WINDOW for one in slices)
    return (slices[0], slices[1]) if is_dense and is_small else None


def _crop(level: Floats, window: tuple[slice, slice]) -> Floats:
    """A window of a level; its margin shows what lies around it."""
    rows, columns = (slice(one.start, one.stop + 2 * MARGIN) for one in window)
    return _packed(level[:, rows, columns])


def _packed(values: Floats) -> Floats:
    return np.ascontiguousarray(values, np.float32)


def _redraw(part: Part, shift: Floats, kernels: ModuleType) -> Flows | None:
    """Both flows of a window with a thing that moves by a shift, or None if they explain less."""
    is_open = both_unconfirmed(part.start, part.stop, part.flows, kernels)
    things, grounds = _tell_pixels(part, is_open, shift, kernels)
    if not all(_lies_within(thing) for thing in things):
        return None
    shift = _precise(part, shift, dilated(things[0], 1), kernels)
    things, grounds = _tell_pixels(part, is_open, shift, kernels)
    things = dilated(things[0], 1), dilated(things[1], 1)
    near = dilated(things[0] | things[1], BORDER + 1)
    found = []
    for k, own in enumerate((shift, -shift)):
        is_ground = near & (is_open[k] | _is_like(part.flows[k], own))
        outside = np.where(is_ground, _column(grounds[k]), part.flows[k])
        found.append(_packed(np.where(things[k], _column(own), outside)))
    flows = found[0], found[1]
    wide, still_open = dilated(near, BORDER), both_unconfirmed(*part[:2], flows, kernels)
    ways = _ways(part)
    before = unexplained(ways, part.flows, is_open, wide, kernels)
    after = unexplained(ways, flows, still_open, wide, kernels)
    return flows if (after < before).all() else None


def _lies_within(thing: Mask) -> bool:
    """Whether there is a thing, and nearly all of it lies inside its window."""
    at_border = int(thing[[0, -1]].sum() + thing[:, [0, -1]].sum())
    return at_border <= MOST_AT_BORDER * int(thing.sum()) and bool(thing.any())


def _ways(part: Part) -> Ways:
    """Both directions of a window, for the check, which does not read their surroundings."""
    none = np.zeros_like(part.flows[0])
    return (
        Way(part.start, part.stop, none, none[0]),
        Way(part.stop, part.start, none, none[0]),
    )


def _tell_pixels(
    part: Part, is_open: tuple[Mask, Mask], shift: Floats, kernels: ModuleType
) -> tuple[tuple[Mask, Mask], list[Floats]]:
    """The pixels of a thing in both images, and the flow of the ground in both directions."""
    fits, grounds = [], []
    for k, own in enumerate((shift, -shift)):
        start, stop = (part.start, part.stop) if k == 0 else (part.stop, part.start)
        is_like = _is_like(part.flows[k], own)
        elsewhere = part.flows[k][:, ~is_open[k] & ~is_like]
        ground = np.median(elsewhere, axis=1) if elsewhere.size else np.zeros(2)
        grounds.append(ground.astype(np.float32))
        along, beside = (
            _mean_change(start, stop, flow, is_open[k].shape, kernels) for flow in (own, grounds[k])
        )
        is_clear = along + np.float32(CLEARLY) < beside
        is_alike = is_like & (along <= beside + np.float32(1.0))
        fits.append((along < np.float32(FITS)) & (is_clear | is_alike))
    one, other = confirmed_by(fits[0], fits[1], shift), confirmed_by(fits[1], fits[0], -shift)
    return (filled(one, (5, 5)), filled(other, (5, 5))), grounds


def _is_like(flow: Floats, shift: Floats) -> Mask:
    """Pixels whose flow is like a shift."""
    most = LIKE_PX**2 + LIKE_RELATIVE**2 * float((shift**2).sum())
    is_like: Mask = ((flow - _column(shift)) ** 2).sum(axis=0) < np.float32(most)
    return is_like


def _precise(part: Part, shift: Floats, thing: Mask, kernels: ModuleType) -> Floats:
    """The shift near another one along which a thing's brightness changes least."""
    least, best = np.inf, shift
    for step in FINER:
        middle = best
        for down, right in np.ndindex(3, 3):
            tried = middle + np.array([right - 1, down - 1], np.float32) * np.float32(step)
            change = _change(part.start, part.stop, tried, thing.shape, kernels)[thing]
            total = float(change.sum(dtype=np.float64))
            if total < least:
                least, best = total, tried
    return best


def _change(
    start: Floats, stop: Floats, shift: Floats, shape: tuple[int, ...], kernels: ModuleType
) -> Floats:
    """What brightness changes by along a shift, [H, W], at most `MOST_CHANGE` levels."""
    flow = _packed(np.broadcast_to(_column(shift), (2, *shape)))
    change = np.minimum(np.abs(kernels.change_along(start, stop, flow)), np.float32(MOST_CHANGE))
    return np.asarray(change, np.float32)


def _mean_change(
    start: Floats, stop: Floats, shift: Floats, shape: tuple[int, ...], kernels: ModuleType
) -> Floats:
    """The same, its mean over 3×3 pixels."""
    padded = np.pad(_change(start, stop, shift, shape, kernels), 1, mode="edge")
    rows = padded[:-2] + padded[1:-1] + padded[2:]
    mean: Floats = (rows[:, :-2] + rows[:, 1:-1] + rows[:, 2:]) / np.float32(9.0)
    return mean


def _column(vector: Floats) -> Floats:
    return vector[:, np.newaxis, np.newaxis]
