"""Boats, their origins on the waterline; they rock on the waves."""

from __future__ import annotations

import math

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    DARK,
    GLASS,
    RED,
    STEEL,
    WHITE,
    WOOD,
    Material,
    cloth,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    ball,
    box,
    compose,
    fin,
    moved,
    plank,
    post,
    rod,
    turn_x,
    turn_y,
)
from texvent.scenes.models.variation import choose, fraction, paint
from texvent.scenes.scene import Colour


def build_boat(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a motor boat, 6 m; `colour` is its hull."""
    hue = paint(colour, seed, "hull", (WHITE, RED, (0.04, 0.14, 0.40)))
    hull, deck = Material(hue), WOOD
    parts = [
        *_hull(hull, 5.8, 2.1, 0.95),
        box(deck, (-0.8, 0.0, 0.62), (3.6, 1.7, 0.06)),
        box(Material(WHITE), (0.2, 0.0, 0.95), (1.7, 1.4, 0.75)),
        box(GLASS, (0.75, 0.0, 1.45), (0.70, 1.45, 0.50), lean=-0.7),
        box(Material(WHITE), (0.0, 0.0, 1.74), (1.8, 1.5, 0.10)),
        box(GLASS, (-0.15, 0.0, 1.45), (1.10, 1.42, 0.48)),
        box(DARK, (-2.85, 0.0, 0.55), (0.40, 0.42, 0.90)),
    ]
    return _rocking(parts, scale, seed, 0.03)


def build_sailboat(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a sailing boat, 7 m, with mainsail and jib; `colour` is its hull."""
    hull = Material(paint(colour, seed, "hull", (WHITE, (0.04, 0.12, 0.35), (0.35, 0.05, 0.04))))
    sail, second = cloth((0.85, 0.84, 0.80), scale=0.3), cloth((0.74, 0.73, 0.70), scale=0.3)
    parts = [
        *_hull(hull, 6.6, 2.0, 0.85),
        box(WOOD, (-0.8, 0.0, 0.62), (2.8, 1.4, 0.10)),
        ball(Material(WHITE), (0.6, 0.0, 0.62), (2.2, 1.2, 0.8)),
        rod(STEEL, (0.5, 0.0, 0.4), (0.5, 0.0, 8.4), 0.07),
        rod(STEEL, (0.5, 0.0, 1.3), (-2.8, 0.15, 1.3), 0.06),
        _sail(sail, (0.4, 0.0, 1.4), (-2.7, 0.15, 1.4), 8.2),
        _sail(second, (3.1, 0.0, 1.0), (0.75, 0.12, 1.2), 7.2, leans_back=True),
        rod(DARK, (3.2, 0.0, 0.8), (0.5, 0.0, 8.2), 0.02),
        rod(DARK, (-3.1, 0.0, 0.8), (0.5, 0.0, 8.4), 0.02),
    ]
    return _rocking(parts, scale, seed, 0.05)


def _sail(material: Material, luff: tuple[float, float, float], clew: tuple[float, float, float],
          top: float, *, leans_back: bool = False) -> ModelPart:  # fmt: skip
    """A flat cone with its point at the mast's head."""
    middle = (0.5 * (luff[0] + clew[0]), 0.5 * (luff[1] + clew[1]), 0.5 * (luff[2] + clew[2]))
    chord = (clew[0] - luff[0], clew[1] - luff[1], clew[2] - luff[2])
    tip = (clew[0] - 0.1 if leans_back else luff[0], 0.0, top)
    return fin(material, middle, tip, chord=chord, thickness=(0.0, 0.10, 0.0))


def build_ship(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a cargo ship, 60 m, with containers and a bridge; `colour` is its hull."""
    hue = paint(colour, seed, "hull", ((0.05, 0.10, 0.25), BLACK))
    hull, white = Material(hue), Material(WHITE)
    parts = [
        *_hull(hull, 58.0, 9.5, 6.0),
        box(Material((0.35, 0.04, 0.03)), (-2.0, 0.0, 0.3), (50.0, 9.2, 0.8)),
        box(white, (-21.0, 0.0, 8.0), (7.0, 8.0, 9.0)),
        box(GLASS, (-20.6, 0.0, 11.2), (6.6, 8.1, 1.1)),
        box(white, (-21.0, 0.0, 12.8), (8.0, 9.4, 0.9)),
        post(Material(RED), (-23.5, 0.0, 14.4), (2.2, 2.2, 3.6)),
        rod(STEEL, (22.0, 0.0, 5.0), (22.0, 0.0, 12.0), 0.3),
    ]
    hues: tuple[Colour, ...] = (RED, (0.05, 0.20, 0.45), (0.60, 0.30, 0.04), (0.10, 0.30, 0.14))
    for index in range(5):
        tall = 2.6 * (1 + int(2.99 * fraction(seed, f"stack {index}")))
        stack = Material(choose(seed, f"container {index}", hues))
        parts.append(box(stack, (-13.0 + 7.0 * index, 0.0, 4.6 + 0.5 * tall), (6.4, 8.0, tall)))
    return _rocking(parts, scale, seed, 0.01)


def _hull(material: Material, length: float, width: float, tall: float) -> list[ModelPart]:
    """A box with a raked, pointed bow; a quarter of it lies under water."""
    dark = Material(shade(material.colour, 0.6))
    z = 0.25 * tall
    stern, shoulder, bow = -0.48 * length, 0.20 * length, 0.50 * length
    middle = 0.5 * (stern + shoulder)
    half = 0.5 * width
    parts = [
        box(material, (middle, 0.0, z), (shoulder - stern, width, tall)),
        box(
            dark,
            (middle, 0.0, z + 0.46 * tall),
            (shoulder - stern + 0.06, width + 0.06, 0.10 * tall),
        ),
    ]
    # Two leaning slabs run together at the bow; a flat cone closes the deck between them.
    for side in (1.0, -1.0):
        root = (shoulder, side * 0.5 * half, z)
        tip = (bow, 0.02 * side * half, z + 0.10 * tall)
        across = (0.0, 0.96 * side * half, 0.0)
        parts.append(plank(material, root, tip, chord=across, thickness=(0.0, 0.0, tall)))
    return parts


def _rocking(parts: list[ModelPart], scale: float, seed: int, amount: float) -> ArticulatedModel:
    start = 2.0 * math.pi * fraction(seed, "waves")

    def articulate(pose: Pose) -> list[ModelPart]:
        roll = amount * math.sin(1.5 * pose.time_s + start)
        pitch = 0.6 * amount * math.sin(1.1 * pose.time_s + 2.0 * start)
        return moved(parts, compose(turn_x(roll), turn_y(pitch)))

    return ArticulatedModel([], scale=scale, articulate=articulate)


NOUNS = (
    Noun("boat", build_boat, "water", 4.0, "sail", ("motorboat", "speedboat")),
    Noun(
        "sailboat", build_sailboat, "water", 2.5, "sail",
        ("sailing boat", "yacht"),
    ),
    Noun(
        "ship", build_ship, "water", 6.0, "sail",
        ("vessel",),
    ),
)  # fmt: skip
