"""Balls that roll, balloon, kite, cube and other simple solids, pendulum, spinning top."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    DARK,
    GREY,
    RED,
    WHITE,
    WOOD,
    YELLOW,
    Material,
    checked,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Affine,
    ball,
    box,
    compose,
    moved,
    rod,
    shift,
    spike,
    turn_x,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour

_BRIGHT: tuple[Colour, ...] = (RED, YELLOW, (0.05, 0.30, 0.60), (0.10, 0.42, 0.10))


@dataclass(frozen=True)
class BallLook:
    """Size and surface of a ball."""

    radius: float
    colours: tuple[Colour, ...]
    second_colour: Colour | None
    """None = a darker shade of the first."""
    seams: bool = False
    """Dark hoops, as on a basketball."""


BEACH_BALL = BallLook(0.25, _BRIGHT, WHITE)
FOOTBALL = BallLook(0.15, (WHITE,), BLACK)
BASKETBALL = BallLook(0.16, ((0.60, 0.16, 0.02),), None, seams=True)
TENNIS_BALL = BallLook(0.08, ((0.55, 0.70, 0.04),), None)


def build_ball(
    look: BallLook, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a ball that rolls on the ground below its middle without slipping."""
    first = paint(colour, seed, "colour", look.colours)
    second = look.second_colour if look.second_colour is not None else shade(first, 0.72)
    size = 2.0 * look.radius
    skin = Material(first) if look.seams else checked(first, second, 1.4)
    parts = [ball(skin, (0.0, 0.0, 0.0), (size, size, size))]
    if look.seams:
        hoop, thin = 1.006 * size, 0.06 * size
        parts += [
            rod(DARK, (0.0, 0.0, -0.5 * thin), (0.0, 0.0, 0.5 * thin), 0.5 * hoop),
            rod(DARK, (-0.5 * thin, 0.0, 0.0), (0.5 * thin, 0.0, 0.0), 0.5 * hoop),
        ]
    tilt = turn_z(2.0 * math.pi * fraction(seed, "turn"))
    parts = moved(parts, compose(turn_x(0.5), tilt))

    def articulate(pose: Pose) -> list[ModelPart]:
        roll = turn_y(pose.distance_m / look.radius)
        return moved(parts, compose(shift(z=look.radius), roll))

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_balloon(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a toy balloon on a string, about 1.3 m with the string."""
    skin = Material(paint(colour, seed, "colour", _BRIGHT))
    shine = Material(shade(skin.colour, 1.9))
    string = Material(GREY)
    body = [
        ball(skin, (0.0, 0.0, 0.32), (0.46, 0.46, 0.56)),
        spike(skin, (0.0, 0.0, 0.0), (0.0, 0.0, 0.14), 0.05),
        ball(shine, (0.09, -0.13, 0.42), (0.14, 0.14, 0.18)),
    ]
    start = 2.0 * math.pi * fraction(seed, "sway")

    def articulate(pose: Pose) -> list[ModelPart]:
        sway = math.sin(2.1 * pose.time_s + start)
        lag = math.sin(2.1 * pose.time_s + start - 1.0)
        knee, end = (0.05 * sway, 0.0, -0.3), (0.10 * lag, 0.0, -0.62)
        cord = [rod(string, (0.0, 0.0, 0.0), knee, 0.008), rod(string, knee, end, 0.008)]
        return [*moved(body, turn_y(0.06 * sway)), *cord]

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True)


KITE_TURN_RAD = 1.0
"""Turn of a kite's face from ahead, radians."""


def build_kite(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a diamond kite with a fluttering tail, about 1.2 m.

    Its face looks ahead and to the side, so that it is seen from either.
    """
    first = paint(colour, seed, "colour", _BRIGHT)
    second = YELLOW if first is not YELLOW else RED
    sail, other, spar = Material(first), Material(second), WOOD
    face = [
        moved([box(sail, (0.0, 0.0, 0.0), (0.02, 0.62, 0.62))], turn_x(0.25 * math.pi))[0],
        moved([box(other, (0.004, 0.0, 0.0), (0.02, 0.30, 0.30))], turn_x(0.25 * math.pi))[0],
        rod(spar, (0.02, 0.0, -0.44), (0.02, 0.0, 0.44), 0.012),
        rod(spar, (0.02, -0.44, 0.0), (0.02, 0.44, 0.0), 0.012),
    ]
    stretched = compose(turn_z(KITE_TURN_RAD), compose(shift(z=0.25), _stretch_z(1.25)))
    body = moved(face, stretched)
    start = 2.0 * math.pi * fraction(seed, "flutter")

    def articulate(pose: Pose) -> list[ModelPart]:
        parts = moved(body, turn_x(0.15 * math.sin(1.7 * pose.time_s + start)))
        last = (0.0, 0.0, -0.28)
        for index in range(4):
            wave = 0.10 * math.sin(6.0 * pose.time_s + start - 1.1 * index)
            here = (0.0, wave, -0.28 - 0.14 * (index + 1))
            parts.append(rod(spar, last, here, 0.008))
            parts.append(ball(sail if index % 2 else other, here, (0.03, 0.12, 0.06)))
            last = here
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True)


def _stretch_z(factor: float) -> Affine:
    return np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, factor, 0.0]])


NOUNS = (
    Noun("ball", partial(build_ball, BEACH_BALL), "ground", 2.0, "roll", ("beach ball",)),
    Noun(
        "football",
        partial(build_ball, FOOTBALL),
        "ground",
        4.0,
        "roll",
        ("soccer ball", "sports ball", "sport ball"),
    ),
    Noun("basketball", partial(build_ball, BASKETBALL), "ground", 3.0, "roll"),
    Noun("tennis ball", partial(build_ball, TENNIS_BALL), "ground", 5.0, "roll"),
    Noun("balloon", build_balloon, "air", 0.4, "float"),
    Noun("kite", build_kite, "air", 1.5, "fly"),
)
