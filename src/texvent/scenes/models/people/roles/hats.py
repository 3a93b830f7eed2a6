"""What is on a head: hats, helmets, hoods, veils, hair and beards.

Drawn in the head's axes: origin at the base of the neck, x ahead, z up; the hat's paint is given.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

from texvent.scenes.models.materials import (
    BLACK,
    CHROME,
    DARK,
    RED,
    STEEL,
    WHITE,
    YELLOW,
    Material,
    cloth,
    shade,
)
from texvent.scenes.models.people.roles.robot_shell import draw_robot_head
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, blade, box, limb, peak, post, rod, spike

HEAD_SIZE = 0.23
"""Height of an adult's head, m."""
HatDraw = Callable[[Material, float], Sequence[ModelPart]]
"""Paint and height of the head, m → parts."""

_WHITE, _BLACK = cloth(WHITE), Material(BLACK)
_GOLD = Material((0.62, 0.40, 0.05))
_VISOR = Material((0.03, 0.04, 0.06))


def _at(size: float, x: float, y: float, z: float) -> Point:
    """A place in multiples of the head's height from the middle of the head."""
    return (0.01 + x * size, y * size, 0.09 + (0.5 + z) * size)


def _ball(skin: Material, size: float, place: Point, extent: Point) -> ModelPart:
    x, y, z = extent
    return ball(skin, _at(size, *place), (x * size, y * size, z * size))


_BRIM = 0.42
"""Height of a brim, in multiples of the head's height."""


def _brimmed(wide: Point, crown: Point, band: Material) -> HatDraw:
    """A crown on a flat brim; extents in multiples of the head's height."""

    def draw(skin: Material, size: float) -> list[ModelPart]:
        x, y, z = (size * each for each in crown)
        return [
            _ball(skin, size, (0.0, 0.0, _BRIM), wide),
            post(skin, _at(size, -0.02, 0.0, _BRIM + 0.5 * crown[2]), (x, y, z)),
            post(band, _at(size, -0.02, 0.0, _BRIM + 0.12), (1.04 * x, 1.04 * y, 0.11 * size)),
        ]

    return draw


def _shell(
    low: float, shade: float = 1.2, *more: Callable[[Material, float], ModelPart]
) -> HatDraw:
    """A round helmet whose middle is `low` above that of the head."""

    def draw(skin: Material, size: float) -> list[ModelPart]:
        shell = _ball(skin, size, (-0.03, 0.0, low), (shade, 1.08, 0.95))
        return [shell, *(one(skin, size) for one in more)]

    return draw


def _visor(deep: float, skin: Material | None = None) -> Callable[[Material, float], ModelPart]:
    """The peak of a cap, over the eyes."""
    return lambda paint, size: _ball(
        skin or paint, size, (0.46 + 0.5 * deep, 0.0, 0.24), (deep + 0.5, 0.72, 0.09)
    )


def _glass(skin: Material, tall: float = 0.26) -> Callable[[Material, float], ModelPart]:
    """Goggles or a visor before the eyes."""
    return lambda _, size: box(
        skin, _at(size, 0.42, 0.0, 0.06), (0.30 * size, 0.80 * size, tall * size)
    )


def _toque(skin: Material, size: float) -> list[ModelPart]:
    x, y, z = _at(size, -0.03, 0.0, 0.66)
    puffs = [(math.cos(a), math.sin(a)) for a in (0.0, 1.57, 3.14, 4.71)]
    return [
        post(skin, (x, y, z), (0.92 * size, 0.88 * size, 0.62 * size)),
        *(
            ball(
                skin,
                (x + 0.26 * size * c, 0.28 * size * s, z + 0.36 * size),
                (0.72 * size, 0.72 * size, 0.46 * size),
            )
            for c, s in puffs
        ),
    ]


def _peaked(skin: Material, size: float) -> list[ModelPart]:
    return [
        post(skin, _at(size, -0.01, 0.0, 0.34), (0.98 * size, 0.90 * size, 0.22 * size)),
        post(skin, _at(size, 0.0, 0.0, 0.50), (1.28 * size, 1.16 * size, 0.13 * size)),
        _visor(0.16, _BLACK)(skin, size),
        _ball(_GOLD, size, (0.50, 0.0, 0.40), (0.10, 0.18, 0.20)),
    ]


def _fire_helmet(skin: Material, size: float) -> list[ModelPart]:
    return [
        _ball(skin, size, (-0.02, 0.0, 0.30), (1.10, 1.00, 0.92)),
        _ball(skin, size, (-0.14, 0.0, 0.26), (1.90, 1.30, 0.12)),
        limb(Material(YELLOW), _at(size, -0.45, 0.0, 0.55), _at(size, 0.42, 0.0, 0.60), 0.03),
        box(Material(YELLOW), _at(size, 0.50, 0.0, 0.46), (0.08 * size, 0.34 * size, 0.36 * size)),
    ]


def _crown(_: Material, size: float) -> list[ModelPart]:
    parts: list[ModelPart] = [
        post(_GOLD, _at(size, -0.02, 0.0, 0.46), (0.94 * size, 0.86 * size, 0.22 * size))
    ]
    for turn in range(8):
        x, y = 0.44 * math.cos(0.785 * turn), 0.40 * math.sin(0.785 * turn)
        base, tip = _at(size, x - 0.02, y, 0.52), _at(size, 1.15 * x - 0.02, 1.15 * y, 0.86)
        parts += [spike(_GOLD, base, tip, 0.15 * size), ball(Material(RED), tip, (0.03,) * 3)]
    return parts


def _bubble(_: Material, size: float) -> list[ModelPart]:
    """The helmet of a space suit."""
    suit = Material(WHITE)
    return [
        _ball(suit, size, (-0.04, 0.0, 0.02), (1.75, 1.70, 1.72)),
        _ball(Material((0.30, 0.18, 0.03)), size, (0.30, 0.0, 0.06), (1.22, 1.34, 1.06)),
        post(
            Material((0.4, 0.4, 0.42)),
            _at(size, -0.02, 0.0, -0.72),
            (1.3 * size, 1.3 * size, 0.2 * size),
        ),
    ]


def _hood(skin: Material, size: float) -> list[ModelPart]:
    return [
        _ball(skin, size, (-0.15, 0.0, 0.06), (1.05, 1.08, 1.36)),
        _ball(skin, size, (-0.16, 0.0, -0.50), (1.30, 1.60, 0.70)),
    ]


def _diver(skin: Material, size: float) -> list[ModelPart]:
    return [
        *_hood(_BLACK, size)[:1],
        _glass(Material((0.08, 0.28, 0.36)), 0.36)(skin, size),
        rod(
            Material((0.7, 0.4, 0.0)),
            _at(size, 0.40, 0.42, -0.25),
            _at(size, -0.1, 0.52, 0.85),
            0.014,
        ),
        _ball(_BLACK, size, (0.52, 0.0, -0.26), (0.26, 0.34, 0.20)),
    ]


def _knight(_: Material, size: float) -> list[ModelPart]:
    return [
        post(CHROME, _at(size, 0.0, 0.0, 0.02), (1.16 * size, 1.08 * size, 1.05 * size)),
        _ball(CHROME, size, (0.0, 0.0, 0.52), (1.16, 1.08, 0.70)),
        box(_BLACK, _at(size, 0.50, 0.0, 0.10), (0.22 * size, 0.78 * size, 0.09 * size)),
        box(_BLACK, _at(size, 0.54, 0.0, -0.22), (0.12 * size, 0.05 * size, 0.42 * size)),
        limb(Material(RED), _at(size, 0.0, 0.0, 0.86), _at(size, -0.60, 0.0, 0.70), 0.035),
    ]


def _clown(_: Material, size: float) -> list[ModelPart]:
    wig, red = Material((0.80, 0.16, 0.01)), Material((0.75, 0.02, 0.02))
    places = (
        (0.0, 0.56, 0.15),
        (0.0, -0.56, 0.15),
        (-0.2, 0.4, 0.5),
        (-0.2, -0.4, 0.5),
        (-0.45, 0.0, 0.1),
    )
    return [
        *(_ball(wig, size, place, (0.62, 0.62, 0.62)) for place in places),
        _ball(red, size, (0.56, 0.0, -0.05), (0.28, 0.28, 0.28)),
        *(_ball(Material(WHITE), size, (0.35, 0.2 * s, 0.12), (0.2, 0.32, 0.4)) for s in (1, -1)),
    ]


def _veil(_: Material, size: float) -> list[ModelPart]:
    veil = cloth((0.84, 0.84, 0.83))
    low, top = _at(size, -0.95, 0.0, -3.4), _at(size, -0.25, 0.0, 0.62)
    return [
        blade(veil, low, top, chord=(0.0, 0.62, 0.0), thickness=(0.06, 0.0, 0.03)),
        _ball(veil, size, (-0.20, 0.0, 0.30), (0.80, 0.96, 0.62)),
    ]


def _habit(_: Material, size: float) -> list[ModelPart]:
    return [
        *_hood(_BLACK, size),
        _ball(_WHITE, size, (0.0, 0.0, 0.16), (0.94, 0.92, 0.96)),
        _ball(_WHITE, size, (0.05, 0.0, -0.62), (0.80, 1.20, 0.34)),
    ]


def _surgeon(_: Material, size: float) -> list[ModelPart]:
    green = cloth((0.10, 0.36, 0.32))
    return [
        _ball(green, size, (-0.05, 0.0, 0.30), (1.02, 0.98, 0.66)),
        _ball(cloth((0.35, 0.58, 0.62)), size, (0.34, 0.0, -0.24), (0.42, 0.66, 0.46)),
    ]


def _pointed(skin: Material, size: float) -> list[ModelPart]:
    x, y, z = _at(size, -0.04, 0.0, 1.0)
    return [
        _ball(skin, size, (0.0, 0.0, 0.40), (1.90, 1.80, 0.10)),
        peak(skin, (x, y, z), (0.98 * size, 0.94 * size, 1.25 * size)),
        post(_GOLD, _at(size, -0.02, 0.0, 0.50), (0.96 * size, 0.92 * size, 0.10 * size)),
    ]


def _santa(skin: Material, size: float) -> list[ModelPart]:
    red, tip = skin, _at(size, -0.85, 0.0, 0.72)
    return [
        post(_WHITE, _at(size, -0.02, 0.0, 0.36), (1.10 * size, 1.02 * size, 0.20 * size)),
        spike(red, _at(size, 0.0, 0.0, 0.42), tip, 0.115),
        ball(_WHITE, tip, (0.08, 0.08, 0.08)),
        *_beard(Material(WHITE), size),
    ]


def _beard(skin: Material, size: float) -> list[ModelPart]:
    return [
        _ball(skin, size, (0.32, 0.0, -0.48), (0.46, 0.70, 0.72)),
        _ball(skin, size, (0.46, 0.0, -0.22), (0.20, 0.52, 0.12)),
    ]


def _pirate(_: Material, size: float) -> list[ModelPart]:
    black = Material((0.02, 0.02, 0.022))
    return [
        _ball(black, size, (0.0, 0.0, 0.48), (1.05, 1.10, 0.72)),
        _ball(black, size, (0.0, 0.0, 0.40), (1.85, 2.10, 0.22)),
        _ball(black, size, (-0.62, 0.0, 0.56), (0.30, 1.50, 0.50)),
        *(_ball(black, size, (0.25, 0.72 * s, 0.58), (1.30, 0.24, 0.52)) for s in (1.0, -1.0)),
        _ball(Material(WHITE), size, (0.48, 0.0, 0.52), (0.10, 0.26, 0.24)),
        _ball(black, size, (0.46, 0.17, 0.06), (0.20, 0.24, 0.20)),
        *_beard(Material((0.05, 0.03, 0.02)), size),
    ]


def _ninja(_: Material, size: float) -> list[ModelPart]:
    return [
        *_hood(_BLACK, size)[:1],
        _ball(_BLACK, size, (0.16, 0.0, -0.28), (0.80, 0.86, 0.62)),
        limb(_BLACK, _at(size, -0.6, 0.0, 0.1), _at(size, -1.2, 0.2, -0.3), 0.02),
    ]


def _bun(skin: Material, size: float) -> list[ModelPart]:
    return [_ball(skin, size, (-0.28, 0.0, 0.62), (0.44, 0.44, 0.40))]


def _pigtails(skin: Material, size: float) -> list[ModelPart]:
    return [
        part
        for s in (1.0, -1.0)
        for part in (
            limb(skin, _at(size, -0.1, 0.42 * s, 0.25), _at(size, -0.15, 0.85 * s, -0.45), 0.035),
            _ball(Material(RED), size, (-0.1, 0.44 * s, 0.22), (0.16, 0.16, 0.16)),
        )
    ]


def _wild_hair(skin: Material, size: float) -> list[ModelPart]:
    return [
        _ball(Material((0.62, 0.62, 0.60)), size, place, (0.6, 0.6, 0.6))
        for place in ((-0.1, 0.45, 0.2), (-0.1, -0.45, 0.2), (-0.3, 0.0, 0.4))
    ]


def _samurai(skin: Material, size: float) -> list[ModelPart]:
    return [
        _ball(Material(BLACK), size, (-0.05, 0.0, 0.32), (1.15, 1.10, 0.90)),
        _ball(Material(BLACK), size, (-0.20, 0.0, 0.0), (1.3, 1.5, 0.5)),
        *(
            limb(_GOLD, _at(size, 0.5, 0.08 * s, 0.4), _at(size, 0.5, 0.55 * s, 1.05), 0.016)
            for s in (1.0, -1.0)
        ),
    ]


def _welding(_: Material, size: float) -> list[ModelPart]:
    return [
        _ball(DARK, size, (0.14, 0.0, 0.02), (1.10, 1.02, 1.30)),
        box(
            Material((0.05, 0.14, 0.06)),
            _at(size, 0.62, 0.0, 0.10),
            (0.16 * size, 0.52 * size, 0.24 * size),
        ),
    ]


def _ponytail(skin: Material, size: float) -> list[ModelPart]:
    return [limb(skin, _at(size, -0.42, 0.0, 0.30), _at(size, -0.62, 0.0, -0.60), 0.04)]


def _headlamp(skin: Material, size: float) -> list[ModelPart]:
    return [
        *_shell(0.28)(skin, size),
        _ball(
            Material((1.0, 0.95, 0.7), emission=1.5), size, (0.58, 0.0, 0.32), (0.14, 0.26, 0.26)
        ),
    ]


HATS: Mapping[str, HatDraw] = MappingProxyType(
    {
        "toque": _toque,
        "cowboy": _brimmed((1.95, 1.75, 0.13), (0.92, 0.84, 0.60), Material((0.05, 0.02, 0.01))),
        "straw": _brimmed((2.10, 2.05, 0.10), (0.96, 0.90, 0.40), Material(RED)),
        "top hat": _brimmed((1.45, 1.35, 0.09), (0.90, 0.84, 0.92), Material(RED)),
        "cap": _shell(0.22, 1.06, _visor(0.30)),
        "batting helmet": _shell(0.18, 1.16, _visor(0.24)),
        "peaked": _peaked,
        "fire helmet": _fire_helmet,
        "crown": _crown,
        "bubble": _bubble,
        "hood": _hood,
        "diver": _diver,
        "knight": _knight,
        "clown": _clown,
        "veil": _veil,
        "habit": _habit,
        "surgeon": _surgeon,
        "pointed": _pointed,
        "santa": _santa,
        "beard": _beard,
        "pirate": _pirate,
        "ninja": _ninja,
        "bun": _bun,
        "pigtails": _pigtails,
        "ponytail": _ponytail,
        "wild hair": _wild_hair,
        "samurai": _samurai,
        "welding": _welding,
        "headlamp": _headlamp,
        "robot": draw_robot_head,
        "ski helmet": _shell(0.20, 1.16, _glass(Material((0.70, 0.28, 0.02)), 0.30)),
        "flying cap": _shell(0.16, 1.12, _glass(Material((0.10, 0.22, 0.28)), 0.24)),
        "bicycle helmet": _shell(
            0.34, 1.42, lambda _, size: _ball(_BLACK, size, (0.0, 0.0, 0.50), (1.10, 0.26, 0.66))
        ),
        "hockey helmet": _shell(0.16, 1.22, _glass(STEEL, 0.50)),
        "football helmet": _shell(
            0.06,
            1.40,
            lambda _, size: rod(
                Material(WHITE), _at(size, 0.66, 0.34, -0.24), _at(size, 0.66, -0.34, -0.24), 0.016
            ),
            lambda _, size: rod(
                Material(WHITE), _at(size, 0.64, 0.36, -0.06), _at(size, 0.64, -0.36, -0.06), 0.016
            ),
        ),
        "race helmet": _shell(0.02, 1.38, _glass(_VISOR, 0.32)),
        "army helmet": _shell(
            0.28, 1.30, lambda paint, size: _ball(paint, size, (0.0, 0.0, 0.20), (1.44, 1.28, 0.14))
        ),
        "woolly": _shell(
            0.26,
            1.04,
            lambda paint, size: post(
                Material(shade(paint.colour, 1.5)),
                _at(size, -0.03, 0.0, 0.10),
                (1.12 * size, 1.16 * size, 0.26 * size),
            ),
            lambda _, size: _ball(Material(WHITE), size, (-0.03, 0.0, 0.78), (0.32, 0.32, 0.32)),
        ),
        "beret": lambda skin, size: [_ball(skin, size, (-0.08, 0.12, 0.46), (1.22, 1.22, 0.30))],
        "turban": lambda skin, size: [
            _ball(skin, size, (-0.04, 0.0, z), (x, x, 0.34))
            for z, x in ((0.24, 1.22), (0.40, 1.16), (0.56, 0.92))
        ],
        "headband": lambda _, size: [
            post(Material(RED), _at(size, -0.02, 0.0, 0.26), (1.0 * size, 0.94 * size, 0.12 * size))
        ],
    }
)
"""Name of a `PersonKind.hat` → how it is drawn."""
