"""Butterfly, bee, dragonfly, snake and snail."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    ORANGE,
    YELLOW,
    Material,
    mottled,
    shade,
    striped,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Point,
    ball,
    blade,
    limb,
    moved,
    turn_x,
)
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Insect:
    """Proportions of a flying insect, m."""

    body: tuple[float, float]
    """Length and thickness."""
    wings: tuple[tuple[float, float, float], ...]
    """For each pair: x of its root, its span, its chord."""
    flap_hz: float
    """Wing beats per second, at most 60: bees, flies and mosquitoes beat 200 to 600 times, which no
    frame rate of a clip shows."""
    flap: float
    colours: tuple[Colour, ...]
    """Of the wings (butterfly) or the body."""
    striped_body: bool = False
    clear_wings: bool = False
    legs: float = 0.0
    """Length of the hanging legs, where they show."""
    beak: float = 0.0


BUTTERFLY = Insect(
    (0.10, 0.018), ((0.015, 0.115, 0.10), (-0.03, 0.085, 0.085)), 8.0, 1.0,
    (ORANGE, (0.04, 0.18, 0.55), (0.75, 0.60, 0.08)),
)  # fmt: skip
BEE = Insect(
    (0.055, 0.032), ((0.006, 0.055, 0.026), (-0.008, 0.04, 0.02)), 60.0, 0.7,
    (YELLOW,), striped_body=True, clear_wings=True,
)  # fmt: skip
DRAGONFLY = Insect(
    (0.14, 0.013), ((0.045, 0.095, 0.026), (0.015, 0.09, 0.028)), 30.0, 0.5,
    ((0.04, 0.30, 0.35), (0.45, 0.06, 0.04)), clear_wings=True,
)  # fmt: skip


MOTH = Insect(
    (0.045, 0.016), ((0.008, 0.060, 0.046), (-0.012, 0.045, 0.040)), 20.0, 0.9,
    ((0.34, 0.27, 0.18), (0.42, 0.40, 0.35)),
)  # fmt: skip
FLY = Insect(
    (0.012, 0.006), ((0.001, 0.011, 0.005),), 60.0, 0.7,
    ((0.05, 0.05, 0.055), (0.03, 0.07, 0.05)), clear_wings=True, legs=0.006,
)  # fmt: skip
MOSQUITO = Insect(
    (0.009, 0.0016), ((0.0015, 0.0075, 0.0022),), 60.0, 0.5,
    ((0.10, 0.08, 0.06),), clear_wings=True, legs=0.010, beak=0.004,
)  # fmt: skip


def build_insect(
    kind: Insect, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a flying insect; `colour` is a butterfly's wings or another's body."""
    hue = paint(colour, seed, "colour", kind.colours)
    length, thick = kind.body
    body = Material(BLACK)
    if kind.striped_body:
        body = striped(hue, BLACK, 1.6)
    elif kind.clear_wings:
        body = Material(hue)
    wing = Material((0.62, 0.66, 0.70)) if kind.clear_wings else Material(hue)
    rigid = [
        limb(body, (-0.45 * length, 0.0, 0.0), (0.22 * length, 0.0, 0.0), 0.5 * thick),
        ball(Material(BLACK), (0.36 * length, 0.0, 0.0), (0.24 * length, 1.3 * thick, 1.1 * thick)),
    ]
    for side in (1.0, -1.0):
        start: Point = (0.44 * length, side * 0.2 * thick, 0.4 * thick)
        end: Point = (0.62 * length, side * 0.6 * thick, 0.9 * thick)
        rigid.append(limb(Material(BLACK), start, end, 0.02 * thick + 0.0005))
    rigid += _hang_legs(kind)
    phase = fraction(seed, "flap")

    def articulate(pose: Pose) -> list[ModelPart]:
        beat = math.sin(2.0 * math.pi * (kind.flap_hz * pose.time_s + phase))
        parts: list[ModelPart] = []
        for pair in kind.wings:
            for side in (1.0, -1.0):
                lift = side * (0.55 + kind.flap * beat)
                parts += moved(_wing(kind, wing, pair, side), turn_x(lift))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


def _hang_legs(kind: Insect) -> list[ModelPart]:
    """Six legs that hang, and what a mosquito stings with."""
    length, thick = kind.body
    dark, parts = Material(BLACK), []
    if kind.legs > 0.0:
        for x in (0.18, 0.0, -0.15):
            for side in (1.0, -1.0):
                root: Point = (x * length, side * 0.3 * thick, -0.3 * thick)
                knee = (1.8 * x * length, side * 0.6 * kind.legs, -0.2 * kind.legs)
                foot = (2.4 * x * length, side * 0.8 * kind.legs, -kind.legs)
                parts += [limb(dark, root, knee, 0.03 * kind.legs + 1e-4),
                          limb(dark, knee, foot, 0.02 * kind.legs + 1e-4)]  # fmt: skip
    if kind.beak > 0.0:
        nose = (0.46 * length, 0.0, 0.0)
        parts.append(limb(dark, nose, (nose[0] + kind.beak, 0.0, -0.6 * kind.beak), 2e-4))
    return parts


def _wing(
    kind: Insect, material: Material, pair: tuple[float, float, float], side: float
) -> list[ModelPart]:
    """A wing, and for a butterfly a dark rim under it and a pale spot on it."""
    x, span, chord = pair
    up = 0.035 * span
    root = (x, 0.0, up)
    lean = 0.35 * span if x > 0.0 else -0.45 * span
    tip = (x + (0.0 if kind.clear_wings else lean), side * span, up)
    thin = (0.0, 0.0, 0.026 * span)
    parts = [blade(material, root, tip, chord=(chord, 0.0, 0.0), thickness=thin)]
    if not kind.clear_wings:
        far = (1.10 * tip[0] - 0.10 * x, 1.10 * tip[1], up)
        wide, flat = (1.2 * chord, 0.0, 0.0), (0.0, 0.0, 0.013 * span)
        rim = blade(Material(BLACK), root, far, chord=wide, thickness=flat)
        spot = (0.4 * x + 0.6 * tip[0], 0.6 * tip[1], up)
        light = Material(shade(material.colour, 2.2))
        parts += [rim, ball(light, spot, (0.3 * chord, 0.3 * chord, 0.039 * span))]
    return parts


def build_snake(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a snake, 1.6 m, that slithers along its own track; `colour` is its skin."""
    hue = paint(colour, seed, "skin", ((0.12, 0.26, 0.05), (0.30, 0.16, 0.06)))
    skin = striped(hue, shade(hue, 0.4), 2.0)
    count, step, thick = 14, 0.12, 0.045

    def track(s: float) -> Point:
        return (s, 0.13 * math.sin(2.0 * math.pi * s / 0.75), 0.0)

    def articulate(pose: Pose) -> list[ModelPart]:
        # The body follows one wave fixed to the ground: every point passes the same places.
        parts = []
        for index in range(count):
            near, far = (0.84 - (index + k) * step for k in (0, 1))
            a, b = track(near + pose.distance_m), track(far + pose.distance_m)
            radius = thick * (1.0 - 0.75 * (index / count) ** 2)
            start, end = (near, a[1], radius), (far, b[1], radius)
            parts.append(limb(skin, start, end, radius))
        tip = track(0.84 + pose.distance_m)
        ahead = (0.92, tip[1], 1.1 * thick)
        parts.append(ball(skin, ahead, (0.20, 0.11, 0.09)))
        for side in (0.035, -0.035):
            parts.append(
                ball(Material(BLACK), (0.96, ahead[1] + side, 0.08), (0.022, 0.022, 0.022))
            )
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_snail(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a snail, 8 cm; `colour` is its shell."""
    hue = colour if colour is not None else (0.36, 0.17, 0.06)
    shell, body = striped(hue, shade(hue, 0.45), 3.0), mottled((0.40, 0.33, 0.22), contrast=0.2)
    start = 2.0 * math.pi * fraction(seed, "creep")
    rigid = [
        blade(shell, (-0.012, -0.020, 0.034), (-0.012, 0.020, 0.034), chord=(0.056, 0.0, 0.0),
              thickness=(0.0, 0.0, 0.056)),
        ball(Material(shade(hue, 0.5)), (-0.010, 0.0, 0.036), (0.022, 0.046, 0.022)),
    ]  # fmt: skip

    def articulate(pose: Pose) -> list[ModelPart]:
        creep = 0.004 * math.sin(2.0 * math.pi * pose.distance_m / 0.03 + start)
        parts = [
            ball(body, (0.0, 0.0, 0.008), (0.090 + creep, 0.030, 0.016)),
            limb(body, (0.030 + creep, 0.0, 0.010), (0.044 + creep, 0.0, 0.028), 0.010),
        ]
        for side in (0.006, -0.006):
            eye = (0.056 + creep, 1.6 * side, 0.052)
            parts.append(limb(body, (0.046 + creep, side, 0.032), eye, 0.002))
            parts.append(ball(Material(BLACK), eye, (0.006, 0.006, 0.006)))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


NOUNS = (
    Noun("butterfly", partial(build_insect, BUTTERFLY), "air", 0.8, "fly"),
    Noun("moth", partial(build_insect, MOTH), "air", 0.8, "fly"),
    Noun("housefly", partial(build_insect, FLY), "air", 0.8, "fly", ("house fly",)),
    Noun("mosquito", partial(build_insect, MOSQUITO), "air", 0.5, "fly"),
    Noun("bee", partial(build_insect, BEE), "air", 1.2, "fly", ("honeybee",)),
    Noun("dragonfly", partial(build_insect, DRAGONFLY), "air", 1.5, "fly"),
    Noun("snake", build_snake, "ground", 0.5, "walk"),
    Noun("snail", build_snail, "ground", 0.02, "walk"),
)
