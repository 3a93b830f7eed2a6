"""What activities need, drawn with the person: instruments, tools, balls and boards."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from types import MappingProxyType
from typing import Any

from texvent.scenes.models.materials import BLUE, ORANGE, RED, YELLOW, Material, striped
from texvent.scenes.models.people.outfit import draw_parts
from texvent.scenes.models.people.track import ease
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, rod
from texvent.scenes.models.tables import read_table

Draw = Callable[[float], Sequence[ModelPart]]


@dataclass(frozen=True)
class Prop:
    """Something that goes with a place of the body."""

    anchor: str
    """Place of `anchors.locate_anchor`; "ground" = body coordinates."""
    draw: Draw
    """Its shapes at a time, s, in the axes of that place, m."""
    nouns: tuple[str, ...] = ()
    """Nouns that are the same thing: where the scene shows one, the prop is left out."""
    is_own: bool = False
    """Whether it is drawn in place of a named one, not left out for it."""


_BASKETBALL = striped(ORANGE, (0.05, 0.03, 0.02), 2.0)
_BALL_M = 0.24
_DRIBBLE_HZ, _JUGGLE_HZ, _ROPE_HZ = 1.6, 1.1, 1.05
"""Bounces of a ball, rounds of a juggler's hand and turns of a rope per second: rates of the
activities."""


def _dribbled(time_s: float) -> list[ModelPart]:
    """Between the right hand and the ground: free flight after each bounce, pushed down again."""
    # The hand has it at the start of each cycle and is lowest in the middle, when it bounces.
    share = (time_s * _DRIBBLE_HZ) % 1.0
    height = 0.12 + 0.72 * abs(math.cos(math.pi * share)) ** 1.3
    return [ball(_BASKETBALL, (0.66, -0.30, height), (_BALL_M,) * 3)]


def _juggled(time_s: float) -> list[ModelPart]:
    """Three balls in turn from hand to hand, each in free flight half of the time."""
    parts = []
    for index, colour in enumerate((RED, YELLOW, BLUE)):
        cycle = (time_s * _JUGGLE_HZ + index / 1.5) / 2.0 % 1.0
        half, into = divmod(2.0 * cycle, 1.0)
        across = 0.22 * (1.0 if half < 1.0 else -1.0) * (1.0 - 2.0 * into)
        rise = 4.0 * into * (1.0 - into)
        parts.append(ball(Material(colour), (0.42, across, 1.14 + 0.62 * rise), (0.12,) * 3))
    return parts


def _skipping_rope(time_s: float) -> list[ModelPart]:
    """From hand to hand, backward over the head and forward below the feet at the top of a hop."""
    turn = 2.0 * math.pi * _ROPE_HZ * time_s
    c, s = math.cos(turn), math.sin(turn)
    points = []
    for step in range(13):
        along = -1.0 + step / 6.0
        bulge = 1.02 * (1.0 - along**2)
        points.append((0.12 + bulge * s, 0.48 * along, 0.98 - bulge * c))
    return [rod(Material(RED), a, b, 0.014) for a, b in pairwise(points)]


_SHOT_S, _IN_S = 0.75, 1.5
"""When a ball leaves the hands, and when it is in the basket, s."""
_HANDS, _BASKET = (0.36, 2.02), (2.52, 2.52)
"""Where it is then: ahead, up, m."""
_GRAVITY_M_S2 = 9.81


def _shot(time_s: float) -> list[ModelPart]:
    """In both hands, then in free flight into the basket, through it and down."""
    if time_s < _SHOT_S:
        low = ease(time_s, 0.05, 0.40) - ease(time_s, 0.42, 0.75)
        x, z = _HANDS[0], 1.36 - 0.16 * low + 0.66 * ease(time_s, 0.35, _SHOT_S)
    elif time_s < _IN_S:
        share = (time_s - _SHOT_S) / (_IN_S - _SHOT_S)
        arc = 0.5 * _GRAVITY_M_S2 * (_IN_S - _SHOT_S) ** 2 * share * (1.0 - share)
        x, z = (a + share * (b - a) for a, b in zip(_HANDS, _BASKET, strict=True))
        z += arc
    else:
        after = time_s - _IN_S
        x, z = _BASKET[0], _BASKET[1] - 1.5 * after - 0.5 * _GRAVITY_M_S2 * after**2
    return [ball(_BASKETBALL, (x, 0.0, max(z, 0.5 * _BALL_M)), (_BALL_M,) * 3)]


_MOVING: Mapping[str, Draw] = MappingProxyType(
    {
        "dribbled ball": _dribbled,
        "juggled balls": _juggled,
        "skipping rope": _skipping_rope,
        "shot ball": _shot,
    }
)
"""Shape → how it is drawn, if it moves in its place."""


def _read_prop(row: Mapping[str, Any]) -> Prop:
    draw = _MOVING.get(row["shape"], partial(_draw_still, row["shape"]))
    return Prop(row["at"], draw, tuple(row.get("nouns", ())), row.get("is_own", False))


def _draw_still(shape: str, _: float) -> Sequence[ModelPart]:
    return draw_parts("props", "shapes", shape)


PROPS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        activity: tuple(map(_read_prop, row["props"]))
        for activity, row in read_table("activities").items()
        if "props" in row
    }
)
"""Activity → what is drawn with it."""
HOLDS: Mapping[str, tuple[Prop, ...]] = MappingProxyType(
    {
        noun: tuple(
            prop
            for one in row["holds"]
            for prop in (PROPS[one["of"]] if "of" in one else (_read_prop(one),))
        )
        for noun, row in read_table("outfits")["people"].items()
        if "holds" in row
    }
)
"""Noun of a person → what it has with it, unless its act or the scene says otherwise."""


def list_props(activity: str, size: float = 1.0) -> tuple[Prop, ...]:
    """What comes with an activity; `size` is that of the body, relative to an adult."""
    return tuple(_scaled(prop, size) for prop in PROPS.get(activity, ()))


def _scaled(prop: Prop, size: float) -> Prop:
    """What the body stands at or wears is as large as the body; what a hand holds is not."""
    if size == 1.0 or prop.anchor not in ("ground", "torso"):
        return prop

    def draw(time_s: float) -> list[ModelPart]:
        return [part.at(size * part.to_body) for part in prop.draw(time_s)]

    return replace(prop, draw=draw)
