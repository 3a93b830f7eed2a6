"""Bodies that fit no table: apes, kangaroo, frog, seal, octopus, owl, bat, two-legged dinosaur."""

from __future__ import annotations

import math
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.limb_kinematics import Gait, bend, foot_path, step_amount
from texvent.scenes.models.materials import BLACK, WHITE, Material, fur, shade, skin
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import Point, ball, blade, limb, moved, shift, spike, turn_x
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour

_MONKEY = (0.55, ((0.20, 0.10, 0.045), (0.28, 0.20, 0.11)), 0.6)
_GORILLA = (1.15, ((0.022, 0.022, 0.025),), 0.0)


def build_ape(
    height: float,
    usual: tuple[Colour, ...],
    tail: float,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make an ape on its knuckles; lengths are shares of the height of its back."""
    hue = paint(colour, seed, "fur", usual)
    coat, face = fur(hue), skin((0.40, 0.25, 0.17) if tail > 0.0 else (0.05, 0.045, 0.045))
    h = height
    gait = Gait(0.9 * h, 0.62, 0.10 * h)
    start = fraction(seed, "step")
    bulk = 1.0 if tail > 0.0 else 1.45

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 0.3 * h)
        distance = pose.distance_m + start * gait.stride
        sits = pose.activity == "sit"
        hips: Point = (-0.34 * h, 0.0, (0.22 if sits else 0.60) * h)
        chest: Point = (0.16 * h, 0.0, 0.84 * h)
        head: Point = (0.38 * h, 0.0, 1.02 * h)
        parts = [
            limb(coat, hips, chest, 0.17 * bulk * h, side_radius=0.18 * bulk * h),
            ball(coat, chest, (0.36 * bulk * h, 0.42 * bulk * h, 0.38 * bulk * h)),
            *_ape_head(coat, face, head, h),
        ]
        for side, phase in ((1.0, 0.0), (-1.0, 0.5)):
            x, z = foot_path(gait, distance, phase, amount)
            parts += _draw_limb(
                coat,
                face,
                (chest[0] + 0.04 * h, side * 0.20 * bulk * h, chest[2]),
                (0.30 * h + x, side * 0.20 * bulk * h, z),
                (0.46 * h, 0.07 * bulk * h),
                (-1.0, 0.4 * side, 0.0),
            )
            x, z = foot_path(gait, distance, phase + 0.5, amount)
            x = 0.30 * h if sits else x
            parts += _draw_limb(
                coat,
                face,
                (hips[0], side * 0.14 * bulk * h, hips[2]),
                (-0.30 * h + x, side * 0.16 * bulk * h, z),
                (0.36 * h, 0.08 * bulk * h),
                (1.0, 0.5 * side, 0.3),
            )
        return [*parts, *_curl(coat, hips, tail * h, 0.15 * math.sin(2.0 * pose.time_s + start))]

    return ArticulatedModel([], scale=scale, articulate=articulate)


def _ape_head(coat: Material, face: Material, head: Point, h: float) -> list[ModelPart]:
    """Skull, face, muzzle, eyes and ears around the point `head` of an ape `h` metres high."""
    x, _, z = head
    parts = [
        ball(coat, head, (0.30 * h, 0.27 * h, 0.32 * h)),
        ball(face, (x + 0.09 * h, 0.0, z - 0.04 * h), (0.18 * h, 0.21 * h, 0.22 * h)),
        ball(face, (x + 0.16 * h, 0.0, z - 0.09 * h), (0.12 * h, 0.15 * h, 0.11 * h)),
    ]
    for side in (1.0, -1.0):
        eye = (x + 0.17 * h, side * 0.05 * h, z + 0.03 * h)
        parts.append(ball(Material(BLACK), eye, (0.04 * h, 0.04 * h, 0.04 * h)))
        ear = (x - 0.01 * h, side * 0.15 * h, z)
        parts.append(ball(face, ear, (0.05 * h, 0.05 * h, 0.09 * h)))
    return parts


def _draw_limb(
    coat: Material,
    end: Material,
    root: Point,
    foot: Point,
    size: tuple[float, float],
    towards: Point,
) -> list[ModelPart]:
    """Upper and lower part, and a hand or foot on the ground; size = length of each, thickness."""
    half, thick = size
    ankle = (foot[0], foot[1], foot[2] + 0.7 * thick)
    joint = bend(root, ankle, half, half, towards)
    toe = (ankle[0] + 1.6 * thick, ankle[1], ankle[2] - 0.1 * thick)
    return [
        limb(coat, root, joint, thick),
        limb(coat, joint, ankle, 0.8 * thick),
        limb(end, ankle, toe, 0.6 * thick),
    ]


def _curl(coat: Material, hips: Point, long: float, sway: float) -> list[ModelPart]:
    """A monkey's tail, up and back over."""
    if long <= 0.0:
        return []
    parts, here = [], (hips[0] - 0.1 * long, 0.0, hips[2])
    for angle in (2.9, 2.1, 1.4, 0.6):
        there = (
            here[0] + 0.3 * long * math.cos(angle + sway),
            0.0,
            here[2] + 0.3 * long * math.sin(angle + sway),
        )
        parts.append(limb(coat, here, there, 0.045 * long))
        here = there
    return parts


def build_kangaroo(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a kangaroo, 1.4 m, that hops on its hind legs; `colour` is its fur."""
    hue = paint(colour, seed, "fur", ((0.36, 0.20, 0.10), (0.28, 0.22, 0.18)))
    coat, pale = fur(hue), fur(shade(hue, 1.7))
    gait = Gait(1.5, 0.35, 0.08)
    start = fraction(seed, "step")

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 0.5)
        distance = pose.distance_m + start * gait.stride
        turn = 2.0 * math.pi * (distance / gait.stride)
        x, z = foot_path(gait, distance, 0.0, amount)
        rise = amount * 0.12 * (0.5 - 0.5 * math.cos(turn - math.pi * gait.duty))
        hips: Point = (-0.10, 0.0, 0.52 + rise)
        chest: Point = (0.16, 0.0, 0.92 + rise)
        head: Point = (0.30, 0.0, 1.22 + rise)
        parts = [
            limb(coat, hips, chest, 0.17),
            limb(pale, (0.03, 0.0, 0.56 + rise), (0.20, 0.0, 0.86 + rise), 0.13),
            limb(coat, chest, head, 0.075),
            ball(coat, head, (0.22, 0.14, 0.15)),
            limb(coat, (0.34, 0.0, 1.20 + rise), (0.46, 0.0, 1.16 + rise), 0.045),
            ball(Material(BLACK), (0.48, 0.0, 1.16 + rise), (0.05, 0.06, 0.05)),
            limb(coat, (-0.18, 0.0, 0.46 + rise), (-0.56, 0.0, 0.20 + 0.8 * rise), 0.085),
            limb(coat, (-0.54, 0.0, 0.21 + 0.8 * rise), (-0.98, 0.0, 0.07 + 0.5 * rise), 0.05),
        ]
        for side in (1.0, -1.0):
            parts.append(
                spike(
                    coat, (0.24, side * 0.05, 1.26 + rise), (0.20, side * 0.09, 1.46 + rise), 0.04
                )
            )
            parts.append(
                ball(Material(BLACK), (0.36, side * 0.062, 1.25 + rise), (0.03, 0.02, 0.03))
            )
            hand = (0.34, side * 0.10, 0.74 + rise)
            parts.append(limb(coat, (chest[0] + 0.04, side * 0.14, chest[2]), hand, 0.035))
            foot = (x - 0.06, side * 0.13, 0.05 + z)
            knee = bend((hips[0], side * 0.12, hips[2]), foot, 0.36, 0.34, (1.0, 0.0, 0.3))
            parts += [
                limb(coat, (hips[0], side * 0.12, hips[2]), knee, 0.12),
                limb(coat, knee, foot, 0.055),
                limb(coat, foot, (foot[0] + 0.30, foot[1], foot[2] - 0.01), 0.035),
            ]
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_frog(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a frog, 10 cm, that hops; `colour` is its skin."""
    hue = paint(colour, seed, "skin", ((0.10, 0.34, 0.05), (0.24, 0.26, 0.08)))
    body, belly = skin(hue), skin((0.60, 0.60, 0.38))
    gait = Gait(0.24, 0.45, 0.0)
    start = fraction(seed, "hop")

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 0.06)
        share = (pose.distance_m / gait.stride + start) % 1.0
        air = max(0.0, share - 0.4) / 0.6
        rise = amount * 0.06 * (math.sin(math.pi * air) ** 2 if air > 0.0 else 0.0)
        stretch = amount * math.sin(math.pi * air) ** 2
        z = 0.036 + rise
        parts = [
            limb(body, (-0.035, 0.0, z - 0.006), (0.022, 0.0, z + 0.010), 0.026, side_radius=0.032),
            ball(belly, (0.0, 0.0, z - 0.012), (0.09, 0.05, 0.03)),
            ball(body, (0.038, 0.0, z + 0.014), (0.046, 0.054, 0.036)),
        ]
        for side in (1.0, -1.0):
            parts.append(ball(body, (0.036, side * 0.017, z + 0.032), (0.020, 0.018, 0.020)))
            parts.append(
                ball(Material(BLACK), (0.042, side * 0.021, z + 0.034), (0.011, 0.012, 0.012))
            )
            hand = (0.040 + 0.02 * stretch, side * 0.040, 0.005 + rise)
            parts += [
                limb(body, (0.02, side * 0.028, z), (0.026, side * 0.046, z - 0.008), 0.008),
                limb(body, (0.026, side * 0.046, z - 0.008), hand, 0.006),
                ball(body, hand, (0.022, 0.020, 0.007)),
            ]
            foot = (-0.015 - 0.08 * stretch, side * (0.052 - 0.02 * stretch), 0.006 + rise)
            knee = bend(
                (-0.040, side * 0.026, z - 0.006), foot, 0.046, 0.046, (1.0, 0.6 * side, 0.6)
            )
            parts += [
                limb(body, (-0.040, side * 0.026, z - 0.006), knee, 0.013),
                limb(body, knee, foot, 0.009),
                ball(body, (foot[0] + 0.014, foot[1], foot[2] - 0.001), (0.042, 0.026, 0.008)),
            ]
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_seal(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a seal, 1.6 m, that swims; its tail beats. `colour` is its fur."""
    hue = paint(colour, seed, "fur", ((0.10, 0.10, 0.11), (0.26, 0.22, 0.18)))
    coat = fur(hue)
    start = fraction(seed, "beat")

    def articulate(pose: Pose) -> list[ModelPart]:
        beat = 2.0 * math.pi * (0.8 * pose.time_s + start)
        places = [(0.52 - 0.22 * k, 0.03 * k * math.sin(beat - 0.8 * k)) for k in range(6)]
        widths = (0.15, 0.21, 0.23, 0.19, 0.12, 0.07)
        parts = [
            limb(coat, (x + 0.13, y, 0.0), (x - 0.13, y, 0.0), wide, side_radius=1.05 * wide)
            for (x, y), wide in zip(places, widths, strict=True)
        ]
        parts.append(ball(coat, (0.68, 0.0, 0.06), (0.30, 0.26, 0.25)))
        parts.append(ball(skin(shade(hue, 1.6)), (0.80, 0.0, 0.03), (0.12, 0.14, 0.10)))
        parts.append(ball(Material(BLACK), (0.86, 0.0, 0.05), (0.04, 0.06, 0.04)))
        for side in (1.0, -1.0):
            parts.append(ball(Material(BLACK), (0.77, side * 0.09, 0.11), (0.05, 0.04, 0.05)))
            flap = 0.3 * math.sin(0.5 * beat + side)
            fin = [
                blade(
                    coat,
                    (0.30, side * 0.18, -0.06),
                    (0.06, side * 0.52, -0.16),
                    chord=(0.20, 0.06 * side, 0.0),
                    thickness=(0.0, 0.0, 0.05),
                )
            ]
            parts += moved(fin, turn_x(side * flap, (0.30, side * 0.18, -0.06)))
            x, y = places[-1]
            parts.append(
                blade(
                    coat,
                    (x, y, 0.0),
                    (x - 0.34, y + side * 0.16, 0.0),
                    chord=(0.04, 0.14, 0.0),
                    thickness=(0.0, 0.0, 0.04),
                )
            )
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True)


def build_octopus(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make an octopus, 0.9 m, whose eight arms wave; `colour` is its skin."""
    hue = paint(colour, seed, "skin", ((0.50, 0.12, 0.06), (0.38, 0.18, 0.22)))
    surface = skin(hue)
    start = fraction(seed, "wave")

    def articulate(pose: Pose) -> list[ModelPart]:
        beat = 2.0 * math.pi * (0.5 * pose.time_s + start)
        puff = 1.0 + 0.05 * math.sin(beat)
        parts = [
            ball(surface, (-0.06, 0.0, 0.26), (0.32 * puff, 0.28 * puff, 0.40)),
            ball(surface, (0.02, 0.0, 0.06), (0.22, 0.24, 0.20)),
        ]
        for side in (1.0, -1.0):
            parts.append(ball(Material(WHITE), (0.10, side * 0.08, 0.12), (0.06, 0.05, 0.06)))
            parts.append(ball(Material(BLACK), (0.125, side * 0.085, 0.12), (0.03, 0.035, 0.02)))
        for index in range(8):
            around = 2.0 * math.pi * (index + 0.5) / 8.0
            here: Point = (0.02 + 0.07 * math.cos(around), 0.07 * math.sin(around), 0.0)
            for bone in range(4):
                down = -0.9 + 0.42 * bone + 0.35 * math.sin(beat - 0.9 * bone + 1.7 * index)
                out = around + 0.18 * math.sin(beat - 0.7 * bone + index)
                there = (
                    here[0] + 0.13 * math.cos(down) * math.cos(out),
                    here[1] + 0.13 * math.cos(down) * math.sin(out),
                    here[2] + 0.13 * math.sin(down),
                )
                parts.append(limb(surface, here, there, 0.034 - 0.007 * bone))
                here = there
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True)


def build_dinosaur(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a two-legged dinosaur, 4 m high, that strides; `colour` is its skin."""
    hue = paint(colour, seed, "skin", ((0.16, 0.20, 0.08), (0.26, 0.16, 0.08)))
    hide, teeth = skin(hue), Material(WHITE)
    gait = Gait(3.4, 0.6, 0.4)
    start = fraction(seed, "step")

    def articulate(pose: Pose) -> list[ModelPart]:
        amount = step_amount(pose.activity, pose.speed_m_s, 1.0)
        distance = pose.distance_m + start * gait.stride
        turn = 2.0 * math.pi * distance / gait.stride
        bob, sway = 0.06 * amount * math.cos(2.0 * turn), 0.25 * amount * math.sin(turn)
        jaw = 0.10 + 0.08 * math.sin(3.0 * pose.time_s)
        trunk = [
            limb(hide, (-0.7, 0.0, 2.3), (0.9, 0.0, 2.6), 0.62, side_radius=0.52),
            limb(hide, (0.8, 0.0, 2.7), (1.5, 0.0, 3.3), 0.36),
            limb(hide, (1.5, 0.0, 3.42), (2.55, 0.0, 3.36), 0.28, side_radius=0.26),
            ball(hide, (1.6, 0.0, 3.45), (0.80, 0.62, 0.66)),
            limb(hide, (1.6, 0.0, 3.18), (2.4, 0.0, 3.08 - jaw), 0.13, side_radius=0.20),
            *(
                spike(teeth, (x, y, 3.22), (x, y, 3.08), 0.04)
                for x in (2.0, 2.2, 2.4, 2.6)
                for y in (0.16, -0.16)
            ),
            *(
                ball(Material((0.7, 0.5, 0.02)), (1.85, y, 3.62), (0.13, 0.09, 0.13))
                for y in (0.25, -0.25)
            ),
            limb(hide, (-0.8, 0.0, 2.3), (-2.0, -0.5 * sway, 2.2), 0.42),
            limb(hide, (-1.9, -0.5 * sway, 2.2), (-3.4, -1.4 * sway, 2.0), 0.22),
        ]
        for side in (1.0, -1.0):
            trunk.append(limb(hide, (1.0, side * 0.42, 2.4), (1.25, side * 0.45, 2.0), 0.10))
            trunk.append(limb(hide, (1.25, side * 0.45, 2.0), (1.50, side * 0.45, 2.05), 0.07))
        parts = moved(trunk, shift(z=bob))
        for side, phase in ((1.0, 0.0), (-1.0, 0.5)):
            x, z = foot_path(gait, distance, phase, amount)
            root, ankle = (-0.2, side * 0.46, 2.2 + bob), (x - 0.2, side * 0.42, 0.30 + z)
            knee = bend(root, ankle, 1.15, 1.10, (1.0, 0.0, 0.0))
            parts += [
                limb(hide, root, knee, 0.40),
                limb(hide, knee, ankle, 0.19),
                limb(hide, ankle, (ankle[0] + 0.55, ankle[1], 0.14 + z), 0.14),
            ]
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate)


NOUNS = (
    Noun("monkey", partial(build_ape, *_MONKEY), "ground", 1.0, "walk"),
    Noun("gorilla", partial(build_ape, *_GORILLA), "ground", 1.1, "walk"),
    Noun("kangaroo", build_kangaroo, "ground", 2.5, "walk"),
    Noun("frog", build_frog, "ground", 0.25, "walk"),
    Noun("seal", build_seal, "water", 1.2, "swim"),
    Noun("octopus", build_octopus, "water", 0.4, "swim", (), ("octopi",)),
    Noun(
        "dinosaur",
        build_dinosaur,
        "ground",
        2.6,
        "walk",
        ("tyrannosaurus", "t rex", "tyrannosaurus rex"),
    ),
)
