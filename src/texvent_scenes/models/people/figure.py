"""A body between given joints: torso, head, arms, legs; named places on it; riders of cycles."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from texvent_scenes.models.materials import STEEL
from texvent_scenes.models.part_lines import Placed, read_parts
from texvent_scenes.models.people.outfit import ADULT, PersonKind, draw_parts, dress_person
from texvent_scenes.models.people.posture import (
    FOREARM,
    LOWER_ARM,
    NECK,
    Arm,
    Leg,
    Posture,
    Skeleton,
    solve,
)
from texvent_scenes.models.proportions import fill_in
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.models.shapes import (
    Affine,
    Point,
    limb,
    mixed,
    moved,
    point,
    rod,
    spike,
)
from texvent_scenes.models.surfaces import Painted
from texvent_scenes.models.tables import read_table

HEAD_SIZE = 0.23
"""Height of an adult's head, m."""
_UP = np.array([0.0, 0.0, 1.0])


def draw_figure(kind: PersonKind, outfit: Painted, joints: Skeleton) -> list[ModelPart]:
    """A whole person in the posture that the joints describe."""
    parts = moved(outfit.draw(_read_lines("torso")), joints.torso)
    parts += moved(_head(kind, outfit), joints.head)
    if kind.dress == "skirt":
        parts.append(_skirt(outfit, joints))
    for side in (0, 1):
        parts += _arm(outfit, joints.shoulders[side], joints.elbows[side], joints.hands[side])
    for side in (0, 1):
        parts += _leg(outfit, joints, side)
    for name in kind.garments:
        parts += moved(draw_parts("outfits", "garments", name), joints.torso)
    return parts


@cache
def _read_lines(name: str, head: float = 1.0, hair: float = 0.92) -> tuple[Placed, ...]:
    """Parts of `figure` in `data/outfits.toml`, for a head of that size, and that much hair."""
    sizes = {"size": HEAD_SIZE * head, "hair": hair}
    table = {**read_table("outfits")["figure"], "sizes": sizes}
    return read_parts(fill_in(table)[name])[0]


def _skirt(outfit: Painted, joints: Skeleton) -> ModelPart:
    """A cone from the chest down to the knees; of who sits it begins lower and is narrower."""
    hips = joints.torso[:, 3]
    knees = 0.5 * (np.array(joints.knees[0]) + np.array(joints.knees[1]))
    thigh = knees - hips
    level = float(np.linalg.norm(thigh[:2])) / max(float(np.linalg.norm(thigh)), 1e-9)
    level = max(level - 0.5, 0.0) * 2.0
    tip = joints.torso @ np.array([0.02, 0.0, 0.46 - 0.34 * level, 1.0])
    x, y, z = hips + 1.12 * thigh
    wide = 0.33 - 0.15 * level
    return spike(
        outfit.material("shirt"), (x, y, z), (float(tip[0]), float(tip[1]), float(tip[2])), wide
    )


def _head(kind: PersonKind, outfit: Painted) -> list[ModelPart]:
    """Neck, head, face, hair and hat above the base of the neck."""
    parts = outfit.draw(_read_lines("head", kind.head, 0.80 if kind.hat else 0.92))
    if kind.long_hair:
        parts += outfit.draw(_read_lines("long_hair"))
    if kind.hat:
        # From multiples of the head's height to metres.
        size = HEAD_SIZE * kind.head
        to_head = np.column_stack([size * np.eye(3), [0.01, 0.0, 0.09 + 0.5 * size]])
        hat = draw_parts("outfits", "hats", kind.hat, outfit.material("hat"))
        parts += moved(hat, to_head)
    return parts


def _arm(outfit: Painted, shoulder: Point, elbow: Point, palm: Point) -> list[ModelPart]:
    """Sleeve, forearm and hand; `palm` is the middle of the palm."""
    wrist = mixed(elbow, palm, FOREARM / LOWER_ARM)
    tips = mixed(elbow, palm, 1.16)
    return [
        limb(outfit.material("shirt"), shoulder, elbow, 0.055),
        limb(outfit.material("forearms"), elbow, wrist, 0.040),
        limb(outfit.material("hands"), wrist, tips, 0.042, side_radius=0.034),
    ]


def _leg(outfit: Painted, joints: Skeleton, side: int) -> list[ModelPart]:
    """Thigh, shin and shoe."""
    hip, knee, ankle = joints.hips[side], joints.knees[side], joints.ankles[side]
    heel, toe = (
        foot_point(ankle, joints.pitches[side], joints.heading, ahead) for ahead in (-0.05, 0.13)
    )
    return [
        limb(outfit.material("legs"), hip, knee, 0.085),
        limb(outfit.material("shins"), knee, ankle, 0.058),
        limb(outfit.material("shoes"), heel, toe, 0.044),
    ]


def foot_point(ankle: Point, pitch: float, heading: float, ahead: float) -> Point:
    """A point of the middle of the shoe, `ahead` m before the ankle."""
    along = ahead * math.cos(pitch) - 0.035 * math.sin(pitch)
    up = -ahead * math.sin(pitch) - 0.035 * math.cos(pitch)
    return (
        ankle[0] + along * math.cos(heading),
        ankle[1] + along * math.sin(heading),
        ankle[2] + up,
    )


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


_GEAR = 0.45
"""Turns of the pedals per turn of the wheels."""
_CRANK_M = 0.17


@dataclass(frozen=True)
class Rider:
    """Contact points of a rider on a cycle, m; the right hand and pedal mirror the left ones."""

    hips: Point
    neck: Point
    grip: Point
    crank: Point
    wheel: float
    """Radius of the wheels."""

    def draw(self, seed: int, distance_m: float) -> list[ModelPart]:
        """The rider and the pedals after a distance."""
        turn, legs, pedals = _GEAR * distance_m / self.wheel, [], []
        for side, phase in ((1.0, 0.0), (-1.0, math.pi)):
            ahead, up = (_CRANK_M * wave(turn + phase) for wave in (math.sin, math.cos))
            pedal = (self.crank[0] + ahead, side * self.crank[1], self.crank[2] + up)
            axle = (self.crank[0], side * (self.crank[1] - 0.03), self.crank[2])
            pedals.append(rod(STEEL, axle, pedal, 0.018))
            foot = (pedal[0] - 0.04, self.crank[1], pedal[2] + 0.10)
            legs.append(Leg(foot, (1.0, 0.0, 0.35), 0.15))
        x, y, z = self.grip
        left, right = (Arm((x, s * y, z + 0.02), (-0.3, 0.5, -1.0), True) for s in (1.0, -1.0))
        lean = math.atan2(self.neck[0] - self.hips[0], self.neck[2] - self.hips[2])
        posture = Posture(self.hips, lean, nod=-lean, left=left, right=right,
                          left_leg=legs[0], right_leg=legs[1])  # fmt: skip
        outfit = dress_person(ADULT, colour=None, seed=seed)
        return [*pedals, *draw_figure(ADULT, outfit, solve(posture))]


def read_rider(table: Mapping[str, Any]) -> Rider:
    """A rider from a noun's table.

    Raises:
        ValueError: a place is missing or no point.
    """
    wanted = ("hips", "neck", "grip", "crank")
    if set(table) != {*wanted, "wheel"}:
        raise ValueError(f"a rider has {', '.join(wanted)} and wheel, not {', '.join(table)}")
    hips, neck, grip, crank = (point(table[name]) for name in wanted)
    return Rider(hips, neck, grip, crank, float(table["wheel"]))
