"""Things that bend or flicker: candle, flag, balloon, kite, rocket, and a ring that grows."""

from __future__ import annotations

import itertools
import math
from functools import partial
from itertools import pairwise

import numpy as np

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    CHROME,
    DARK,
    GLASS,
    GREY,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    Material,
    glowing,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose, fixed_noun, working_noun
from texvent.scenes.models.shapes import (
    Affine,
    ball,
    box,
    compose,
    fin,
    limb,
    moved,
    peak,
    plank,
    post,
    rod,
    shift,
    spike,
    turn_x,
    turn_y,
    turn_z,
)
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour, Texture

_BRIGHT: tuple[Colour, ...] = (RED, YELLOW, (0.05, 0.30, 0.60), (0.10, 0.42, 0.10))
KITE_TURN_RAD = 1.0
"""Turn of a kite's face from ahead, radians."""
_BLACK: Colour = (0.008, 0.008, 0.009)
_GROW_HZ = 0.5
_FOOT = ((0.0, 0.0, 0.001), (0.002, 0.002, 0.002))


def _flat(colour: Colour) -> Material:
    return Material(colour, texture=Texture.PLAIN)


def build_candle(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a candle, 25 cm, whose flame flickers; `colour` is its wax."""
    wax = Material(colour if colour is not None else (0.78, 0.70, 0.55))
    rigid = [
        post(CHROME, (0.0, 0.0, 0.008), (0.12, 0.12, 0.016)),
        post(wax, (0.0, 0.0, 0.10), (0.06, 0.06, 0.18)),
        post(Material(BLACK), (0.0, 0.0, 0.195), (0.005, 0.005, 0.02)),
    ]
    start = 2.0 * math.pi * fraction(seed, "flame")

    def articulate(pose: Pose) -> list[ModelPart]:
        t = pose.time_s
        tall = 0.055 + 0.006 * math.sin(23.0 * t + start) + 0.004 * math.sin(41.0 * t)
        lean = 0.006 * math.sin(9.0 * t + start)
        base, tip = (0.0, 0.0, 0.203), (lean, 0.6 * lean, 0.203 + tall)
        inner = (0.6 * lean, 0.4 * lean, 0.203 + 0.55 * tall)
        return [
            limb(glowing((1.0, 0.50, 0.10), 3.0), base, tip, 0.014),
            limb(glowing((1.0, 0.85, 0.45), 5.0), base, inner, 0.009),
        ]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def build_flag(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a flag that waves along -x from a pole of 4 m; `colour` is its cloth."""
    hue = paint(colour, seed, "cloth", (RED, (0.04, 0.14, 0.45)))
    cloth, band = Material(hue), Material(WHITE)
    rigid = [
        post(STEEL, (0.0, 0.0, 2.0), (0.07, 0.07, 4.0)),
        ball(Material(YELLOW), (0.0, 0.0, 4.03), (0.14, 0.14, 0.14)),
    ]
    start = 2.0 * math.pi * fraction(seed, "wave")
    pieces, long = 8, 1.6

    def articulate(pose: Pose) -> list[ModelPart]:
        parts: list[ModelPart] = []
        ends = []
        for index in range(pieces + 1):
            share = index / pieces
            wave = 0.34 * share**0.7 * math.sin(5.0 * pose.time_s + start - 6.0 * share)
            lift = 0.10 * share * math.sin(5.0 * pose.time_s + start + 1.0 - 4.0 * share)
            ends.append((-long * share, wave, 3.35 - 0.10 * share + lift))
        for a, b in pairwise(ends):
            for material, tall, thin in ((cloth, 1.0, 0.03), (band, 0.30, 0.04)):
                across, thick = (0.0, 0.0, tall), (0.0, thin, 0.0)
                parts.append(plank(material, a, b, chord=across, thickness=thick))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


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


def build_rocket(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an upright rocket, 10 m, whose flame flickers; `colour` is its nose and fins."""
    accent = Material(colour if colour is not None else RED)
    body = Material(WHITE)
    rigid = [
        post(body, (0.0, 0.0, 0.2), (1.8, 1.8, 6.0)),
        peak(accent, (0.0, 0.0, 4.3), (1.8, 1.8, 2.2)),
        post(accent, (0.0, 0.0, 0.6), (1.84, 1.84, 0.5)),
        ball(GLASS, (0.86, 0.0, 2.0), (0.3, 0.8, 0.8)),
        ball(GLASS, (0.0, -0.86, 2.0), (0.8, 0.3, 0.8)),
        peak(DARK, (0.0, 0.0, -2.95), (1.3, 1.3, 0.9)),
    ]
    for x, y in ((1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)):
        root, tip = (0.8 * x, 0.8 * y, -1.8), (2.0 * x, 2.0 * y, -3.4)
        thin = (-0.16 * y, 0.16 * x, 0.0)
        rigid.append(fin(accent, root, tip, chord=(0.0, 0.0, 2.2), thickness=thin))
    start = fraction(seed, "flame")

    def articulate(pose: Pose) -> list[ModelPart]:
        burst = math.sin(2.0 * math.pi * (7.0 * pose.time_s + start))
        long = 2.2 + 0.35 * burst
        outer, inner = glowing((1.0, 0.35, 0.03), 2.5), glowing((1.0, 0.80, 0.30), 4.0)
        return [
            spike(outer, (0.0, 0.0, -3.2), (0.0, 0.0, -3.2 - long), 0.62),
            spike(inner, (0.0, 0.0, -3.2), (0.0, 0.0, -3.2 - 0.6 * long), 0.40),
        ]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


def _grown(pose: Pose, least: float) -> float:
    """Size of what expands, from `least` to 1, again and again."""
    return least + (1.0 - least) * ((_GROW_HZ * pose.time_s) % 1.0)


def _ring_parts(skin: Material, pose: Pose) -> list[ModelPart]:
    """A ring of rods whose radius grows."""
    radius, count = 0.62 * _grown(pose, 0.12), 28
    points = [
        (0.0, radius * math.cos(turn), 0.65 + radius * math.sin(turn))
        for turn in (2.0 * math.pi * k / count for k in range(count + 1))
    ]
    return [limb(skin, start, end, 0.03) for start, end in itertools.pairwise(points)]


def _build_ring(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A ring that grows to 1.2 m, again and again; `colour` is its own."""
    skin = _flat(paint(colour, seed, "paint", (_BLACK,)))
    foot = box(skin, *_FOOT)
    return ArticulatedModel([foot], scale=scale, articulate=partial(_ring_parts, skin))


NOUNS = (
    fixed_noun("candle", build_candle, ("candle flame", "burning candle", "lit candle")),
    working_noun("flag", build_flag, ("flagpole",)),
    Noun("balloon", build_balloon, "air", 0.4, "float"),
    Noun("kite", build_kite, "air", 1.5, "fly"),
    Noun("rocket", build_rocket, "air", 8.0, "fly"),
    Noun(
        "expanding ring", _build_ring, "fixed", 0.0, "stand",
        ("expanding circle", "growing ring"), place="plain", is_working=True,
    ),
)  # fmt: skip
