"""Balls of sports, and what else rolls or turns in a game: marble, disc, coin-like things."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, checked, mottled
from texvent.scenes.models.objects.figures import (
    Draw,
    Motion,
    Moving,
    disc,
    lathe,
    nothing,
    placed,
    ring,
    rolling,
    spinning,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BRASS,
    INK,
    PALE,
    RED_PAINT,
    SILVER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart, Noun
from texvent.scenes.models.shapes import (
    Point,
    ball,
    blade,
    box,
    compose,
    limb,
    post,
    rod,
    spike,
    turn_x,
)
from texvent.scenes.scene import Colour


def _rolled(
    name: str,
    colours: tuple[Colour, ...],
    radius: float,
    speed_m_s: float,
    draw: Draw,
    same: tuple[str, ...] = (),
) -> Noun:
    """A ball that rolls without slipping; it is drawn around the origin."""
    return thing(
        name,
        colours,
        nothing,
        same,
        moving=(Moving(draw, rolling(radius)),),
        goes=("ground", "roll", speed_m_s),
    )


def _round(skin: Material, radius: float) -> ModelPart:
    return ball(skin, (0.0, 0.0, 0.0), (2 * radius, 2 * radius, 2 * radius))


def _hoops(
    skin: Material, radius: float, shifts: tuple[float, ...], axis: str = "x"
) -> list[ModelPart]:
    """Thin stripes around a ball: discs a little wider than it is there."""
    parts = []
    for along in shifts:
        wide = math.sqrt(max(radius * radius - along * along, 1e-9)) * 1.02
        half = 0.022 * radius
        ends: dict[str, tuple[Point, Point]] = {
            "x": ((along - half, 0.0, 0.0), (along + half, 0.0, 0.0)),
            "y": ((0.0, along - half, 0.0), (0.0, along + half, 0.0)),
            "z": ((0.0, 0.0, along - half), (0.0, 0.0, along + half)),
        }  # fmt: skip
        parts.append(rod(skin, *ends[axis], wide))
    return parts


def _american(skin: Material) -> list[ModelPart]:
    """A pointed ball with laces, lying."""
    return [
        ball(skin, (0.0, 0.0, 0.085), (0.17, 0.24, 0.17)),
        spike(skin, (0.0, 0.06, 0.085), (0.0, 0.145, 0.085), 0.068),
        spike(skin, (0.0, -0.06, 0.085), (0.0, -0.145, 0.085), 0.068),
        *(rod(PALE, (0.0, y, 0.085), (0.0, y + 0.012, 0.085), 0.069) for y in (0.075, -0.087)),
        box(PALE, (0.05, 0.0, 0.155), (0.012, 0.10, 0.012)),
        *(box(PALE, (0.05, y, 0.156), (0.04, 0.007, 0.012))
            for y in (-0.04, -0.02, 0.0, 0.02, 0.04)),
    ]  # fmt: skip


def _frisbee(skin: Material) -> list[ModelPart]:
    return [
        post(skin, (0.0, 0.0, 0.0), (0.25, 0.25, 0.022)),
        ball(skin, (0.0, 0.0, 0.008), (0.24, 0.24, 0.030)),
        post(PALE, (0.0, 0.0, 0.018), (0.13, 0.13, 0.01)),
        post(skin, (0.0, 0.0, 0.0185), (0.11, 0.11, 0.01)),
        box(PALE, (0.0, 0.0, 0.019), (0.09, 0.02, 0.0105)),
        # The hollow below, in the shade: told by its rim.
        post(toned(skin, 2.2), (0.0, 0.0, -0.008), (0.22, 0.22, 0.008)),
        post(toned(PALE, 1.2), (0.0, 0.0, -0.010), (0.13, 0.13, 0.008)),
        post(toned(skin, 2.2), (0.0, 0.0, -0.0105), (0.10, 0.10, 0.008)),
    ]  # fmt: skip


def _tilted(turns_hz: float) -> Motion:
    """Spinning about an axis that leans, as what is thrown flat does."""
    spin = spinning("z", turns_hz)
    return lambda pose: compose(turn_x(0.5), spin(pose))


def _top_parts(skin: Material) -> list[ModelPart]:
    return [
        spike(toned(skin, 0.5), (0.0, 0.0, 0.03), (0.0, 0.0, 0.0), 0.012),
        *lathe(skin, [(0.02, 0.02), (0.075, 0.085), (0.09, 0.08)], 7),
        post(toned(skin, 0.7), (0.0, 0.0, 0.10), (0.10, 0.10, 0.02)),
        post(Material(WOOD_BROWN), (0.0, 0.0, 0.13), (0.018, 0.018, 0.06)),
        *(box(hue, (0.05 * c, 0.05 * s, 0.0915), (0.045, 0.045, 0.004)) for hue, c,
            s in ((YELLOW_PAINT, 1, 0), (PALE, -1, 0), (YELLOW_PAINT, 0, 1), (PALE, 0, -1))),
    ]  # fmt: skip


_BRIGHT: tuple[Colour, ...] = ((0.55, 0.03, 0.02), (0.03, 0.15, 0.50), (0.05, 0.35, 0.08))

NOUNS = placed("indoor", (
    _rolled("bowling ball", ((0.02, 0.03, 0.10), (0.25, 0.02, 0.05)), 0.11, 4.0, lambda p: [
        _round(mottled(p.colour, contrast=0.3), 0.11),
        *(ball(PALE, (0.098 * c, y, z), (0.02, 0.024, 0.024)) for c, y,
            z in ((1.0, 0.02, 0.05), (1.0, -0.025, 0.05), (1.02, 0.0, 0.0)))]),
    _rolled("golf ball", (PALE.colour,), 0.0215, 3.0,
        lambda p: [_round(checked(p.colour, toned(p, 0.72).colour, 5.0), 0.0215)]),
    _rolled("baseball", (PALE.colour,), 0.037, 5.0,
        lambda p: [_round(p, 0.037), *_hoops(RED_PAINT, 0.037, (0.021, -0.021), "y")]),
    _rolled("volleyball", (PALE.colour,), 0.105, 3.0, lambda p: [
        _round(p, 0.105), *_hoops(Material((0.05, 0.15, 0.45)), 0.105, (0.05, 0.0, -0.05), "y"),
        *_hoops(YELLOW_PAINT, 0.105, (0.025, -0.025), "z")]),
    _rolled("billiard ball", ((0.50, 0.03, 0.02), (0.05, 0.12, 0.45), (0.75, 0.45, 0.02)), 0.0285,
        1.5, lambda p: [
        _round(p, 0.0285), *(disc(PALE, (0.0, 0.0), 0.012, 0.003, x) for x in (0.0262, -0.0262)),
        *(disc(INK, (0.0, 0.0), 0.005, 0.003, x) for x in (0.0268, -0.0268))],
        ("pool ball", "snooker ball", "cue ball")),
    _rolled("ping-pong ball", ((0.75, 0.40, 0.05), PALE.colour), 0.02, 2.0,
        lambda p: [_round(p, 0.02), *_hoops(toned(p, 0.7), 0.02, (0.0,), "y")],
        ("table tennis ball", "ping pong ball")),
    _rolled("marble", ((0.03, 0.20, 0.50), (0.05, 0.35, 0.15)), 0.008, 0.4,
        lambda p: [_round(p, 0.008), ball(PALE, (0.0, 0.003, 0.0), (0.0159, 0.005, 0.012)),
            ball(YELLOW_PAINT, (0.003, -0.002, 0.0), (0.012, 0.004, 0.0159))], ("glass marble",)),
    _rolled("hamster ball", ((0.40, 0.60, 0.70),), 0.09, 0.6,
        lambda p: [_round(checked(p.colour, toned(p, 0.7).colour, 2.4), 0.09)]),
    thing("american football", ((0.28, 0.10, 0.04),), _american),
    thing("shuttlecock", (PALE.colour,), lambda p: [
        ball(PALE, (0.0, 0.0, 0.013), (0.026, 0.026, 0.026)),
        post(RED_PAINT, (0.0, 0.0, 0.02), (0.0265, 0.0265, 0.004)),
        *(blade(toned(p, 0.8 if k % 2 else 1.0), (0.012 * c, 0.012 * s, 0.024),
            (0.034 * c, 0.034 * s, 0.090), chord=(-0.017 * s, 0.017 * c, 0.0),
            thickness=(0.002 * c, 0.002 * s, 0.0)) for k in range(14)
            for c, s in ((math.cos(k * math.tau / 14), math.sin(k * math.tau / 14)),)),
        *ring(RED_PAINT, (0.0, 0.0, 0.050), (0.021, 0.021), 0.0015, axis="z")],
        ("birdie", "badminton birdie")),
    thing("puck", (BLACKISH,),
        lambda p: [post(p, (0.0, 0.0, 0.0125), (0.076, 0.076, 0.025)),
            post(toned(p, 2.5), (0.0, 0.0, 0.0252), (0.05, 0.05, 0.001))], ("hockey puck",)),
    thing("frisbee", _BRIGHT, nothing, ("flying disc", "flying disk"),
        moving=(Moving(_frisbee, _tilted(2.0)),), goes=("air", "fly", 3.9)),
    thing("boomerang", (WOOD_BROWN,), nothing, moving=(Moving(lambda p: [
        limb(p, (-0.06, 0.0, 0.0), (0.10, 0.16, 0.0), 0.024),
        limb(p, (-0.06, 0.0, 0.0), (0.10, -0.16, 0.0), 0.024),
        box(YELLOW_PAINT, (-0.05, 0.0, 0.0), (0.02, 0.05, 0.05))], _tilted(2.0)),),
        goes=("air", "fly", 4.0)),
    thing("spinning top", _BRIGHT, nothing, ("whipping top", "top"),
        moving=(Moving(_top_parts, spinning("z", 3.57)),)),
    thing("gyroscope", (BRASS.colour,),
        lambda p: [post(INK, (0.0, 0.0, 0.01), (0.07, 0.07, 0.02)),
            post(INK, (0.0, 0.0, 0.03), (0.012, 0.012, 0.03)),
            *ring(SILVER, (0.0, 0.0, 0.10), (0.055, 0.055), 0.003, pieces=16),
            rod(SILVER, (0.0, 0.0, 0.045), (0.0, 0.0, 0.155), 0.003)],
        moving=(Moving(lambda p: [post(p, (0.0, 0.0, 0.10), (0.085, 0.085, 0.010)),
            *(box(INK, (0.025 * c, 0.025 * s, 0.1055), (0.014, 0.014, 0.002)) for c,
                s in ((1, 0), (-1, 0)))], spinning("z", 4.0)),)),
    thing("fidget spinner", _BRIGHT,
        lambda p: [post(SILVER, (0.0, 0.0, 0.007), (0.022, 0.022, 0.014))],
        moving=(Moving(lambda p: [
        part for i in range(3)
            for part in (limb(p, (0.0, 0.0, 0.006),
                (0.028 * math.cos(2.094 * i), 0.028 * math.sin(2.094 * i), 0.006), 0.006),
                post(p, (0.03 * math.cos(2.094 * i), 0.03 * math.sin(2.094 * i), 0.006),
                    (0.03, 0.03, 0.009)),
        post(INK, (0.03 * math.cos(2.094 * i), 0.03 * math.sin(2.094 * i), 0.006),
            (0.016, 0.016, 0.010)))], spinning("z", 3.0)),), same=("spinner",)),
    thing("yo-yo", _BRIGHT, lambda p: [rod(PALE, (0.0, 0.02, 0.03), (0.0, 0.02, 0.60), 0.002)],
        ("yoyo",), moving=(Moving(lambda p: [
        *(disc(p, (0.0, 0.03), 0.028, 0.013, x) for x in (0.009, -0.009)),
        *(disc(PALE, (0.010, 0.038), 0.007, 0.002, x) for x in (0.016, -0.016))],
        spinning("x", 1.9, (0.0, 0.0, 0.03))),)),
))  # fmt: skip
"""Nouns of balls and toys that spin."""
