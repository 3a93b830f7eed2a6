"""Large things of streets, sites and fairs: roller coaster, gas station, solar panel, container."""

from __future__ import annotations

import itertools
import math

from texvent.scenes.models.materials import Material, foliage, glowing, metal, mottled, striped
from texvent.scenes.models.objects.figures import bar, chain, disc, placed, ring, thing, toned
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    SILVERY,
    STEELY,
    WATER,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, box, limb, plank, post, rod, spike
from texvent.scenes.scene import Colour

_WHITE: Colour = (0.80, 0.80, 0.78)
_WOOD = Material(WOOD_BROWN)


def _coaster(p: Material) -> list[ModelPart]:
    """Hills of track on posts, a loop, and a train of three cars."""
    track: list[Point] = [
        (0.0, -14.0 + 0.7 * k, 2.0 + 5.0 * (0.5 + 0.5 * math.cos(0.52 * k)) * (1.0 - 0.018 * k))
        for k in range(0, 41, 2)
    ]
    loop = [(1.2 - 0.06 * k, 3.0 + 3.0 * math.sin(0.262 * k), 4.2 - 3.0 * math.cos(0.262 * k))
            for k in range(0, 25, 2)]  # fmt: skip
    posts = [rod(PALE, (0.0, y, 0.0), (0.0, y, z), 0.12) for _, y, z in track[::4]]
    cars = [
        box(YELLOW_PAINT, (0.1, track[k][1], track[k][2] + 0.65), (0.9, 1.0, 0.7))
        for k in (4, 5, 6)
    ]
    riders = [
        ball(BLUE_PAINT, (0.1, track[k][1] + s, track[k][2] + 1.15), (0.35, 0.3, 0.4))
        for k in (4, 5, 6)
        for s in (0.25, -0.25)
    ]
    return [*chain(p, track, 0.16), *chain(p, loop, 0.16), *posts, *cars, *riders]


def _gas_station(p: Material) -> list[ModelPart]:
    return [
        *(rod(PALE, (x, y, 0.0), (x, y, 4.2), 0.16) for x in (1.5, -1.5) for y in (3.0, -3.0)),
        box(PALE, (0.0, 0.0, 4.5), (5.0, 9.0, 0.6)), box(p, (0.0, 0.0, 4.6), (5.1, 9.1, 0.3)),
        box(mottled((0.35, 0.35, 0.34)), (0.0, 0.0, 0.08), (1.6, 7.0, 0.16)),
        *(part for y in (2.0, -2.0) for part in (
            box(p, (0.0, y, 0.95), (0.6, 0.9, 1.6)), box(PALE, (0.31, y, 1.35), (0.02, 0.7, 0.5)),
            box(INK, (0.33, y, 1.4), (0.02, 0.5, 0.25)),
            limb(INK, (0.2, y + 0.5, 1.3), (0.3, y + 0.6, 0.5), 0.04))),
        box(PALE, (-5.0, 0.0, 1.5), (3.0, 8.0, 3.0)), box(p, (-3.46, 0.0, 2.7), (0.06, 8.0, 0.5)),
        box(Material((0.12, 0.20, 0.26)), (-3.46, 0.8, 1.3), (0.06, 5.0, 1.5)),
        *(rod(IRON, (2.5, 5.6 + s, 0.0), (2.5, 5.6 + s, 4.0), 0.08) for s in (0.6, -0.6)),
        box(p, (2.5, 5.6, 4.4), (0.2, 1.7, 1.7)), box(PALE, (2.62, 5.6, 4.4), (0.02, 1.2, 0.5)),
    ]  # fmt: skip


def _solar_panel(p: Material) -> list[ModelPart]:
    return [
        plank(PALE, (0.55, 0.0, 0.45), (-0.55, 0.0, 1.55), chord=(0.0, 3.1, 0.0),
              thickness=(0.05, 0.0, 0.05)),
        plank(p, (0.53, 0.0, 0.50), (-0.53, 0.0, 1.56), chord=(0.0, 3.0, 0.0),
              thickness=(0.05, 0.0, 0.05)),
        *(plank(SILVER, (0.56, y, 0.50), (-0.50, y, 1.56), chord=(0.0, 0.03, 0.0),
                thickness=(0.04, 0.0, 0.04)) for y in (-1.0, -0.5, 0.0, 0.5, 1.0)),
        *(rod(SILVER, (0.58 - 1.06 * t, -1.5, 0.52 + 1.06 * t),
              (0.58 - 1.06 * t, 1.5, 0.52 + 1.06 * t), 0.014) for t in (0.25, 0.5, 0.75)),
        *(rod(IRON, (x, y, 0.0), (x, y, z), 0.04) for x, z in ((0.4, 0.6), (-0.4, 1.4))
          for y in (1.2, -1.2)),
    ]  # fmt: skip


def _dish(p: Material) -> list[ModelPart]:
    bowl = [
        part
        for k in range(4)
        for part in ring(p, (0.05 + 0.05 * k * k, 0.0, 2.0), (0.25 + 0.26 * k, 0.25 + 0.26 * k),
                         0.16, pieces=12)
    ]  # fmt: skip
    return [
        rod(IRON, (-0.2, 0.0, 0.0), (-0.2, 0.0, 1.6), 0.09),
        limb(IRON, (-0.2, 0.0, 1.5), (0.0, 0.0, 2.0), 0.09), *bowl,
        disc(p, (0.0, 2.0), 0.35, 0.06, 0.04),
        *(rod(IRON, (0.75, y, z), (1.4, 0.0, 2.0), 0.025) for y, z in
          ((0.9, 1.6), (-0.9, 1.6), (0.0, 2.95))),
        ball(INK, (1.4, 0.0, 2.0), (0.22, 0.16, 0.16)),
    ]  # fmt: skip


def _container(p: Material) -> list[ModelPart]:
    ribs = [
        box(toned(p, 0.75), (x, -2.8 + 0.4 * k, 1.3), (0.06, 0.16, 2.3))
        for k in range(15)
        for x in (1.21, -1.21)
    ]
    doors = [box(toned(p, 0.8), (0.6 * s, 3.01, 1.3), (1.1, 0.03, 2.3)) for s in (1.0, -1.0)]
    bolts = [rod(SILVER, (x, 3.06, 0.2), (x, 3.06, 2.4), 0.03) for x in (0.2, -0.2, 0.8, -0.8)]
    return [box(p, (0.0, 0.0, 1.28), (2.4, 6.0, 2.56)), *ribs, *doors, *bolts]


def _trailer(p: Material) -> list[ModelPart]:
    return [
        box(p, (0.0, 0.0, 0.75), (2.6, 1.5, 0.12)),
        *(box(p, (0.0, 0.74 * s, 0.98), (2.6, 0.05, 0.4)) for s in (1.0, -1.0)),
        *(box(p, (1.28 * s, 0.0, 0.98), (0.05, 1.5, 0.4)) for s in (1.0, -1.0)),
        *(rod(INK, (0.0, 0.72 * s, 0.36), (0.0, 0.92 * s, 0.36), 0.36) for s in (1.0, -1.0)),
        *(rod(SILVER, (0.0, 0.90 * s, 0.36), (0.0, 0.94 * s, 0.36), 0.18) for s in (1.0, -1.0)),
        *(rod(IRON, (1.3, 0.5 * s, 0.66), (2.3, 0.0, 0.55), 0.04) for s in (1.0, -1.0)),
        ball(IRON, (2.35, 0.0, 0.55), (0.14, 0.12, 0.12)),
        rod(IRON, (2.1, 0.0, 0.55), (2.1, 0.0, 0.0), 0.03),
    ]  # fmt: skip


def _roundabout(p: Material) -> list[ModelPart]:
    """A ring of road with four ends and a planted island, to be seen from above or near."""
    road = Material((0.045, 0.045, 0.048))
    ends = [box(road, (10.5 * c, 10.5 * s, 0.015), (7.0 if c else 5.5, 7.0 if s else 5.5, 0.03))
            for c, s in ((1, 0), (-1, 0), (0, 1), (0, -1))]  # fmt: skip
    dashes = [
        box(PALE, (10.5 * c + (k - 3) * 1.2 * abs(c), 10.5 * s + (k - 3) * 1.2 * abs(s), 0.045),
            (1.2 if c else 0.15, 1.2 if s else 0.15, 0.01))
        for c, s in ((1, 0), (-1, 0), (0, 1), (0, -1)) for k in range(1, 7, 2)
    ]  # fmt: skip
    return [
        *ends, post(road, (0.0, 0.0, 0.03), (17.0, 17.0, 0.05)),
        post(PALE, (0.0, 0.0, 0.06), (6.4, 6.4, 0.10)),
        post(foliage((0.05, 0.16, 0.025)), (0.0, 0.0, 0.10), (6.0, 6.0, 0.14)),
        *(ball(foliage((0.05, 0.20, 0.03)), (1.7 * math.cos(a), 1.7 * math.sin(a), 0.6),
               (1.6, 1.6, 1.2)) for a in (0.0, 1.57, 3.14, 4.71)),
        *(box(BLUE_PAINT, (2.7 * c, 2.7 * s, 1.1), (0.15 if c else 1.2, 0.15 if s else 1.2, 0.8))
          for c, s in ((1, 0), (-1, 0), (0, 1), (0, -1))), *dashes,
        rod(_WOOD, (0.0, 0.0, 0.1), (0.0, 0.0, 2.6), 0.25),
        ball(foliage(p.colour), (0.0, 0.0, 4.0), (3.4, 3.4, 3.2)),
    ]  # fmt: skip


def _wave(p: Material) -> list[ModelPart]:
    """A breaking wave: a wall of water, its lip bent forwards, foam on top and before it."""
    foam = Material((0.78, 0.82, 0.84))
    curl = [
        (-2.2, 0.15),
        (-1.4, 0.8),
        (-0.6, 1.7),
        (0.1, 2.25),
        (0.7, 2.3),
        (1.1, 1.95),
        (1.2, 1.6),
    ]
    face = [(-0.9, 0.15), (-0.6, 0.8), (-0.1, 1.5), (0.4, 1.9), (0.9, 1.9)]
    parts = [
        plank(skin, (x0, 0.0, z0), (x1, 0.0, z1), chord=(0.0, 9.0, 0.0), thickness=(0.0, 0.0, 0.3))
        for skin, line in ((toned(p, 0.8), curl), (p, face))
        for (x0, z0), (x1, z1) in itertools.pairwise(line)
    ]
    parts += [
        ball(foam, (1.1 + 0.12 * (k % 3), -4.4 + 0.55 * k, 1.75 + 0.18 * (k % 2)), (0.5, 0.9, 0.6))
        for k in range(17)
    ]
    parts += [
        ball(foam, (1.9 + 0.5 * (k % 4), -4.4 + 0.55 * k, 0.14), (0.8, 1.1, 0.24))
        for k in range(17)
    ]
    return parts


_STREET = placed("road", (
    thing("gas station", ((0.55, 0.03, 0.02), (0.03, 0.22, 0.10)), _gas_station,
          ("petrol station", "filling station", "service station", "fuel station")),
    thing("trailer", (SILVERY, (0.30, 0.05, 0.04)), _trailer, ("car trailer", "cargo trailer")),
    thing("shipping container", ((0.45, 0.10, 0.04), (0.04, 0.14, 0.36), (0.05, 0.24, 0.12)),
          _container, ("cargo container", "freight container", "sea container", "steel container")),
    thing("roundabout", ((0.05, 0.20, 0.03),), _roundabout, ("traffic circle", "rotary",
          "traffic roundabout")),
    thing("crosswalk", (_WHITE,), lambda p: [
        box(p, (-2.4 + 0.8 * k, 0.0, 0.012), (0.42, 3.2, 0.012)) for k in range(7)],
        ("zebra crossing", "pedestrian crossing", "zebra stripes of a road")),
))  # fmt: skip
_OPEN = placed("grass", (
    thing("roller coaster", (RED_PAINT.colour, (0.03, 0.15, 0.45)), _coaster,
          ("rollercoaster", "roller-coaster")),
    thing("solar panel", ((0.02, 0.04, 0.14),), _solar_panel, ("solar array", "photovoltaic panel",
          "solar module")),
    thing("satellite dish", (_WHITE,), _dish, ("parabolic antenna", "dish antenna",
          "radar dish", "radio telescope")),
    thing("steel beam", (STEELY, (0.40, 0.12, 0.05)), lambda p: [
        *(box(metal(p.colour), (0.0, 0.0, z), (0.30, 3.6, 0.05)) for z in (0.025, 0.375)),
        box(metal(toned(p, 0.8).colour), (0.0, 0.0, 0.2), (0.05, 3.6, 0.32))],
        ("girder", "steel girder", "i-beam", "i beam", "metal beam", "iron beam")),
    thing("plank", ((0.45, 0.28, 0.13),), lambda p: [
        box(p, (0.0, 0.0, 0.03), (0.28, 2.4, 0.05)), *(bar(toned(p, 0.6), (-1.2, 0.0),
            (1.2, 0.0), 0.012, 0.012, x) for x in (0.06, -0.07))],
        ("wooden plank", "wooden board", "wood plank", "floorboard", "piece of wood")),
    thing("breaking wave", ((0.06, 0.26, 0.30),), _wave, ("ocean wave", "big wave", "giant wave",
          "sea wave", "tsunami", "tidal wave")),
    thing("tornado", ((0.30, 0.29, 0.28),), lambda p: [
        *(part for k in range(9) for part in ring(mottled(toned(p, 0.8 + 0.05 * (k % 4)).colour),
            (0.25 * math.sin(0.8 * k), 0.3 * math.sin(0.6 * k), 0.20 + 0.62 * k),
            (0.16 + 0.02 * k * k, 0.16 + 0.02 * k * k), 0.22 + 0.05 * k,
            axis="z", pieces=6))], ("twister", "whirlwind")),
    thing("diamond", ((0.70, 0.82, 0.88), (0.55, 0.02, 0.08), (0.02, 0.35, 0.14)), lambda p: [
        spike(p, (0.0, 0.0, 0.05), (0.0, 0.0, 0.0), 0.045),
        *(spike(toned(p, 0.6 + 0.35 * (k % 3)), (0.022 * math.cos(0.785 * k), 0.022 * math.sin(
            0.785 * k), 0.05), (0.004 * math.cos(0.785 * k), 0.004 * math.sin(0.785 * k), 0.004),
            0.023) for k in range(8)), post(toned(p, 1.3), (0.0, 0.0, 0.053), (0.09, 0.09, 0.008)),
        post(toned(p, 1.1), (0.0, 0.0, 0.061), (0.072, 0.072, 0.010)),
        post(toned(p, 1.6), (0.0, 0.0, 0.067), (0.055, 0.055, 0.004))],
        ("gem", "gemstone", "crystal gem", "ruby", "emerald", "sapphire", "amethyst")),
    thing("neon arch", (GREY_PLASTIC.colour,), lambda p: [
        *ring(glowing((0.9, 0.2, 0.6), 1.5), (0.0, 0.0, 0.05), (2.0, 2.6), 0.07, span=(0.0, 180.0)),
        *(box(p, (0.0, 2.0 * s, 0.1), (0.5, 0.5, 0.2)) for s in (1.0, -1.0))],
        ("light arch", "illuminated arch", "arch of bulbs")),
    thing("horse trough", (WOOD_BROWN,), lambda p: [
        box(p, (0.0, 0.0, 0.3), (0.6, 1.6, 0.5)), box(WATER, (0.0, 0.0, 0.545), (0.5, 1.5, 0.02)),
        *(box(toned(p, 0.7), (0.0, 0.7 * s, 0.06), (0.7, 0.12, 0.12)) for s in (1.0, -1.0))],
        ("trough", "water trough", "feeding trough", "drinking trough")),
    thing("striped awning", (RED_PAINT.colour,), lambda p: [
        plank(striped(p.colour, _WHITE, 6.0), (0.0, -1.5, 2.6), (0.0, 1.5, 2.6),
              chord=(1.4, 0.0, -0.5), thickness=(0.0, 0.0, 0.03)),
        *(rod(IRON, (0.68, y, 0.0), (0.68, y, 2.35), 0.03) for y in (1.4, -1.4))],
        ("awning", "shop awning", "sun awning")),
))  # fmt: skip

NOUNS = (*_STREET, *_OPEN)
"""Nouns of large things outdoors."""
