"""What stands on a table: cutlery, plates, glasses, jars, pots, pans."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, mottled
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
    vessel,
)
from texvent.scenes.models.objects.palette import (
    BLACK_PLASTIC,
    BRASS,
    CHINA,
    DARK_WOOD,
    IRON,
    PALE,
    PALE_WOOD,
    SILVER,
    SILVERY,
    STEELY,
    WATER,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, post, rod
from texvent.scenes.scene import Colour

_DARK_INSIDE = Material((0.05, 0.05, 0.055))
_TEA = Material((0.20, 0.07, 0.015))
_JAM = Material((0.35, 0.02, 0.03))
_GLASSY: Colour = (0.34, 0.46, 0.50)
_GLAZES: tuple[Colour, ...] = ((0.05, 0.20, 0.45), (0.55, 0.05, 0.04), (0.78, 0.76, 0.70))


def _ear(skin: Material, edge: float, low: float, high: float, thick: float) -> list[ModelPart]:
    """The handle of a cup, on its right."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    return ring(skin, (0.0, edge, middle), (1.1 * half, half), thick, span=(-90.0, 90.0), pieces=6)


def _long_handle(skin: Material, start: float, length: float, z: float) -> list[ModelPart]:
    """The handle of a pan, to the right."""
    return [limb(skin, (0.0, start, z), (0.0, start + length, 1.15 * z), 0.012)]


def _spoon(skin: Material, long: float) -> list[ModelPart]:
    return lying([
        ball(skin, (0.0, 0.0, 0.86 * long), (0.010, 0.22 * long, 0.32 * long)),
        ball(toned(skin, 0.55), (0.002, 0.0, 0.86 * long), (0.010, 0.16 * long, 0.25 * long)),
        bar(skin, (0.0, 0.0), (0.0, 0.74 * long), 0.055 * long, 0.005),
        ball(skin, (0.0, 0.0, 0.02 * long), (0.006, 0.10 * long, 0.12 * long)),
    ])  # fmt: skip


NOUNS = placed("indoor", (
    thing("fork", (SILVERY,), lambda p: lying([
        bar(p, (0.0, 0.0), (0.0, 0.12), 0.010, 0.004),
        ball(p, (0.0, 0.0, 0.012), (0.005, 0.018, 0.05)),
        bar(p, (-0.014, 0.125), (0.014, 0.125), 0.022, 0.004),
        *(bar(p, (y, 0.13), (y, 0.195), 0.0045, 0.004) for y in (-0.0118, -0.004, 0.004, 0.0118)),
    ])),
    thing("knife", (SILVERY,), lambda p: lying([
        bar(Material((0.05, 0.03, 0.02)), (0.0, 0.0), (0.0, 0.11), 0.020, 0.014),
        bar(p, (0.0, 0.11), (0.0, 0.23), 0.024, 0.004),
        bar(p, (-0.010, 0.20), (0.006, 0.255), 0.020, 0.003),
        *(disc(SILVER, (0.0, z), 0.004, 0.016) for z in (0.03, 0.08)),
    ]), ("kitchen knife", "table knife", "butter knife", "bread knife")),
    thing("spoon", (SILVERY,), lambda p: _spoon(p, 0.18), ("teaspoon", "tablespoon", "soup spoon")),
    thing("wooden spoon", (PALE_WOOD,), lambda p: _spoon(p, 0.32)),
    thing("chopstick", (DARK_WOOD,), lambda p: lying([
        bar(p, (-0.01, 0.0), (-0.003, 0.23), 0.007, 0.007),
        bar(p, (0.02, 0.0), (0.004, 0.23), 0.007, 0.007)])),
    thing("bowl", _GLAZES, lambda p: [
        *lathe(p, [(0.0, 0.062), (0.012, 0.066), (0.04, 0.086), (0.08, 0.10)], 9),
        post(toned(p, 1.6), (0.0, 0.0, 0.0805), (0.184, 0.184, 0.003)),
        post(toned(p, 0.6), (0.0, 0.004, 0.081), (0.15, 0.15, 0.004))],
        ("mixing bowl", "cereal bowl")),
    thing("water bowl", _GLAZES, lambda p: [
        *lathe(p, [(0.0, 0.12), (0.03, 0.125), (0.06, 0.105), (0.08, 0.10)], 9),
        post(Material((0.20, 0.42, 0.60)), (0.0, 0.0, 0.079), (0.19, 0.19, 0.004))],
        ("bowl of water", "water dish"), plurals=("bowls of water",)),
    thing("plate", (CHINA,), lambda p: [
        post(toned(p, 0.8), (0.0, 0.0, 0.006), (0.15, 0.15, 0.012)),
        post(p, (0.0, 0.0, 0.014), (0.26, 0.26, 0.010)),
        post(Material((0.05, 0.16, 0.42)), (0.0, 0.0, 0.0150), (0.245, 0.245, 0.0105)),
        post(p, (0.0, 0.0, 0.0156), (0.232, 0.232, 0.0110)),
        post(toned(p, 0.75), (0.0, 0.0, 0.0160), (0.165, 0.165, 0.0115)),
        post(p, (0.0, 0.0, 0.0164), (0.158, 0.158, 0.0120))], ("dish", "dinner plate")),
    thing("wine glass", (_GLASSY,), lambda p: [
        post(p, (0.0, 0.0, 0.003), (0.075, 0.075, 0.006)),
        post(p, (0.0, 0.0, 0.05), (0.009, 0.009, 0.10)),
        *lathe(Material((0.28, 0.01, 0.03)), [(0.09, 0.008), (0.105, 0.030), (0.13, 0.038)], 5),
        *lathe(p, [(0.13, 0.039), (0.16, 0.037), (0.19, 0.031)], 4),
        post(toned(p, 0.4), (0.0, 0.0, 0.19), (0.054, 0.054, 0.002))],
        ("wineglass", "glass of wine"), plurals=("glasses of wine",)),
    thing("glass", (_GLASSY,), lambda p: [
        post(WATER, (0.0, 0.0, 0.05), (0.064, 0.064, 0.095)),
        post(p, (0.0, 0.0, 0.12), (0.068, 0.068, 0.05)),
        post(p, (0.0, 0.0, 0.004), (0.068, 0.068, 0.008)),
        post(toned(p, 0.4), (0.0, 0.0, 0.1455), (0.058, 0.058, 0.003)),
        box(PALE, (0.034, -0.012, 0.075), (0.004, 0.006, 0.10))],
        ("glass of water", "drinking glass", "water glass", "tumbler"),
        plurals=("glasses of water",)),
    thing("beer glass", ((0.70, 0.36, 0.03),), lambda p: [
        post(p, (0.0, 0.0, 0.07), (0.085, 0.085, 0.14)),
        post(PALE, (0.0, 0.0, 0.15), (0.09, 0.09, 0.03)),
        ball(PALE, (0.0, 0.0, 0.165), (0.088, 0.088, 0.03)),
        *_ear(toned(p, 1.3), 0.042, 0.03, 0.12, 0.008)],
        ("glass of beer", "pint", "pint of beer")),
    thing("mug", _GLAZES, lambda p: [
        *vessel(p, 0.042, 0.095, _TEA),
        post(toned(p, 1.4), (0.0, 0.0, 0.0945), (0.084, 0.084, 0.0015)),
        *_ear(p, 0.038, 0.022, 0.076, 0.007)],
        ("coffee mug", "beer mug", "mug of coffee", "mug of tea", "cup of coffee",
            "cup of tea"),
        plurals=("mugs of coffee", "cups of coffee", "cups of tea")),
    thing("kettle", ((0.45, 0.46, 0.48), (0.55, 0.03, 0.02)), lambda p: [
        post(BLACK_PLASTIC, (0.0, 0.0, 0.012), (0.17, 0.17, 0.024)),
        *lathe(p, [(0.024, 0.082), (0.12, 0.075), (0.17, 0.055), (0.19, 0.030)], 9),
        ball(BLACK_PLASTIC, (0.0, 0.0, 0.20), (0.03, 0.03, 0.03)),
        rod(p, (0.0, -0.06, 0.11), (0.0, -0.125, 0.17), 0.016),
        *chain(BLACK_PLASTIC, [(0.0, 0.03, 0.19), (0.0, 0.11, 0.20), (0.0, 0.13, 0.15),
            (0.0, 0.08, 0.06)], 0.012)],
        ("electric kettle", "tea kettle")),
    thing("teapot", _GLAZES, lambda p: [
        ball(p, (0.0, 0.0, 0.078), (0.17, 0.17, 0.14)),
        post(p, (0.0, 0.0, 0.008), (0.09, 0.09, 0.016)),
        ball(toned(p, 0.8), (0.0, 0.0, 0.142), (0.085, 0.085, 0.02)),
        ball(p, (0.0, 0.0, 0.162), (0.024, 0.024, 0.026)),
        *chain(p, [(0.0, -0.07, 0.055), (0.0, -0.11, 0.085), (0.0, -0.135, 0.135)], 0.014),
        *_ear(p, 0.076, 0.045, 0.115, 0.008)], ("tea pot", "coffee pot", "coffeepot")),
    thing("pot", (STEELY, (0.50, 0.04, 0.03)), lambda p: [
        post(p, (0.0, 0.0, 0.075), (0.24, 0.24, 0.15)),
        post(toned(p, 1.5), (0.0, 0.0, 0.155), (0.25, 0.25, 0.012)),
        ball(toned(p, 1.5), (0.0, 0.0, 0.16), (0.23, 0.23, 0.05)),
        ball(BLACK_PLASTIC, (0.0, 0.0, 0.195), (0.045, 0.045, 0.025)),
        *(limb(BLACK_PLASTIC, (0.0, y, 0.12), (0.0, 1.28 * y, 0.12), 0.014)
            for y in (0.122, -0.122))],
        ("cooking pot", "saucepan")),
    thing("frying pan", ((0.03, 0.03, 0.033),), lambda p: [
        *lathe(p, [(0.0, 0.11), (0.045, 0.135)], 3),
        post(Material((0.12, 0.12, 0.13)), (0.0, 0.0, 0.0455), (0.25, 0.25, 0.002)),
        post(p, (0.0, 0.0, 0.046), (0.215, 0.215, 0.0025)), *_long_handle(p, 0.13, 0.19, 0.035)],
        ("skillet", "cooking pan", "pan")),
    thing("tray", (PALE_WOOD,), lambda p: [
        box(p, (0.0, 0.0, 0.008), (0.30, 0.44, 0.016)),
        *(box(toned(p, 0.7), (x, 0.0, 0.025), (0.014, 0.44, 0.05)) for x in (0.15, -0.15)),
        *(box(toned(p, 0.7), (0.0, y, 0.03), (0.30, 0.014, 0.06)) for y in (0.22, -0.22)),
        *(part for y in (0.22, -0.22) for part in chain(toned(p, 0.5),
            [(-0.06, y, 0.05), (-0.06, y, 0.085), (0.06, y, 0.085), (0.06, y, 0.05)], 0.006))],
        ("serving tray",)),
    thing("jar", (_GLASSY,), lambda p: [
        post(_JAM, (0.0, 0.0, 0.040), (0.09, 0.09, 0.076)),
        post(p, (0.0, 0.0, 0.003), (0.092, 0.092, 0.006)),
        post(p, (0.0, 0.0, 0.087), (0.09, 0.09, 0.020)),
        ball(p, (0.0, 0.0, 0.096), (0.09, 0.09, 0.03)),
        box(PALE, (0.0, 0.0, 0.042), (0.0915, 0.044, 0.036)),
        box(PALE, (0.0, 0.0, 0.042), (0.044, 0.0915, 0.036)),
        post(p, (0.0, 0.0, 0.110), (0.070, 0.070, 0.01)),
        post(BRASS, (0.0, 0.0, 0.122), (0.084, 0.084, 0.020))], ("jam jar", "mason jar")),
    thing("soda can", ((0.55, 0.03, 0.02), (0.04, 0.14, 0.42)), lambda p: [
        post(p, (0.0, 0.0, 0.06), (0.066, 0.066, 0.11)),
        post(SILVER, (0.0, 0.0, 0.1165), (0.056, 0.056, 0.007)),
        post(SILVER, (0.0, 0.0, 0.004), (0.058, 0.058, 0.008)),
        box(PALE, (0.0, 0.0, 0.06), (0.0672, 0.02, 0.07)),
        post(_DARK_INSIDE, (0.012, 0.0, 0.1205), (0.02, 0.014, 0.002))],
        ("tin can", "tin", "drink can", "pop can", "coke can")),
    thing("jug", (CHINA, (0.05, 0.20, 0.45)), lambda p: [
        post(p, (0.0, 0.0, 0.01), (0.10, 0.10, 0.02)),
        ball(p, (0.0, 0.0, 0.085), (0.16, 0.16, 0.16)),
        post(p, (0.0, 0.0, 0.165), (0.10, 0.10, 0.08)),
        ball(p, (0.0, 0.0, 0.20), (0.115, 0.115, 0.02)),
        post(_DARK_INSIDE, (0.0, 0.0, 0.209), (0.09, 0.09, 0.004)),
        limb(p, (0.0, -0.045, 0.19), (0.0, -0.07, 0.206), 0.016),
        *_ear(p, 0.055, 0.06, 0.18, 0.009)], ("water jug", "ewer")),
    thing("vase", ((0.05, 0.22, 0.45), (0.55, 0.16, 0.05), (0.70, 0.66, 0.58)), lambda p: [
        post(p, (0.0, 0.0, 0.01), (0.09, 0.09, 0.02)),
        ball(p, (0.0, 0.0, 0.12), (0.17, 0.17, 0.21)),
        post(p, (0.0, 0.0, 0.235), (0.062, 0.062, 0.06)),
        ball(p, (0.0, 0.0, 0.272), (0.115, 0.115, 0.024)),
        post(_DARK_INSIDE, (0.0, 0.0, 0.2835), (0.075, 0.075, 0.003)),
        post(toned(p, 1.9), (0.0, 0.0, 0.12), (0.171, 0.171, 0.02))]),
    thing("urn", ((0.50, 0.22, 0.10),), lambda p: [
        post(p, (0.0, 0.0, 0.015), (0.16, 0.16, 0.03)),
        post(p, (0.0, 0.0, 0.05), (0.08, 0.08, 0.06)),
        ball(p, (0.0, 0.0, 0.24), (0.32, 0.32, 0.34)),
        post(p, (0.0, 0.0, 0.42), (0.15, 0.15, 0.10)),
        post(p, (0.0, 0.0, 0.47), (0.21, 0.21, 0.02)),
        post(_DARK_INSIDE, (0.0, 0.0, 0.4805), (0.15, 0.15, 0.003)),
        *(part for s in (1.0, -1.0) for part in chain(
            p, [(0.0, 0.07 * s, 0.45), (0.0, 0.19 * s, 0.45), (0.0, 0.15 * s, 0.30)], 0.014))]),
    thing("bucket", ((0.05, 0.20, 0.50), (0.55, 0.04, 0.03), (0.36, 0.37, 0.39)), lambda p: [
        *lathe(p, [(0.0, 0.10), (0.27, 0.15)], 7),
        post(toned(p, 1.3), (0.0, 0.0, 0.262), (0.315, 0.315, 0.016)),
        post(_DARK_INSIDE, (0.0, 0.0, 0.271), (0.28, 0.28, 0.003)),
        *ring(IRON, (0.0, 0.0, 0.265), (0.155, 0.17), 0.006, span=(0.0, 180.0), pieces=8)],
        ("pail",)),
    thing("basket", ((0.40, 0.22, 0.08),), lambda p: [
        *lathe(mottled(p.colour, contrast=0.5, scale=9.0), [(0.0, 0.14), (0.18, 0.19)], 6),
        post(_DARK_INSIDE, (0.0, 0.0, 0.181), (0.34, 0.34, 0.003)),
        *ring(p, (0.0, 0.0, 0.18), (0.18, 0.20), 0.012, span=(0.0, 180.0), pieces=9),
        *ring(toned(p, 0.6), (0.0, 0.0, 0.18), (0.19, 0.19), 0.012, axis="z", pieces=12)],
        ("wicker basket",)),
    thing("chopping board", (PALE_WOOD,), lambda p: lying([
        box(mottled(p.colour, contrast=0.2), (0.0, 0.0, 0.15), (0.02, 0.24, 0.30)),
        box(mottled(p.colour, contrast=0.2), (0.0, 0.0, 0.34), (0.02, 0.06, 0.10)),
        disc(_DARK_INSIDE, (0.0, 0.36), 0.012, 0.022)]),
        ("cutting board",)),
    thing("whisk", (SILVERY,), lambda p: lying([
        limb(BLACK_PLASTIC, (0.0, 0.0, 0.0), (0.0, 0.0, 0.10), 0.011),
        *(part for wide in (0.035, 0.022, 0.009)
            for part in ring(p, (0.0, 0.0, 0.18), (wide, 0.08), 0.002, pieces=10,
                span=(-90.0, 270.0)))])),
    thing("corkscrew", (SILVERY,), lambda p: lying([
        limb(Material(PALE_WOOD), (0.0, -0.05, 0.10), (0.0, 0.05, 0.10), 0.012),
        rod(p, (0.0, 0.0, 0.06), (0.0, 0.0, 0.10), 0.004),
        *chain(p, [(0.008 * math.cos(1.3 * i), 0.008 * math.sin(1.3 * i), 0.06 - 0.005 * i)
            for i in range(13)], 0.002)])),
    thing("napkin", (CHINA, (0.50, 0.04, 0.05)), lambda p: [
        box(p, (0.0, 0.0, 0.004), (0.20, 0.20, 0.008)),
        box(toned(p, 0.8), (0.05, 0.0, 0.0085), (0.10, 0.20, 0.006))], ("serviette",)),
    thing("candlestick", ((0.58, 0.40, 0.10),), lambda p: [
        *lathe(p, [(0.0, 0.055), (0.02, 0.05), (0.03, 0.014), (0.09, 0.020), (0.12, 0.011),
            (0.19, 0.012), (0.21, 0.03)], 14),
        post(PALE, (0.0, 0.0, 0.30), (0.022, 0.022, 0.18)),
        ball(Material((1.0, 0.6, 0.15), emission=3.0), (0.0, 0.0, 0.41), (0.016, 0.016, 0.036)),
        post(BRASS, (0.0, 0.0, 0.214), (0.03, 0.03, 0.01))],
        ("candle holder",)),
))  # fmt: skip
"""Nouns of what stands on a table."""
