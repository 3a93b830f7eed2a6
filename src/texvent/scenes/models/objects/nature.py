"""Rock, stone, mountain, cloud."""

from __future__ import annotations

import math

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    Material,
    made_of,
    shade,
    stone,
)
from texvent.scenes.models.protocol import Noun, fixed_noun
from texvent.scenes.models.shapes import ball, moved, peak, turn_z
from texvent.scenes.models.variation import between, fraction
from texvent.scenes.scene import Colour, Texture

_STONE: Colour = (0.30, 0.28, 0.26)


def build_rock(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a boulder of a few stones, about 1.4 m; `colour` is its stone."""
    hue = colour if colour is not None else shade(_STONE, between(seed, "stone", 0.8, 1.2))
    parts = [ball(stone(hue), (0.0, 0.0, 0.42), (1.3, 1.05, 0.84))]
    for index in range(3):
        angle = 2.0 * math.pi * (index + 0.6 * fraction(seed, f"angle {index}")) / 3.0
        size = between(seed, f"size {index}", 0.55, 0.85)
        at = (0.45 * math.cos(angle), 0.36 * math.sin(angle), 0.38 * size)
        boulder = ball(stone(shade(hue, 0.85)), at, (size, 0.8 * size, 0.76 * size))
        parts += moved([boulder], turn_z(0.7 * angle, at))
    return ArticulatedModel(parts, scale=scale)


def build_stone(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a smooth stone that a hand holds, 0.2 m; `colour` is its surface."""
    hue = colour if colour is not None else shade(_STONE, between(seed, "stone", 0.9, 1.5))
    parts = [
        ball(stone(hue, scale=4.0), (0.0, 0.0, 0.055), (0.20, 0.15, 0.11)),
        ball(stone(hue, scale=4.0), (0.03, 0.01, 0.06), (0.13, 0.13, 0.11)),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_mountain(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a mountain of three peaks with snow, about 60 m; `colour` is its rock."""
    hue = colour if colour is not None else (0.19, 0.19, 0.20)
    rock, snow = stone(hue, scale=0.02), made_of(Texture.SNOW, (0.85, 0.87, 0.90), scale=0.05)
    parts = []
    for index, (x, y, tall) in enumerate(((0.0, 0.0, 60.0), (8.0, 34.0, 40.0), (5.0, -32.0, 44.0))):
        high = tall * between(seed, f"height {index}", 0.9, 1.1)
        wide = 1.55 * high
        parts.append(peak(rock, (x, y, 0.5 * high), (wide, wide, high)))
        cap = 0.30
        parts.append(
            peak(
                snow,
                (x, y, high * (1.003 - 0.5 * cap)),
                (1.03 * cap * wide, 1.03 * cap * wide, cap * high),
            )
        )
    return ArticulatedModel(parts, scale=scale)


def build_cloud(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a small cumulus cloud, about 12 m; `colour` is its tint."""
    white = Material(colour if colour is not None else (0.86, 0.88, 0.91), emission=0.12)
    parts = [ball(white, (0.0, 0.0, 0.0), (9.0, 6.0, 3.2))]
    for index in range(6):
        angle = 2.0 * math.pi * index / 6.0
        size = between(seed, f"size {index}", 3.2, 5.0)
        at = (3.4 * math.cos(angle), 1.6 * math.sin(angle), between(seed, f"up {index}", 0.2, 1.2))
        parts.append(ball(white, at, (1.2 * size, size, 0.8 * size)))
    return ArticulatedModel(parts, scale=scale, is_centred=True)


NOUNS = (
    fixed_noun("rock", build_rock, ("boulder",)),
    fixed_noun("stone", build_stone),
    fixed_noun("mountain", build_mountain, ("mountain peak",)),
    Noun("cloud", build_cloud, "air", 1.5, "float"),
)
