"""Named places on a person at which things are held and worn."""

from __future__ import annotations

import numpy as np

from texvent.scenes.models.people.figure import HEAD_SIZE, foot_point
from texvent.scenes.models.people.posture import NECK, Skeleton
from texvent.scenes.models.shapes import Affine, Point

_UP = np.array([0.0, 0.0, 1.0])


def locate_anchor(name: str, joints: Skeleton, head: float = 1.0) -> Affine:
    """Axes at a named place of a body.

    Args:
        name: "right hand" (z along what it holds), "left hand", "hands" (between both),
            "crown" (top of the head), "face", "mouth", "neck", "torso" (origin at the hips),
            "seat", "ground", "right foot" or "left foot" (tip of the shoe).
        joints: the body.
        head: size of its head relative to an adult's.

    Returns:
        [3, 4] map from the place's axes (x ahead, y left, z up) to body coordinates.
    """
    if name in ("right hand", "left hand"):
        return _hand(name, joints)
    if name == "hands":
        middle = 0.5 * (np.array(joints.hands[0]) + np.array(joints.hands[1]))
        return _level(joints.torso[:, 0], middle)
    if name in ("right foot", "left foot"):
        side = 0 if name == "left foot" else 1
        tip = foot_point(joints.ankles[side], joints.pitches[side], joints.heading, 0.17)
        return _level(joints.torso[:, 0], np.array(tip))
    if name == "ground":
        return np.eye(3, 4)
    if name in _ON_HEAD:
        return _carried(joints.head, _ON_HEAD[name], head * HEAD_SIZE)
    return _carried(joints.torso, _ON_TORSO[name], 1.0)


_ON_HEAD: dict[str, Point] = {
    "crown": (0.03, 0.0, 0.95), "face": (0.50, 0.0, 0.55), "mouth": (0.52, 0.0, 0.24),
    "head": (0.05, 0.0, 0.5),
}  # fmt: skip
"""Places in multiples of the head's height above the middle of the neck."""
_ON_TORSO: dict[str, Point] = {
    "torso": (0.0, 0.0, 0.0), "seat": (0.0, 0.0, -0.10), "neck": (0.0, 0.0, NECK),
}  # fmt: skip


def _carried(axes: Affine, place: Point, size: float) -> Affine:
    offset = size * np.array(place)
    if size < 1.0:
        offset = offset + np.array([0.0, 0.0, 0.09])
    return np.column_stack([axes[:, :3], axes @ np.array([*offset, 1.0])])


def _hand(name: str, joints: Skeleton) -> Affine:
    side = 0 if name == "left hand" else 1
    palm = np.array(joints.hands[side])
    along = palm - np.array(joints.elbows[side])
    upright = np.array(joints.tool) if side == 1 else joints.torso[:, 2]
    upright = upright / np.linalg.norm(upright)
    ahead = along - (along @ upright) * upright
    if float(np.linalg.norm(ahead)) < 0.05:
        ahead = joints.torso[:, 0] - (joints.torso[:, 0] @ upright) * upright
    ahead = ahead / np.linalg.norm(ahead)
    return np.column_stack([ahead, np.cross(upright, ahead), upright, palm])


def _level(forward: Affine, origin: Affine) -> Affine:
    """Upright axes that face `forward`."""
    flat = np.array([forward[0], forward[1], 0.0])
    norm = float(np.linalg.norm(flat))
    flat = flat / norm if norm > 0.1 else np.array([1.0, 0.0, 0.0])
    return np.column_stack([flat, np.cross(_UP, flat), _UP, origin])
