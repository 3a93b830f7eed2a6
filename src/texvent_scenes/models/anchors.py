"""Anchors of a model for other things: named places, and the surface that carries what is on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import Affine, Point, bounds
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.rendered_scene import Shape

_ON_BOX: dict[str, Point] = {
    "mouth": (0.46, 0.0, 0.72), "right hand": (0.40, -0.20, 0.45), "left hand": (0.40, 0.20, 0.45),
    "hands": (0.48, 0.0, 0.45), "crown": (0.30, 0.0, 0.98), "face": (0.44, 0.0, 0.80),
    "head": (0.36, 0.0, 0.85), "neck": (0.30, 0.0, 0.70),
    "torso": (0.0, 0.0, 0.50), "seat": (0.0, 0.0, 0.30),
    "right foot": (0.40, -0.20, 0.05), "left foot": (0.40, 0.20, 0.05), "ground": (0.0, 0.0, 0.0),
}  # fmt: skip
"""Place → share of length, width and height of a box that stands on the ground."""


def locate(model: Model, name: str, pose: Pose) -> Affine:
    """Axes at a named place of a model.

    Args:
        model: any model.
        name: a place such as "right hand": those of the model, else of `_ON_BOX`.
        pose: of the model.

    Returns:
        [3, 4] map from the place's axes (x ahead, z up) to body coordinates, m. A model that names
        no places of its own has them at fixed shares of its box.
    """
    own = getattr(model, "anchor", None)
    axes = own(name, pose) if own is not None else None
    if axes is not None:
        return np.asarray(axes)
    along, across, up = _ON_BOX[name]
    low = -0.5 * model.height if getattr(model, "is_centred", False) else 0.0
    place = [along * model.length, across * model.width, low + up * model.height]
    return np.column_stack([np.eye(3), np.array(place)])


def has_places(model: Model) -> bool:
    """Whether a model names places of its own: a body with limbs."""
    own = getattr(model, "anchor", None)
    return own is not None and own("ground", Pose(0.0, 0.0, 0.0)) is not None


_GRID = 17
_REST = Pose(0.0, 0.0, 0.0, "stand")
_LEVEL_M = 0.03
_LEAST_SHARE = 0.12
"""Share of what the model covers that a level surface must have to count as one."""


@dataclass(frozen=True)
class Support:
    """A level surface of a model, body coordinates, m."""

    height: float
    low: tuple[float, float]
    """Least x and y."""
    high: tuple[float, float]
    """Greatest x and y."""

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle: x, y."""
        return 0.5 * (self.low[0] + self.high[0]), 0.5 * (self.low[1] + self.high[1])


_AHEAD = 0.5
"""Worth of room on the preferred side, as a share of its distance."""
_SEAT_BAND = (0.5, 1.7)
"""Heights that count as near a wanted one, in multiples of it."""


def find_support(model: Model, near_m: float | None = None) -> Support:
    """The largest level surface of a model that is open to above; on a ridge, its top.

    The model is looked at from above on a grid of 17 x 17 points; heights are collected in levels
    of 3 cm.

    Args:
        model: the model, at rest.
        near_m: height of the surface that is wanted, m; where no part of the model is about as
            high, the largest surface is taken.
    """
    parts = model.parts(_REST)
    xs = np.linspace(-0.48, 0.48, _GRID) * model.length
    ys = np.linspace(-0.48, 0.48, _GRID) * model.width
    x, y = (axis.ravel() for axis in np.meshgrid(xs, ys, indexing="ij"))
    tops = top_heights(parts, x, y)
    covered = np.isfinite(tops)
    if not covered.any():
        return Support(model.height, (0.0, 0.0), (0.0, 0.0))
    level = max(_LEVEL_M, 0.02 * model.height)
    bins = np.round(tops[covered] / level).astype(int)
    values, counts = np.unique(bins, return_counts=True)
    # Of two surfaces of about the same size the higher one is meant.
    sizes = counts * (1.0 + 0.25 * values / max(int(values.max()), 1))
    low, high = (share * (near_m or 0.0) for share in _SEAT_BAND)
    is_near = (values * level > low) & (values * level < high)
    best = int(np.argmax(np.where(is_near, sizes, 0.0) if is_near.any() else sizes))
    is_small = counts[best] < _LEAST_SHARE * covered.sum()
    if not is_near.any() and (is_small or values[best] * level < 0.1 * model.height):
        here = top_heights(parts, np.zeros(1), np.zeros(1))[0]
        height = float(here) if math.isfinite(here) else float(tops[covered].max())
        return Support(height, (0.0, 0.0), (0.0, 0.0))
    chosen = np.flatnonzero(covered)[np.abs(bins - values[best]) <= 1]
    return Support(
        float(np.max(tops[covered][bins == values[best]])),
        (float(x[chosen].min()), float(y[chosen].min())),
        (float(x[chosen].max()), float(y[chosen].max())),
    )


def find_room(
    parts: Sequence[ModelPart], under: Model, support: Support, ahead: tuple[float, float]
) -> tuple[float, float]:
    """Place on a support, near its middle, where bodies go into nothing that rises there.

    Args:
        parts: the bodies, at rest, about the place in the axes of `under`.
        under: the model of the support.
        support: its level surface.
        ahead: direction in which there is room rather than in others, in these axes.

    Returns:
        x and y in the coordinates of `under`, m; the middle where it is free, or no place is.
    """
    rising = _boxes(under.parts(_REST))
    edge = np.array([support.low, support.high])
    inside = (rising[:, 0, :2] > edge[0]) & (rising[:, 1, :2] < edge[1])
    rising = rising[inside.all(axis=1) & (rising[:, 1, 2] > support.height + _LEVEL_M)]
    if not len(rising):
        return support.middle
    own = _boxes(parts)
    own[..., 2] += support.height + 0.5 * _LEVEL_M - own[..., 2].min()
    foot = own[own[:, 0, 2] < own[:, 0, 2].min() + _LEVEL_M][..., :2]
    room = edge[0] - foot[:, 0].min(axis=0), edge[1] - foot[:, 1].max(axis=0)
    axes = [np.linspace(*ends, _GRID) for ends in zip(*room, strict=True)]
    spots = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    spots = np.vstack([support.middle, spots])
    lows, highs = (np.pad(spots, ((0, 0), (0, 1)))[:, None] + own[None, :, end] for end in (0, 1))
    meets = (lows[:, :, None] < rising[:, 1]) & (highs[:, :, None] > rising[:, 0])
    is_taken = meets.all(axis=-1).any(axis=(1, 2))
    off = spots - support.middle
    worth = np.linalg.norm(off, axis=1) - _AHEAD * off @ ahead
    best = int(np.argmin(np.where(is_taken, np.inf, worth))) if is_taken[0] else 0
    return float(spots[best, 0]), float(spots[best, 1])


def _boxes(parts: Sequence[ModelPart]) -> NDArray[np.float64]:
    """[n, 2, 3] least and greatest corners of parts, m."""
    return np.array([bounds([one]) for one in parts])


def top_heights(
    parts: Sequence[ModelPart], x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Height of the highest surface over points of the ground; -inf where there is none.

    Args:
        parts: shapes in body coordinates.
        x: [n] m.
        y: [n] m.

    Returns:
        [n] m. Cones count as the cylinders around them.
    """
    tops = np.full(x.shape, -np.inf)
    for part in parts:
        np.maximum(tops, _top(part.shape, part.to_body, x, y), out=tops)
    return tops


def _top(
    shape: Shape, to_body: Affine, x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.float64]:
    inverse = np.linalg.inv(to_body[:, :3])
    points = np.stack([x, y, np.zeros_like(x)]) - to_body[:, 3:]
    start, rise = inverse @ points, inverse[:, 2]
    low, high = np.full(x.shape, -np.inf), np.full(x.shape, np.inf)
    flat = {Shape.BOX: (0, 1, 2), Shape.CYLINDER: (2,), Shape.CONE: (2,)}.get(shape, ())
    for axis in flat:
        low, high = _cut_slab(start[axis], rise[axis], low, high)
    count = {Shape.ELLIPSOID: 3, Shape.CYLINDER: 2, Shape.CONE: 2}.get(shape, 0)
    if count:
        low, high = _cut_round(np.asarray(start[:count]), np.asarray(rise[:count]), low, high)
    return np.where(low <= high, high, -np.inf)


def _cut_slab(
    start: NDArray[np.float64], rise: float, low: NDArray[np.float64], high: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    if abs(rise) < 1e-12:
        outside = np.abs(start) > 1.0
        return np.where(outside, np.inf, low), high
    first, second = (-1.0 - start) / rise, (1.0 - start) / rise
    return np.maximum(low, np.minimum(first, second)), np.minimum(high, np.maximum(first, second))


def _cut_round(
    start: Affine,
    rise: Affine,
    low: NDArray[np.float64],
    high: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    a = float(np.sum(rise * rise))
    b, c = rise @ start, np.sum(start * start, axis=0) - 1.0
    if a < 1e-18:
        return np.where(c > 0.0, np.inf, low), high
    under = b * b - a * c
    root = np.sqrt(np.maximum(under, 0.0))
    entry = np.where(under < 0.0, np.inf, (-b - root) / a)
    return np.maximum(low, entry), np.minimum(high, (-b + root) / a)


class Rim(NamedTuple):
    """An opening to above of a model, body coordinates, m."""

    x: float
    height: float
    radius: float
    floor: float
    """Height of what a body comes to rest on behind it."""


def takes_in(noun: str) -> bool:
    """Whether what is kicked or thrown at it ends up in it: a bin, a goal."""
    return has_rim(noun) or noun in nouns_with("net")


def find_rim(noun: str, model: Model) -> Rim | None:
    """The rim of a noun, or of a container."""
    row, scale = trait_value("rim", noun), float(getattr(model, "scale", 1.0))
    if row is not None:
        return Rim(*(scale * one for one in row))
    hollow = trait_value("container", noun)
    if hollow is None or not has_rim(noun):
        return None
    long, wide, floor, *_ = hollow
    radius = 0.5 * min(long * model.length, wide * model.width)
    return Rim(0.0, model.height, radius, floor * model.height)


def has_rim(noun: str) -> bool:
    """Whether small things come down into it, which has no lid or is drawn without one."""
    is_closed = noun in nouns_with("lidded") and trait_value("drawn open", noun) is None
    known = trait_value("rim", noun) or trait_value("container", noun)
    return known is not None and not is_closed


@dataclass(frozen=True)
class Gripper:
    """Hand of a machine: a row of the trait "gripper"."""

    acts: tuple[str, ...]
    """Relations to what it handles."""
    reach: tuple[float, float]
    """Least and greatest shift to a height: rad or m."""
    turn: float
    """Shift between both places."""
    width: float
    """Greatest width of a thing, m."""
    is_below: bool = False
    """Whether the hand is below the thing, not about its middle."""
    bend: tuple[float, float] = (0.0, 0.0)
    """Least and greatest turn of the hand by which it reaches nearer or further, rad."""


def gripper_of(noun: str) -> Gripper:
    """The hand of a machine that has one."""
    return Gripper(**trait_values("gripper")[noun])


def grips(noun: str, relation: str) -> bool:
    """Whether a noun is a machine that does so to things."""
    return noun in trait_values("gripper") and relation in gripper_of(noun).acts
