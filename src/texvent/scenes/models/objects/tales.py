"""Creatures that only tales have, and a skeleton: ghost, dragon, unicorn, alien."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from texvent.scenes.models.animals.four_legged.animal import build_animal
from texvent.scenes.models.animals.four_legged.build import Build, Coat
from texvent.scenes.models.animals.quadrupeds import HORSE
from texvent.scenes.models.materials import WHITE, Material, glowing, scales, striped
from texvent.scenes.models.objects.figures import Moving, chain, disc, ring, swinging, thing, toned
from texvent.scenes.models.objects.palette import INK, PALE, YELLOW_PAINT
from texvent.scenes.models.protocol import ModelPart, Noun
from texvent.scenes.models.shapes import ball, blade, box, limb, peak, plank, post, spike

_BONE = Material((0.76, 0.73, 0.64))
_EYE = glowing((1.0, 0.55, 0.05), 1.5)


def _horn(build: Build, coat: Coat) -> list[ModelPart]:
    """A twisted horn on the brow, in the coordinates of the horse's body."""
    long, _, _ = build.body
    reach = build.neck
    head = (0.40 * long + 0.62 * reach, 0.0, build.shoulder + 0.78 * reach)
    tip = (head[0] + 0.34, 0.0, head[2] + 0.62)
    return [spike(striped((0.85, 0.68, 0.25), (0.95, 0.90, 0.75), 5.0), head, tip, 0.055)]


_UNICORN = replace(
    HORSE, colours=((0.80, 0.80, 0.80),), dark=(0.72, 0.40, 0.62), hoof=(0.5, 0.38, 0.12),
    extras=_horn,
)  # fmt: skip


def _skeleton(p: Material) -> list[ModelPart]:
    ribs = [
        part
        for k in range(5)
        for part in ring(p, (0.04, 0.0, 1.38 - 0.075 * k), (0.15 - 0.008 * k, 0.09), 0.013,
                         axis="z", pieces=6)
    ]  # fmt: skip
    limbs = [
        part
        for s in (1.0, -1.0)
        for part in chain(p, [(0.0, 0.0, 1.42), (0.0, 0.20 * s, 1.42), (0.0, 0.26 * s, 1.12),
                              (0.06, 0.28 * s, 0.86)], 0.024)
        + chain(p, [(0.0, 0.10 * s, 0.92), (0.02, 0.11 * s, 0.50), (0.0, 0.11 * s, 0.08)], 0.030)
        + [limb(p, (0.0, 0.11 * s, 0.05), (0.16, 0.12 * s, 0.03), 0.03),
           ball(p, (0.07, 0.285 * s, 0.78), (0.04, 0.08, 0.16))]
    ]  # fmt: skip
    return [
        *ribs, *limbs,
        *(ball(p, (-0.03, 0.0, 0.96 + 0.11 * k), (0.05, 0.06, 0.11)) for k in range(5)),
        ball(p, (0.0, 0.0, 0.93), (0.13, 0.28, 0.13)),
        ball(p, (0.0, 0.0, 1.66), (0.21, 0.18, 0.22)),
        box(p, (0.05, 0.0, 1.54), (0.09, 0.11, 0.10)),
        *(disc(INK, (0.04 * s, 1.66), 0.026, 0.02, 0.095) for s in (1.0, -1.0)),
        spike(INK, (0.104, 0.0, 1.60), (0.104, 0.0, 1.64), 0.014),
        *(box(INK, (0.098, -0.03 + 0.02 * k, 1.535), (0.006, 0.006, 0.05)) for k in range(4)),
    ]  # fmt: skip


def _ghost(p: Material) -> list[ModelPart]:
    return [
        ball(p, (0.0, 0.0, 1.25), (0.62, 0.66, 0.80)), post(p, (0.0, 0.0, 0.85), (0.64, 0.68, 0.8)),
        *(spike(p, (0.22 * x, 0.24 * y, 0.50), (0.22 * x, 0.24 * y, 0.02), 0.13)
          for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7),
                       (-0.7, -0.7))),
        *(limb(p, (0.1, 0.28 * s, 1.0), (0.35, 0.50 * s, 1.15), 0.10) for s in (1.0, -1.0)),
        *(ball(INK, (0.285, 0.13 * s, 1.36), (0.08, 0.11, 0.17)) for s in (1.0, -1.0)),
        ball(INK, (0.32, 0.0, 1.10), (0.06, 0.15, 0.20)),
    ]  # fmt: skip


def _alien(p: Material) -> list[ModelPart]:
    return [
        ball(p, (0.0, 0.0, 1.18), (0.34, 0.40, 0.46)), spike(p, (0.06, 0.0, 1.14),
            (0.09, 0.0, 0.92), 0.13),
        *(ball(INK, (0.13, 0.10 * s, 1.17), (0.10, 0.14, 0.20)) for s in (1.0, -1.0)),
        *(ball(PALE, (0.18, 0.09 * s, 1.22), (0.03, 0.03, 0.04)) for s in (1.0, -1.0)),
        limb(p, (0.0, 0.0, 0.95), (0.0, 0.0, 0.48), 0.11),
        *(part for s in (1.0, -1.0) for part in chain(p, [(0.0, 0.10 * s, 0.88),
            (0.04, 0.24 * s, 0.62), (0.14, 0.28 * s, 0.42)], 0.032)),
        *(part for s in (1.0, -1.0) for part in chain(p, [(0.0, 0.07 * s, 0.48),
            (0.04, 0.09 * s, 0.25), (0.0, 0.10 * s, 0.03)], 0.045)),
        *(ball(p, (0.06, 0.10 * s, 0.03), (0.20, 0.09, 0.06)) for s in (1.0, -1.0)),
        *(limb(p, (0.0, 0.08 * s, 1.36), (0.0, 0.16 * s, 1.56), 0.014) for s in (1.0, -1.0)),
        *(ball(YELLOW_PAINT, (0.0, 0.16 * s, 1.58), (0.06, 0.06, 0.06)) for s in (1.0, -1.0)),
    ]  # fmt: skip


def _dragon(p: Material) -> list[ModelPart]:
    hide, belly = scales(p.colour), scales((0.60, 0.42, 0.12))
    return [
        ball(hide, (0.0, 0.0, 1.1), (2.2, 0.95, 1.0)), ball(belly, (0.1, 0.0, 0.98),
            (1.9, 0.80, 0.85)),
        *chain(hide, [(0.85, 0.0, 1.3), (1.35, 0.0, 1.9), (1.55, 0.0, 2.5)], 0.26),
        ball(hide, (1.75, 0.0, 2.62), (0.75, 0.42, 0.40)), ball(hide, (2.15, 0.0, 2.52),
            (0.60, 0.30, 0.24)),
        *(ball(_EYE, (1.85, 0.17 * s, 2.74), (0.12, 0.08, 0.12)) for s in (1.0, -1.0)),
        *(spike(_BONE, (1.55, 0.12 * s, 2.75), (1.20, 0.24 * s, 3.15), 0.07) for s in (1.0, -1.0)),
        *(spike(_BONE, (2.30, 0.08 * s, 2.44), (2.32, 0.08 * s, 2.32), 0.03) for s in (1.0, -1.0)),
        *chain(hide, [(-0.9, 0.0, 1.0), (-1.6, 0.0, 0.7), (-2.3, 0.0, 0.55), (-2.9, 0.0, 0.8)],
               0.20),
        spike(hide, (-2.9, 0.0, 0.8), (-3.4, 0.0, 1.15), 0.22),
        *(peak(belly, (x, 0.0, z), (0.22, 0.06, 0.34)) for x, z in
          ((1.2, 2.15), (0.75, 1.72), (0.3, 1.70), (-0.2, 1.70), (-0.7, 1.5), (-1.3, 1.1),
           (-1.9, 0.95))),
        *(part for x in (0.65, -0.65) for s in (1.0, -1.0) for part in
          [limb(hide, (x, 0.40 * s, 0.95), (x - 0.12, 0.48 * s, 0.45), 0.20),
           limb(hide, (x - 0.12, 0.48 * s, 0.45), (x, 0.50 * s, 0.08), 0.13),
           ball(hide, (x + 0.14, 0.50 * s, 0.07), (0.45, 0.26, 0.14))]),
    ]  # fmt: skip


def _dragon_wing(side: float) -> Moving:
    def draw(p: Material) -> list[ModelPart]:
        skin = toned(scales(p.colour), 0.7)
        return [
            limb(p, (0.3, 0.35 * side, 1.5), (0.1, 1.4 * side, 2.7), 0.07),
            *(limb(p, (0.1, 1.4 * side, 2.7), (x, y * side, z), 0.035) for x, y, z in
              ((0.2, 3.2, 2.5), (-0.7, 2.8, 1.9), (-1.2, 1.9, 1.6))),
            *(plank(skin, (0.2, 0.45 * side, 1.5), (x, y * side, z), chord=(0.7, 0.0, 0.35),
                    thickness=(0.0, 0.0, 0.03)) for x, y, z in
              ((-0.5, 1.9, 2.1), (-0.2, 2.5, 2.35))),
            blade(skin, (-0.1, 0.6 * side, 1.6), (-0.2, 3.0 * side, 2.3), chord=(1.7, 0.0, 0.6),
                  thickness=(0.0, 0.0, 0.05)),
        ]  # fmt: skip

    return Moving(draw, swinging("x", 0.28 * side, 0.8, (0.0, 0.35 * side, 1.5)))


NOUNS = (
    Noun("unicorn", partial(build_animal, _UNICORN), "ground", 1.6, "walk"),
    thing("skeleton", (_BONE.colour,), _skeleton, ("human skeleton",)),
    thing("ghost", (WHITE,), _ghost, ("spook", "phantom"), plurals=(),
          goes=("ground", "slide", 0.6)),
    thing("alien", ((0.22, 0.48, 0.16), (0.40, 0.42, 0.44)), _alien,
          ("extraterrestrial", "martian", "space alien")),
    thing("dragon", ((0.42, 0.04, 0.03), (0.04, 0.24, 0.08)), _dragon, ("wyvern",),
          moving=(_dragon_wing(1.0), _dragon_wing(-1.0))),
)  # fmt: skip
"""Nouns of tales."""
