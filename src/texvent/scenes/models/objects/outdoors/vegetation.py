"""Plants of water and woods, leaves, the moon and a rainbow."""

from __future__ import annotations

import itertools
import math

from texvent.scenes.models.materials import BARK, Material, foliage, glowing, mottled
from texvent.scenes.models.objects.figures import (
    Moving,
    nothing,
    placed,
    ring,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import EARTH, LEAF, PALE, WATER
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    blade,
    box,
    limb,
    peak,
    plank,
    post,
    rod,
    spike,
)

_CLEAR = Material((0.70, 0.82, 0.86), emission=0.15)
_AUTUMN = (Material((0.62, 0.16, 0.02)), Material((0.70, 0.38, 0.03)), Material((0.42, 0.10, 0.03)),
           Material((0.72, 0.55, 0.06)))  # fmt: skip


def _leaf(skin: Material, at: Point, angle: float, size: float) -> ModelPart:
    x, y, z = at
    tip = (x + size * math.cos(angle), y + size * math.sin(angle), z + 0.12 * size)
    return blade(skin, at, tip, chord=(-0.55 * size * math.sin(angle),
        0.55 * size * math.cos(angle),
                                       0.1 * size), thickness=(0.0, 0.0, 0.03 * size))  # fmt: skip


def _frond(skin: Material, angle: float, long: float) -> list[ModelPart]:
    """A fern's leaf: a stalk that arches outwards, with pairs of leaflets."""
    c, s = math.cos(angle), math.sin(angle)
    arch = [(long * u, long * (1.3 * u - 1.05 * u * u)) for u in (0.0, 0.3, 0.65, 1.0)]
    points = [(r * c, r * s, z) for r, z in arch]
    parts = [limb(skin, a, b, 0.012 * long) for a, b in itertools.pairwise(points)]
    for k, (x, y, z) in enumerate(points[1:], 1):
        wide = long * (0.34 - 0.07 * k)
        for side in (1.0, -1.0):
            tip = (x + wide * (0.4 * c - side * s), y + wide * (0.4 * s + side * c), z - 0.02)
            parts.append(blade(skin, (x, y, z), tip, chord=(0.6 * wide * c, 0.6 * wide * s, 0.0),
                thickness=(0.0, 0.0, 0.006)))  # fmt: skip
    return parts


def _crown(trunk: Material, crown: Material, tall: float) -> list[ModelPart]:
    return [
        rod(trunk, (0.0, 0.0, 0.0), (0.0, 0.0, 0.55 * tall), 0.035 * tall),
        *(limb(trunk, (0.0, 0.0, 0.4 * tall), (0.22 * tall * math.cos(a),
            0.22 * tall * math.sin(a), 0.66 * tall),
               0.02 * tall) for a in (0.3, 2.2, 4.3)),
        *(ball(crown, (0.24 * tall * math.cos(a), 0.24 * tall * math.sin(a), 0.70 * tall), (
            0.42 * tall, 0.42 * tall, 0.34 * tall)) for a in (0.0, 1.26, 2.51, 3.77, 5.03)),
        ball(crown, (0.0, 0.0, 0.84 * tall), (0.5 * tall, 0.5 * tall, 0.34 * tall)),
    ]  # fmt: skip


def _bare(p: Material) -> list[ModelPart]:
    parts = [rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 2.6), 0.20)]
    for k in range(7):
        a, z = 2.4 * k, 1.7 + 0.35 * k
        mid = (0.9 * math.cos(a), 0.9 * math.sin(a), z + 0.8)
        parts.append(limb(p, (0.0, 0.0, z), mid, 0.07))
        for turn in (0.5, -0.5):
            tip = (
                mid[0] + 0.7 * math.cos(a + turn),
                mid[1] + 0.7 * math.sin(a + turn),
                mid[2] + 0.7,
            )
            parts.append(limb(p, mid, tip, 0.035))
    return [*parts, limb(p, (0.0, 0.0, 2.4), (0.1, 0.1, 4.6), 0.09)]


def _coral(p: Material) -> list[ModelPart]:
    parts = [post(toned(p, 0.6), (0.0, 0.0, 0.04), (0.5, 0.5, 0.08))]
    for k in range(8):
        a = 0.785 * k
        fork = (0.14 * math.cos(a), 0.18 * math.sin(a), 0.30)
        parts.append(limb(p, (0.0, 0.0, 0.0), fork, 0.035))
        for turn in (0.5, -0.4):
            parts.append(
                limb(p, fork, (0.30 * math.cos(a + turn), 0.34 * math.sin(a + turn), 0.58), 0.028)
            )
    return parts


_WEED = Moving(lambda p: [part for k in range(7) for part in (
    limb(p, (0.10 * math.cos(2.4 * k), 0.10 * math.sin(2.4 * k), 0.0), (
        0.16 * math.cos(2.4 * k) + 0.06, 0.16 * math.sin(2.4 * k), 0.5), 0.035),
    limb(p, (0.16 * math.cos(2.4 * k) + 0.06, 0.16 * math.sin(2.4 * k), 0.5), (
        0.20 * math.cos(2.4 * k) - 0.05, 0.20 * math.sin(2.4 * k), 1.0), 0.03),
    limb(p, (0.20 * math.cos(2.4 * k) - 0.05, 0.20 * math.sin(2.4 * k), 1.0), (
        0.24 * math.cos(2.4 * k) + 0.08, 0.22 * math.sin(2.4 * k), 1.4), 0.022))],
    swinging("y", 0.14, 0.4))  # fmt: skip

NOUNS = (
    *placed("underwater", (
        thing("coral branch", ((0.80, 0.25, 0.22), (0.75, 0.45, 0.08), (0.55, 0.20, 0.55)), _coral,
              ("staghorn coral", "branching coral")),
        thing("seaweed", ((0.05, 0.20, 0.04),), nothing, ("kelp", "algae", "sea grass"),
            moving=(_WEED,)),
        thing("anemone", ((0.75, 0.25, 0.45),), nothing, ("sea anemone",),
            moving=(Moving(lambda p: [
            post(toned(p, 0.6), (0.0, 0.0, 0.08), (0.30, 0.30, 0.16)), *(limb(p,
                (0.08 * math.cos(0.52 * k), 0.08 * math.sin(
                0.52 * k), 0.14), (0.22 * math.cos(0.52 * k), 0.22 * math.sin(0.52 * k), 0.40),
                    0.022) for k in range(12)),
            *(limb(p, (0.0, 0.0, 0.14), (0.1 * math.cos(k), 0.1 * math.sin(k), 0.44),
                0.02) for k in range(6))],
            swinging("x", 0.12, 0.5)),)),
    )),
    *placed("lake", (
        thing("lily pad", ((0.07, 0.26, 0.05),), lambda p: [
            *(post(toned(p, 0.8 + 0.1 * (k % 3)), (x, y, 0.02), (w, w, 0.03)) for k, (x, y,
                w) in enumerate((
                (0.0, 0.0, 0.6), (0.5, 0.35, 0.45), (-0.45, 0.4, 0.5), (0.15, -0.55, 0.5)))),
            *(_leaf(Material((0.85, 0.55, 0.65)), (0.05, 0.0, 0.08), 0.785 * k,
                0.2) for k in range(8)),
            ball(Material((0.8, 0.6, 0.1)), (0.05, 0.0, 0.12), (0.09, 0.09, 0.07))],
            ()),
        thing("reed", ((0.20, 0.28, 0.06),), nothing, ("cattail", "bulrush"), plurals=("reeds",),
            moving=(Moving(lambda p: [
            part for k in range(9) for part in (limb(p, (0.3 * math.cos(2.4 * k),
                0.3 * math.sin(2.4 * k), 0.0), (
                0.34 * math.cos(2.4 * k), 0.34 * math.sin(2.4 * k), 1.5 + 0.1 * (k % 3)), 0.018),
                    limb(Material((0.16, 0.07, 0.03)), (
                    0.34 * math.cos(2.4 * k), 0.34 * math.sin(2.4 * k), 1.4),
                        (0.34 * math.cos(2.4 * k), 0.34 * math.sin(2.4 * k), 1.62), 0.04))],
            swinging("y", 0.06, 0.5)),)),
    )),
    *placed("grass", (
        thing("leaf pile", ((0.35, 0.12, 0.03),), lambda p: [ball(mottled(p.colour, contrast=0.5,
            scale=8.0), (0.0, 0.0, 0.17), (
            1.3, 1.5, 0.30)), *(_leaf(_AUTUMN[k % 4], (1.0 * math.sqrt(k / 58) * math.cos(2.4 * k),
                1.1 * math.sqrt(k / 58) * math.sin(2.4 * k), 0.02 + 0.32 * (1.0 - k / 58)**0.6),
                        1.7 * k, 0.34 + 0.06 * (k % 3)) for k in range(58))],
              ()),
        thing("autumn tree", ((0.66, 0.26, 0.03),), lambda p: _crown(BARK, foliage(p.colour), 6.0),
              ("golden tree", "fall tree")),
        thing("cherry tree", ((0.82, 0.48, 0.56),), lambda p: _crown(BARK, foliage(p.colour), 5.0),
              ("cherry blossom", "cherry blossom tree", "blossoming tree", "sakura",
                  "blossom tree")),
        thing("bare tree", ((0.12, 0.08, 0.05),), _bare, ("dead tree", "leafless tree",
            "winter tree", "dead birch")),
        thing("bamboo", ((0.16, 0.34, 0.06),), lambda p: [part for k in range(7) for part in (
            rod(p, (0.5 * math.cos(2.4 * k), 0.5 * math.sin(2.4 * k), 0.0),
                (0.55 * math.cos(2.4 * k), 0.55 * math.sin(2.4 * k), 4.0), 0.05),
            *(post(toned(p, 0.6), (0.52 * math.cos(2.4 * k), 0.52 * math.sin(2.4 * k), z), (0.12,
                0.12, 0.03)) for z in (1.0, 2.0, 3.0)),
            *(_leaf(LEAF, (0.54 * math.cos(2.4 * k), 0.54 * math.sin(2.4 * k), z), 2.0 * k + z,
                0.6) for z in (2.6, 3.6)))],
            ("bamboo stalk", "bamboo grove")),
        thing("fern", ((0.06, 0.26, 0.04),), lambda p: [
            part for k in range(6) for part in _frond(toned(p, 0.8 + 0.1 * (k % 4)), 1.05 * k,
                0.75 - 0.08 * (k % 3))]),
        thing("grass blade", ((0.08, 0.30, 0.03),), lambda p: [
            *(spike(toned(p, 0.8 + 0.1 * (k % 3)), (0.006 * k - 0.02, 0.014 * (k - 3), 0.0),
                (0.006 * k + 0.01 * ((k * 5) % 3), 0.026 * (k - 3), 0.10 + 0.015 * (k % 3)),
                0.006) for k in range(7)), spike(toned(p, 1.3), (0.02, 0.0, 0.0), (0.03, 0.01,
                       0.17), 0.010),
            *(ball(_CLEAR, (0.032 - 0.001 * k, 0.004 * k, 0.04 + 0.035 * k), (0.010, 0.010,
                0.010)) for k in range(3))],
            ("blade of grass", "grass stalk", "stalk of grass"),
                plurals=("blades of grass",)),
        thing("anthill", ((0.28, 0.16, 0.08),), lambda p: [peak(mottled(p.colour, contrast=0.3,
            scale=8.0), (0.0, 0.0, 0.25), (0.9, 0.9, 0.5)),
                                                     ball(Material((0.02, 0.015, 0.01)), (0.0,
                        0.0, 0.48), (0.12, 0.12, 0.06))], ("termite mound",)),
        thing("puddle", ((0.20, 0.30, 0.38),), lambda p: [ball(p, (0.0, 0.0, 0.0), (1.6, 1.1,
            0.03)), ball(p, (0.6, 0.4, 0.0), (0.9, 0.7, 0.03))],
              ("rain puddle", )),
        thing("seedling", ((0.08, 0.36, 0.04),), lambda p: [ball(EARTH, (0.0, 0.0, 0.0), (0.18,
            0.18, 0.05)), limb(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.10), 0.005),
            *(_leaf(p, (0.0, 0.0, 0.10), a, 0.07) for a in (0.4, 3.5, 2.0))], ("sprout",
                "sapling", "young plant")),
    )),
    *placed("sky", (
        thing("rainbow", ((0.70, 0.05, 0.05),), lambda p: [part for k, c in enumerate(((0.75,
            0.05, 0.04), (0.80, 0.32, 0.02), (0.80, 0.70, 0.05),
            (0.08, 0.50, 0.10), (0.06, 0.20, 0.70), (0.30, 0.06,
                0.50))) for part in ring(glowing(c, 0.4), (0.0, 0.0, 0.0), (
                10.0 - 0.5 * k, 9.0 - 0.5 * k), 0.28, span=(0.0, 180.0), pieces=9)], goes=("air",
                    "float", 0.2)),
        thing("moon", ((0.80, 0.79, 0.72),), lambda p: [ball(Material(p.colour, emission=0.8),
            (0.0, 0.0, 0.0), (4.0, 4.0, 4.0)),
            *(ball(Material((0.55, 0.55, 0.52), emission=0.4), (1.5, y, z), (1.0, w, w)) for y,
                z, w in ((0.5, 0.6, 1.1), (-0.7, 0.2, 0.8), (0.1, -0.8, 0.9)))],
            (), goes=("air", "float", 0.3)),
    )),
    thing("dripping icicle", ((0.72, 0.82, 0.88),), lambda p: [spike(p, (0.12 * k,
        0.16 * (k - 3), 1.0), (0.12 * k, 0.16 * (k - 3), 0.5 - 0.07 * (k % 3)), 0.05)
        for k in range(7)] + [ball(PALE, (0.3, 0.0, 1.05), (1.0, 1.4, 0.16))], ("icicle",)),
    thing("ice block", ((0.62, 0.76, 0.84),), lambda p: [
        box(p, (0.0, 0.0, 0.24), (0.60, 0.66, 0.44)), box(p, (0.0, 0.0, 0.24), (0.56, 0.62, 0.48)),
        *(plank(PALE, (0.301, -0.2 + 0.2 * k, 0.1 + 0.06 * k), (0.301, -0.05 + 0.2 * k, 0.3),
            chord=(0.0, 0.03, -0.02), thickness=(0.004, 0.0, 0.0)) for k in range(3)),
        ball(WATER, (0.1, 0.0, 0.0), (1.0, 1.1, 0.02))], ()),
)  # fmt: skip
