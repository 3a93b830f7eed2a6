"""Senses of turning: what "clockwise" and "counter-clockwise" are for a body.

About the vertical they are as seen from above; about any other axis as the default camera sees the
body, or as who looks at its front sees it.
"""

from __future__ import annotations

import math

import numpy as np

from texvent_scenes.models.protocol import Model, Pose
from texvent_scenes.spec.scene import Direction

CLOCKWISE = frozenset({"clockwise", "right"})
"""Directions of turning that are clockwise: a turn to the right is, as seen from above."""
_ANTICLOCKWISE = frozenset({"counter-clockwise", "left"})
_STEP_S, _LEAST = 0.004, 1e-6


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
