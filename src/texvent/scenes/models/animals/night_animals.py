"""An owl that sits and looks around or flies, and a bat."""

from __future__ import annotations

import math
from dataclasses import replace

from texvent.scenes.models.animals.flying_birds import Plumage, build_flier
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import BLACK, Material, feathers, fur, shade, skin
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Point, ball, blade, limb, moved, spike, turn_x
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour

_PLUMAGES: tuple[Colour, ...] = ((0.28, 0.17, 0.08), (0.62, 0.58, 0.52))
_OWL = Plumage(
    0.45, 2.3, 0.48, 2.4, 0.55, ((0.28, 0.17, 0.08),),
    (0.2, 0.13, 0.06), (0.28, 0.17, 0.08), (0.6, 0.45, 0.1),
)  # fmt: skip


def build_owl(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an owl that sits and turns its head, 0.4 m; `colour` is its plumage."""
    hue = paint(colour, seed, "plumage", _PLUMAGES)
    coat, pale = feathers(hue), feathers(shade(hue, 1.6))
    start = fraction(seed, "look")

    def articulate(pose: Pose) -> list[ModelPart]:
        look = 0.9 * math.sin(2.0 * math.pi * (0.3 * pose.time_s + start))
        c, s = math.cos(look), math.sin(look)
        parts = [
            limb(coat, (-0.02, 0.0, 0.07), (0.0, 0.0, 0.24), 0.095),
            ball(pale, (0.05, 0.0, 0.16), (0.12, 0.14, 0.20)),
            ball(coat, (0.01, 0.0, 0.33), (0.18, 0.20, 0.17)),
            blade(
                coat,
                (-0.06, 0.0, 0.10),
                (-0.16, 0.0, 0.01),
                chord=(0.0, 0.12, 0.0),
                thickness=(0.04, 0.0, 0.02),
            ),
        ]
        for side in (1.0, -1.0):
            parts.append(ball(coat, (-0.02, side * 0.095, 0.17), (0.17, 0.05, 0.22)))
            parts.append(
                limb(
                    skin((0.5, 0.35, 0.1)),
                    (0.04, side * 0.04, 0.05),
                    (0.06, side * 0.04, 0.014),
                    0.014,
                )
            )
            for size, ahead, hue_of_eye in (
                (0.085, 0.072, (0.75, 0.70, 0.6)),
                (0.055, 0.088, (0.75, 0.42, 0.02)),
                (0.028, 0.106, BLACK),
            ):
                x, y = ahead, side * 0.043
                eye = (0.01 + c * x - s * y, s * x + c * y, 0.345)
                parts.append(ball(Material(hue_of_eye), eye, (size * 0.5, size, size)))
            tuft = (0.01 - s * side * 0.06, c * side * 0.06, 0.39)
            parts.append(spike(coat, tuft, (tuft[0], 1.3 * tuft[1], 0.46), 0.025))
        beak = (0.01 + 0.10 * c, 0.10 * s, 0.315)
        parts.append(
            spike(Material((0.6, 0.45, 0.1)), beak, (beak[0] + 0.02 * c, beak[1], 0.285), 0.014)
        )
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_flying_owl(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an owl in flight, 1 m across; `colour` is its plumage."""
    hue = paint(colour, seed, "plumage", _PLUMAGES)
    coat, pale = feathers(hue), feathers(shade(hue, 1.6))
    plumage = replace(_OWL, wing=shade(hue, 0.8), head=hue)
    flier = build_flier(plumage, colour=hue, scale=1.0, seed=seed)
    face = [
        ball(pale, (0.17, 0.0, 0.03), (0.08, 0.17, 0.16)),
        ball(coat, (0.14, 0.0, 0.03), (0.15, 0.20, 0.19)),
        *(ball(Material(BLACK), (0.20, y, 0.05), (0.03, 0.04, 0.04)) for y in (0.04, -0.04)),
    ]
    return ArticulatedModel(face, scale=scale, articulate=flier.parts, is_centred=True)


def build_fruit_bat(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a bat in flight, 0.5 m across; `colour` is its fur."""
    hue = paint(colour, seed, "fur", ((0.16, 0.09, 0.05), (0.12, 0.07, 0.05)))
    coat, web = fur(hue), skin(shade(hue, 0.5))
    start = fraction(seed, "flap")
    rigid = [
        limb(coat, (-0.06, 0.0, 0.0), (0.04, 0.0, 0.0), 0.032),
        ball(coat, (0.075, 0.0, 0.015), (0.06, 0.05, 0.05)),
        *(spike(coat, (0.07, y, 0.03), (0.065, 1.7 * y, 0.075), 0.014) for y in (0.017, -0.017)),
        ball(Material(BLACK), (0.105, 0.0, 0.012), (0.014, 0.018, 0.012)),
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (6.0 * pose.time_s + start)
        lift, bent = 0.7 * math.sin(turn) + 0.1, 0.5 * math.sin(turn - 0.9) - 0.15
        parts = []
        for side in (1.0, -1.0):
            wrist: Point = (0.05, side * 0.11, 0.0)
            arm = blade(
                web,
                (0.01, side * 0.01, 0.0),
                (0.0, side * 0.13, 0.0),
                chord=(0.15, 0.0, 0.0),
                thickness=(0.0, 0.0, 0.006),
            )
            hand = [
                blade(
                    web,
                    (0.02, side * 0.10, 0.0),
                    (-0.05, side * 0.27, 0.0),
                    chord=(0.12, 0.0, 0.0),
                    thickness=(0.0, 0.0, 0.005),
                ),
                spike(web, wrist, (-0.07, side * 0.20, 0.0), 0.022),
            ]
            wing = [arm, *moved(hand, turn_x(side * bent, wrist))]
            parts += moved(wing, turn_x(side * lift))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


NOUNS = (
    Noun("owl", build_owl, "ground", 0.2, "walk"),
    Noun("flying owl", build_flying_owl, "air", 3.0, "fly"),
    Noun("fruit bat", build_fruit_bat, "air", 2.5, "fly"),
)
