"""Animals on six or more legs and none: spider, crab, ant, beetle, ladybug, worm, caterpillar."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import Gait, bend, foot_path, step_amount
from texvent.scenes.models.materials import BLACK, WHITE, Material, fur, shade, skin, striped
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Point, ball, limb
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Arthropod:
    """Proportions in units of the body's length."""

    length: float
    """Of the body, m."""
    body: tuple[tuple[float, float, float], ...]
    """For each segment: x of its middle, its length and its width (and height)."""
    height: float
    """Of the body's middle above the ground."""
    legs: tuple[float, ...]
    """x of the root of each pair."""
    reach: float
    """From the middle line to the feet."""
    colours: tuple[Colour, ...]
    leg_colour: Colour = BLACK
    thick: float = 0.02
    """Of a leg."""
    flatness: float = 0.8
    """Height of a segment over its width."""
    claws: bool = False
    spots: bool = False
    feelers: float = 0.0
    """Length of the feelers."""
    is_sideways: bool = False
    """Whether it walks to its side, as crabs do."""


SPIDER = Arthropod(
    0.10, ((0.20, 0.40, 0.34), (-0.22, 0.62, 0.50)), 0.34, (0.30, 0.22, 0.12, 0.02), 0.95,
    ((0.05, 0.035, 0.03), (0.16, 0.08, 0.04)), (0.06, 0.04, 0.03), 0.035,
)  # fmt: skip
CRAB = Arthropod(
    0.16, ((0.0, 0.72, 1.0),), 0.26, (0.20, 0.06, -0.08, -0.22), 1.0,
    ((0.55, 0.09, 0.03), (0.50, 0.20, 0.05)), (0.42, 0.08, 0.03), 0.05, 0.34, claws=True,
    is_sideways=True,
)  # fmt: skip
ANT = Arthropod(
    0.05, ((0.34, 0.30, 0.26), (0.04, 0.36, 0.20), (-0.30, 0.46, 0.34)), 0.24, (0.14, 0.04, -0.06),
    0.55, ((0.05, 0.02, 0.012), (0.20, 0.06, 0.02)), (0.04, 0.016, 0.01), 0.025, 0.85, feelers=0.32,
)  # fmt: skip
BEETLE = Arthropod(
    0.07, ((-0.10, 0.76, 0.56), (0.30, 0.28, 0.44), (0.44, 0.18, 0.26)), 0.20, (0.24, 0.04, -0.20),
    0.56, ((0.03, 0.05, 0.02), (0.05, 0.02, 0.06), (0.12, 0.05, 0.02)), BLACK, 0.03, 0.7,
    feelers=0.22,
)  # fmt: skip
LADYBUG = Arthropod(
    0.05, ((-0.08, 0.84, 0.76), (0.36, 0.28, 0.44)), 0.20, (0.22, 0.02, -0.20), 0.55,
    ((0.60, 0.03, 0.015),), BLACK, 0.028, 0.62, spots=True, feelers=0.14,
)  # fmt: skip


def build_arthropod(
    kind: Arthropod, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make an animal with jointed legs; `colour` is its body."""
    hue = paint(colour, seed, "body", kind.colours)
    size, legs = kind.length, skin(kind.leg_colour if colour is None else shade(colour, 0.5))
    rigid = _draw_body(kind, skin(hue), size)
    gait = Gait(0.8 * size, 0.6, 0.10 * size)
    start = fraction(seed, "step")

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 0.3 * size)
        distance = pose.distance_m + start * gait.stride
        parts: list[ModelPart] = []
        for index, root_x in enumerate(kind.legs):
            spread = (index - 0.5 * (len(kind.legs) - 1)) * -0.34
            for side, phase in ((1.0, 0.0), (-1.0, 0.5)):
                step, lift = foot_path(gait, distance, phase + 0.5 * (index % 2), amount)
                root = (root_x * size, side * 0.12 * size, kind.height * size)
                foot = (
                    (root_x + spread) * size + step,
                    side * kind.reach * size * (1.0 - 0.12 * abs(spread)),
                    0.5 * kind.thick * size + lift,
                )
                knee = bend(root, foot, 0.54 * kind.reach * size, 0.60 * kind.reach * size,
                            (0.0, 0.35 * side, 1.0))  # fmt: skip
                parts.append(limb(legs, root, knee, kind.thick * size))
                parts.append(limb(legs, knee, foot, 0.7 * kind.thick * size))
        wave = math.sin(2.0 * math.pi * (0.8 * pose.time_s + start))
        return [*parts, *_draw_claws(kind, skin(hue), size, wave)]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def _draw_body(kind: Arthropod, surface: Material, size: float) -> list[ModelPart]:
    z = kind.height * size
    parts = []
    for index, (x, long, wide) in enumerate(kind.body):
        material = Material(BLACK) if kind.spots and index > 0 else surface
        across = wide * size
        parts.append(
            ball(material, (x * size, 0.0, z), (long * size, across, across * kind.flatness))
        )
    front = max(x + 0.42 * long for x, long, _ in kind.body) * size
    for side in (1.0, -1.0):
        eye = (front - 0.02 * size, side * 0.09 * size, z + 0.08 * size)
        white = Material(WHITE) if kind.claws or kind.spots else Material(BLACK)
        parts.append(ball(white, eye, (0.07 * size, 0.07 * size, 0.07 * size)))
        if kind.feelers > 0.0:
            tip = (front + kind.feelers * size, side * 0.7 * kind.feelers * size, z + 0.12 * size)
            parts.append(limb(Material(BLACK), eye, tip, 0.012 * size))
    if kind.spots:
        wide = kind.body[0][2]
        for x, y in ((0.12, 0.20), (-0.12, 0.26), (-0.34, 0.14), (-0.10, 0.0)):
            for side in (1.0, -1.0):
                up = kind.flatness * math.sqrt(max(0.25 - (y / wide) ** 2 * 0.9, 0.05)) * wide
                spot = (x * size, side * y * size, z + 0.86 * up * size)
                parts.append(ball(Material(BLACK), spot, (0.14 * size, 0.14 * size, 0.10 * size)))
    return parts


def _draw_claws(kind: Arthropod, surface: Material, size: float, wave: float) -> list[ModelPart]:
    if not kind.claws:
        return []
    parts = []
    for side in (1.0, -1.0):
        root: Point = (0.26 * size, side * 0.36 * size, kind.height * size)
        elbow = (0.46 * size, side * 0.62 * size, (kind.height + 0.08) * size)
        hand = (0.66 * size, side * 0.42 * size, (kind.height + 0.16 + 0.05 * wave * side) * size)
        gap = (0.05 + 0.03 * wave) * size
        parts += [
            limb(surface, root, elbow, 0.06 * size),
            limb(surface, elbow, hand, 0.10 * size),
            limb(surface, hand, (hand[0] + 0.2 * size, hand[1] - side * 0.10 * size,
                                 hand[2] + gap), 0.05 * size),
            limb(surface, hand, (hand[0] + 0.2 * size, hand[1] - side * 0.10 * size,
                                 hand[2] - gap), 0.04 * size),
        ]  # fmt: skip
    return parts


def build_crawler(
    length: float, thick: float, usual: tuple[Colour, ...], is_fuzzy: bool,
    *, colour: Colour | None, scale: float, seed: int,
) -> ArticulatedModel:  # fmt: skip
    """Make a worm or a caterpillar of segments that draw together in turn."""
    hue = paint(colour, seed, "body", usual)
    count, step = 11, length / 11.0
    one, other = fur(hue), fur(shade(hue, 0.55))
    if not is_fuzzy:
        one = other = striped(hue, shade(hue, 0.7), 3.0)

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (pose.distance_m / (0.35 * length) + 0.25 * pose.time_s)
        parts = []
        for index in range(count):
            phase = turn - 0.9 * index
            x = 0.45 * length - index * step + 0.18 * step * math.sin(phase)
            y = 0.0 if is_fuzzy else 0.10 * length * math.sin(0.7 * phase)
            up = 0.5 * thick + (0.5 if is_fuzzy else 0.08) * thick * (0.5 + 0.5 * math.cos(phase))
            wide = thick * (1.0 if index else 1.12)
            material = one if index % 2 else other
            parts.append(ball(material, (x, y, up), (1.7 * step, wide, wide)))
            if index == 0:
                eyes = [(x + 0.5 * step, y + s * 0.25 * thick, up + 0.25 * thick) for s in (1, -1)]
                parts += [ball(Material(BLACK), eye, (0.16 * thick,) * 3) for eye in eyes]
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


_WORM = partial(build_crawler, 0.16, 0.014, ((0.42, 0.17, 0.12),), False)
_CATERPILLAR = partial(build_crawler, 0.09, 0.018, ((0.12, 0.34, 0.04), (0.45, 0.35, 0.03)), True)

NOUNS = (
    Noun("spider", partial(build_arthropod, SPIDER), "ground", 0.08, "walk"),
    Noun("crab", partial(build_arthropod, CRAB), "ground", 0.15, "walk"),
    Noun("ant", partial(build_arthropod, ANT), "ground", 0.05, "walk"),
    Noun("beetle", partial(build_arthropod, BEETLE), "ground", 0.05, "walk"),
    Noun("ladybug", partial(build_arthropod, LADYBUG), "ground", 0.04, "walk"),
    Noun("worm", _WORM, "ground", 0.02, "walk", ("earthworm",)),
    Noun("caterpillar", _CATERPILLAR, "ground", 0.02, "walk"),
)  # fmt: skip
