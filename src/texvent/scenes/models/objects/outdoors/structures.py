"""Buildings of one kind each, walls, gates, towers and what else is built outdoors."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing, mottled
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    disc,
    lathe,
    placed,
    ring,
    spinning,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BRASS,
    BRICK,
    BULB,
    DARK_WOOD,
    INK,
    IRON,
    LEAF,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    ROOF,
    STEELY,
    STONE,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    gable,
    moved,
    peak,
    plank,
    post,
    rod,
    shift,
    turn_z,
)
from texvent.scenes.scene import Colour

_STONES: tuple[Colour, ...] = ((0.40, 0.38, 0.35), (0.48, 0.42, 0.32))
_DARK = Material((0.03, 0.03, 0.035))
_PANE = Material((0.05, 0.07, 0.09))


def _rough(skin: Material) -> Material:
    return mottled(skin.colour, contrast=0.25, scale=6.0)


def _battlements(
    skin: Material, centre: Point, wide: float, count: int, thick: float
) -> list[ModelPart]:
    """A round row of merlons."""
    x, y, z = centre
    r = 0.5 * wide
    return [
        box(skin, (x + r * math.cos(a), y + r * math.sin(a), z + 0.4), (thick, thick, 0.8))
        for a in (2 * math.pi * k / count for k in range(count))
    ]


def _tower(
    skin: Material, x: float, y: float, wide: float, tall: float, cap: Material
) -> list[ModelPart]:
    """A round tower with a pointed roof."""
    return [
        post(skin, (x, y, 0.5 * tall), (wide, wide, tall)),
        post(toned(skin, 0.8), (x, y, tall), (1.15 * wide, 1.15 * wide, 0.08 * tall)),
        peak(cap, (x, y, 1.04 * tall + 0.5 * wide), (1.25 * wide, 1.25 * wide, wide)),
        box(_DARK, (x + 0.5 * wide, y, 0.72 * tall), (0.1, 0.12 * wide, 0.12 * tall)),
    ]


def _roof(skin: Material, size: Point, eaves: float) -> list[ModelPart]:
    """A gable roof whose ridge runs along x, with the triangle of the wall below it."""
    long, wide, rise = size
    return [
        plank(
            skin,
            (0.0, 0.56 * s * wide, eaves - 0.1 * rise),
            (0.0, -0.02 * s, eaves + rise + 0.1),
            chord=(long + 0.6, 0.0, 0.0),
            thickness=(0.0, 0.1, 0.14),
        )
        for s in (1.0, -1.0)
    ]


def _gabled(wall: Material, size: Point, rise: float) -> list[ModelPart]:
    """Walls with a triangle at the front (+x) and back."""
    long, wide, tall = size
    return [
        box(wall, (0.0, 0.0, 0.5 * tall), (long, wide, tall)),
        *moved([gable(wall, (0.0, 0.0, tall), (wide, long, rise))], turn_z(0.5 * math.pi)),
    ]


NOUNS = placed("grass", (
    thing("tower", _STONES,
        lambda p: [post(_rough(p), (0.0, 0.0, 7.0), (5.0, 5.0, 14.0)),
            post(_rough(toned(p, 0.85)), (0.0, 0.0, 14.2), (6.0, 6.0, 1.2)),
            *_battlements(_rough(p), (0.0, 0.0, 14.8), 5.4, 10, 0.9),
            box(_DARK, (2.45, 0.0, 1.3), (0.2, 1.4, 2.6)),
            *(box(_DARK, (2.45, 0.0, z), (0.2, 0.5, 1.4)) for z in (5.5, 8.5, 11.5))],
            ("stone tower",)),
    thing("lighthouse", (RED_PAINT.colour,),
        lambda p: [*(post(p if k % 2 else PALE, (0.0, 0.0, 1.5 + 3.0 * k),
            (5.4 - 0.45 * k, 5.4 - 0.45 * k, 3.0)) for k in range(6)),
            post(INK, (0.0, 0.0, 18.1), (4.4, 4.4, 0.3)),
            *ring(INK, (0.0, 0.0, 19.1), (2.1, 2.1), 0.06, axis="z", pieces=12),
            post(Material((0.55, 0.62, 0.60)), (0.0, 0.0, 19.4), (2.2, 2.2, 2.4)),
            peak(RED_PAINT, (0.0, 0.0, 21.4), (2.9, 2.9, 1.7)),
            ball(BULB, (0.0, 0.0, 19.6), (1.2, 1.2, 1.4)),
            box(_DARK, (2.65, 0.0, 1.2), (0.2, 1.2, 2.4)),
            *(box(_DARK, (2.3 - 0.08 * k, 0.0, 6.0 + 4.0 * k), (0.3, 0.6, 1.1)) for k in range(3))],
        ("light house",),
        moving=(Moving(lambda p: [ball(glowing((1.0, 0.92, 0.65), 5.0), (1.1, 0.0, 19.5),
            (0.3, 1.0, 1.2)), ball(glowing((1.0, 0.92, 0.65), 5.0), (-1.1, 0.0, 19.5),
            (0.3, 1.0, 1.2))], spinning("z", 0.2)),)),
    thing("water tower", (STEELY, (0.50, 0.52, 0.52)),
        lambda p: [*(rod(IRON, (3.2 * math.cos(a), 3.2 * math.sin(a), 0.0),
            (2.4 * math.cos(a), 2.4 * math.sin(a), 13.0), 0.22) for a in (0.4, 1.97, 3.54, 5.11)),
            *(rod(IRON, (2.9 * math.cos(a), 2.9 * math.sin(a), 2.0),
                (2.5 * math.cos(a + 1.57), 2.5 * math.sin(a + 1.57), 11.0), 0.06)
                for a in (0.4, 1.97, 3.54, 5.11)), post(IRON, (0.0, 0.0, 6.5), (0.7, 0.7, 13.0)),
                ball(p, (0.0, 0.0, 13.4), (6.8, 6.8, 4.0)),
                post(p, (0.0, 0.0, 15.2), (6.8, 6.8, 3.8)),
                peak(toned(p, 0.75), (0.0, 0.0, 18.2), (7.2, 7.2, 2.2)),
                *ring(IRON, (0.0, 0.0, 13.6), (3.7, 3.7), 0.1, axis="z", pieces=14)],
                ("water-tower",)),
    thing("church", ((0.66, 0.62, 0.54),),
        lambda p: [*_gabled(p, (16.0, 8.0, 6.5), 4.2), *_roof(ROOF, (16.0, 8.0, 4.2), 6.5),
            box(p, (8.0, 0.0, 7.5), (4.5, 4.5, 15.0)),
            peak(ROOF, (8.0, 0.0, 18.5), (6.0, 6.0, 7.5)),
            bar(BRASS, (0.0, 22.0), (0.0, 24.2), 0.22, 0.22, 8.0),
            bar(BRASS, (-0.6, 23.4), (0.6, 23.4), 0.22, 0.22, 8.0),
            box(Material((0.12, 0.05, 0.03)), (10.26, 0.0, 1.6), (0.1, 2.0, 3.2)),
            disc(PALE, (0.0, 11.0), 1.0, 0.2, 10.22), disc(_PANE, (0.0, 7.5), 1.0, 0.2, 10.22),
            *(box(_PANE, (-6.0 + 3.6 * k, 4.0 * s, 3.6), (1.1, 0.2, 3.0)) for k in range(4)
                for s in (1.0, -1.0)), bar(INK, (0.0, 11.0), (0.0, 11.8), 0.12, 0.1, 10.35),
                bar(INK, (0.0, 11.0), (0.5, 10.8), 0.12, 0.1, 10.35)]),
    thing("mosque", ((0.66, 0.62, 0.54),),
        lambda p: [box(p, (0.0, 0.0, 3.5), (12.0, 12.0, 7.0)),
            post(p, (0.0, 0.0, 7.6), (8.6, 8.6, 1.2)),
            ball(Material((0.10, 0.36, 0.32)), (0.0, 0.0, 8.4), (8.4, 8.4, 8.4)),
            rod(BRASS, (0.0, 0.0, 12.4), (0.0, 0.0, 14.4), 0.12),
            *(part for a in (1, -1) for b in (1, -1)
                for part in (post(p, (7.0 * a, 7.0 * b, 8.0), (1.5, 1.5, 16.0)),
                    post(p, (7.0 * a, 7.0 * b, 12.0), (2.3, 2.3, 0.5)),
                    peak(Material((0.10, 0.36, 0.32)), (7.0 * a, 7.0 * b, 17.4),
                        (1.8, 1.8, 3.0)))), box(_DARK, (6.0, 0.0, 2.0), (0.1, 2.2, 4.0)),
                        *(box(_PANE, (6.0, y, 3.5), (0.1, 1.0, 2.4)) for y in (-4.0, 4.0))]),
    thing("castle", _STONES,
        lambda p: [box(_rough(p), (0.0, 0.0, 4.0), (14.0, 16.0, 8.0)),
            *(part for a in (1, -1) for b in (1, -1)
                for part in _tower(_rough(p), 7.0 * a, 8.0 * b, 4.6, 11.0, ROOF)),
                *(box(_rough(p), (7.0, -5.0 + 1.7 * k, 8.5), (0.8, 0.9, 1.0)) for k in range(7)),
                box(_DARK, (7.02, 0.0, 2.0), (0.2, 3.0, 4.0)),
                disc(_DARK, (0.0, 4.0), 1.5, 0.2, 7.02),
                *_tower(_rough(p), -2.0, 0.0, 5.5, 15.0, ROOF),
                *(box(_DARK, (7.02, y, 5.6), (0.1, 0.5, 1.3)) for y in (-3.8, 3.8))],
                ("fortress",)),
    thing("hut", (PALE_WOOD, (0.40, 0.28, 0.14)),
        lambda p: [post(mottled(p.colour, contrast=0.3), (0.0, 0.0, 1.1), (3.4, 3.4, 2.2)),
            peak(mottled((0.42, 0.30, 0.10), contrast=0.4, scale=8.0), (0.0, 0.0, 3.0),
                (5.0, 5.0, 2.4)), box(_DARK, (1.66, 0.0, 0.85), (0.15, 0.9, 1.7)),
                *(rod(Material(DARK_WOOD), (2.1 * math.cos(a), 2.1 * math.sin(a), 0.0),
                    (2.1 * math.cos(a), 2.1 * math.sin(a), 2.1), 0.06)
                    for a in (0.6, 1.6, 2.6, 3.7, 4.7, 5.7))],
                    ("cottage hut",)),
    thing("log cabin", (WOOD_BROWN,),
        lambda p: [*(rod(mottled(p.colour, contrast=0.3), (-2.2, 2.4 * s, 0.2 + 0.36 * k),
            (2.2, 2.4 * s, 0.2 + 0.36 * k), 0.2) for k in range(6) for s in (1.0, -1.0)),
            *(rod(mottled(p.colour, contrast=0.3), (2.0, -2.6, 0.2 + 0.36 * k),
                (2.0, 2.6, 0.2 + 0.36 * k), 0.2) for k in range(6)),
                box(toned(p, 0.6), (0.0, 0.0, 1.1), (3.8, 4.7, 2.2)),
                *moved([gable(mottled(p.colour, contrast=0.3), (0.0, 0.0, 2.3), (5.0, 4.2, 1.7))],
                    turn_z(0.5 * math.pi)),
                    *_roof(Material((0.10, 0.09, 0.085)), (4.6, 5.2, 1.7), 2.3),
                    box(Material((0.12, 0.05, 0.03)), (2.2, 0.6, 0.95), (0.1, 0.9, 1.9)),
                    box(_PANE, (2.2, -1.2, 1.3), (0.1, 0.9, 0.8)),
                    box(STONE, (-1.2, 1.3, 3.2), (0.6, 0.6, 2.2))], ("wooden cabin",)),
    thing("igloo", (PALE.colour,),
        lambda p: [*lathe(p, [(0.0, 1.7), (0.8, 1.5), (1.4, 0.9), (1.65, 0.2)], 7),
            rod(p, (1.0, 0.0, 0.55), (2.4, 0.0, 0.55), 0.55),
            disc(_DARK, (0.0, 0.48), 0.42, 0.02, 2.41)]),
    thing("greenhouse", ((0.40, 0.52, 0.55),),
        lambda p: [*_gabled(p, (4.0, 3.0, 1.8), 1.2),
            *(part for x in (-2.0, -1.0, 0.0, 1.0, 2.0)
                for part in (*(bar(PALE, (1.5 * s, 0.0), (1.5 * s, 1.8), 0.07, 0.07, x)
                    for s in (1.0, -1.0)),
                    *(bar(PALE, (1.52 * s, 1.8), (0.0, 3.05), 0.07, 0.07, x)
                        for s in (1.0, -1.0)))),
                        bar(PALE, (-1.5, 0.9), (1.5, 0.9), 0.06, 0.06, 2.02),
                        bar(PALE, (0.0, 0.0), (0.0, 3.0), 0.06, 0.06, 2.02),
                        box(LEAF, (0.0, 0.9, 0.5), (3.0, 0.6, 0.8))], ("glasshouse",)),
    thing("doghouse", (RED_PAINT.colour, PALE_WOOD),
        lambda p: [*_gabled(p, (0.9, 0.8, 0.6), 0.4),
            *_roof(Material((0.10, 0.09, 0.09)), (0.6, 0.8, 0.42), 0.6),
            box(_DARK, (0.452, 0.0, 0.22), (0.01, 0.34, 0.44)),
            disc(_DARK, (0.0, 0.44), 0.17, 0.01, 0.453)], ("dog house", "kennel")),
    thing("birdhouse", (PALE_WOOD, RED_PAINT.colour),
        lambda p: [post(Material(DARK_WOOD), (0.0, 0.0, 0.6), (0.06, 0.06, 1.2)),
            *moved([*_gabled(p, (0.20, 0.22, 0.22), 0.12),
                *(plank(ROOF, (0.0, 0.14 * s, 0.19), (0.0, 0.0, 0.36), chord=(0.28, 0.0, 0.0),
                    thickness=(0.0, 0.02, 0.02)) for s in (1.0, -1.0)),
                    disc(_DARK, (0.0, 0.13), 0.035, 0.01, 0.10),
                    rod(Material(DARK_WOOD), (0.10, 0.0, 0.06), (0.16, 0.0, 0.06), 0.008)],
                    shift(z=1.2))], ("bird house", "nesting box", "nest box")),
    thing("stone bridge", _STONES,
        lambda p: [*(box(_rough(p), (-9.0 + 1.5 * k, 0.0, 2.0 + 1.4 * math.cos((k - 6) * 0.26)),
            (1.7, 4.0, 0.9)) for k in range(13)),
            *(box(_rough(toned(p, 0.8)),
                (-9.0 + 1.5 * k, 1.9 * s, 2.8 + 1.4 * math.cos((k - 6) * 0.26)), (1.7, 0.3, 0.8))
                for k in range(13) for s in (1.0, -1.0)),
                *(box(_rough(p), (9.0 * s, 0.0, 1.1), (2.4, 4.2, 2.2)) for s in (1.0, -1.0)),
                box(_rough(p), (0.0, 0.0, 1.4), (1.6, 3.8, 2.8))],
                ("arch bridge",)),
    thing("gate", (IRON.colour, WOOD_BROWN),
        lambda p: [*(box(BRICK, (0.0, 1.7 * s, 1.1), (0.5, 0.5, 2.2)) for s in (1.0, -1.0)),
            *(ball(STONE, (0.0, 1.7 * s, 2.35), (0.4, 0.4, 0.4)) for s in (1.0, -1.0)),
            *(bar(p, (-1.35 + 0.225 * k, 0.1),
                (-1.35 + 0.225 * k, 1.75 + 0.25 * math.cos(0.26 * (k - 6))), 0.04, 0.04)
                for k in range(13)), *(bar(p, (-1.4, z), (1.4, z), 0.06, 0.05)
                    for z in (0.25, 1.55))], ("iron gate", "garden gate")),
    thing("wall", (BRICK.colour, (0.40, 0.38, 0.35)),
        lambda p: [*(box(mottled(p.colour, contrast=0.3, scale=5.0),
            (0.0, -1.75 + 0.5 * k + 0.25 * (r % 2), 0.12 + 0.25 * r), (0.30, 0.47, 0.22))
            for r in range(6) for k in range(8 - r % 2)),
            box(Material((0.42, 0.40, 0.37)), (0.0, 0.0, 0.72), (0.26, 3.94, 1.44)),
            box(STONE, (0.0, 0.0, 1.53), (0.40, 4.1, 0.10))], ("brick wall", "stone wall")),
    thing("tunnel", _STONES,
        lambda p: [*(box(_rough(p), (0.0, 4.6 * s, 3.2), (8.0, 4.0, 6.4)) for s in (1.0, -1.0)),
            box(_rough(p), (0.0, 0.0, 5.8), (8.0, 5.3, 1.2)),
            box(mottled((0.06, 0.16, 0.04), scale=5.0), (0.0, 0.0, 6.6), (7.9, 13.4, 0.4)),
            *(bush for s in (1.0, -1.0) for bush in (
                ball(mottled((0.06, 0.16, 0.04), scale=5.0), (-1.0, 4.5 * s, 6.6), (5.0, 5.0, 2.4)),
                box(_rough(toned(p, 1.25)), (4.05 * s, 0.0, 5.7), (0.4, 6.2, 0.8)),
                box(_rough(toned(p, 1.25)), (4.05 * s, 2.85, 2.7), (0.4, 0.5, 5.4)),
                box(_rough(toned(p, 1.25)), (4.05 * s, -2.85, 2.7), (0.4, 0.5, 5.4))))],
                ("tunnel entrance", "underpass")),
    thing("column", ((0.62, 0.60, 0.55),),
        lambda p: [box(p, (0.0, 0.0, 0.1), (0.8, 0.8, 0.2)),
            post(p, (0.0, 0.0, 0.28), (0.7, 0.7, 0.16)),
            post(p, (0.0, 0.0, 1.7), (0.52, 0.52, 2.7)),
            *(rod(toned(p, 0.75), (0.255 * math.cos(a), 0.255 * math.sin(a), 0.4),
                (0.255 * math.cos(a), 0.255 * math.sin(a), 3.0), 0.022)
                for a in (0.524 * k for k in range(12))),
                post(p, (0.0, 0.0, 3.1), (0.66, 0.66, 0.2)),
                box(p, (0.0, 0.0, 3.28), (0.85, 0.85, 0.18))],
                ("pillar",)),
    thing("temple", ((0.62, 0.60, 0.55),),
        lambda p: [*(box(p, (0.0, 0.0, 0.2 + 0.3 * k), (12.0 - 0.8 * k, 9.0 - 0.8 * k, 0.4))
            for k in range(3)), *(post(p, (4.6, -3.0 + 1.5 * k, 3.2), (0.75, 0.75, 4.6))
                for k in range(5)), *(post(p, (4.6 - 2.2 * k, 3.0 * s, 3.2), (0.75, 0.75, 4.6))
                    for k in range(1, 5) for s in (1.0, -1.0)),
                    box(toned(p, 0.5), (-0.8, 0.0, 3.2), (8.0, 4.0, 4.6)),
                    box(p, (0.0, 0.0, 5.75), (11.0, 7.6, 0.6)),
                    *moved([gable(p, (0.0, 0.0, 6.0), (7.6, 10.6, 1.9))], turn_z(0.5 * math.pi)),
                    *_roof(ROOF, (10.8, 7.6, 1.9), 6.1)], ("greek temple",)),
    thing("arch", _STONES,
        lambda p: [*(box(_rough(p), (0.0, 3.2 * s, 3.5), (3.0, 2.6, 7.0)) for s in (1.0, -1.0)),
            box(_rough(p), (0.0, 0.0, 8.4), (3.2, 9.2, 3.0)),
            *ring(_rough(toned(p, 0.85)), (1.4, 0.0, 5.2), (2.0, 1.9), 0.35, span=(0.0, 180.0),
                pieces=8), box(_rough(toned(p, 1.2)), (0.0, 0.0, 7.0), (3.5, 9.4, 0.4)),
                box(_rough(toned(p, 1.2)), (0.0, 0.0, 10.0), (3.6, 9.8, 0.4))],
                ("triumphal arch", "archway")),
    thing("pier", (WOOD_BROWN,),
        lambda p: [*(box(mottled(p.colour, contrast=0.3), (-5.0 + 0.5 * k, 0.0, 1.0),
            (0.44, 2.4, 0.10)) for k in range(21)),
            *(rod(toned(p, 0.6), (x, 1.1 * s, -0.0), (x, 1.1 * s, 1.5), 0.11)
                for x in (-4.6, -1.5, 1.5, 4.6) for s in (1.0, -1.0))],
                ("dock", "jetty", "wharf", "boardwalk")),
    thing("water well", _STONES,
        lambda p: [*lathe(_rough(p), [(0.0, 0.65), (0.8, 0.62)], 2),
            post(_DARK, (0.0, 0.0, 0.802), (0.95, 0.95, 0.01)),
            *(bar(Material(DARK_WOOD), (0.6 * s, 0.0), (0.6 * s, 2.0), 0.1, 0.1)
                for s in (1.0, -1.0)),
                *(plank(ROOF, (0.75 * s, 0.0, 1.85), (0.0, 0.0, 2.45), chord=(0.0, 1.7, 0.0),
                    thickness=(0.06, 0.0, 0.06)) for s in (1.0, -1.0)),
                    rod(Material(PALE_WOOD), (0.0, -0.6, 1.45), (0.0, 0.6, 1.45), 0.07),
                    rod(PALE, (0.0, 0.0, 0.95), (0.0, 0.0, 1.45), 0.015),
                    post(Material(WOOD_BROWN), (0.0, 0.0, 1.0), (0.26, 0.26, 0.26))],
                    ("stone well", "wishing well")),
    thing("scaffold", (STEELY,),
        lambda p: [*(rod(p, (x, y, 0.0), (x, y, 4.4), 0.035) for x in (0.5, -0.5)
            for y in (-2.0, 0.0, 2.0)),
            *(rod(p, (x, -2.0, z), (x, 2.0, z), 0.03) for x in (0.5, -0.5)
                for z in (1.0, 2.1, 3.1, 4.2)),
                *(box(Material(PALE_WOOD), (0.0, 0.0, z), (0.95, 4.1, 0.05)) for z in (2.0, 4.1)),
                *(bar(p, (-2.0 + 2.0 * k, 0.1), (2.0 * k, 2.0), 0.05, 0.05, 0.52)
                    for k in range(2))], ("scaffolding",)),
    thing("oil rig", (RED_PAINT.colour, (0.75, 0.45, 0.02)),
        lambda p: [*(post(p, (7.0 * a, 7.0 * b, 5.0), (2.2, 2.2, 10.0)) for a in (1, -1)
            for b in (1, -1)), box(Material(STEELY), (0.0, 0.0, 11.0), (20.0, 20.0, 2.4)),
            box(PALE, (-5.0, 5.0, 14.5), (7.0, 8.0, 5.0)),
            *(rod(p, (4.0 + 3.0 * a, -3.0 + 3.0 * b, 12.0), (4.0, -3.0, 28.0), 0.4)
                for a in (1, -1) for b in (1, -1)),
                rod(IRON, (-6.0, -7.0, 12.0), (6.0, -13.0, 20.0), 0.5),
                post(p, (8.0, 8.0, 12.6), (7.0, 7.0, 0.5))], ("drilling platform", "oil platform")),
    thing("ruin", _STONES,
        lambda p: [*(box(_rough(p), (x, y, 0.5 * h), (0.8, 1.4, h)) for x, y,
            h in ((0.0, -2.8, 3.2), (0.0, -1.4, 2.2), (0.2, 1.4, 1.2), (0.0, 2.8, 4.0),
                (-1.6, 3.2, 2.4), (-3.0, 3.2, 1.2))),
                *(box(_rough(toned(p, 0.8)), (x, y, 0.25), (0.8, 0.6, 0.5)) for x,
                    y in ((1.2, 0.2), (1.8, -1.2), (1.0, 1.9))),
                    post(_rough(p), (-1.4, -0.5, 1.2), (0.7, 0.7, 2.4))], ("ruins",),
                    plurals=("ruins",)),
))  # fmt: skip
"""Nouns of what is built outdoors."""
