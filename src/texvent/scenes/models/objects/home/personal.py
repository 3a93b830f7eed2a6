"""Bags, clothes, umbrella and what is used at the basin or the desk."""

from __future__ import annotations

from texvent.scenes.models.materials import Material, fur
from texvent.scenes.models.objects.figures import (
    bar,
    chain,
    disc,
    lathe,
    lying,
    placed,
    ring,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BRASS,
    INK,
    LEATHER,
    PALE,
    PALE_WOOD,
    RED_PAINT,
    SILVER,
    SILVERY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    ball,
    box,
    limb,
    moved,
    plank,
    post,
    rod,
    shift,
    spike,
    turn_z,
)
from texvent.scenes.scene import Colour

_CLOTH: tuple[Colour, ...] = ((0.45, 0.05, 0.04), (0.05, 0.14, 0.42), (0.06, 0.26, 0.12))
_BLUE_RED: tuple[Colour, ...] = ((0.05, 0.20, 0.50), (0.50, 0.04, 0.03))
_LENS = Material((0.04, 0.06, 0.09))


def _shoe(skin: Material, y: float) -> list[ModelPart]:
    """A shoe that points to +x."""
    return [
        box(PALE, (0.0, y, 0.012), (0.26, 0.085, 0.024)),
        ball(PALE, (0.12, y, 0.014), (0.08, 0.085, 0.028)),
        limb(skin, (-0.07, y, 0.05), (0.09, y, 0.038), 0.036, side_radius=0.042),
        limb(skin, (-0.075, y, 0.05), (-0.07, y, 0.10), 0.045),
        *(box(PALE, (x, y, 0.082 - 0.25 * (x + 0.02)), (0.008, 0.05, 0.006))
            for x in (-0.01, 0.02, 0.05)), ball(INK, (-0.07, y, 0.135), (0.07, 0.06, 0.03)),
    ]  # fmt: skip


def _glove(skin: Material) -> list[ModelPart]:
    return lying([
        ball(skin, (0.0, 0.0, 0.10), (0.035, 0.10, 0.12)),
        *(limb(skin, (0.0, y, 0.13), (0.0, 1.25 * y, z), 0.012) for y,
            z in ((-0.035, 0.195), (-0.012, 0.215), (0.012, 0.21), (0.035, 0.19))),
        limb(skin, (0.0, 0.04, 0.08), (0.0, 0.085, 0.13), 0.014),
        box(toned(skin, 0.7), (0.0, 0.0, 0.025), (0.04, 0.085, 0.05)),
    ])  # fmt: skip


def _shirt(skin: Material) -> list[ModelPart]:
    """A shirt laid flat."""
    return lying([
        box(skin, (0.0, 0.0, 0.34), (0.03, 0.46, 0.62)),
        *(bar(skin, (0.16 * s, 0.60), (0.36 * s, 0.42), 0.17, 0.028) for s in (1.0, -1.0)),
        disc(toned(skin, 0.4), (0.0, 0.655), 0.07, 0.034),
        bar(toned(skin, 0.75), (-0.23, 0.04), (0.23, 0.04), 0.03, 0.034),
    ])  # fmt: skip


def _fold(skin: Material, layer: int) -> list[ModelPart]:
    """A layer of a folded towel: soft edges, a pale stripe at both ends."""
    z, wide, long = 0.02 + 0.036 * layer, 0.13 - 0.004 * layer, 0.20 - 0.006 * layer
    return [
        box(skin, (0.0, 0.0, z), (2.0 * wide, 2.0 * long, 0.034)),
        *(limb(skin, (-wide, s * long, z), (wide, s * long, z), 0.019) for s in (1.0, -1.0)),
        *(limb(skin, (s * wide, -long, z), (s * wide, long, z), 0.019) for s in (1.0, -1.0)),
        *(box(PALE, (0.0, s * 0.145, z), (2.0 * wide + 0.01, 0.02, 0.0355)) for s in (1.0, -1.0)),
    ]


NOUNS = placed("indoor", (
    thing("backpack", _CLOTH, lambda p: [
        box(p, (0.0, 0.0, 0.22), (0.16, 0.30, 0.36)),
        rod(p, (0.0, -0.15, 0.38), (0.0, 0.15, 0.38), 0.08),
        box(toned(p, 0.7), (0.09, 0.0, 0.13), (0.07, 0.24, 0.18)),
        box(BRASS, (0.128, 0.0, 0.19), (0.006, 0.20, 0.008)),
        *ring(INK, (0.0, 0.0, 0.45), (0.04, 0.04), 0.009, span=(0.0, 180.0), pieces=6),
        *(part for y in (0.09, -0.09)
            for part in chain(INK, [(-0.08, y, 0.40), (-0.15, y, 0.28), (-0.09, y, 0.06)], 0.018)),
            box(toned(p, 1.4), (0.075, 0.0, 0.32), (0.02, 0.16, 0.02))],
        ("rucksack", "knapsack", "school bag", "schoolbag")),
    thing("handbag", ((0.50, 0.05, 0.05), LEATHER.colour, BLACKISH), lambda p: [
        plank(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.20), chord=(0.11, 0.0, 0.0),
            thickness=(0.0, 0.32, 0.0)), rod(p, (0.0, -0.14, 0.20), (0.0, 0.14, 0.20), 0.045),
        box(toned(p, 0.7), (0.052, 0.0, 0.17), (0.015, 0.30, 0.09)),
        ball(BRASS, (0.062, 0.0, 0.135), (0.01, 0.03, 0.03)),
        *ring(toned(p, 0.6), (0.0, 0.0, 0.22), (0.09, 0.14), 0.009, span=(0.0, 180.0), pieces=9)],
        ("purse",)),
    thing("suitcase", ((0.05, 0.16, 0.40), (0.50, 0.05, 0.04), BLACKISH), lambda p: [
        box(p, (0.0, 0.0, 0.36), (0.24, 0.44, 0.62)),
        *(box(toned(p, 0.65), (0.0, y, 0.36), (0.25, 0.022, 0.60))
            for y in (-0.14, -0.05, 0.05, 0.14)),
        *(rod(SILVER, (-0.08, y, 0.66), (-0.08, y, 0.98), 0.010) for y in (0.09, -0.09)),
        bar(INK, (-0.11, 0.99), (0.11, 0.99), 0.03, 0.03, -0.08),
        *(disc(INK, (y, 0.03), 0.03, 0.03, x) for x in (0.08, -0.08) for y in (0.18, -0.18))],
        ("luggage", "trolley case")),
    thing("briefcase", (LEATHER.colour, BLACKISH), lambda p: [
        box(p, (0.0, 0.0, 0.16), (0.10, 0.44, 0.32)),
        box(toned(p, 0.5), (0.0, 0.0, 0.24), (0.104, 0.44, 0.01)),
        *(box(BRASS, (0.053, y, 0.245), (0.008, 0.05, 0.03)) for y in (0.13, -0.13)),
        *ring(INK, (0.0, 0.0, 0.32), (0.07, 0.05), 0.010, span=(0.0, 180.0), pieces=6)],
        ("attache case",)),
    thing("shopping bag", (PALE.colour, (0.42, 0.26, 0.12)), lambda p: [
        box(p, (0.0, 0.0, 0.18), (0.14, 0.28, 0.36)),
        box(INK, (0.0, 0.0, 0.361), (0.12, 0.26, 0.004)),
        disc(RED_PAINT, (0.0, 0.18), 0.07, 0.006, 0.07),
        *(part for x in (0.06, -0.06)
            for part in ring(toned(p, 0.6), (x, 0.0, 0.36), (0.06, 0.10), 0.005, span=(0.0, 180.0),
                pieces=8))], ("carrier bag",)),
    thing("tie", _CLOTH, lambda p: lying([
        # The blade widens towards a point; the knot is over it, the band around no neck.
        *(bar(p, (0.0, z), (0.0, z + 0.045), 0.105 - 0.13 * (z - 0.07), 0.008)
            for z in (0.07, 0.11, 0.15, 0.19, 0.23, 0.27, 0.31, 0.35, 0.39, 0.43)),
        *(bar(p, (0.0, z), (0.0, z + 0.014), 1.5 * z, 0.008)
            for z in (0.008, 0.02, 0.032, 0.044, 0.056)),
        *(bar(PALE, (-w, z), (w, z + 0.035), 0.014, 0.012)
            for w, z in ((0.045, 0.09), (0.040, 0.16), (0.036, 0.23), (0.031, 0.30),
                (0.026, 0.37))),
        bar(toned(p, 0.8), (0.0, 0.465), (0.0, 0.50), 0.052, 0.028),
        bar(toned(p, 0.8), (0.0, 0.50), (0.0, 0.53), 0.066, 0.028),
        *ring(p, (0.0, 0.0, 0.565), (0.085, 0.045), 0.011, pieces=12)]),
        ("necktie",)),
    thing("hat", (BLACKISH, (0.40, 0.26, 0.12), (0.45, 0.05, 0.04)), lambda p: [
        post(p, (0.0, 0.0, 0.008), (0.36, 0.32, 0.016)),
        *lathe(p, [(0.01, 0.105), (0.11, 0.09)], 3), ball(p, (0.0, 0.0, 0.11), (0.18, 0.18, 0.05)),
        post(toned(p, 0.4), (0.0, 0.0, 0.03), (0.216, 0.216, 0.035))]),
    thing("cap", _BLUE_RED, lambda p: [
        post(p, (-0.02, 0.0, 0.02), (0.19, 0.17, 0.04)),
        *lathe(p, [(0.04, 0.09), (0.08, 0.075), (0.11, 0.03)], 6),
        ball(toned(p, 0.6), (0.0, 0.0, 0.112), (0.02, 0.02, 0.012)),
        post(toned(p, 0.8), (0.085, 0.0, 0.012), (0.19, 0.16, 0.012)),
        disc(PALE, (0.0, 0.045), 0.022, 0.03, 0.072)],
        ("baseball cap",)),
    thing("helmet", ((0.75, 0.45, 0.02), (0.50, 0.03, 0.02)), lambda p: [
        ball(p, (0.0, 0.0, 0.055), (0.30, 0.25, 0.20)),
        post(toned(p, 0.8), (0.0, 0.0, 0.055), (0.305, 0.255, 0.03)),
        ball(p, (0.10, 0.0, 0.045), (0.22, 0.22, 0.02)),
        box(toned(p, 1.4), (0.0, 0.0, 0.153), (0.18, 0.035, 0.012))],
        ("safety helmet", "crash helmet", "bicycle helmet")),
    thing("shoe", ((0.45, 0.05, 0.04), (0.05, 0.14, 0.42), (0.06, 0.06, 0.065)),
        lambda p: moved([*_shoe(p, 0.07), *moved(_shoe(p, -0.07), shift(x=0.05))], turn_z(0.9)),
          ("sneaker", "running shoe", "pair of shoes", "a pair of shoes")),
    thing("glove", (LEATHER.colour, (0.45, 0.05, 0.04), BLACKISH), _glove),
    thing("shirt", _CLOTH, _shirt,
        ("t-shirt",)),
    thing("sock", ((0.45, 0.05, 0.04), PALE.colour), lambda p: lying([
        bar(p, (0.0, 0.06), (0.0, 0.36), 0.10, 0.03),
        ball(p, (0.0, 0.0, 0.05), (0.032, 0.11, 0.10)),
        bar(p, (0.0, 0.05), (0.13, 0.05), 0.085, 0.03),
        ball(p, (0.0, 0.13, 0.05), (0.032, 0.10, 0.085)),
        *(bar(PALE if i % 2 else INK, (-0.05, 0.25 + 0.03 * i), (0.05, 0.25 + 0.03 * i), 0.02,
            0.034) for i in range(4))])),
    thing("glasses", (BLACKISH,), lambda p: [
        *(part for y in (0.034, -0.034)
            for part in ring(p, (0.0, y, 0.025), (0.028, 0.024), 0.0025, pieces=12)),
            *(disc(_LENS, (y, 0.025), 0.026, 0.002) for y in (0.034, -0.034)),
        rod(p, (0.0, -0.008, 0.03), (0.0, 0.008, 0.03), 0.002),
        *(part for y in (0.062, -0.062)
            for part in chain(p, [(0.0, y, 0.03), (-0.10, y, 0.03), (-0.135, y, 0.012)], 0.0022))],
        ("spectacles", "eyeglasses", "pair of glasses", "a pair of glasses"),
        plurals=("glasses",)),
    thing("watch", (BLACKISH, LEATHER.colour), lambda p: lying([
        bar(p, (0.0, 0.0), (0.0, 0.22), 0.022, 0.004), disc(SILVER, (0.0, 0.11), 0.02, 0.010),
        disc(PALE, (0.0, 0.11), 0.017, 0.0115), bar(INK, (0.0, 0.11), (0.0, 0.122), 0.0022, 0.013),
        bar(INK, (0.0, 0.11), (0.008, 0.104), 0.0026, 0.013),
        box(SILVER, (0.0, 0.0, 0.004), (0.006, 0.026, 0.012)),
        disc(SILVER, (0.021, 0.11), 0.003, 0.005)]),
        ("wristwatch", "wrist watch")),
    thing("ring", (BRASS.colour,), lambda p: [
        *ring(p, (0.0, 0.0, 0.011), (0.010, 0.010), 0.0015, pieces=16),
        ball(Material((0.6, 0.75, 0.85)), (0.0, 0.0, 0.0235), (0.006, 0.006, 0.005))],
        ("wedding ring", "diamond ring")),
    thing("wallet", (LEATHER.colour,),
        lambda p: [box(p, (0.0, 0.0, 0.01), (0.10, 0.12, 0.02)),
            box(toned(p, 0.5), (0.0, 0.0, 0.0205), (0.09, 0.11, 0.001)),
            box(BRASS, (0.045, 0.0, 0.02), (0.012, 0.02, 0.004))], ("billfold",)),
    thing("hair drier", ((0.50, 0.05, 0.20), (0.05, 0.16, 0.40)), lambda p: lying([
        rod(p, (0.0, -0.08, 0.17), (0.0, 0.05, 0.17), 0.046),
        ball(p, (0.0, 0.05, 0.17), (0.094, 0.08, 0.094)),
        rod(toned(p, 0.4), (0.0, -0.17, 0.17), (0.0, -0.08, 0.17), 0.040),
        rod(INK, (0.0, -0.172, 0.17), (0.0, -0.16, 0.17), 0.033),
        limb(p, (0.0, 0.015, 0.15), (0.0, 0.04, 0.0), 0.032),
        *chain(INK, [(0.0, 0.05, -0.01), (0.0, 0.07, -0.05), (0.0, 0.05, -0.08)], 0.006),
        box(PALE, (0.026, 0.035, 0.10), (0.012, 0.016, 0.03)),
        disc(INK, (0.095, 0.17), 0.03, 0.05)]),
        ("hair dryer", "hairdryer", "blow dryer", "hand blower", "hairdrier")),
    thing("toothbrush", _BLUE_RED, lambda p: lying([
        bar(p, (0.0, 0.0), (0.0, 0.19), 0.011, 0.006),
        ball(p, (0.0, 0.0, 0.03), (0.008, 0.016, 0.07)),
        *(bar(PALE if i % 2 else toned(p, 1.8), (-0.006, 0.157 + 0.007 * i),
            (0.006, 0.157 + 0.007 * i), 0.005, 0.014, 0.008) for i in range(5))])),
    thing("toothpaste", (PALE.colour,), lambda p: lying([
        bar(p, (0.0, 0.02), (0.0, 0.15), 0.045, 0.026),
        bar(p, (0.0, 0.15), (0.0, 0.16), 0.052, 0.006),
        rod(RED_PAINT, (0.0, 0.0, -0.005), (0.0, 0.0, 0.02), 0.012),
        bar(RED_PAINT, (0.0, 0.05), (0.0, 0.12), 0.02, 0.028)]),
        ("toothpaste tube", "tube of toothpaste")),
    thing("comb", (BLACKISH, (0.40, 0.10, 0.30)),
        lambda p: lying([bar(p, (-0.09, 0.04), (0.09, 0.04), 0.018, 0.005),
            *(bar(p, (-0.087 + 0.0092 * i, 0.0), (-0.087 + 0.0092 * i, 0.04), 0.0045, 0.004)
                for i in range(20))])),
    thing("brush", (WOOD_BROWN, (0.40, 0.10, 0.30)), lambda p: lying([
        limb(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.10), 0.011),
        ball(p, (0.0, 0.0, 0.16), (0.02, 0.07, 0.13)),
        *(rod(INK, (0.008, y, z), (0.028, y, z), 0.002) for y in (-0.018, 0.0, 0.018)
            for z in (0.12, 0.14, 0.16, 0.18, 0.20))]), ("hairbrush", "hair brush")),
    thing("razor", (_BLUE_RED[0],),
        lambda p: lying([bar(p, (0.0, 0.0), (0.0, 0.11), 0.012, 0.010),
            box(SILVER, (0.0, 0.0, 0.118), (0.012, 0.045, 0.018)),
            box(INK, (0.006, 0.0, 0.118), (0.004, 0.042, 0.006))])),
    thing("soap", ((0.55, 0.70, 0.50),),
        lambda p: [box(p, (0.0, 0.0, 0.012), (0.05, 0.075, 0.024)),
            ball(p, (0.0, 0.0, 0.012), (0.066, 0.09, 0.028)),
            box(toned(p, 0.7), (0.0, 0.0, 0.0265), (0.02, 0.04, 0.001))], ("bar of soap",)),
    thing("towel", _BLUE_RED,
        lambda p: [*(part for i in range(4) for part in _fold(fur(p.colour), i))],
            ("bath towel",)),
    thing("toilet paper", (PALE.colour,),
        lambda p: [rod(p, (-0.05, 0.0, 0.055), (0.05, 0.0, 0.055), 0.055),
            disc(Material((0.40, 0.26, 0.14)), (0.0, 0.055), 0.021, 0.102),
            bar(p, (0.053, 0.0), (0.053, 0.06), 0.004, 0.10)],
            ("toilet roll", "toilet tissue")),
    thing("scissors", ((0.55, 0.04, 0.03), (0.75, 0.30, 0.02)), lambda p: lying([
        *(part for s in (1.0, -1.0)
            for part in ring(p, (0.002 * s, 0.032 * s, 0.035), (0.022, 0.032), 0.006, pieces=10)),
            *(bar(SILVER, (0.022 * s, 0.06), (-0.022 * s, 0.20), 0.014, 0.003, 0.002 * s)
                for s in (1.0, -1.0)), disc(INK, (0.0, 0.115), 0.005, 0.012)]),
        ("pair of scissors", "a pair of scissors"), plurals=("scissors", "pairs of scissors")),
    thing("pen", _BLUE_RED,
        lambda p: lying([bar(p, (0.0, 0.012), (0.0, 0.14), 0.011, 0.011),
            spike(SILVER, (0.0, 0.0, 0.014), (0.0, 0.0, -0.004), 0.0055),
            bar(SILVER, (0.005, 0.10), (0.005, 0.14), 0.004, 0.016),
            rod(SILVER, (0.0, 0.0, 0.14), (0.0, 0.0, 0.15), 0.004)]),
            ("ballpoint", "ballpoint pen")),
    thing("pencil", (YELLOW_PAINT.colour,), lambda p: lying([
        rod(p, (0.0, 0.0, 0.02), (0.0, 0.0, 0.17), 0.0042),
        spike(Material(PALE_WOOD), (0.0, 0.0, 0.02), (0.0, 0.0, 0.0), 0.0042),
        spike(INK, (0.0, 0.0, 0.006), (0.0, 0.0, -0.001), 0.0016),
        rod(SILVER, (0.0, 0.0, 0.165), (0.0, 0.0, 0.178), 0.0045),
        rod(Material((0.70, 0.25, 0.28)), (0.0, 0.0, 0.178), (0.0, 0.0, 0.188), 0.0042)]),
        ("coloured pencil", "colored pencil")),
    thing("paintbrush", ((0.55, 0.20, 0.04),),
        lambda p: lying([limb(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.15), 0.008),
            bar(SILVER, (0.0, 0.155), (0.0, 0.19), 0.03, 0.012),
            bar(INK, (0.0, 0.19), (0.0, 0.24), 0.028, 0.012),
            ball(INK, (0.0, 0.0, 0.24), (0.012, 0.026, 0.03))]), ("paint brush",)),
    thing("stapler", (BLACKISH, _BLUE_RED[1]),
        lambda p: [box(p, (0.0, 0.0, 0.006), (0.04, 0.16, 0.012)),
            plank(p, (0.0, 0.07, 0.022), (0.0, -0.08, 0.050), chord=(0.034, 0.0, 0.0),
                thickness=(0.0, 0.0, 0.02)),
                box(SILVER, (0.0, -0.075, 0.035), (0.024, 0.016, 0.02)),
                post(p, (0.0, 0.065, 0.02), (0.03, 0.03, 0.025))]),
    thing("key", (BRASS.colour, SILVERY),
        lambda p: lying([*ring(p, (0.0, 0.0, 0.06), (0.013, 0.013), 0.004, pieces=12),
            bar(p, (0.0, 0.0), (0.0, 0.048), 0.006, 0.003),
            *(bar(p, (0.0, z), (0.010, z), 0.004, 0.003) for z in (0.003, 0.011, 0.017))]),
            ("door key", "house key")),
    thing("padlock", (BRASS.colour,),
        lambda p: [box(p, (0.0, 0.0, 0.022), (0.022, 0.05, 0.044)),
            *ring(SILVER, (0.0, 0.0, 0.044), (0.016, 0.032), 0.005, span=(0.0, 180.0), pieces=8),
            disc(INK, (0.0, 0.025), 0.005, 0.024),
            bar(INK, (0.0, 0.012), (0.0, 0.024), 0.004, 0.024)], ()),
    thing("coin", (BRASS.colour, SILVERY),
        lambda p: [disc(p, (0.0, 0.012), 0.012, 0.002),
            disc(toned(p, 0.7), (0.0, 0.012), 0.0105, 0.0022),
            disc(p, (0.0, 0.012), 0.0098, 0.0024),
            bar(toned(p, 0.6), (0.0, 0.007), (0.0, 0.017), 0.003, 0.0028)]),
))  # fmt: skip
"""Nouns of what people carry, wear and use."""
