"""A hand with a forearm: palm, five fingers with joints, and its gestures over time.

The motion of the gestures is in `data/hand_gestures.toml`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np

from texvent_scenes.models.materials import CLOTH_COLOURS, SKIN_TONES, Material, cloth, mix, skin
from texvent_scenes.models.people.activities import HAND_GESTURES, Track, motion_of, read_track
from texvent_scenes.models.protocol import ModelPart, Noun, Pose, choose, paint
from texvent_scenes.models.shapes import (
    Affine,
    ArticulatedModel,
    Point,
    ball,
    compose,
    limb,
    mixed,
    moved,
    shift,
    turn_about,
)
from texvent_scenes.models.tables import read_table
from texvent_scenes.rendered_scene import Colour

_FINGERS = (
    # Where it begins: left (towards the thumb), up; its three bones; its radius, m.
    (0.030, 0.052, (0.042, 0.026, 0.022), 0.0095),
    (0.010, 0.056, (0.046, 0.030, 0.024), 0.0098),
    (-0.011, 0.053, (0.042, 0.028, 0.023), 0.0093),
    (-0.030, 0.044, (0.033, 0.021, 0.020), 0.0083),
)
_JOINTS = (1.45, 1.75, 1.05)
"""Flexion of the joints of a finger in a fist, radians."""
_SPREAD = (0.22, 0.04, -0.12, -0.30)
_WRIST_Z = -0.055


@dataclass(frozen=True)
class HandShape:
    """One instant of a hand: a right hand, fingers up, its palm to the front."""

    bent: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    """Thumb, index, middle, ring and little finger: 0 = straight .. 1 = in the fist."""
    spread: float = 0.3
    """0 = fingers side by side .. 1 = apart."""
    roll: float = 0.0
    """Turn in the plane of the palm, to its left (as seen from the front: clockwise), radians."""
    pitch: float = 0.0
    """Fingers to the front, radians."""
    yaw: float = 0.0
    """About the forearm, radians."""
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Displacement of the whole hand: front, left, up, m."""


def find_shape(gesture: str, time_s: float) -> HandShape:
    """The shape of a gesture at a time, s; of an unknown one that of a hand at rest."""
    values = _find_track(gesture if gesture in HAND_GESTURES else "stand").at(time_s)
    return HandShape(**{name: numbers if name in _ROWS else numbers[0]
                        for name, numbers in values.items()})  # type: ignore[arg-type]  # fmt: skip


_ROWS = ("bent", "shift")


@cache
def _find_track(gesture: str) -> Track:
    return read_track(motion_of("hand_gestures", gesture))


def build_hand(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a right hand, 0.19 m, with a sleeve; the palm looks ahead. `colour` is its skin."""
    flesh = choose(seed, "skin", SKIN_TONES) if colour is None else colour
    sleeve = cloth(paint(None, seed, "sleeve", CLOTH_COLOURS))
    surface, nail = skin(flesh), skin(mix(flesh, (0.8, 0.55, 0.5), 0.5))

    def articulate(pose: Pose) -> list[ModelPart]:
        shape = _shape_at(pose)
        parts = [
            ball(surface, (0.0, 0.0, 0.002), (0.034, 0.088, 0.118)),
            ball(surface, (0.008, 0.028, -0.018), (0.034, 0.042, 0.062)),
        ]
        for index in range(4):
            parts += _draw_finger(index, shape, surface)
        parts += _draw_thumb(shape, surface)
        for part in parts[4::3][:4]:
            middle = part.to_body[:, 3]
            spot = (float(middle[0]) - 0.004, float(middle[1]), float(middle[2]))
            parts.append(ball(nail, spot, (0.008, 0.009, 0.012)))
        hand = moved(parts, _turned(shape))
        wrist = shift(*shape.shift)
        arm = [
            limb(surface, (0.0, 0.0, _WRIST_Z), (0.0, 0.0, -0.17), 0.027),
            limb(sleeve, (0.0, 0.0, -0.13), (0.0, 0.0, -0.28), 0.040),
        ]
        return [*moved(hand, wrist), *moved(arm, wrist)]

    def anchor(name: str, pose: Pose) -> Affine:
        shape = _shape_at(pose)
        if name == "ground":
            return np.eye(3, 4)
        return compose(shift(*shape.shift), compose(_turned(shape), shift(0.03)))

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True, anchor=anchor)


def _shape_at(pose: Pose) -> HandShape:
    shape = find_shape(pose.activity, pose.time_s)
    if pose.before is None:
        return shape
    between: HandShape = mixed(find_shape(pose.before, pose.time_s), shape, pose.share)
    return between


def _turned(shape: HandShape) -> Affine:
    """Rotation of the hand about the wrist; the forearm stays."""
    wrist: Point = (0.0, 0.0, _WRIST_Z)
    tilted = compose(turn_about("x", -shape.roll, wrist), turn_about("y", shape.pitch, wrist))
    return compose(tilted, turn_about("z", shape.yaw, wrist))


def _draw_finger(index: int, shape: HandShape, surface: Material) -> list[ModelPart]:
    left, up, bones, radius = _FINGERS[index]
    bent = shape.bent[index + 1]
    sideways = shape.spread * _SPREAD[index] * (1.0 - 0.9 * bent)
    here: Point = (0.0, left, up)
    angle, parts = 0.0, []
    for bone, joint in zip(bones, _JOINTS, strict=True):
        angle += joint * bent
        forward, rise = bone * math.sin(angle), bone * math.cos(angle)
        there = (
            here[0] + forward,
            here[1] + rise * math.sin(sideways),
            here[2] + rise * math.cos(sideways),
        )
        parts.append(limb(surface, here, there, radius))
        here = there
    return parts


def _draw_thumb(shape: HandShape, surface: Material) -> list[ModelPart]:
    """Two bones beside the palm; bent, they lie across it."""
    bent = shape.bent[0]
    out = 0.85 - 1.25 * bent + 0.15 * shape.spread
    ahead = 0.25 + 0.65 * bent
    here: Point = (0.006, 0.038, -0.022)
    parts = []
    for bone, radius, more in ((0.044, 0.0125, 0.0), (0.034, 0.0105, -0.75)):
        angle = out + more * bent
        there = (
            here[0] + bone * math.sin(ahead) * 0.8,
            here[1] + bone * math.sin(angle) * math.cos(0.5 * ahead),
            here[2] + bone * math.cos(angle) * math.cos(0.5 * ahead),
        )
        parts.append(limb(surface, here, there, radius))
        here = there
    return parts


NOUNS = tuple(
    Noun(name, build_hand, "air", 0.3, "float", tuple(row["names"]))
    for name, row in read_table("outfits")["hands"].items()
)
