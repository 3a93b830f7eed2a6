"""Furniture: table, chair, sofa, bed, shelf; they face +x."""

from __future__ import annotations

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    WHITE,
    WOOD,
    Material,
    cloth,
    shade,
    wood,
)
from texvent.scenes.models.protocol import fixed_noun
from texvent.scenes.models.shapes import ball, box, limb
from texvent.scenes.models.variation import choose, fraction, paint
from texvent.scenes.scene import Colour

_FABRICS: tuple[Colour, ...] = ((0.05, 0.16, 0.32), (0.36, 0.07, 0.05), (0.24, 0.24, 0.22))


def build_table(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a table, 1.6 m by 0.9 m; `colour` is its wood."""
    grain = wood(colour) if colour is not None else WOOD
    parts = [box(grain, (0.0, 0.0, 0.73), (0.90, 1.60, 0.05))]
    parts.append(box(grain, (0.0, 0.0, 0.66), (0.74, 1.44, 0.09)))
    parts += [
        box(grain, (x, y, 0.36), (0.07, 0.07, 0.72)) for x in (0.38, -0.38) for y in (0.7, -0.7)
    ]
    return ArticulatedModel(parts, scale=scale)


def build_chair(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a chair with a slatted back; `colour` is its wood."""
    grain = wood(colour) if colour is not None else WOOD
    parts = [box(grain, (0.0, 0.0, 0.45), (0.44, 0.44, 0.05))]
    parts += [box(grain, (0.19, y, 0.22), (0.05, 0.05, 0.44)) for y in (0.19, -0.19)]
    parts += [box(grain, (-0.20, y, 0.47), (0.05, 0.05, 0.94)) for y in (0.19, -0.19)]
    parts += [box(grain, (-0.20, 0.0, z), (0.03, 0.40, 0.08)) for z in (0.62, 0.76, 0.90)]
    return ArticulatedModel(parts, scale=scale)


def build_sofa(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a sofa for two, 2 m wide; `colour` is its fabric."""
    hue = paint(colour, seed, "fabric", _FABRICS)
    fabric, cushion = cloth(hue), cloth(shade(hue, 1.35))
    parts = [
        box(fabric, (0.0, 0.0, 0.24), (0.85, 1.90, 0.30)),
        box(fabric, (-0.36, 0.0, 0.55), (0.22, 1.90, 0.65)),
        *(box(fabric, (0.02, y, 0.40), (0.85, 0.20, 0.48)) for y in (0.92, -0.92)),
        *(box(cushion, (0.08, y, 0.44), (0.66, 0.80, 0.14)) for y in (0.41, -0.41)),
        *(box(cushion, (-0.20, y, 0.66), (0.16, 0.80, 0.36), lean=-0.3) for y in (0.41, -0.41)),
        *(box(WOOD, (x, y, 0.05), (0.07, 0.07, 0.10)) for x in (0.36, -0.38) for y in (0.9, -0.9)),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_bed(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a double bed, 2.1 m long, its headboard at -x; `colour` is its blanket."""
    blanket = cloth(paint(colour, seed, "blanket", _FABRICS))
    white = cloth(WHITE)
    parts = [
        box(WOOD, (0.0, 0.0, 0.20), (2.10, 1.60, 0.20)),
        box(WOOD, (-1.05, 0.0, 0.55), (0.08, 1.70, 1.10)),
        box(WOOD, (1.05, 0.0, 0.30), (0.08, 1.70, 0.60)),
        box(white, (0.0, 0.0, 0.40), (2.00, 1.55, 0.22)),
        box(blanket, (0.30, 0.0, 0.42), (1.45, 1.64, 0.24)),
        *(ball(white, (-0.75, y, 0.58), (0.45, 0.68, 0.20)) for y in (0.38, -0.38)),
        *(
            box(WOOD, (x, y, 0.05), (0.09, 0.09, 0.12))
            for x in (0.98, -0.98)
            for y in (0.72, -0.72)
        ),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_shelf(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a bookshelf, 1.8 m tall, full of books; `colour` is its wood."""
    grain = wood(colour) if colour is not None else WOOD
    parts = [box(grain, (0.0, y, 0.90), (0.32, 0.04, 1.80)) for y in (0.48, -0.48)]
    parts.append(box(grain, (-0.15, 0.0, 0.90), (0.02, 0.96, 1.80)))
    parts += [box(grain, (0.0, 0.0, 0.06 + 0.43 * i), (0.32, 0.96, 0.035)) for i in range(5)]
    hues: tuple[Colour, ...] = (*_FABRICS, (0.08, 0.28, 0.10), (0.55, 0.35, 0.06), WHITE)
    for shelf in range(4):
        y = -0.44
        for index in range(4):
            wide = 0.10 + 0.12 * fraction(seed, f"wide {shelf} {index}")
            tall = 0.24 + 0.10 * fraction(seed, f"tall {shelf} {index}")
            book = Material(choose(seed, f"hue {shelf} {index}", hues))
            middle = (0.0, y + 0.5 * wide, 0.08 + 0.43 * shelf + 0.5 * tall)
            parts.append(box(book, middle, (0.24, wide - 0.01, tall)))
            y += wide
    return ArticulatedModel(parts, scale=scale)


def build_bench(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a park bench, 1.6 m wide, with slats; `colour` is its wood."""
    grain = wood(colour) if colour is not None else WOOD
    iron = Material((0.03, 0.03, 0.03))
    parts = [box(grain, (0.20 - 0.14 * i, 0.0, 0.45), (0.11, 1.60, 0.035)) for i in range(4)]
    parts += [
        box(grain, (-0.28 - 0.03 * i, 0.0, 0.60 + 0.14 * i), (0.035, 1.60, 0.11)) for i in range(3)
    ]
    for y in (0.65, -0.65):
        parts.append(limb(iron, (0.22, y, 0.03), (0.18, y, 0.43), 0.03))
        parts.append(limb(iron, (-0.26, y, 0.03), (-0.33, y, 0.92), 0.03))
        parts.append(box(iron, (-0.02, y, 0.41), (0.50, 0.05, 0.05)))
    return ArticulatedModel(parts, scale=scale)


NOUNS = (
    fixed_noun("table", build_table, ("dining table", "kitchen table")),
    fixed_noun("chair", build_chair, ("wooden chair", "kitchen chair")),
    fixed_noun("sofa", build_sofa, ("couch", "settee")),
    fixed_noun("bed", build_bed, ("double bed",)),
    fixed_noun("bookshelf", build_shelf, ("bookcase",)),
    fixed_noun("bench", build_bench, ("park bench",)),
)
