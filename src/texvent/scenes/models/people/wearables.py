"""What people put on that no shop table has: vest, scarf, mask, crown, jacket, coat, dress."""

from __future__ import annotations

import math
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    CLOTH_COLOURS,
    ORANGE,
    RED,
    WHITE,
    YELLOW,
    Material,
    cloth,
    shade,
)
from texvent.scenes.models.objects.figures import ring
from texvent.scenes.models.people.roles.hanging import draw_dress, draw_top
from texvent.scenes.models.protocol import ModelPart, fixed_noun
from texvent.scenes.models.shapes import ball, box, limb, post, rod, spike
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour


def build_vest(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a safety vest with bright bands, its hem on the ground; `colour` is its cloth."""
    fabric = cloth(colour if colour is not None else paint(None, seed, "vest", (ORANGE, YELLOW)))
    band = Material((0.78, 0.78, 0.70), emission=0.25)
    parts = [
        limb(fabric, (0.0, 0.0, 0.04), (0.0, 0.0, 0.40), 0.142, side_radius=0.192),
        ball(fabric, (0.0, 0.0, 0.38), (0.25, 0.40, 0.24)),
        *(ball(band, (0.0, 0.0, z), (0.30, wide, 0.05))
          for z, wide in ((0.12, 0.385), (0.26, 0.40))),
        *(rod(band, (0.115, y, 0.20), (0.08, y, 0.47), 0.026) for y in (0.10, -0.10)),
    ]  # fmt: skip
    return ArticulatedModel(parts, scale=scale)


def build_scarf(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a scarf as it lies round a neck, one end hanging; `colour` is its wool."""
    wool = cloth(paint(colour, seed, "scarf", CLOTH_COLOURS))
    parts = [
        *ring(wool, (0.0, 0.0, 0.41), (0.10, 0.11), 0.045, axis="z", pieces=12),
        ball(wool, (0.11, 0.05, 0.39), (0.08, 0.10, 0.09)),
    ]
    for y, low in ((0.10, 0.02), (0.02, 0.10)):
        step = (0.36 - low) / 6
        for k in range(6):
            stripe = wool if k % 2 == 0 else Material(shade(wool.colour, 2.2))
            parts.append(box(stripe, (0.13, y, low + (k + 0.5) * step), (0.022, 0.085, step)))
        parts += [
            rod(wool, (0.13, y + 0.018 * k, low), (0.13, y + 0.018 * k, low - 0.02), 0.005)
            for k in (-2, -1, 0, 1, 2)
        ]
    return ArticulatedModel(parts, scale=scale)


def build_mask(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a face mask with its ribbons; `colour` is its front."""
    surface = cloth(colour if colour is not None else (0.35, 0.55, 0.68))
    parts = [ball(surface, (0.0, 0.0, 0.06), (0.07, 0.17, 0.12))]
    parts += [box(Material(shade(surface.colour, 0.6)), (0.030, 0.0, z), (0.012, 0.12, 0.006))
              for z in (0.035, 0.06, 0.085)]  # fmt: skip
    for side in (1.0, -1.0):
        parts += ring(Material(WHITE), (-0.02, 0.095 * side, 0.06), (0.034, 0.045), 0.005)
    return ArticulatedModel(parts, scale=scale)


def build_crown(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a crown with eight points; `colour` is its metal."""
    gold = Material(colour if colour is not None else (0.62, 0.40, 0.05))
    parts: list[ModelPart] = [post(gold, (0.0, 0.0, 0.03), (0.22, 0.21, 0.06))]
    for turn in range(8):
        x, y = math.cos(0.25 * math.pi * turn), math.sin(0.25 * math.pi * turn)
        foot = (0.095 * x, 0.09 * y, 0.05)
        tip = (0.115 * x, 0.11 * y, 0.15)
        parts += [spike(gold, foot, tip, 0.032), ball(Material(RED), tip, (0.026, 0.026, 0.026))]
    return ArticulatedModel(parts, scale=scale)


def build_garment(
    long: float, has_skirt: bool, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a jacket, a coat or a dress by its outline; `colour` is its cloth."""
    fabric = cloth(paint(colour, seed, "cloth", CLOTH_COLOURS))
    if has_skirt:
        return ArticulatedModel(draw_dress(fabric), scale=scale)
    return ArticulatedModel(draw_top(fabric, long, is_open=True, has_hood=False), scale=scale)


NOUNS = (
    fixed_noun("vest", build_vest, ("safety vest", "reflective vest", "hi-vis vest")),
    fixed_noun("scarf", build_scarf, (), ("scarves",)),
    fixed_noun("mask", build_mask, ("surgical mask",)),
    fixed_noun("crown", build_crown),
    fixed_noun("jacket", partial(build_garment, 0.72, False)),
    fixed_noun(
        "coat",
        partial(build_garment, 1.05, False),
        ("overcoat", "raincoat", "trench coat", "lab coat", "laboratory coat", "fur coat"),
    ),
    fixed_noun("dress", partial(build_garment, 1.10, True), ("gown",)),
)
