"""Senses of turning: what "clockwise" and "counter-clockwise" are for a body.

About the vertical they are as seen from above; about any other axis as the default camera sees the
body, or as who looks at its front sees it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from texvent_scenes.models.protocol import Model, ModelPart, Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.spec.scene import Direction

CLOCKWISE = frozenset({"clockwise", "right"})
"""Directions of turning that are clockwise: a turn to the right is, as seen from above."""
_ANTICLOCKWISE = frozenset({"counter-clockwise", "left"})
_STEP_S, _LEAST = 0.004, 1e-6
_AXES = {"roll": 0, "pitch": 1}
"""Channel of a turn about a horizontal axis → number of that axis."""
_ROUND, _FILLED = 0.97, 0.75
"""Least over greatest width of what is round; share of a body's width from which on its largest
round part tells where its middle is: what sticks out of it does not."""


class Axle(NamedTuple):
    """Horizontal axis about which a body turns or rolls."""

    height_m: float
    """Above its origin."""
    radius_m: float
    """Radius of the round part about it; of what has none, half its height."""
    reach_m: float
    """Most distance of any point from it."""


def axle_of(model: Model, axis: str) -> Axle:
    """The axle of a body at rest: the middle of its disc or ball, or of its box.

    Args:
        model: the body.
        axis: "roll", for an axle along its length, or "pitch", along its width.
    """
    along = _AXES[axis]
    across = [1 - along, 2]
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    low, high = bounds(parts)
    radius_m, middle = 0.5 * model.height, 0.5 * (low + high)
    middle[2] = low[2] + radius_m
    least = _FILLED * 0.5 * float((high - low)[across].max())
    found = [_round_part(one, along, across) for one in parts]
    radii = [one for one in found if one is not None and one[0] >= least]
    if radii:
        radius_m, middle = max(radii, key=lambda one: one[0])
    reach_m = max((_reach(one, middle, across) for one in parts), default=radius_m)
    return Axle(float(middle[2]), radius_m, reach_m)


def _round_part(
    part: ModelPart, along: int, across: Sequence[int]
) -> tuple[float, np.ndarray] | None:
    """Radius and middle of a ball, or of a disc about the axis; None: it is neither."""
    linear, middle = part.to_body[:, :3], part.to_body[:, 3]
    if part.shape is Shape.ELLIPSOID:
        widths = np.linalg.norm(linear, axis=1)[list(across)]
    elif part.shape is Shape.CYLINDER:
        if abs(linear[along, 2]) < _ROUND * np.linalg.norm(linear[:, 2]):
            return None
        widths = np.linalg.norm(linear[:, :2], axis=0)
    else:
        return None
    return (float(widths.max()), middle) if widths.min() >= _ROUND * widths.max() else None


def _reach(part: ModelPart, axle: np.ndarray, across: Sequence[int]) -> float:
    """Most distance of a part from an axle."""
    linear, off = part.to_body[list(across), :3], (part.to_body[:, 3] - axle)[list(across)]
    if part.shape is Shape.ELLIPSOID:
        return float(np.linalg.norm(off) + np.linalg.norm(linear, 2))
    if part.shape is Shape.CYLINDER and np.linalg.norm(linear[:, 2]) < 1e-6:
        return float(np.linalg.norm(off) + np.linalg.norm(linear[:, :2], 2))
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return float(np.linalg.norm(off + corners @ linear.T, axis=1).max())


def spin_sign(direction: Direction | None, axis: str, yaw: float) -> float:
    """Sign of a spin in its channel: 1 is usual.

    Args:
        direction: what is said.
        axis: "yaw", "roll" of what shows its front, or "pitch" of a wheel.
        yaw: heading of the body, radians.
    """
    sign = -1.0 if direction in CLOCKWISE else 1.0
    if axis == "pitch" and direction in CLOCKWISE | _ANTICLOCKWISE and math.cos(yaw) >= 0.0:
        return -sign  # its axle points away from the camera
    return sign


def work_sign(direction: Direction | None, model: Model) -> float:
    """Sign of the time of a thing that works: 1 is usual, -1 runs backwards.

    What turns about its front or the vertical does so in the sense that is said, a clock too; a
    belt runs backwards for "clockwise".
    """
    if direction not in ("clockwise", "counter-clockwise"):
        return 1.0
    said = -1.0 if direction == "clockwise" else 1.0
    return said * _own_sense(model)


def _own_sense(model: Model) -> float:
    """1 of what turns anticlockwise of itself, seen from above or from its front, else -1."""
    first, later = (model.parts(Pose(at_s, 0.0, 0.0, "move")) for at_s in (0.0, _STEP_S))
    fastest = np.zeros(3)
    for one, other in zip(first, later, strict=True):
        a, b = (each.to_body[:, :3] / np.linalg.norm(each.to_body[:, :3], axis=0)
                for each in (one, other))  # fmt: skip
        turn = b @ a.T
        axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
        if np.linalg.norm(axis) > np.linalg.norm(fastest) + _LEAST:
            fastest = axis
    along = fastest[[0, 2]]
    return -1.0 if along[int(np.argmax(np.abs(along)))] < -_LEAST else 1.0
