"""Patterns of walls, things, plants and animals, as tiles (see `grounds.Pattern`)."""

from __future__ import annotations

import numpy as np

from texvent.scenes.raycast.surfaces.fields import (
    cells,
    courses,
    exponential,
    fractal,
    grid,
    noise,
    smooth_step,
    strokes,
)
from texvent.scenes.raycast.surfaces.grounds import Pattern


def worn() -> Pattern:
    """Paint, plastic, glass: almost even, with dirt and scratches."""
    scratches = strokes(60, 211, length=0.2, width=1, ground=0.0)
    dirt = fractal(3, 7, 212, gain=0.9)
    return Pattern(exponential(0.07 * dirt - 0.12 * scratches), 0.0 * dirt, 0.0 * dirt)


def stone() -> Pattern:
    """Rock: facets, cracks, lichen."""
    rough = fractal(2, 7, 221, gain=0.85)
    middle, gap, name = cells(7, 222)
    wander = fractal(5, 5, 223)
    crack = 1.0 - smooth_step(gap - middle + 0.06 * wander, 0.01, 0.08)
    lichen = smooth_step(fractal(4, 6, 224, gain=0.9), 0.7, 1.2)
    factor = exponential(0.22 * rough + 0.25 * (name - 0.5) - 0.8 * crack)
    return Pattern(factor, lichen, rough + 0.5 * name - crack)


def concrete() -> Pattern:
    """Formwork lines, pores, chips, streaks of damp, stains of oil and rust, cracks."""
    pores, _, chance = cells(60, 231)
    pore = (1.0 - smooth_step(pores, 0.15, 0.3)) * smooth_step(chance, 0.7, 0.75)
    streaks = fractal(2, 5, 232, gain=0.9, stretch=4)
    rough = fractal(8, 5, 233, gain=1.0)
    inside, _ = courses(1, 4, (0.004, 0.012), is_staggered=False, salt=234)
    spot, _, which = cells(9, 235)
    stain = 1.0 - smooth_step(spot + 0.10 * rough, 0.10, 0.40)
    stain = stain * smooth_step(which, 0.55, 0.85)
    middle, gap, _ = cells(3, 236)
    crack = 1.0 - smooth_step(gap - middle + 0.04 * fractal(6, 5, 237), 0.004, 0.02)
    factor = exponential(0.23 * rough + 0.10 * streaks - 0.7 * pore - 0.35 * (1.0 - inside)
                         - 0.5 * stain - 0.5 * crack)  # fmt: skip
    return Pattern(factor, smooth_step(streaks + stain, 0.0, 2.0), 0.3 * rough - pore - crack)


def plaster() -> Pattern:
    """Render with trowel marks, hairline cracks and patches."""
    rough = fractal(4, 6, 241, gain=0.95)
    middle, gap, _ = cells(5, 242)
    crack = 1.0 - smooth_step(gap - middle + 0.05 * rough, 0.004, 0.02)
    crack = crack * smooth_step(noise(3, 243), 0.2, 0.8)
    stains = smooth_step(fractal(2, 6, 244, gain=0.8), 0.5, 1.8)
    return Pattern(exponential(0.11 * rough - 0.22 * crack - 0.06 * stains), stains, 0.6 * rough)


def brick() -> Pattern:
    """Bricks of many shades in running bond, with mortar."""
    inside, name = courses(8, 24, (0.05, 0.14), salt=251)
    rough = fractal(5, 6, 252, gain=0.95)
    factor = exponential(inside * (0.7 * (name - 0.5) + 0.17 * rough) + (1 - inside) * 0.1 * rough)
    return Pattern(factor, 1.0 - inside, inside * (1.0 + 0.15 * rough))


def roofing() -> Pattern:
    """Rows of roof tiles, each row shading the one below."""
    inside, name = courses(10, 12, (0.07, 0.0), salt=261)
    _, y = grid()
    drop = y * 12.0 - np.floor(y * 12.0)
    rough = fractal(4, 6, 262, gain=0.9)
    shadow = 1.0 - smooth_step(drop, 0.0, 0.18)
    factor = exponential(0.55 * (name - 0.5) + 0.14 * rough - 0.9 * shadow - 0.5 * (1.0 - inside))
    return Pattern(factor, smooth_step(rough, 0.6, 1.6), inside - drop)


def wallpaper() -> Pattern:
    """A repeated figure on stripes of two shades."""
    x, y = grid()
    stripes = smooth_step(np.abs((x * 6.0) % 1.0 - 0.5), 0.22, 0.26)
    across, up = (x * 6.0) % 1.0 - 0.5, (y * 6.0 + 0.5 * np.floor(x * 6.0)) % 1.0 - 0.5
    square = across * across + up * up
    petals = 0.09 * (1.0 + 4.0 * across * across * up * up / (square * square + 1e-9))
    figure = 1.0 - smooth_step(np.sqrt(square), 0.8 * petals, 1.2 * petals + 0.02)
    rough = fractal(4, 6, 271, gain=0.9)
    factor = exponential(0.10 * rough - 0.22 * stripes)
    return Pattern(factor, figure, 0.1 * rough)


def wood() -> Pattern:
    """Grain along v, with growth rings and knots."""
    grain = fractal(2, 6, 281, gain=0.9, stretch=10)
    rings = fractal(2, 3, 282, gain=0.6, stretch=4)
    bands = (6.0 * rings) - np.floor(6.0 * rings)
    line = np.abs(bands - 0.5)
    factor = exponential(0.17 * grain - 0.35 * smooth_step(line, 0.3, 0.5)
                         + 0.10 * fractal(2, 6, 283))  # fmt: skip
    return Pattern(factor, smooth_step(rings, -1.0, 1.5), 0.15 * grain)


def bark() -> Pattern:
    """Ridges along v with deep furrows."""
    middle, gap, name = cells(14, 291, 4)
    rough = fractal(3, 6, 292, gain=0.95, stretch=3)
    furrow = 1.0 - smooth_step(gap - middle + 0.10 * rough, 0.04, 0.30)
    factor = exponential(0.30 * rough + 0.4 * (name - 0.5) - 1.1 * furrow)
    return Pattern(factor, smooth_step(rough, 0.5, 1.8), 0.4 * rough - 1.5 * furrow)


def foliage() -> Pattern:
    """Leaves that shade one another, with dark gaps between clumps."""
    leaf = strokes(5200, 301, length=0.05, lean=1.0, width=5, ground=0.05)
    clumps = fractal(3, 5, 302, gain=0.8)
    gap = smooth_step(clumps, -2.0, -0.4)
    factor = exponential(1.3 * (leaf - 0.4) + 0.32 * clumps - 0.5 * (1.0 - gap))
    return Pattern(factor, smooth_step(leaf, 0.55, 0.95), leaf + 0.8 * clumps)


def needles() -> Pattern:
    """Needles of pines on twigs."""
    needle = strokes(9000, 311, length=0.07, lean=0.35, width=1, ground=0.03)
    clumps = fractal(4, 5, 312, gain=0.85)
    factor = exponential(1.3 * (needle - 0.35) + 0.34 * clumps)
    return Pattern(factor, smooth_step(needle, 0.4, 0.95), needle + 0.8 * clumps)


def fur() -> Pattern:
    """Hairs along v in tufts."""
    hairs = strokes(9000, 321, length=0.09, lean=0.16, width=1, ground=0.3)
    tufts = fractal(3, 6, 322, gain=0.85, stretch=2)
    return Pattern(exponential(0.75 * (hairs - 0.4) + 0.25 * tufts),
                   smooth_step(tufts, 0.2, 2.0), 0.6 * hairs + 0.5 * tufts)  # fmt: skip


def feathers() -> Pattern:
    """Rows of rounded feathers with quills."""
    middle, gap, name = cells(14, 331, 10)
    barbs = strokes(5000, 332, length=0.05, lean=0.25, width=1, ground=0.4)
    edge = 1.0 - smooth_step(gap - middle, 0.03, 0.25)
    factor = exponential(0.5 * (barbs - 0.4) + 0.45 * (name - 0.5) - 0.6 * edge)
    return Pattern(factor, edge, 1.0 - middle)


def cloth() -> Pattern:
    """Weave and folds."""
    weave = fractal(60, 2, 341, gain=1.0) + 0.5 * noise(128, 342, 8) + 0.5 * noise(8, 343, 128)
    folds = fractal(3, 5, 344, gain=0.75, stretch=2)
    return Pattern(exponential(0.10 * weave + 0.20 * folds), smooth_step(folds, 0.5, 2.0), folds)


def skin() -> Pattern:
    """Pores, wrinkles and blood below."""
    blood = fractal(3, 7, 351, gain=0.85)
    return Pattern(exponential(0.075 * blood), smooth_step(blood, 0.3, 2.5), 0.2 * blood)


def metal() -> Pattern:
    """Brushed along u, with soft reflections and scratches."""
    brushed = fractal(3, 6, 361, gain=0.95, stretch=16).T
    scratches = strokes(120, 362, length=0.2, width=1, ground=0.0)
    sheen = fractal(2, 4, 363, gain=0.7)
    factor = exponential(0.11 * brushed + 0.12 * sheen + 0.3 * scratches)
    return Pattern(factor, smooth_step(sheen, 0.3, 2.0), 0.1 * brushed)


def rust() -> Pattern:
    """Flakes of rust over what is left of the paint."""
    flakes = fractal(3, 7, 371, gain=0.85)
    pits, _, name = cells(40, 372)
    rusty = smooth_step(flakes, -0.5, 0.4)
    factor = exponential(0.25 * flakes + rusty * (0.5 * (name - 0.5) - 0.4 * pits))
    return Pattern(factor, rusty, flakes - 0.5 * pits * rusty)


def leather() -> Pattern:
    """Creased grain."""
    middle, gap, name = cells(48, 381)
    crease = 1.0 - smooth_step(gap - middle, 0.03, 0.25)
    rough = fractal(3, 6, 382, gain=0.9)
    factor = exponential(0.13 * rough - 0.5 * crease + 0.2 * (name - 0.5))
    return Pattern(factor, smooth_step(rough, 0.5, 2.0), 0.4 * rough - crease)


def scales() -> Pattern:
    """Overlapping rows of scales."""
    inside, name = courses(20, 24, (0.12, 0.16), salt=391)
    rough = fractal(3, 6, 392, gain=0.9)
    factor = exponential(0.45 * (name - 0.5) - 0.6 * (1.0 - inside) + 0.13 * rough)
    return Pattern(factor, smooth_step(rough, 0.5, 1.8), inside)


def spots() -> Pattern:
    """Soft patches of the second colour."""
    patches = fractal(4, 6, 401, gain=0.8)
    return Pattern(exponential(0.10 * patches), smooth_step(patches, -0.9, 0.9), 0.3 * patches)
