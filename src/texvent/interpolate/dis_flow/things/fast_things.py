"""Small things that move too far for the search of patches, such as a ball of 8 px by 12 px.

Coarse levels do not show them, and on fine ones they are out of reach. So they are looked for once
both flows are known on a level, one after the other, in what the motion around does not explain:

1. *Around.* The flow of the surroundings is the median over a large window.
2. *Missed.* Pixels that change along it, and whose flow is not confirmed by the other direction,
   belong to a thing, or to what it covers and uncovers.
3. *Shift.* These pixels of both images are correlated at every shift: first their detail, then
   their difference from a wide mean, which tells a thing of one colour. The best shift is tried,
   unless another one explains the same pixels nearly as well, or they are mostly ground that
   something covers or uncovers which is followed already.
4. *Pixels.* A missed pixel takes the shift if its surroundings agree there, and the other image
   says the same. What the thing covers or uncovers takes the flow of the surroundings.
5. *Check.* Around the thing, brightness must change clearly less along the new flows than along
   those before, both directions together, and also if each unconfirmed pixel counts as a change by
   `CHANGED`. What is covered by something that is followed changes by `CHANGED` alone: no flow
   explains it. Otherwise nothing is changed.
"""

from __future__ import annotations

from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.dis_flow.confirmation import Flows, both_unconfirmed
from texvent.interpolate.dis_flow.definitions import CHANGED, MARGIN, Floats, Mask, size_of
from texvent.interpolate.dis_flow.things.missed_shift import correlate_missed, wide_detail
from texvent.interpolate.dis_flow.things.outlines import redraw_things
from texvent.interpolate.dis_flow.things.ways import (
    BORDER,
    Way,
    Ways,
    confirmed_by,
    covered,
    dilated,
    filled,
    look,
    unexplained,
)
from texvent.pairs.shift_correlation import detail

MOST_SIDE = 400
"""Longer side of the level on which things are looked for, at most, px."""
MOST_THINGS = 4
"""At most so many per pair."""
MOST_MISSED = 0.2
"""Where a larger share is missed, no small thing explains it."""
FITS, FITS_DETAIL = 0.3, 0.2
"""A pixel takes the shift if its surroundings (3×3) change by less than this share of what they
change by along the surroundings' motion, and on average by less than `FITS_DETAIL` of the range of
brightness around (9×9): ground that a thing covers fits other ground better than the thing."""
AMBIGUOUS = 0.5
"""Where a rival fits this share of a shift's pixels too, as in a texture that repeats, neither
counts."""
HIDDEN = 0.5
"""At most this share of a thing's pixels may be ground, moving as the surroundings do, that in the
other image is covered by something that is followed: two such grounds look alike by chance."""
GAPS_AND_EDGE = 5, 5, 2
"""A pixel with so many of a thing's pixels among 3×3 belongs to it: gaps, then the soft edge."""
BETTER = 0.8
"""What is unexplained must fall to this share. Of discs and bars before textures, true shifts leave
0.4 to 0.75 of it, and false ones 0.85 and more."""


def level_of_things(pyramid: list[Floats]) -> int:
    """Number of the level on which things are looked for."""
    sizes = [max(size_of(level)) for level in pyramid]
    return next((k for k, side in enumerate(sizes) if side <= MOST_SIDE), len(sizes) - 1)


def follow_fast_things(
    start: Floats, stop: Floats, flows: Flows, kernels: ModuleType, *, is_full_size: bool = False
) -> Flows:
    """Both flows of a level, with the motion of small fast things where there are any.

    Args:
        start: level of the one image.
        stop: level of the other.
        flows: from one to the other and back, [2, H, W] px.
        kernels: `flow_reference` or `flow_cpu`.
        is_full_size: the level is that of the frames. Outlines are then not drawn anew: a mask of
            whole pixels cuts the soft edge of a thing off.
    """
    ways = look(start, stop, flows[0], kernels), look(stop, start, flows[1], kernels)
    if not 0 < ways[0].missed.mean() <= MOST_MISSED:
        return flows
    is_open, settled = both_unconfirmed(start, stop, flows, kernels), np.zeros_like(ways[0].missed)
    images = _image(start), _image(stop)
    for _ in range(MOST_THINGS):
        missed = ways[0].missed & is_open[0] & ~settled, ways[1].missed & is_open[1] & ~settled
        for detail_of in (detail, wide_detail):
            shifts = correlate_missed((detail_of(images[0]), detail_of(images[1])), missed)
            if not shifts:
                continue
            fits = _fits(ways[0], shifts[0], is_open[0]), _fits(ways[1], -shifts[0], is_open[1])
            rivals = [_fits(ways[0], rival, is_open[0]) for rival in shifts[1:]]
            if _is_ambiguous(fits[0], rivals) or _is_hidden(fits, ways, is_open):
                continue
            found, near = _follow(ways, flows, is_open, shifts[0], fits)
            still_open, wide = both_unconfirmed(start, stop, found, kernels), dilated(near, BORDER)
            before = unexplained(ways, flows, is_open, wide, kernels)
            after = unexplained(ways, found, still_open, wide, kernels)
            if (after < BETTER * before).all():
                flows, is_open, settled = found, still_open, settled | near
                break
        else:
            break
    return flows if is_full_size else redraw_things(ways, flows, is_open, settled, kernels)


def _is_ambiguous(fits: Mask, rivals: list[Mask]) -> bool:
    """Whether another shift fits the pixels that the first one fits."""
    return any(bool((fits & rival).sum() > AMBIGUOUS * fits.sum()) for rival in rivals)


def _is_hidden(fits: tuple[Mask, Mask], ways: Ways, is_open: tuple[Mask, Mask]) -> bool:
    """Whether most pixels that a shift fits are ground that something followed covers."""
    hidden = (
        mask & covered(way.around, one, other)
        for mask, way, one, other in zip(fits, ways, is_open, is_open[::-1], strict=True)
    )
    total = sum(int(mask.sum()) for mask in fits)
    return sum(int(mask.sum()) for mask in hidden) > HIDDEN * total


def _follow(
    ways: Ways,
    flows: Flows,
    is_open: tuple[Mask, Mask],
    shift: Floats,
    fits: tuple[Mask, Mask],
) -> tuple[Flows, Mask]:
    """Both flows with a thing that moves by a shift, and the pixels around it in either image."""
    shifts = shift, -shift
    things = [
        filled(confirmed_by(one, other, each), GAPS_AND_EDGE)
        for one, other, each in zip(fits, fits[::-1], shifts, strict=True)
    ]
    near = dilated(things[0] | things[1], BORDER)
    found = [
        np.where(
            things[k],
            shifts[k][:, np.newaxis, np.newaxis],
            np.where(near & is_open[k], ways[k].around, flows[k]),
        )
        for k in (0, 1)
    ]
    return (found[0], found[1]), near


def _image(level: Floats) -> NDArray[np.float64]:
    return level[0, MARGIN:-MARGIN, MARGIN:-MARGIN].astype(np.float64)


def _fits(way: Way, shift: Floats, is_open: Mask) -> Mask:
    """Missed pixels whose surroundings agree with the other image at the shift."""
    height, width = size_of(way.start)
    fits = np.zeros((height, width), np.bool_)
    y, x = np.nonzero(way.missed & is_open)
    to_x, to_y = x + shift[0], y + shift[1]
    is_inside = (to_x >= 1) & (to_y >= 1) & (to_x < width - 2) & (to_y < height - 2)
    y, x = y[is_inside], x[is_inside]
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
    may_fit = error < FITS * before
    y, x, error = y[may_fit], x[may_fit], error[may_fit]
    near = _window(way.start, y, x, 4)
    spread = near.max(axis=0) - near.min(axis=0)
    fits[y, x] = (spread >= CHANGED) & (error < 9 * FITS_DETAIL * spread)
    return fits


def _window(level: Floats, y: NDArray[np.intp], x: NDArray[np.intp], reach: int) -> Floats:
    """Levels around pixels, [(2 · reach + 1)², n]."""
    steps = range(-reach, reach + 1)
    return np.stack([level[0, y + MARGIN + i, x + MARGIN + j] for i in steps for j in steps])
