"""Rows and arcs: places on the ground that lie on a line, and ways that lie on a circle."""

from __future__ import annotations

import math

import numpy as np

from texvent_scenes.rendered_scene import Float64Array

_STILL = 1e-3
"""Extent of a way that goes nowhere, m."""
_STRAY, _UNEVEN = 0.12, 2.0
"""Most departure of a row from its line, in gaps; most ratio of its gaps."""
_ROUND, _LEAST_ARC = 0.08, math.pi / 3.0
"""Most departure of a way from its circle, in radii; least angle of that circle that it covers."""


def is_in_line(places: Float64Array) -> bool:
    """Whether places on the ground, [n, 2] m, are on a line, at even gaps."""
    if len(places) < 2:
        return False
    off = places - places.mean(axis=0)
    _, _, axes = np.linalg.svd(off)
    gaps = np.diff(np.sort(off @ axes[0]))
    is_straight = np.abs(off @ axes[1]).max() <= _STRAY * gaps.mean()
    return bool(is_straight and gaps.max() <= _UNEVEN * gaps.min())


def is_arc(way: Float64Array) -> bool:
    """Whether a way on the ground, [t, 2] m, lies on a circle, and covers enough of it."""
    if np.ptp(way, axis=0).max() < _STILL:
        return False
    terms = np.column_stack([2.0 * way, np.ones(len(way))])
    x, y, rest = np.linalg.lstsq(terms, (way**2).sum(axis=1), rcond=None)[0]
    radius = math.sqrt(max(rest + x * x + y * y, 0.0))
    off = way - [x, y]
    angles = np.unwrap(np.arctan2(off[:, 1], off[:, 0]))
    strays = np.abs(np.linalg.norm(off, axis=1) - radius).max()
    return bool(strays <= _ROUND * radius and np.ptp(angles) >= _LEAST_ARC)
