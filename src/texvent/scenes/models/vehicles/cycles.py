"""Bicycle and motorcycle: with a rider who keeps hands and feet where they belong, or parked."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import bend
from texvent.scenes.models.materials import (
    CHROME,
    DARK,
    GLASS,
    HEADLIGHT,
    RED,
    STEEL,
    TAILLIGHT,
    Material,
)
from texvent.scenes.models.people.figure import draw_arm, draw_head, draw_leg, draw_torso
from texvent.scenes.models.people.outfit import ADULT, Outfit, PersonKind, dress_person
from texvent.scenes.models.people.posture import LOWER_ARM, UPPER_ARM
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Point, ball, box, rod
from texvent.scenes.models.variation import paint
from texvent.scenes.models.vehicles.wheels import Wheel, spoked_wheels, wheeled_model
from texvent.scenes.scene import Colour

_FRAMES: tuple[Colour, ...] = (RED, (0.04, 0.14, 0.45), (0.05, 0.30, 0.12))
_LEATHER: Colour = (0.035, 0.035, 0.04)
_MOTORCYCLIST = PersonKind(
    hair=_LEATHER, shirts=(_LEATHER,), trousers=_LEATHER, has_sleeves=True, gloves=_LEATHER
)
_GEAR = 0.45
"""Turns of the pedals per turn of the wheels."""


def build_bicycle(
    rider: PersonKind | None, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a bicycle with a rider who pedals, or alone; `colour` is its frame."""
    frame = Material(paint(colour, seed, "frame", _FRAMES))
    outfit = dress_person(rider or ADULT, colour=None, seed=seed)
    wheels = [Wheel((x, 0.0, 0.34), 0.34, 0.045) for x in (0.54, -0.54)]
    crank: Point = (-0.05, 0.0, 0.30)
    hips: Point = (-0.24, 0.0, 1.00)
    grip: Point = (0.44, 0.0, 1.02)
    rigid = [
        rod(frame, crank, (-0.22, 0.0, 0.88), 0.026),
        rod(frame, crank, (0.38, 0.0, 0.78), 0.028),
        rod(frame, (-0.19, 0.0, 0.78), (0.37, 0.0, 0.84), 0.026),
        rod(frame, (-0.54, 0.0, 0.34), crank, 0.022),
        rod(frame, (-0.54, 0.0, 0.34), (-0.19, 0.0, 0.78), 0.020),
        rod(frame, (0.54, 0.0, 0.34), (0.36, 0.0, 0.96), 0.026),
        rod(STEEL, (0.36, 0.0, 0.93), (grip[0], 0.0, grip[2]), 0.024),
        rod(STEEL, (grip[0], -0.26, grip[2]), (grip[0], 0.26, grip[2]), 0.018),
        *(
            rod(DARK, (grip[0], 0.14 * s, grip[2]), (grip[0], 0.27 * s, grip[2]), 0.024)
            for s in (1.0, -1.0)
        ),
        ball(DARK, (-0.24, 0.0, 0.91), (0.28, 0.15, 0.08)),
    ]
    if rider is not None:
        rigid += _upper_body(outfit, hips, (0.10, 0.0, 1.44), grip)

    def articulate(pose: Pose) -> list[ModelPart]:
        parts = spoked_wheels(wheels, pose.distance_m, is_open=rider is None)
        turn = _GEAR * pose.distance_m / 0.34
        for side, phase in ((1.0, 0.0), (-1.0, math.pi)):
            c, s = math.cos(turn + phase), math.sin(turn + phase)
            pedal: Point = (crank[0] + 0.17 * s, side * 0.11, crank[2] + 0.17 * c)
            parts.append(rod(STEEL, (crank[0], side * 0.08, crank[2]), pedal, 0.018))
            ankle = (pedal[0] - 0.04, pedal[1], pedal[2] + 0.10)
            if rider is not None:
                parts += draw_leg(outfit, (hips[0], side * 0.09, hips[2]), ankle, pitch=0.15)
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def build_motorcycle(
    rider: PersonKind | None, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a motorcycle with a rider in a helmet, or alone; `colour` is its tank."""
    tank = Material(paint(colour, seed, "frame", _FRAMES))
    wheels = [Wheel((x, 0.0, 0.33), 0.33, 0.16) for x in (0.76, -0.72)]
    hips: Point = (-0.30, 0.0, 0.86)
    grip: Point = (0.36, 0.0, 1.02)
    neck: Point = (0.10, 0.0, 1.30)
    rigid = [
        ball(tank, (0.12, 0.0, 0.80), (0.66, 0.32, 0.32)),
        ball(tank, (0.74, 0.0, 0.66), (0.56, 0.20, 0.14)),
        box(DARK, (-0.38, 0.0, 0.76), (0.62, 0.26, 0.12)),
        ball(tank, (-0.76, 0.0, 0.78), (0.50, 0.22, 0.18)),
        box(STEEL, (0.05, 0.0, 0.46), (0.52, 0.30, 0.36)),
        rod(CHROME, (0.10, -0.18, 0.32), (-0.85, -0.18, 0.36), 0.055),
        *(rod(CHROME, (0.76, y, 0.33), (0.44, y, 1.00), 0.035) for y in (0.12, -0.12)),
        rod(STEEL, (-0.72, 0.0, 0.33), (-0.10, 0.0, 0.45), 0.05),
        rod(DARK, (grip[0], -0.36, grip[2]), (grip[0], 0.36, grip[2]), 0.025),
        ball(HEADLIGHT, (0.60, 0.0, 0.88), (0.16, 0.22, 0.22)),
        ball(TAILLIGHT, (-1.00, 0.0, 0.78), (0.06, 0.16, 0.08)),
    ]
    if rider is None:
        return wheeled_model(rigid, wheels, scale)
    outfit = replace(dress_person(rider, colour=None, seed=seed), skin=DARK)
    rigid += [
        *_upper_body(outfit, hips, neck, grip, wide=0.30),
        ball(tank, (0.13, 0.0, 1.52), (0.30, 0.27, 0.31)),
        ball(GLASS, (0.19, 0.0, 1.53), (0.20, 0.25, 0.13)),
    ]
    for side in (1.0, -1.0):
        ankle = (-0.14, side * 0.20, 0.40)
        rigid += draw_leg(outfit, (hips[0], side * 0.12, hips[2]), ankle, pitch=0.1)
    return wheeled_model(rigid, wheels, scale)


def _upper_body(
    outfit: Outfit, hips: Point, neck: Point, grip: Point, *, wide: float = 0.24
) -> list[ModelPart]:
    """A rider bent over the handlebar."""
    parts = [*draw_torso(ADULT, outfit, hips, neck), *draw_head(ADULT, outfit, neck)]
    for side in (1.0, -1.0):
        shoulder = (neck[0], side * 0.19, neck[2] - 0.09)
        hand = (grip[0], side * wide, grip[2] + 0.02)
        elbow = bend(shoulder, hand, UPPER_ARM, LOWER_ARM, (-0.3, side * 0.5, -1.0))
        parts += draw_arm(outfit, shoulder, elbow, hand)
    return parts


NOUNS = (
    Noun(
        "bicycle", partial(build_bicycle, ADULT), "ground", 4.5, "drive",
        ("bike", "cyclist", "bicyclist", "pushbike"),
    ),
    Noun(
        "motorcycle", partial(build_motorcycle, _MOTORCYCLIST), "ground", 11.0, "drive",
        ("motorbike", "motorcyclist", "biker"),
    ),
    Noun("parked bicycle", partial(build_bicycle, None), "fixed", 0.0, "stand"),
    Noun("parked motorcycle", partial(build_motorcycle, None), "fixed", 0.0, "stand"),
)  # fmt: skip
