"""Musical instruments."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material
from texvent.scenes.models.objects.figures import (
    Moving,
    bar,
    chain,
    disc,
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
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    WOOD_BROWN,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, moved, plank, post, rod, shift, spike


def _strung(skin: Material, size: float, neck: Material) -> list[ModelPart]:
    """A body with a waist, a sound hole, a neck and strings; `size` is its length, m."""
    s = size
    return [
        disc(skin, (0.0, 0.185 * s), 0.185 * s, 0.09 * s),
        disc(skin, (0.0, 0.41 * s), 0.140 * s, 0.09 * s),
        box(skin, (0.0, 0.0, 0.31 * s), (0.09 * s, 0.21 * s, 0.16 * s)),
        disc(INK, (0.0, 0.34 * s), 0.055 * s, 0.094 * s),
        bar(INK, (-0.07 * s, 0.16 * s), (0.07 * s, 0.16 * s), 0.025 * s, 0.11 * s),
        bar(neck, (0.0, 0.42 * s), (0.0, 0.86 * s), 0.055 * s, 0.03 * s, 0.045 * s),
        bar(neck, (0.0, 0.86 * s), (0.0, 1.0 * s), 0.085 * s, 0.03 * s, 0.04 * s),
        *(bar(PALE, (y * s, 0.16 * s), (y * s, 0.90 * s), 0.0035 * s, 0.004 * s, 0.062 * s)
            for y in (-0.016, -0.006, 0.006, 0.016)),
        *(ball(SILVER, (0.04 * s, y * s, z * s), (0.02 * s, 0.03 * s, 0.02 * s))
            for y in (0.055, -0.055) for z in (0.89, 0.93, 0.97)),
    ]  # fmt: skip


def _bowed(skin: Material, size: float) -> list[ModelPart]:
    s = size
    dark = Material((0.02, 0.015, 0.012))
    return [
        disc(skin, (0.0, 0.175 * s), 0.175 * s, 0.08 * s),
        disc(skin, (0.0, 0.45 * s), 0.135 * s, 0.08 * s),
        box(skin, (0.0, 0.0, 0.31 * s), (0.08 * s, 0.16 * s, 0.22 * s)),
        *(bar(INK, (y * s, 0.24 * s), (1.2 * y * s, 0.36 * s), 0.015 * s, 0.084 * s)
            for y in (0.075, -0.075)),
            bar(dark, (0.0, 0.04 * s), (0.0, 0.20 * s), 0.055 * s, 0.10 * s),
            bar(PALE, (-0.045 * s, 0.27 * s), (0.045 * s, 0.27 * s), 0.012 * s, 0.13 * s),
        bar(dark, (0.0, 0.40 * s), (0.0, 0.88 * s), 0.045 * s, 0.03 * s, 0.045 * s),
        *(bar(PALE, (y * s, 0.18 * s), (y * s, 0.88 * s), 0.004 * s, 0.004 * s, 0.064 * s)
            for y in (-0.012, 0.0, 0.012)),
        ball(skin, (0.03 * s, 0.0, 0.96 * s), (0.07 * s, 0.04 * s, 0.08 * s)),
        *(bar(dark, (-0.06 * s, z * s), (0.06 * s, z * s), 0.014 * s, 0.016 * s, 0.03 * s)
            for z in (0.90, 0.935)),
    ]  # fmt: skip


def _drum(skin: Material, radius: float, tall: float, low: float) -> list[ModelPart]:
    """An upright drum, its lower edge at a height."""
    d = 2 * radius
    return [
        post(skin, (0.0, 0.0, low + 0.5 * tall), (d, d, tall)),
        post(PALE, (0.0, 0.0, low + tall), (0.95 * d, 0.95 * d, 0.02 * tall)),
        *(post(SILVER, (0.0, 0.0, low + z * tall), (1.04 * d, 1.04 * d, 0.07 * tall))
            for z in (0.04, 0.95)),
        *(rod(SILVER, (1.03 * radius * math.cos(a), 1.03 * radius * math.sin(a), low),
            (1.03 * radius * math.cos(a), 1.03 * radius * math.sin(a), low + tall), 0.02 * radius)
            for a in (-1.2, -0.6, 0.0, 0.6, 1.2)),
    ]  # fmt: skip


def _at(parts: list[ModelPart], x: float, y: float) -> list[ModelPart]:
    return moved(parts, shift(x, y))


def _cymbal(x: float, y: float, z: float) -> list[ModelPart]:
    return [
        rod(SILVER, (x, y, 0.0), (x, y, z), 0.012),
        post(BRASS, (x, y, z), (0.42, 0.42, 0.012)),
        ball(BRASS, (x, y, z), (0.12, 0.12, 0.05)),
    ]


def _keys(wide: float, x: float, z: float, long: float) -> list[ModelPart]:
    """White keys with black ones between, along y."""
    whites = box(PALE, (x, 0.0, z), (long, wide, 0.02))
    step = wide / 14
    return [whites, *(box(INK, (x - 0.2 * long, (k - 6.5) * step, z + 0.014),
        (0.6 * long, 0.55 * step, 0.016)) for k in range(14) if k % 7 not in (2, 6)),
            *(box(GREY_PLASTIC, (x, (k - 7) * step, z + 0.0105), (long, 0.06 * step, 0.002))
                for k in range(1, 14))]  # fmt: skip


NOUNS = placed("indoor", (
    thing("guitar", ((0.50, 0.22, 0.06), (0.30, 0.10, 0.03)),
        lambda p: _strung(p, 1.0, Material(DARK_WOOD)), ("acoustic guitar", "classical guitar")),
    thing("electric guitar", ((0.50, 0.03, 0.03), (0.03, 0.10, 0.40)), lambda p: [
        disc(p, (0.0, 0.17), 0.16, 0.045), disc(p, (0.05, 0.33), 0.12, 0.045),
        disc(p, (-0.06, 0.32), 0.11, 0.045), limb(p, (0.0, 0.10, 0.38), (0.0, 0.14, 0.46), 0.03),
        limb(p, (0.0, -0.09, 0.36), (0.0, -0.13, 0.42), 0.03),
        bar(PALE, (-0.06, 0.14), (0.06, 0.34), 0.14, 0.048),
        *(bar(INK, (-0.05, z), (0.05, z), 0.025, 0.055) for z in (0.18, 0.25, 0.31)),
        bar(Material(PALE_WOOD), (0.0, 0.36), (0.0, 0.86), 0.05, 0.03, 0.015),
        bar(p, (0.0, 0.86), (0.02, 1.0), 0.08, 0.025, 0.015),
        *(bar(SILVER, (y, 0.14), (y, 0.9), 0.003, 0.004, 0.034)
            for y in (-0.015, -0.005, 0.005, 0.015))]),
    thing("ukulele", ((0.40, 0.18, 0.06),), lambda p: _strung(p, 0.55, Material(DARK_WOOD))),
    thing("violin", ((0.36, 0.10, 0.03),),
        lambda p: lying([*_bowed(p, 0.60),
            rod(Material(DARK_WOOD), (0.0, 0.16, -0.02), (0.0, 0.19, 0.66), 0.005),
            bar(PALE, (0.145, 0.0), (0.175, 0.64), 0.006, 0.004)]), ("fiddle",)),
    thing("cello", ((0.36, 0.10, 0.03),), lambda p: _bowed(p, 1.2)),
    thing("piano", (BLACKISH, DARK_WOOD), lambda p: [
        box(p, (-0.22, 0.0, 0.62), (0.30, 1.45, 1.20)),
        box(p, (0.06, 0.0, 0.60), (0.40, 1.45, 0.10)), *_keys(1.30, 0.10, 0.665, 0.18),
        *(box(p, (0.06, 0.69 * s, 0.66), (0.42, 0.07, 0.22)) for s in (1.0, -1.0)),
        *(box(p, (0.20, 0.66 * s, 0.28), (0.07, 0.07, 0.56)) for s in (1.0, -1.0)),
        box(toned(p, 2.5), (-0.06, 0.0, 0.92), (0.02, 1.2, 0.30)),
        box(PALE, (-0.04, 0.0, 0.94), (0.01, 0.34, 0.24)),
        *(box(BRASS, (0.0, y, 0.05), (0.14, 0.03, 0.02)) for y in (-0.07, 0.0, 0.07))],
        ("upright piano",)),
    thing("grand piano", (BLACKISH,), lambda p: [
        box(p, (0.0, 0.0, 0.85), (0.7, 1.45, 0.26)),
        plank(p, (-0.3, 0.28, 0.85), (-1.0, 0.45, 0.85), chord=(0.0, 0.90, 0.0),
            thickness=(0.0, 0.0, 0.26)), *_keys(1.25, 0.26, 0.99, 0.16),
            plank(toned(p, 2.0), (-0.5, -0.72, 1.0), (-0.5, -0.35, 1.75), chord=(1.4, 0.0, 0.0),
                thickness=(0.0, 0.0, 0.03)),
        *(rod(p, (x, y, 0.0), (x, y, 0.75), 0.05) for x,
            y in ((0.22, 0.62), (0.22, -0.62), (-0.85, 0.35)))], ("concert grand",)),
    thing("music keyboard", (BLACKISH,),
        lambda p: [box(p, (0.0, 0.0, 0.74), (0.30, 1.10, 0.08)), *_keys(1.0, 0.07, 0.785, 0.14),
            *(rod(IRON, (0.0, 0.35 * s, 0.0), (0.0, -0.35 * s, 0.70), 0.02) for s in (1.0, -1.0)),
            box(Material((0.10, 0.30, 0.55), emission=0.8), (-0.08, 0.0, 0.782),
                (0.07, 0.18, 0.01))], ("electric piano", "electronic keyboard")),
    thing("drum", ((0.50, 0.03, 0.03), (0.04, 0.12, 0.42)),
        lambda p: [*_drum(p, 0.19, 0.26, 0.0),
            *(rod(Material(PALE_WOOD), (-0.12, 0.02 * s, 0.275), (0.22, 0.10 * s, 0.30), 0.008)
                for s in (1.0, -1.0))], ("snare drum", "tom-tom", "tambour")),
    thing("drum kit", ((0.50, 0.03, 0.03), (0.04, 0.12, 0.42)), lambda p: [
        rod(p, (-0.20, 0.0, 0.29), (0.22, 0.0, 0.29), 0.28),
        disc(PALE, (0.0, 0.29), 0.26, 0.02, 0.225), disc(INK, (0.0, 0.29), 0.10, 0.022, 0.228),
        *_at(_drum(p, 0.17, 0.16, 0.45)[:4], -0.30, 0.42),
        *_at(_drum(p, 0.20, 0.36, 0.15)[:4], -0.25, -0.48),
        *_at(_drum(p, 0.14, 0.20, 0.62)[:4], 0.02, 0.17),
        *_at(_drum(p, 0.14, 0.20, 0.62)[:4], 0.02, -0.17), *_cymbal(-0.15, 0.62, 1.05),
        *_cymbal(-0.10, -0.62, 1.15),
        *(rod(SILVER, (-0.25, -0.48 + 0.15 * s, 0.0), (-0.25, -0.48 + 0.17 * s, 0.3), 0.012)
            for s in (1.0, -1.0))],
        ("drum set", "drumset"), plurals=("drum kits",)),
    thing("cymbal", (BRASS.colour,),
        lambda p: [rod(SILVER, (0.0, 0.0, 0.0), (0.0, 0.0, 0.95), 0.012),
            *(rod(SILVER, (0.0, 0.0, 0.3), (0.3 * c, 0.3 * s, 0.0), 0.012) for c,
                s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87)))], moving=(Moving(lambda p: [
        post(p, (0.0, 0.0, 0.95), (0.50, 0.50, 0.012)),
        ball(p, (0.0, 0.0, 0.95), (0.15, 0.15, 0.06)),
        post(toned(p, 0.7), (0.0, 0.0, 0.952), (0.34, 0.34, 0.012)),
        post(p, (0.0, 0.0, 0.954), (0.32, 0.32, 0.012))],
        swinging("x", 0.16, 1.6, (0.0, 0.0, 0.95))),)),
    thing("gong", (BRASS.colour,),
        lambda p: [*(rod(Material(DARK_WOOD), (0.0, 0.55 * s, 0.0), (0.0, 0.55 * s, 1.25), 0.035)
            for s in (1.0, -1.0)),
            rod(Material(DARK_WOOD), (0.0, -0.6, 1.25), (0.0, 0.6, 1.25), 0.035)],
            moving=(Moving(lambda p: [
        disc(p, (0.0, 0.68), 0.42, 0.05), disc(toned(p, 0.7), (0.0, 0.68), 0.30, 0.055),
        disc(p, (0.0, 0.68), 0.28, 0.06), disc(toned(p, 1.2), (0.0, 0.68), 0.10, 0.08),
        *(rod(PALE, (0.0, 0.2 * s, 1.0), (0.0, 0.2 * s, 1.25), 0.008) for s in (1.0, -1.0))],
        swinging("y", 0.10, 0.6, (0.0, 0.0, 1.25))),)),
    thing("trumpet", (BRASS.colour,), lambda p: lying([
        spike(p, (0.0, 0.30, 0.12), (0.0, 0.02, 0.12), 0.062),
        rod(toned(p, 0.5), (0.0, 0.298, 0.12), (0.0, 0.303, 0.12), 0.05),
        rod(p, (0.0, -0.30, 0.12), (0.0, 0.08, 0.12), 0.009),
        *(rod(p, (0.012 * (k - 1), -0.06 + 0.045 * k, 0.03),
            (0.012 * (k - 1), -0.06 + 0.045 * k, 0.17), 0.014) for k in range(3)),
            *(ball(PALE, (0.012 * (k - 1), -0.06 + 0.045 * k, 0.185), (0.022,) * 3)
                for k in range(3)),
        *chain(p, [(0.0, 0.08, 0.12), (0.0, 0.11, 0.085), (0.0, 0.08, 0.05), (0.0, -0.14, 0.05),
            (0.0, -0.17, 0.085), (0.0, -0.14, 0.12)], 0.009),
            rod(SILVER, (0.0, -0.34, 0.12), (0.0, -0.30, 0.12), 0.012)])),
    thing("saxophone", (BRASS.colour,), lambda p: [
        *chain(p, [(0.0, -0.20, 0.72), (0.0, -0.11, 0.76), (0.0, -0.05, 0.70)], 0.014),
        rod(p, (0.0, -0.05, 0.70), (0.0, 0.0, 0.12), 0.03),
        *chain(p, [(0.0, 0.0, 0.12), (0.0, 0.06, 0.045), (0.0, 0.13, 0.12)], 0.045),
        rod(p, (0.0, 0.13, 0.12), (0.0, 0.17, 0.30), 0.055),
        spike(p, (0.0, 0.20, 0.44), (0.0, 0.14, 0.12), 0.095),
        *(disc(toned(p, 1.3), (-0.04 + 0.006 * i, 0.60 - 0.09 * i), 0.022, 0.07)
            for i in range(5)), rod(INK, (0.0, -0.24, 0.70), (0.0, -0.19, 0.725), 0.014)],
            ("sax",)),
    thing("flute", (SILVERY,),
        lambda p: lying([rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.66), 0.0105),
            *(disc(toned(p, 0.6), (0.0, 0.05 + 0.032 * i), 0.009, 0.026) for i in range(12)),
            box(p, (0.008, 0.0, 0.58), (0.02, 0.025, 0.03))])),
    thing("harp", (BRASS.colour,), lambda p: [
        limb(p, (0.0, -0.35, 0.05), (0.0, -0.40, 1.60), 0.04),
        limb(p, (0.0, -0.35, 0.05), (0.0, 0.42, 1.15), 0.06),
        *chain(p, [(0.0, -0.40, 1.60), (0.0, -0.18, 1.40), (0.0, 0.15, 1.42), (0.0, 0.44, 1.18)],
            0.04), box(p, (0.0, -0.3, 0.04), (0.3, 0.35, 0.08)),
        *(rod(PALE, (0.0, -0.30 + 0.06 * i, 1.46 - 0.05 * math.sin(0.3 * i)),
            (0.0, -0.30 + 0.06 * i, 0.12 + 0.085 * i), 0.004) for i in range(11))]),
    thing("accordion", ((0.50, 0.03, 0.04),),
        lambda p: [*(box(p, (0.0, 0.17 * s, 0.17), (0.18, 0.09, 0.32)) for s in (1.0, -1.0)),
            *(box(INK if i % 2 else PALE, (0.0, -0.105 + 0.03 * i, 0.17),
                (0.17 if i % 2 else 0.155, 0.03, 0.30)) for i in range(8)),
                box(PALE, (0.095, 0.195, 0.17), (0.02, 0.03, 0.28)),
        *(disc(PALE, (-0.17 + 0.03 * (i % 2), 0.06 + 0.045 * i), 0.008, 0.19) for i in range(6))]),
    thing("xylophone", (WOOD_BROWN,),
        lambda p: [*(box(p, (x, 0.0, 0.03), (0.02, 0.62, 0.04)) for x in (0.08, -0.08)),
            *(box(Material(hue), (0.0, -0.26 + 0.075 * i, 0.06), (0.36 - 0.025 * i, 0.055, 0.014))
                for i, hue in enumerate(((0.5, 0.03, 0.03), (0.7, 0.2, 0.02), (0.7, 0.45, 0.03),
                    (0.2, 0.4, 0.05), (0.03, 0.3, 0.3), (0.03, 0.12, 0.45), (0.2, 0.05, 0.35),
                    (0.5, 0.05, 0.2))))]),
    thing("microphone", (BLACKISH,),
        lambda p: [post(p, (0.0, 0.0, 0.02), (0.28, 0.28, 0.04)),
            rod(SILVER, (0.0, 0.0, 0.0), (0.0, 0.0, 1.35), 0.012),
            limb(p, (0.0, 0.0, 1.33), (0.05, 0.0, 1.50), 0.026),
            ball(GREY_PLASTIC, (0.055, 0.0, 1.54), (0.075, 0.075, 0.085))], ("mic", "mike")),
    thing("metronome", (WOOD_BROWN, DARK_WOOD),
        lambda p: [*(box(p, (0.0, 0.0, 0.0125 + 0.025 * i),
            (0.13 - 0.009 * i, 0.13 - 0.009 * i, 0.025)) for i in range(9)),
            box(PALE, (0.052, 0.0, 0.11), (0.004, 0.03, 0.16))], moving=(Moving(lambda p: [
        bar(SILVER, (0.0, 0.03), (0.0, 0.25), 0.005, 0.004, 0.062),
        bar(BRASS, (-0.016, 0.19), (0.016, 0.19), 0.024, 0.012, 0.064)],
        swinging("x", 0.42, 1.0, (0.06, 0.0, 0.03))),)),
    thing("speaker", (BLACKISH,),
        lambda p: [box(p, (0.0, 0.0, 0.30), (0.26, 0.32, 0.60)),
            disc(GREY_PLASTIC, (0.0, 0.20), 0.13, 0.03, 0.125),
            disc(INK, (0.0, 0.20), 0.105, 0.034, 0.126),
            disc(GREY_PLASTIC, (0.0, 0.20), 0.04, 0.05, 0.126),
            disc(GREY_PLASTIC, (0.0, 0.46), 0.06, 0.03, 0.125),
            disc(INK, (0.0, 0.46), 0.042, 0.036, 0.126)],
            ("loudspeaker",)),
    thing("headphones", (BLACKISH, (0.50, 0.03, 0.03)),
        lambda p: [*ring(p, (0.0, 0.0, 0.09), (0.085, 0.11), 0.008, span=(0.0, 180.0), pieces=10),
            *(ball(p, (0.0, 0.085 * s, 0.05), (0.075, 0.04, 0.10)) for s in (1.0, -1.0)),
            *(ball(INK, (0.0, 0.070 * s, 0.05), (0.06, 0.03, 0.08)) for s in (1.0, -1.0))],
            ("pair of headphones", "a pair of headphones"),
            plurals=("headphones",)),
    thing("record player", (WOOD_BROWN,),
        lambda p: [box(p, (0.0, 0.0, 0.05), (0.36, 0.46, 0.10)),
            post(SILVER, (-0.10, 0.18, 0.115), (0.05, 0.05, 0.03)),
            *chain(SILVER, [(-0.10, 0.18, 0.13), (0.04, 0.16, 0.13), (0.08, 0.10, 0.122)], 0.007)],
            ("turntable",), moving=(Moving(lambda p: [
        post(INK, (0.0, -0.05, 0.105), (0.31, 0.31, 0.012)),
        post(RED_PAINT, (0.0, -0.05, 0.108), (0.10, 0.10, 0.012)),
        box(PALE, (0.03, -0.05, 0.109), (0.03, 0.02, 0.012)),
        box(GREY_PLASTIC, (0.10, -0.05, 0.1055), (0.09, 0.02, 0.012)),
        post(SILVER, (0.0, -0.05, 0.12), (0.008, 0.008, 0.02))],
        spinning("z", 0.55, (0.0, -0.05, 0.0))),)),
))  # fmt: skip
"""Nouns of instruments."""
