"""Small things of many uses: binoculars, safe, mask, crown, necklace, piggy bank, hammock."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, checked, mottled
from texvent.scenes.models.objects.figures import (
    Motion,
    Moving,
    bar,
    chain,
    disc,
    lathe,
    lying,
    placed,
    ring,
    spinning,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BRASS,
    DARK_WOOD,
    INK,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    STEELY,
    STONE,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.shapes import (
    Affine,
    ball,
    blade,
    box,
    limb,
    plank,
    post,
    rod,
    shift,
    spike,
)

_LENS = Material((0.05, 0.08, 0.16))
_BEADS = tuple(
    Material(hue)
    for hue in ((0.55, 0.03, 0.02), (0.75, 0.45, 0.02), (0.05, 0.35, 0.08), (0.03, 0.15, 0.50))
)


def _belt(start_m: float) -> Motion:
    """A mark on a belt that runs backwards, hidden under the ends."""

    def motion(pose: Pose) -> Affine:
        along = (1.2 * pose.time_s + start_m) % 1.44
        return shift(0.72 - along, 0.0, -0.05 * max(0.0, 1.0 - 20.0 * min(along, 1.44 - along)))

    return motion


_INDOOR = placed("indoor", (
    thing("binoculars", (BLACKISH,), lambda p: [
        *(rod(p, (-0.08, 0.033 * s, 0.04), (0.05, 0.038 * s, 0.04), 0.026) for s in (1.0, -1.0)),
        *(rod(toned(p, 1.8), (0.04, 0.038 * s, 0.04), (0.085, 0.038 * s, 0.04), 0.036)
            for s in (1.0, -1.0)),
            *(disc(_LENS, (0.038 * s, 0.04), 0.031, 0.004, 0.086) for s in (1.0, -1.0)),
        rod(p, (-0.02, -0.03, 0.05), (-0.02, 0.03, 0.05), 0.014),
        post(SILVER, (-0.05, 0.0, 0.055), (0.02, 0.02, 0.02))],
        ("field glasses", "pair of binoculars", "a pair of binoculars"), plurals=("binoculars",)),
    thing("safe", (STEELY, (0.05, 0.10, 0.08)), lambda p: [
        box(p, (0.0, 0.0, 0.32), (0.50, 0.52, 0.56)),
        box(toned(p, 0.7), (0.255, 0.0, 0.32), (0.02, 0.44, 0.48)),
        disc(SILVER, (0.06, 0.36), 0.055, 0.04, 0.275), disc(INK, (0.06, 0.36), 0.025, 0.05, 0.28),
        *(limb(SILVER, (0.30, -0.10, 0.32),
            (0.30, -0.10 + 0.06 * math.cos(a), 0.32 + 0.06 * math.sin(a)), 0.010)
            for a in (0.5, 2.6, 4.7)),
        *(box(INK, (x, y, 0.02), (0.08, 0.08, 0.04)) for x in (0.18, -0.18)
            for y in (0.19, -0.19))], ("strongbox", "bank safe")),
    thing("necklace", ((0.75, 0.72, 0.66), BRASS.colour), lambda p: [
        *(ball(p, (-0.085 * math.sin(a), 0.075 * math.cos(a), 0.008), (0.016, 0.016, 0.016))
            for a in (2 * math.pi * k / 26 for k in range(26))),
            ball(RED_PAINT, (0.10, 0.0, 0.01), (0.026, 0.022, 0.018))],
            ("pearl necklace", "string of pearls")),
    thing("piggy bank", ((0.75, 0.32, 0.36),), lambda p: [
        ball(p, (0.0, 0.0, 0.085), (0.20, 0.13, 0.13)),
        rod(p, (0.085, 0.0, 0.085), (0.118, 0.0, 0.085), 0.026),
        *(disc(INK, (0.01 * s, 0.085), 0.006, 0.004, 0.119) for s in (1.0, -1.0)),
        *(ball(INK, (0.078, 0.03 * s, 0.115), (0.012, 0.012, 0.012)) for s in (1.0, -1.0)),
        *(spike(p, (0.05, 0.035 * s, 0.13), (0.065, 0.05 * s, 0.165), 0.018) for s in (1.0, -1.0)),
        *(post(p, (x, 0.035 * s, 0.02), (0.03, 0.03, 0.05)) for x in (0.05, -0.05)
            for s in (1.0, -1.0)), box(INK, (0.0, 0.0, 0.149), (0.045, 0.008, 0.004)),
            *ring(p, (-0.105, 0.0, 0.10), (0.012, 0.012), 0.004, pieces=8)], ("money box",)),
    thing("harmonica", (SILVERY,),
        lambda p: [box(p, (0.0, 0.0, 0.014), (0.026, 0.10, 0.024)),
            box(Material(DARK_WOOD), (0.0, 0.0, 0.014), (0.0275, 0.102, 0.010)),
            *(box(INK, (0.0135, -0.042 + 0.0093 * k, 0.014), (0.002, 0.005, 0.006))
                for k in range(10))], ("mouth organ",)),
    thing("abacus", (WOOD_BROWN,), lambda p: [
        *(bar(p, (0.15 * s, 0.0), (0.15 * s, 0.24), 0.02, 0.03) for s in (1.0, -1.0)),
        *(bar(p, (-0.15, z), (0.15, z), 0.02, 0.03) for z in (0.01, 0.23)),
        *(rod(SILVER, (0.0, -0.14, 0.045 + 0.042 * k), (0.0, 0.14, 0.045 + 0.042 * k), 0.002)
            for k in range(5)),
        *(ball(_BEADS[k % 4], (0.0, -0.12 + 0.026 * i + (0.07 if i > 3 + k % 3 else 0.0),
            0.045 + 0.042 * k), (0.026, 0.022, 0.026)) for k in range(5) for i in range(7))]),
    thing("disco ball", (SILVERY,),
        lambda p: [rod(INK, (0.0, 0.0, 0.55), (0.0, 0.0, 1.0), 0.01),
            *(bar(INK, (0.35 * s, 0.0), (0.35 * s, 1.0), 0.03, 0.03) for s in (1.0, -1.0)),
            bar(INK, (-0.36, 1.0), (0.36, 1.0), 0.03, 0.03)], ("mirror ball", "mirrorball"),
            moving=(Moving(lambda p: [
        ball(checked(p.colour, (0.10, 0.11, 0.13), 7.0), (0.0, 0.0, 0.55), (0.5, 0.5, 0.5)),
        post(INK, (0.0, 0.0, 0.79), (0.08, 0.08, 0.04))], spinning("z", 0.25)),)),
    thing("treadmill", (INK.colour,),
        lambda p: [box(p, (0.0, 0.0, 0.10), (1.7, 0.75, 0.14)),
            *(rod(SILVER, (0.75, 0.36 * s, 0.15), (0.85, 0.36 * s, 1.3), 0.03)
                for s in (1.0, -1.0)),
                *(rod(SILVER, (0.85, 0.36 * s, 1.1), (0.2, 0.36 * s, 1.0), 0.025)
                    for s in (1.0, -1.0)),
                    plank(p, (0.85, 0.0, 1.2), (0.75, 0.0, 1.45), chord=(0.0, 0.7, 0.0),
                        thickness=(0.06, 0.0, 0.0)),
                        box(Material((0.10, 0.30, 0.55), emission=0.8), (0.76, 0.0, 1.34),
                            (0.01, 0.3, 0.14))], ("running machine",), moving=tuple(Moving(
        lambda p: [box(Material((0.25, 0.25, 0.26)), (0.0, 0.0, 0.175), (0.05, 0.5, 0.012))],
        _belt(0.36 * k)) for k in range(4))),
    thing("crutch", (SILVERY, PALE_WOOD),
        lambda p: lying([*(bar(p, (0.06 * s, 0.55), (0.07 * s, 1.25), 0.022, 0.022)
            for s in (1.0, -1.0)),
            *(bar(p, (0.06 * s, 0.56), (0.0, 0.25), 0.022, 0.022) for s in (1.0, -1.0)),
            bar(p, (0.0, 0.0), (0.0, 0.3), 0.024, 0.024),
            bar(INK, (-0.09, 1.26), (0.09, 1.26), 0.04, 0.05),
            bar(INK, (-0.06, 0.85), (0.06, 0.85), 0.03, 0.035)]), ("crutches",),
            plurals=("crutches",)),
    thing("paddle", (PALE_WOOD,),
        lambda p: lying([rod(p, (0.0, 0.0, 0.35), (0.0, 0.0, 1.4), 0.016),
            ball(p, (0.0, 0.0, 0.26), (0.03, 0.18, 0.50)),
            rod(p, (0.0, -0.06, 1.4), (0.0, 0.06, 1.4), 0.016)]), ("oar",)),
    thing("stethoscope", (BLACKISH, (0.03, 0.12, 0.40)),
        lambda p: lying([*ring(p, (0.0, 0.0, 0.20), (0.11, 0.16), 0.006, span=(-80.0, 260.0),
            pieces=14), *chain(p, [(0.0, -0.02, 0.045), (0.0, 0.05, -0.05), (0.0, 0.15, -0.03)],
            0.006), *(rod(SILVER, (0.0, 0.02 * s, 0.045), (0.0, 0.0, 0.10), 0.005)
                for s in (1.0, -1.0)), disc(SILVER, (0.17, -0.02), 0.025, 0.014),
                disc(INK, (0.17, -0.02), 0.018, 0.017)])),
))  # fmt: skip

_OUTDOOR = placed("grass", (
    thing("hammock", ((0.55, 0.06, 0.05), (0.05, 0.25, 0.35)),
        lambda p: [*(rod(Material((0.11, 0.065, 0.035)), (0.0, 1.7 * s, 0.0), (0.0, 1.7 * s, 2.2),
            0.10) for s in (1.0, -1.0))], moving=(Moving(lambda p: [
        *(plank(toned(p, 1.0 + 0.5 * (k % 2)),
            (0.0, -1.2 + 0.3 * k, 0.62 + 0.36 * ((-1.2 + 0.3 * k) / 1.2) ** 2),
            (0.0, -0.9 + 0.3 * k, 0.62 + 0.36 * ((-0.9 + 0.3 * k) / 1.2) ** 2),
            chord=(0.75, 0.0, 0.0), thickness=(0.0, 0.0, 0.03)) for k in range(8)),
            *(rod(PALE, (x, 1.2 * s, 0.98), (0.0, 1.68 * s, 1.45), 0.012) for s in (1.0, -1.0)
                for x in (0.3, 0.0, -0.3))], swinging("y", 0.15, 0.35, (0.0, 0.0, 1.45))),)),
    thing("sundial", (STONE.colour,),
        lambda p: [*lathe(mottled(p.colour, contrast=0.2),
            [(0.0, 0.22), (0.1, 0.14), (0.8, 0.10), (0.9, 0.2)], 6),
            post(mottled(p.colour, contrast=0.2), (0.0, 0.0, 0.92), (0.55, 0.55, 0.06)),
            post(BRASS, (0.0, 0.0, 0.955), (0.44, 0.44, 0.012)),
            blade(INK, (-0.12, 0.0, 0.96), (0.16, 0.0, 1.12), chord=(0.12, 0.0, 0.0),
                thickness=(0.0, 0.012, 0.0)),
                *(box(INK, (0.18 * math.cos(a), 0.18 * math.sin(a), 0.963), (0.03, 0.012, 0.004))
                    for a in (0.52 * k for k in range(12)))]),
    thing("spider web", ((0.72, 0.73, 0.76),),
        lambda p: [*(bar(Material(WOOD_BROWN), (0.52 * s, 0.0), (0.52 * s, 1.05), 0.05, 0.05)
            for s in (1.0, -1.0)),
            bar(Material(WOOD_BROWN), (-0.54, 1.05), (0.54, 1.05), 0.05, 0.05),
            *(bar(p, (0.0, 0.52), (0.5 * math.cos(a), 0.52 + 0.5 * math.sin(a)), 0.010, 0.006)
                for a in (0.785 * k for k in range(8))),
        *(bar(p, (r * math.cos(0.785 * k), 0.52 + r * math.sin(0.785 * k)),
            (r * math.cos(0.785 * (k + 1)), 0.52 + r * math.sin(0.785 * (k + 1))), 0.008, 0.006)
            for r in (0.10, 0.20, 0.30, 0.40) for k in range(8))], ("web", "cobweb", "spiderweb")),
    thing("starfish", ((0.70, 0.22, 0.04), (0.55, 0.10, 0.06)),
        lambda p: lying([*(spike(mottled(p.colour, contrast=0.3, scale=6.0), (0.0, 0.0, 0.10),
            (0.0, 0.10 * math.cos(a), 0.10 + 0.10 * math.sin(a)), 0.026)
            for a in (1.571 + 1.2566 * k for k in range(5))),
            ball(mottled(p.colour, contrast=0.3, scale=6.0), (0.0, 0.0, 0.10), (0.05, 0.06, 0.06)),
            *(ball(PALE, (0.02, 0.03 * math.cos(a), 0.10 + 0.03 * math.sin(a)), (0.008,) * 3)
                for a in (1.571 + 1.2566 * k for k in range(5)))]), ("sea star",),
                plurals=("starfish",)),
    thing("windsock", ((0.75, 0.22, 0.01),),
        lambda p: [rod(SILVER, (0.0, 0.0, 0.0), (0.0, 0.0, 3.0), 0.04)], ("wind sock",),
        moving=(Moving(lambda p: [
        *(rod(p if k % 2 == 0 else PALE, (0.0, 0.05 + 0.32 * k, 2.88 - 0.03 * k * k),
            (0.0, 0.05 + 0.32 * (k + 1), 2.88 - 0.03 * (k + 1) ** 2), 0.24 - 0.032 * k)
            for k in range(5)), rod(SILVER, (0.0, -0.02, 2.88), (0.0, 0.06, 2.88), 0.25)],
            swinging("z", 0.5, 0.3)),)),
))  # fmt: skip

NOUNS = (*_INDOOR, *_OUTDOOR)
"""Nouns of small things."""
