"""Heads of upright animals, in the axes of a person's neck."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.animals.four_legged.build import Build, Coat
from texvent.scenes.models.animals.four_legged.head import draw_head
from texvent.scenes.models.materials import BLACK, Material, shade, skin
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Affine, Point, ball, limb, moved, spike

_SKULL = 1.16
"""Length of a skull relative to the height of a person's head."""
_LONGEST_MUZZLE, _LONGEST_EAR, _LONGEST_TRUNK = 0.75, 1.15, 1.5
"""Relative to the skull."""
_PALE_EYE = Material((0.85, 0.85, 0.83))


def draw_mammal(build: Build, coat: Coat, size: float) -> list[ModelPart]:
    """The head of a four-legged animal; `size` is the height of a person's head, m."""
    skull, muzzle = build.head
    long, kind = build.ear
    near = replace(
        build,
        head=(skull, min(muzzle, _LONGEST_MUZZLE * skull)),
        ear=(min(long, _LONGEST_EAR * skull), kind),
        trunk=min(build.trunk, _LONGEST_TRUNK * skull),
    )
    share = _SKULL * size / skull
    parts = draw_head(near, coat, (0.0, 0.0, 0.0))
    if build.mane == "full":
        parts.append(
            ball(coat.dark, (-0.30 * skull, 0.0, -0.1 * skull), (skull, 1.6 * skull, 1.8 * skull))
        )
    return moved(parts, _scaling(share, (0.0, 0.0, 0.09 + 0.52 * size)))


def _scaling(share: float, origin: Point) -> Affine:
    return np.column_stack([share * np.eye(3), np.array(origin)])


def _eyes(size: float, ahead: float, apart: float, wide: float) -> list[ModelPart]:
    """White eyes with black pupils; all in multiples of the head's height."""
    z = 0.09 + 0.62 * size
    parts = []
    for side in (1.0, -1.0):
        y = side * apart * size
        parts.append(ball(_PALE_EYE, (ahead * size, y, z), (wide * size,) * 3))
        spot = (ahead * size + 0.38 * wide * size, y, z)
        parts.append(ball(Material(BLACK), spot, (0.5 * wide * size,) * 3))
    return parts


def draw_ape(coat: Coat, size: float) -> list[ModelPart]:
    """A round skull, a bare face and ears at the sides."""
    face = coat.muzzle or skin((0.40, 0.25, 0.17))
    z = 0.09 + 0.52 * size
    parts = [
        ball(coat.limbs, (0.02, 0.0, z), (1.05 * size, 1.0 * size, 1.1 * size)),
        ball(
            face,
            (0.02 + 0.26 * size, 0.0, z - 0.04 * size),
            (0.66 * size, 0.80 * size, 0.80 * size),
        ),
        ball(
            face,
            (0.02 + 0.46 * size, 0.0, z - 0.22 * size),
            (0.44 * size, 0.56 * size, 0.40 * size),
        ),
        *_eyes(size, 0.56, 0.17, 0.16),
    ]
    for side in (1.0, -1.0):
        ear = (0.0, 0.54 * side * size, z + 0.05 * size)
        parts.append(ball(face, ear, (0.14 * size, 0.26 * size, 0.36 * size)))
        nostril = (0.02 + 0.68 * size, 0.06 * side * size, z - 0.16 * size)
        parts.append(ball(Material(BLACK), nostril, (0.05 * size,) * 3))
    return parts


def draw_bird(beak: Material, long: float) -> Callable[[Coat, float], list[ModelPart]]:
    """A round head with a beak, `long` times the head's height."""

    def draw(coat: Coat, size: float) -> list[ModelPart]:
        z = 0.09 + 0.52 * size
        root = (0.02 + 0.40 * size, 0.0, z - 0.10 * size)
        tip = (root[0] + (0.15 + long) * size, 0.0, root[2] - 0.08 * size)
        flat = long > 0.4
        bill = (
            limb(beak, root, tip, 0.09 * size, side_radius=0.20 * size)
            if flat
            else spike(beak, root, tip, 0.15 * size)
        )
        parts = [
            ball(coat.limbs, (0.02, 0.0, z), (1.0 * size, 0.96 * size, 1.05 * size)),
            bill,
            *_eyes(size, 0.40, 0.25, 0.20),
        ]
        if coat.face is not None:
            parts += coat.face(_ROUND, (0.02, 0.0, z))
        return parts

    return draw


def draw_frog(coat: Coat, size: float) -> list[ModelPart]:
    """A flat head with a wide mouth and eyes on its top."""
    z = 0.09 + 0.42 * size
    parts = [
        ball(coat.limbs, (0.04, 0.0, z), (1.2 * size, 1.25 * size, 0.85 * size)),
        ball(
            coat.dark,
            (0.04 + 0.12 * size, 0.0, z - 0.12 * size),
            (1.0 * size, 1.1 * size, 0.10 * size),
        ),
    ]
    for side in (1.0, -1.0):
        eye = (0.06 + 0.1 * size, 0.34 * side * size, z + 0.42 * size)
        parts.append(ball(coat.limbs, eye, (0.36 * size,) * 3))
        parts.append(ball(_PALE_EYE, (eye[0] + 0.09 * size, eye[1], eye[2]), (0.26 * size,) * 3))
        spot = (eye[0] + 0.20 * size, eye[1], eye[2])
        parts.append(ball(Material(BLACK), spot, (0.12 * size,) * 3))
    return parts


def draw_teddy(coat: Coat, size: float) -> list[ModelPart]:
    """A round head with round ears, a pale muzzle and a black nose."""
    z = 0.09 + 0.52 * size
    pale, dark = Material(shade(coat.limbs.colour, 1.7)), Material(BLACK)
    parts = [
        ball(coat.limbs, (0.02, 0.0, z), (1.10 * size, 1.20 * size, 1.10 * size)),
        ball(
            pale,
            (0.02 + 0.46 * size, 0.0, z - 0.12 * size),
            (0.44 * size, 0.56 * size, 0.42 * size),
        ),
        ball(
            dark,
            (0.02 + 0.68 * size, 0.0, z - 0.04 * size),
            (0.12 * size, 0.20 * size, 0.13 * size),
        ),
    ]
    for side in (1.0, -1.0):
        ear = (0.0, 0.48 * side * size, z + 0.46 * size)
        parts.append(ball(coat.limbs, ear, (0.20 * size, 0.44 * size, 0.44 * size)))
        parts.append(
            ball(pale, (0.06 * size, ear[1], ear[2]), (0.16 * size, 0.26 * size, 0.26 * size))
        )
        eye = (0.02 + 0.46 * size, 0.26 * side * size, z + 0.14 * size)
        parts.append(ball(dark, eye, (0.13 * size,) * 3))
    return parts


_ROUND = Build(1.0, (1.0, 1.0, 1.0), 0.1, 0.5, (0.3, 0.1), tail=(0.1, 0.0), ear=(0.01, "round"))
HEADS: Mapping[str, Callable[[Coat, float], list[ModelPart]]] = MappingProxyType(
    {
        "ape": draw_ape,
        "bill": draw_bird(Material((0.80, 0.42, 0.03)), 0.45),
        "beak": draw_bird(Material((0.80, 0.45, 0.05)), 0.25),
        "frog": draw_frog,
        "teddy": draw_teddy,
    }
)
"""Heads that are of no four-legged animal."""
