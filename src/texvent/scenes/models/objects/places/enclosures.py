"""What closes a place off: walls of corridors, alleys and tunnels, parapets, rails of balconies.

Walls on both sides stand along x, which is where the camera looks: doors are from a little behind
it on. What is right across the view spans y.
"""

from __future__ import annotations

from texvent.scenes.models.materials import Material, brick, mottled, plaster
from texvent.scenes.models.objects.figures import thing, toned
from texvent.scenes.models.objects.palette import (
    BRASS,
    BULB,
    DARK_WOOD,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    SILVER,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import box, post, rod

LONG_M = 40.0
"""Of walls along the view, and across it."""
CORRIDOR_M, ALLEY_M, TUNNEL_M = 1.7, 2.3, 4.8
"""From the middle to each wall."""
TUNNEL_LONG_M, _BAYS = 128.0, 14
"""Of a tunnel, and the lamps along it."""


def _door(p: Material, x: float, y: float, side: float) -> list[ModelPart]:
    """A door in a wall along x; `side` is the sign of y on which the wall is."""
    return [
        box(PALE, (x, y - 0.03 * side, 1.08), (1.16, 0.08, 2.16)),
        box(p, (x, y - 0.06 * side, 1.02), (0.94, 0.08, 2.04)),
        box(BRASS, (x + 0.36, y - 0.12 * side, 1.0), (0.12, 0.08, 0.04)),
    ]


def _corridor(p: Material) -> list[ModelPart]:
    """Two walls with doors, a skirting board, and lamps in a row above."""
    wall = plaster((0.72, 0.70, 0.64))
    return _walled(wall, p)


def _ward(p: Material) -> list[ModelPart]:
    """The same in pale green, with rails at hand height."""
    wall = plaster((0.56, 0.70, 0.68))
    rails = [
        rod(SILVER, (-19.0, s * (CORRIDOR_M - 0.08), 0.95), (19.0, s * (CORRIDOR_M - 0.08), 0.95),
            0.04)
        for s in (1.0, -1.0)
    ]  # fmt: skip
    return [*_walled(wall, p), *rails]


def _walled(wall: Material, door: Material) -> list[ModelPart]:
    parts = [
        *(box(wall, (0.0, s * (CORRIDOR_M + 0.1), 1.5), (LONG_M, 0.2, 3.0)) for s in (1.0, -1.0)),
        *(box(toned(door, 0.6), (0.0, s * (CORRIDOR_M - 0.01), 0.09), (LONG_M, 0.04, 0.18))
          for s in (1.0, -1.0)),
    ]  # fmt: skip
    for k in range(7):
        x = -4.0 + 4.0 * k
        parts += [
            *_door(door, x, CORRIDOR_M, 1.0),
            *_door(door, x + 2.0, -CORRIDOR_M, -1.0),
            box(BULB, (x, 0.0, 2.95), (1.2, 0.3, 0.06)),
        ]
    return parts


def _lockers(p: Material) -> list[ModelPart]:
    """Two walls of lockers."""
    wall = plaster((0.70, 0.70, 0.66))
    parts = [box(wall, (0.0, s * (CORRIDOR_M + 0.4), 1.5), (LONG_M, 0.2, 3.0)) for s in (1.0, -1.0)]
    for s in (1.0, -1.0):
        parts.append(box(p, (0.0, s * (CORRIDOR_M + 0.15), 0.95), (LONG_M, 0.3, 1.9)))
        for k in range(20):
            x = -3.0 + 0.8 * k
            parts.append(box(INK, (x, s * (CORRIDOR_M - 0.01), 0.95), (0.03, 0.02, 1.86)))
        for k in range(7):
            x = 0.4 + 0.8 * k
            parts.append(box(SILVER, (x, s * (CORRIDOR_M - 0.01), 1.0), (0.06, 0.04, 0.16)))
    return parts


def _alley(p: Material) -> list[ModelPart]:
    """Two high walls of brick with windows, back doors and pipes."""
    wall = brick(p.colour)
    glass, frame = Material((0.10, 0.14, 0.18)), Material((0.55, 0.53, 0.48))
    parts = [box(wall, (0.0, s * (ALLEY_M + 0.4), 4.5), (LONG_M, 0.8, 9.0)) for s in (1.0, -1.0)]
    for k in range(6):
        x, s = -4.0 + 4.5 * k, 1.0 if k % 2 else -1.0
        parts += _door(Material(DARK_WOOD), x, s * ALLEY_M, s)
        pipe = s * (ALLEY_M - 0.08)
        parts.append(rod(IRON, (x + 1.6, pipe, 0.0), (x + 1.6, pipe, 8.8), 0.07))
        for side in (1.0, -1.0):
            parts += [
                box(frame, (x + 0.7, side * ALLEY_M, 2.9), (1.2, 0.08, 1.5)),
                box(glass, (x + 0.7, side * (ALLEY_M - 0.03), 2.9), (1.0, 0.08, 1.3)),
            ]
    return parts


def _tunnel(p: Material) -> list[ModelPart]:
    """A road between two walls of panels under a vault, with lamps in a row."""
    concrete, panel = mottled(p.colour, contrast=0.2, scale=3.0), plaster((0.60, 0.60, 0.55))
    dark, line = Material((0.13, 0.13, 0.13)), Material((0.62, 0.62, 0.58))
    sign = Material((0.05, 0.42, 0.16), emission=0.25)
    long = TUNNEL_LONG_M
    parts = [box(concrete, (0.0, 0.0, 6.0), (long, 2.0 * TUNNEL_M - 1.6, 0.4))]
    for s in (1.0, -1.0):
        side = s * TUNNEL_M
        parts += [
            box(panel, (0.0, side + 0.3 * s, 1.7), (long, 0.6, 2.6)),
            box(dark, (0.0, side + 0.25 * s, 0.25), (long, 0.7, 0.5)),
            box(toned(panel, 0.5), (0.0, side + 0.28 * s, 3.06), (long, 0.6, 0.14)),
            box(concrete, (0.0, side + 0.3 * s, 4.5), (long, 0.6, 3.0)),
            box(concrete, (0.0, side - 0.5 * s, 5.55), (long, 1.0, 0.6)),
            box(toned(concrete, 1.2), (0.0, side - 0.35 * s, 0.08), (long, 0.7, 0.16)),
            box(line, (0.0, side - 0.95 * s, 0.012), (long, 0.14, 0.01)),
        ]
        for k in range(4):
            x = 0.25 * long * (k - 1.5) + 10.0 * s
            parts.append(box(dark, (x, side - 0.02 * s, 1.2), (1.3, 0.1, 2.2)))
            parts.append(box(sign, (x, side - 0.06 * s, 2.65), (0.9, 0.14, 0.4)))
    for k in range(_BAYS):
        x = long * ((k + 0.5) / _BAYS - 0.5)
        parts.append(box(BULB, (x, 0.0, 5.74), (2.8, 0.5, 0.12)))
        parts.append(box(line, (x, 0.0, 0.012), (3.2, 0.14, 0.01)))
    return parts


def _parapet(p: Material) -> list[ModelPart]:
    """The low wall around a flat roof."""
    return [
        box(p, (0.0, 0.0, 0.5), (0.25, LONG_M, 1.0)),
        box(toned(p, 0.7), (0.0, 0.0, 1.03), (0.40, LONG_M, 0.08)),
    ]


def _roof_unit(p: Material) -> list[ModelPart]:
    """An air conditioner with its fan and a pipe."""
    return [
        box(p, (0.0, 0.0, 0.65), (1.0, 1.6, 1.1)),
        post(INK, (0.0, 0.4, 1.22), (0.7, 0.7, 0.06)),
        *(box(INK, (0.51, -0.1, 0.3 + 0.12 * k), (0.02, 1.2, 0.04)) for k in range(6)),
        box(GREY_PLASTIC, (0.0, 0.0, 0.05), (1.1, 1.7, 0.1)),
        rod(SILVER, (0.0, -1.1, 0.0), (0.0, -1.1, 1.6), 0.12),
        post(SILVER, (0.0, -1.1, 1.65), (0.45, 0.45, 0.12)),
    ]


def _balcony_rail(p: Material) -> list[ModelPart]:
    """A rail on bars, with a low wall below that hides the ground beyond."""
    return [
        box(mottled((0.62, 0.60, 0.55), contrast=0.1), (0.0, 0.0, 0.3), (0.12, LONG_M, 0.6)),
        box(p, (0.0, 0.0, 1.05), (0.10, LONG_M, 0.07)),
        *(rod(p, (0.0, -8.4 + 0.3 * k, 0.6), (0.0, -8.4 + 0.3 * k, 1.05), 0.018)
          for k in range(57)),
    ]  # fmt: skip


NOUNS = (
    thing("corridor walls", (WOOD_BROWN,), _corridor),
    thing("ward walls", ((0.62, 0.66, 0.66),), _ward),
    thing("locker walls", ((0.05, 0.18, 0.36), (0.40, 0.06, 0.05)), _lockers),
    thing("alley walls", ((0.34, 0.13, 0.08), (0.30, 0.20, 0.14)), _alley),
    thing("tunnel walls", ((0.40, 0.39, 0.37), (0.33, 0.31, 0.28)), _tunnel),
    thing("roof parapet", ((0.46, 0.44, 0.41),), _parapet),
    thing("roof unit", ((0.58, 0.59, 0.60),), _roof_unit),
    thing("balcony rail", ((0.10, 0.10, 0.11),), _balcony_rail),
)
"""Nouns that close places off."""
