"""Patterns of grounds, walls, plants and animals, as tiles: colour, second colour, height."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from texvent_scenes.raycast.surfaces.fields import (
    SIDE,
    Field,
    cells,
    courses,
    exponential,
    fractal,
    grid,
    hashed,
    hashed_row,
    noise,
    smooth_step,
    strokes,
)


class Pattern(NamedTuple):
    """Tile of a material; all arrays are [SIDE, SIDE]."""

    factor: Field
    """Factor of the colour; its mean becomes 1."""
    share: Field
    """Share of the second colour, 0..1."""
    height: Field
    """Height in units of the material's relief."""


def variation() -> Pattern:
    """Patches of all sizes, of one colour."""
    return Pattern(exponential(0.30 * fractal(2, 7, 11, gain=0.95)), _half(), 0.0 * _half())


def asphalt() -> Pattern:
    """Stones in tar."""
    stones, _, name = cells(110, 21)
    rough = fractal(3, 6, 22, gain=0.9)
    bright = exponential(0.5 * (name - 0.5) + 0.17 * rough - 0.7 * smooth_step(stones, 0.3, 0.8))
    return Pattern(bright, smooth_step(name, 0.75, 0.95), 0.4 - stones + 0.2 * rough)


def cracked() -> Pattern:
    """Wear of a road: cracks, mended patches, stains, tracks."""
    _, _, patch = cells(5, 31)
    bent, gap, _ = cells(4, 32)
    fine, fine_gap, _ = cells(11, 33)
    wander = fractal(6, 5, 34)
    crack = 1.0 - smooth_step(gap - bent + 0.035 * wander, 0.005, 0.03)
    hair = 1.0 - smooth_step(fine_gap - fine + 0.05 * wander, 0.01, 0.06)
    hair = hair * smooth_step(noise(3, 35), 0.4, 1.0)
    stains = smooth_step(fractal(4, 4, 36), 1.0, 1.9)
    mended = smooth_step(patch, 0.78, 0.80)
    dark = 0.75 * crack + 0.5 * hair + 0.22 * mended + 0.25 * stains
    return Pattern(exponential(0.17 * fractal(3, 7, 37, gain=0.9) - dark), _half(), 0.0 * crack)


def grass() -> Pattern:
    """Blades over darker ground, in tufts."""
    blades = strokes(9000, 41, length=0.055, lean=0.6, width=2, ground=0.12)
    tufts = fractal(4, 5, 42, gain=0.85)
    factor = exponential(1.5 * (blades - 0.4) + 0.32 * tufts)
    return Pattern(factor, smooth_step(blades + 0.2 * tufts, 0.25, 0.95), blades + 0.3 * tufts)


def soil() -> Pattern:
    """Earth: crumbs, pebbles, damp patches."""
    crumbs, _, name = cells(44, 51)
    rough = fractal(3, 6, 52, gain=0.95)
    pebble = smooth_step(name, 0.86, 0.9) * (1.0 - smooth_step(crumbs, 0.32, 0.42))
    factor = exponential(0.26 * rough - 0.5 * smooth_step(crumbs, 0.35, 0.85) + 0.4 * pebble)
    return Pattern(factor, np.maximum(smooth_step(rough, 0.0, 1.8), pebble), rough + pebble)


def sand() -> Pattern:
    """Grains, wind ripples, dents of feet smoothed by wind, shells and weed."""
    grains = fractal(24, 4, 61, gain=1.0)
    hollows = fractal(3, 4, 62, gain=0.7)
    spots, _, chance = cells(26, 65)
    shells = (1.0 - smooth_step(spots, 0.10, 0.25)) * (smooth_step(chance, 0.8, 0.82) - 0.5)
    ripples = _ripples(22, 63)
    dents = _dents(8, 10, 66)
    factor = exponential(0.22 * grains + 0.10 * hollows + 0.16 * ripples - 0.45 * dents
                         - 0.5 * shells)  # fmt: skip
    height = 0.22 * grains + 1.1 * ripples + 1.5 * hollows - 4.0 * dents
    return Pattern(factor, smooth_step(ripples + hollows, -2.0, 2.0), height)


def leaves() -> Pattern:
    """A forest floor: fallen leaves, twigs, earth."""
    _, gap, name = cells(22, 81, 30)
    middle, _, other = cells(40, 82, 34)
    shade = 1.0 - smooth_step(gap, 0.45, 0.95)
    twigs = strokes(260, 83, length=0.16, width=3, ground=0.0)
    rough = fractal(4, 6, 84, gain=0.9)
    factor = exponential(
        0.75 * (name - 0.5) + 0.35 * (other - 0.5) + 0.28 * shade + 0.2 * rough + 0.45 * twigs
        - 0.45 * smooth_step(middle, 0.4, 0.9)
    )  # fmt: skip
    return Pattern(factor, smooth_step(name, 0.35, 0.75), 1.5 * shade + 0.5 * rough + twigs)


def snow() -> Pattern:
    """Drifts, ridges that the wind cuts, dents of feet, crusts."""
    drifts = fractal(2, 7, 91, gain=0.72)
    crusts = fractal(6, 6, 92, gain=0.95)
    ridges = _ripples(14, 93)
    dents = _dents(10, 13, 94)
    factor = exponential(0.15 * crusts + 0.10 * drifts + 0.14 * ridges - 0.40 * dents)
    height = drifts + 0.25 * crusts + 1.2 * ridges - 5.0 * dents
    return Pattern(factor, smooth_step(drifts + ridges, -2.0, 2.0), height)


def paving() -> Pattern:
    """Slabs of stone with joints, stains and chewing gum."""
    inside, name = courses(6, 6, (0.04, 0.04), is_staggered=True, salt=101)
    rough = fractal(4, 6, 102, gain=0.9)
    spots, _, chance = cells(18, 103)
    gum = (1.0 - smooth_step(spots, 0.10, 0.14)) * smooth_step(chance, 0.75, 0.78)
    factor = exponential(0.20 * rough + 0.45 * (name - 0.5) - 0.9 * (1.0 - inside) - 0.5 * gum)
    return Pattern(factor, name, inside + 0.1 * rough)


def tiles() -> Pattern:
    """Glazed tiles in two colours, with grout."""
    inside, name = courses(8, 8, (0.05, 0.05), is_staggered=False, salt=111)
    factor = exponential(0.07 * fractal(6, 6, 112, gain=1.0) + 0.12 * (name - 0.5)
                         - 0.55 * (1.0 - inside))  # fmt: skip
    column = np.floor(np.arange(256) / 32).astype(np.int64)
    checks = ((column[:, None] + column[None, :]) % 2).astype(np.float64)
    return Pattern(factor, checks, inside)


def boards() -> Pattern:
    """Floor boards with grain, knots and gaps."""
    inside, name = courses(2, 10, (0.004, 0.05), salt=121)
    grain = fractal(3, 6, 122, gain=0.9, stretch=1)
    rings = fractal(32, 3, 123, gain=0.8).T
    long_grain = _grain(124).T
    knots, _, chance = cells(7, 125)
    knot = (1.0 - smooth_step(knots, 0.06, 0.20)) * smooth_step(chance, 0.6, 0.65)
    factor = exponential(0.24 * long_grain + 0.10 * grain + 0.06 * rings + 0.4 * (name - 0.5)
                         - 0.8 * knot - 1.1 * (1.0 - inside))  # fmt: skip
    return Pattern(factor, name, inside + 0.05 * long_grain)


def carpet() -> Pattern:
    """Tufts of yarn, worn in places, with a woven lattice of rhombs."""
    tufts, _, name = cells(100, 131)
    rough = fractal(3, 7, 132, gain=0.95)
    x, y = grid()
    first = np.abs((9.0 * x + 6.0 * y) % 1.0 - 0.5)
    second = np.abs((9.0 * x - 6.0 * y) % 1.0 - 0.5)
    lines = 1.0 - smooth_step(np.minimum(first, second), 0.05, 0.09)
    factor = exponential(0.6 * (name - 0.5) - 0.5 * tufts + 0.2 * rough)
    return Pattern(factor, lines, 0.5 - tufts)


def water() -> Pattern:
    """Ripples and the sky that they mirror."""
    ripples = fractal(8, 5, 141, gain=0.8)
    glints = smooth_step(fractal(6, 5, 143, gain=0.8), 0.9, 1.9)
    return Pattern(exponential(0.35 * ripples), glints, ripples)


def _ripples(count: int, salt: int) -> Field:
    """Ridges across y that wind has made, that many per tile: they fork and fade."""
    ridges = noise(3, salt, count) + 0.7 * noise(5, salt + 1, count + count // 2)
    return np.asarray(ridges * (0.5 + 0.5 * smooth_step(noise(3, salt + 2), -1.0, 1.0)))


def _dents(columns: int, rows: int, salt: int) -> Field:
    """Dents as of feet, 0..1, in some of that many squares of a lattice."""
    middle, _, chance = cells(columns, salt, rows)
    ragged = middle + 0.05 * fractal(12, 4, salt + 5)
    return (1.0 - smooth_step(ragged, 0.12, 0.42)) * smooth_step(chance, 0.35, 0.75)


def _grain(salt: int) -> Field:
    """Strands along y, long against their width."""
    return fractal(3, 5, salt, gain=0.9, stretch=8)


def print_() -> Pattern:
    """Panels of headings, lines of letters and pictures."""
    rows, columns = np.indices((SIDE, SIDE))
    kind = hashed(columns // 64, rows // 64, 371)
    words = (rows % 8 < 5) & (hashed(columns // 3, rows // 8, 372) > 0.4)
    heading = (rows % 32 < 20) & (hashed(columns // 9, rows // 32, 373) > 0.3)
    pictured = smooth_step(fractal(8, 5, 374), -0.3, 0.3)
    ink = np.where(kind < 0.4, words, np.where(kind < 0.65, heading, pictured * (kind < 0.85)))
    inside = (columns % 64 >= 4) & (rows % 64 >= 4)
    return Pattern(exponential(0.05 * fractal(4, 5, 375)), ink * inside, 0.0 * ink)


def books() -> Pattern:
    """Spines side by side, each of one shade, with a title and bands across it."""
    ends = np.cumsum(1.0 + 2.0 * hashed_row(34, 411))
    place = (np.arange(SIDE) + 0.5) / SIDE * ends[-1]
    book = np.searchsorted(ends, place)
    starts = np.concatenate([[0.0], ends])
    gap = np.minimum(place - starts[book], ends[book] - place) < 0.18
    _, y = grid()
    shade, hue, middle = (hashed_row(34, salt)[book] for salt in (412, 413, 414))
    title = np.abs((3.0 * (y - middle)) % 1.0 - 0.5) < 0.13
    bands = np.abs((6.0 * (y - middle)) % 1.0 - 0.5) < 0.05
    light = 0.9 * title * (hue > 0.3) + 0.5 * bands * (hue < 0.6)
    factor = exponential(1.5 * (shade - 0.5) + light * (0.8 - shade) - 1.2 * gap)
    round_ = np.broadcast_to(1.0 - gap, (SIDE, SIDE))
    return Pattern(factor, np.broadcast_to(hue > 0.5, (SIDE, SIDE)).astype(float), round_)


def _half() -> Field:
    return np.full((256, 256), 0.5)


def worn() -> Pattern:
    """Paint, plastic, glass: almost even, with dirt and scratches."""
    scratches = strokes(60, 211, length=0.2, width=1, ground=0.0)
    dirt = fractal(3, 7, 212, gain=0.9)
    return Pattern(exponential(0.07 * dirt - 0.12 * scratches), 0.0 * dirt, 0.0 * dirt)


def paper() -> Pattern:
    """Fibres, of which a sensor with usual thresholds sees nothing."""
    fibres = fractal(16, 4, 213, gain=0.9, stretch=4)
    return Pattern(exponential(0.01 * fibres), 0.0 * fibres, 0.0 * fibres)


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
