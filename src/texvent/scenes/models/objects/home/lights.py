"""Things that give light: bulbs, torches, desk lamps, LEDs, lanterns, neon tubes, lasers."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing
from texvent.scenes.models.objects.figures import (
    Moving,
    chain,
    disc,
    lathe,
    placed,
    ring,
    swinging,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLACKISH,
    BRASS,
    BULB,
    GREY_PLASTIC,
    INK,
    IRON,
    PALE,
    SILVER,
    STEELY,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, peak, post, rod, spike


def _led(skin: Material) -> list[ModelPart]:
    """A lamp with its dome and two legs, 30 times as large as it is, so that it can be seen."""
    light = Material(skin.colour, emission=3.0)
    return [
        ball(light, (0.0, 0.0, 0.20), (0.10, 0.10, 0.12)),
        post(light, (0.0, 0.0, 0.16), (0.10, 0.10, 0.08)),
        post(toned(skin, 0.6), (0.0, 0.0, 0.125), (0.12, 0.12, 0.016)),
        *(rod(SILVER, (0.0, y, 0.0), (0.0, y, 0.12), 0.005) for y in (0.025, -0.025)),
    ]  # fmt: skip


def _flame(angle: float, radius: float) -> Moving:
    """A flame of a fire that flickers about its foot."""
    y, z = radius * math.cos(angle), radius * math.sin(angle)
    parts = [
        limb(
            glowing((1.0, 0.40, 0.05), 2.5), (y, z, 0.15), (0.3 * y, 0.3 * z, 0.75 - radius), 0.11
        ),
        limb(glowing((1.0, 0.78, 0.30), 3.5), (y, z, 0.15), (0.4 * y, 0.4 * z, 0.5 - radius), 0.07),
    ]
    axis = "x" if angle < 3.0 else "y"
    return Moving(lambda skin: parts, swinging(axis, 0.16, 1.7 + 0.4 * angle, (0.0, 0.0, 0.1)))


def _lantern(skin: Material) -> list[ModelPart]:
    return [
        post(skin, (0.0, 0.0, 0.015), (0.16, 0.16, 0.03)),
        post(glowing((1.0, 0.75, 0.40), 1.0), (0.0, 0.0, 0.12), (0.10, 0.10, 0.18)),
        *(rod(skin, (x, y, 0.03), (x, y, 0.21), 0.006) for x in (0.055, -0.055)
            for y in (0.055, -0.055)),
        post(skin, (0.0, 0.0, 0.215), (0.17, 0.17, 0.015)),
        peak(skin, (0.0, 0.0, 0.25), (0.16, 0.16, 0.07)),
        *ring(skin, (0.0, 0.0, 0.31), (0.035, 0.04), 0.005, pieces=8),
    ]  # fmt: skip


def _arm(skin: Material, angle: float) -> list[ModelPart]:
    """One arm of a chandelier with its candle."""
    c, s = math.cos(angle), math.sin(angle)
    return [
        *chain(skin, [(0.05 * c, 0.05 * s, 0.10), (0.25 * c, 0.25 * s, 0.02),
            (0.42 * c, 0.42 * s, 0.14)], 0.014),
        post(PALE, (0.42 * c, 0.42 * s, 0.20), (0.035, 0.035, 0.12)),
        ball(BULB, (0.42 * c, 0.42 * s, 0.29), (0.04, 0.04, 0.07)),
    ]  # fmt: skip


NOUNS = placed("indoor", (
    thing("light bulb", (BULB.colour,), lambda p: [
        ball(Material(p.colour, emission=2.5), (0.0, 0.0, 0.085), (0.064, 0.064, 0.066)),
        *lathe(Material(p.colour, emission=1.5), [(0.03, 0.014), (0.065, 0.024)], 4),
        *(post(SILVER if i % 2 else GREY_PLASTIC, (0.0, 0.0, 0.006 + 0.005 * i),
            (0.027, 0.027, 0.005)) for i in range(5)),
            post(INK, (0.0, 0.0, 0.002), (0.014, 0.014, 0.004))],
        ("lightbulb", "bulb", "electric bulb", "incandescent lamp")),
    thing("led", ((0.75, 0.02, 0.02),), _led,
        ("led lamp", "light emitting diode", "led light", "indicator light")),
    thing("flashlight", (BLACKISH, (0.50, 0.04, 0.03)), lambda p: [
        rod(p, (0.0, -0.12, 0.03), (0.0, 0.05, 0.03), 0.018),
        rod(p, (0.0, 0.05, 0.03), (0.0, 0.10, 0.03), 0.03),
        rod(BULB, (0.0, 0.085, 0.03), (0.0, 0.102, 0.03), 0.026),
        box(PALE, (0.016, -0.02, 0.034), (0.008, 0.025, 0.012)),
        *(rod(toned(p, 2.0), (0.0, y, 0.03), (0.0, y + 0.006, 0.03), 0.0186)
            for y in (-0.10, -0.08, -0.06))],
        ("torch light", "electric torch", "torchlight")),
    thing("desk lamp", ((0.50, 0.04, 0.03), BLACKISH, (0.05, 0.20, 0.45)), lambda p: [
        post(p, (0.0, 0.0, 0.012), (0.18, 0.18, 0.024)),
        *chain(SILVER, [(0.0, 0.0, 0.02), (0.0, -0.14, 0.22), (0.0, 0.02, 0.42)], 0.010),
        spike(p, (0.0, 0.14, 0.32), (0.0, -0.02, 0.47), 0.085),
        ball(BULB, (0.0, 0.135, 0.325), (0.075, 0.075, 0.075)),
        ball(p, (0.0, -0.14, 0.22), (0.03, 0.03, 0.03))],
        ("table lamp", "reading lamp", "study lamp", "bedside lamp")),
    thing("lantern", (IRON.colour, (0.45, 0.04, 0.03)), _lantern,
        ("oil lamp", "kerosene lamp")),
    thing("paper lantern", ((0.75, 0.06, 0.03),), lambda p: [
        ball(Material(p.colour, emission=0.8), (0.0, 0.0, 0.24), (0.34, 0.34, 0.30)),
        *(post(BRASS, (0.0, 0.0, z), (0.13, 0.13, 0.03)) for z in (0.09, 0.39)),
        *(post(toned(p, 0.5), (0.0, 0.0, z), (w, w, 0.005)) for z,
            w in ((0.17, 0.30), (0.24, 0.345), (0.31, 0.30))),
            *(rod(BRASS, (0.0, y, 0.0), (0.0, y, 0.08), 0.004) for y in (-0.02, 0.0, 0.02))],
        ("chinese lantern",)),
    thing("chandelier", (BRASS.colour,), lambda p: [
        rod(p, (0.0, 0.0, 0.15), (0.0, 0.0, 0.90), 0.02),
        ball(p, (0.0, 0.0, 0.15), (0.16, 0.16, 0.20)),
        *(part for i in range(6) for part in _arm(p, 2.0 * math.pi * i / 6.0))]),
    thing("neon tube", ((0.95, 0.10, 0.45), (0.10, 0.75, 0.85)), lambda p: [
        rod(Material(p.colour, emission=2.5), (0.0, -0.55, 0.06), (0.0, 0.55, 0.06), 0.02),
        *(box(PALE, (0.0, y, 0.04), (0.06, 0.06, 0.08)) for y in (0.57, -0.57))],
        ("neon lamp", "fluorescent tube", "light tube")),
    thing("spotlight lamp", (BLACKISH,), lambda p: [
        *(rod(IRON, (0.0, 0.0, 0.55), (x, y, 0.0), 0.014) for x,
            y in ((0.3, 0.2), (0.3, -0.2), (-0.3, 0.0))),
            rod(IRON, (0.0, 0.0, 0.5), (0.0, 0.0, 1.45), 0.016),
        rod(p, (-0.18, 0.0, 1.52), (0.12, 0.0, 1.48), 0.12),
        disc(BULB, (0.0, 1.48), 0.10, 0.02, 0.125),
        *(box(p, (0.16, y, 1.48), (0.14, 0.012, 0.22)) for y in (0.13, -0.13))],
        ("stage light", "floodlight", "studio light", "searchlight")),
    thing("torch", (STEELY,), lambda p: [
        *lathe(Material((0.14, 0.07, 0.03)), [(0.0, 0.016), (0.40, 0.035)], 4),
        post(p, (0.0, 0.0, 0.42), (0.09, 0.09, 0.06))],
        ("burning torch",), moving=(Moving(lambda p: [
            limb(glowing((1.0, 0.42, 0.06), 3.0), (0.0, 0.0, 0.46), (0.0, 0.0, 0.62), 0.055),
            limb(glowing((1.0, 0.80, 0.35), 4.0), (0.0, 0.0, 0.46), (0.0, 0.0, 0.55), 0.033)],
            swinging("x", 0.12, 2.3, (0.0, 0.0, 0.45))),)),
    thing("campfire", ((0.16, 0.08, 0.04),), lambda p: [
        *(rod(p, (0.42 * math.cos(a), 0.42 * math.sin(a), 0.06),
            (-0.10 * math.cos(a), -0.10 * math.sin(a), 0.34), 0.055)
            for a in (0.3, 1.4, 2.5, 3.6, 4.6, 5.6)),
        *(ball(Material((0.25, 0.24, 0.23)), (0.55 * math.cos(a), 0.55 * math.sin(a), 0.07),
            (0.2, 0.2, 0.16)) for a in (0.0, 0.8, 1.6, 2.4, 3.1, 3.9, 4.7, 5.5))],
        ("bonfire",),
        moving=tuple(_flame(a, r) for a,
            r in ((0.0, 0.02), (1.6, 0.14), (3.4, 0.15), (5.0, 0.13)))),
    thing("lighter", ((0.50, 0.04, 0.03),), lambda p: [
        box(p, (0.0, 0.0, 0.03), (0.014, 0.026, 0.06)),
        box(SILVER, (0.0, 0.0, 0.067), (0.012, 0.022, 0.014)),
        disc(INK, (0.006, 0.075), 0.006, 0.008)],
        ("cigarette lighter",),
        moving=(Moving(lambda p: [limb(glowing((1.0, 0.60, 0.12), 3.0), (0.0, -0.004, 0.078),
            (0.0, -0.004, 0.10), 0.005)],
            swinging("x", 0.12, 3.1, (0.0, 0.0, 0.075))),)),
    thing("lava lamp", ((0.60, 0.05, 0.25), (0.05, 0.20, 0.55)), lambda p: [
        *lathe(SILVER, [(0.0, 0.07), (0.10, 0.05)], 4),
        *lathe(SILVER, [(0.36, 0.032), (0.42, 0.022)], 3),
        *lathe(Material(p.colour, emission=0.5), [(0.10, 0.055), (0.36, 0.034)], 6),
        *(ball(glowing((1.0, 0.45, 0.15), 1.2), (0.042, y, z), (0.05, w, w)) for y, z,
            w in ((0.01, 0.14, 0.06), (-0.015, 0.22, 0.045), (0.01, 0.30, 0.03)))]),
))  # fmt: skip
"""Nouns of what gives light."""
