"""What is worn over or instead of shirt and trousers: coats, aprons, robes, capes, bands.

Each is drawn on the joints of a body, in body coordinates, so that it follows hips and knees.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.materials import (
    BLACK,
    CHROME,
    WHITE,
    YELLOW,
    Material,
)
from texvent.scenes.models.people.posture import NECK, Skeleton
from texvent.scenes.models.people.roles.robot_shell import draw_robot_joints
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import (
    Point,
    ball,
    blade,
    box,
    fin,
    limb,
    moved,
    part_way,
    plank,
    post,
    rod,
    spike,
)

GarmentDraw = Callable[[Material, Skeleton], Sequence[ModelPart]]


def _point(place: np.ndarray) -> Point:
    x, y, z = (float(value) for value in place)
    return (x, y, z)


def _on_torso(joints: Skeleton, x: float, y: float, z: float) -> Point:
    return _point(joints.torso @ np.array([x, y, z, 1.0]))


def _low(joints: Skeleton, reach: float) -> Point:
    """A point between the hips (0), the knees (1) and the ankles (2)."""
    hips = joints.torso[:, 3]
    knees = 0.5 * (np.array(joints.knees[0]) + np.array(joints.knees[1]))
    feet = 0.5 * (np.array(joints.ankles[0]) + np.array(joints.ankles[1]))
    if reach <= 1.0:
        return _point(hips + reach * (knees - hips))
    return _point(knees + (reach - 1.0) * (feet - knees))


def flared(reach: float, radius: float, top: float = 0.46) -> GarmentDraw:
    """A cone from the chest down: a skirt, a coat, a robe; its hem stays level."""

    def draw(skin: Material, joints: Skeleton) -> list[ModelPart]:
        low, high = _low(joints, reach), _on_torso(joints, 0.02, 0.0, top)
        if abs(high[2] - low[2]) < radius:
            return [spike(skin, low, high, radius)]
        wide = 2.0 * radius
        return [fin(skin, low, high, chord=(wide, 0.0, 0.0), thickness=(0.0, wide, 0.0))]

    return draw


def _straight(reach: float, radius: float) -> GarmentDraw:
    """A tube from the waist down: the skirts of a long coat, open at its front."""

    def draw(skin: Material, joints: Skeleton) -> list[ModelPart]:
        low, top = _low(joints, reach), _on_torso(joints, -0.01, 0.0, 0.30)
        dark = Material((0.05, 0.05, 0.055))
        tube = rod(skin, low, top, radius, side_radius=1.15 * radius)
        gap = _on_torso(joints, 0.125, 0.0, 0.08)
        open_ = limb(dark, (low[0] + radius - 0.012, low[1], low[2] + 0.02), gap, 0.02)
        collar = [
            limb(
                dark,
                _on_torso(joints, 0.135, 0.0, 0.24),
                _on_torso(joints, 0.10, 0.05 * s, 0.46),
                0.018,
            )
            for s in (1.0, -1.0)
        ]
        return [tube, open_, *collar]

    return draw


def _apron(skin: Material, joints: Skeleton) -> list[ModelPart]:
    low = _low(joints, 0.95)
    front = (low[0] + 0.16, low[1], low[2])
    waist, chest = _on_torso(joints, 0.155, 0.0, 0.10), _on_torso(joints, 0.15, 0.0, 0.38)
    wide, thin = (0.0, 0.34, 0.0), (0.02, 0.0, 0.0)
    return [
        plank(skin, front, waist, chord=wide, thickness=thin),
        plank(skin, waist, chest, chord=(0.0, 0.24, 0.0), thickness=thin),
        *(
            limb(
                skin,
                _on_torso(joints, 0.15, 0.10 * s, 0.36),
                _on_torso(joints, 0.0, 0.07 * s, 0.54),
                0.012,
            )
            for s in (1.0, -1.0)
        ),
        limb(
            skin, _on_torso(joints, -0.13, -0.17, 0.10), _on_torso(joints, -0.13, 0.17, 0.10), 0.012
        ),
    ]


def _overalls(skin: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            box(skin, (0.118, 0.0, 0.28), (0.05, 0.24, 0.24)),
            ball(skin, (0.0, 0.0, 0.10), (0.285, 0.385, 0.26)),
            *(limb(skin, (0.125, 0.10 * s, 0.38), (-0.02, 0.09 * s, 0.53), 0.022) for s in (1, -1)),
            *(ball(CHROME, (0.15, 0.09 * s, 0.38), (0.03, 0.04, 0.04)) for s in (1, -1)),
        ],
        joints.torso,
    )


def _bands(_: Material, joints: Skeleton) -> list[ModelPart]:
    bright = Material((0.75, 0.75, 0.30), emission=0.25)
    return moved(
        [
            *(ball(bright, (0.0, 0.0, z), (0.275, 0.375, 0.07)) for z in (0.12, 0.26)),
            *(
                limb(bright, (0.125, 0.10 * s, 0.12), (0.09, 0.10 * s, 0.50), 0.024)
                for s in (1, -1)
            ),
        ],
        joints.torso,
    )


def _leg_bands(_: Material, joints: Skeleton) -> list[ModelPart]:
    bright = Material((0.75, 0.72, 0.20), emission=0.25)
    return [
        limb(
            bright,
            part_way(joints.knees[s], joints.ankles[s], 0.55),
            part_way(joints.knees[s], joints.ankles[s], 0.66),
            0.072,
        )
        for s in (0, 1)
    ]


def _boots(skin: Material, joints: Skeleton) -> list[ModelPart]:
    """The shafts of boots, up to below the knees; the feet have their colour already."""
    return [
        rod(skin, joints.ankles[s], part_way(joints.knees[s], joints.ankles[s], 0.30), 0.068)
        for s in (0, 1)
    ]


def _cape(skin: Material, joints: Skeleton) -> list[ModelPart]:
    low = _low(joints, 1.3)
    back = (low[0] - 0.32, low[1], low[2])
    return [
        blade(
            skin,
            back,
            _on_torso(joints, -0.13, 0.0, 0.60),
            chord=(0.0, 0.62, 0.0),
            thickness=(0.06, 0.0, 0.0),
        )
    ]


def _tutu(skin: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            post(skin, (0.0, 0.0, z), (wide, wide, 0.03))
            for z, wide in ((0.03, 0.78), (0.07, 0.66), (0.0, 0.66))
        ],
        joints.torso,
    )


def _air_tank(_: Material, joints: Skeleton) -> list[ModelPart]:
    yellow = Material(YELLOW)
    fins = [
        blade(
            Material((0.02, 0.10, 0.40)),
            joints.ankles[s],
            (joints.ankles[s][0] + 0.48, joints.ankles[s][1], joints.ankles[s][2] - 0.07),
            chord=(0.0, 0.22, 0.0),
            thickness=(0.0, 0.0, 0.03),
        )
        for s in (0, 1)
    ]
    return [
        *moved(
            [
                rod(yellow, (-0.22, 0.0, 0.02), (-0.22, 0.0, 0.50), 0.10),
                ball(yellow, (-0.22, 0.0, 0.50), (0.20, 0.20, 0.16)),
            ],
            joints.torso,
        ),
        *fins,
    ]


def _life_pack(_: Material, joints: Skeleton) -> list[ModelPart]:
    """The box on the back and the panel on the chest of a space suit."""
    return moved(
        [
            box(Material(WHITE), (-0.27, 0.0, 0.30), (0.22, 0.52, 0.66)),
            box(Material((0.35, 0.36, 0.38)), (0.17, 0.0, 0.28), (0.08, 0.26, 0.16)),
            box(Material((0.55, 0.03, 0.02)), (0.215, 0.06, 0.30), (0.02, 0.05, 0.05)),
        ],
        joints.torso,
    )


def _rucksack(skin: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            ball(skin, (-0.25, 0.0, 0.28), (0.30, 0.38, 0.56)),
            *(limb(skin, (0.12, 0.12 * s, 0.16), (0.05, 0.12 * s, 0.50), 0.022) for s in (1, -1)),
        ],
        joints.torso,
    )


def _belt(_: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            ball(Material(BLACK), (0.0, 0.0, 0.06), (0.275, 0.37, 0.09)),
            box(Material((0.62, 0.40, 0.05)), (0.135, 0.0, 0.06), (0.03, 0.08, 0.07)),
        ],
        joints.torso,
    )


def _bow_tie(_: Material, joints: Skeleton) -> list[ModelPart]:
    dark = Material(BLACK)
    return moved(
        [
            box(Material(WHITE), (0.122, 0.0, 0.30), (0.035, 0.12, 0.26)),
            *(ball(dark, (0.145, 0.035 * s, 0.44), (0.03, 0.07, 0.05)) for s in (1, -1)),
        ],
        joints.torso,
    )


def _tie(_: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            box(Material(WHITE), (0.120, 0.0, 0.36), (0.035, 0.13, 0.18)),
            box(Material((0.45, 0.02, 0.02)), (0.142, 0.0, 0.30), (0.02, 0.05, 0.28)),
        ],
        joints.torso,
    )


def _collar(_: Material, joints: Skeleton) -> list[ModelPart]:
    """A clown's ruff."""
    return moved([post(Material(WHITE), (0.02, 0.0, NECK), (0.42, 0.42, 0.05))], joints.torso)


def _buttons(_: Material, joints: Skeleton) -> list[ModelPart]:
    """The two rows of a cook's jacket."""
    return moved(
        [
            ball(Material(BLACK), (0.135 - 0.05 * abs(z - 0.25), 0.05 * s, z), (0.025,) * 3)
            for s in (1, -1)
            for z in (0.14, 0.26, 0.38)
        ],
        joints.torso,
    )


def _star(_: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [ball(Material((0.70, 0.50, 0.06)), (0.125, 0.09, 0.36), (0.03, 0.07, 0.08))], joints.torso
    )


def _armour(_: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            limb(CHROME, (0.0, 0.0, 0.06), (0.0, 0.0, 0.40), 0.145, side_radius=0.20),
            *(ball(CHROME, (0.0, 0.22 * s, 0.42), (0.20, 0.18, 0.18)) for s in (1, -1)),
        ],
        joints.torso,
    )


def _pads(_: Material, joints: Skeleton) -> list[ModelPart]:
    """Leg guards of a goalkeeper on ice, a catcher, a batsman."""
    pale = Material((0.70, 0.68, 0.60))
    parts = []
    for side in (0, 1):
        knee, ankle = joints.knees[side], joints.ankles[side]
        top = (knee[0] + 0.05, knee[1], knee[2] + 0.08)
        low = (ankle[0] + 0.07, ankle[1], ankle[2])
        parts.append(plank(pale, low, top, chord=(0.0, 0.17, 0.0), thickness=(0.07, 0.0, 0.0)))
    return parts


def _shoulder_pads(skin: Material, joints: Skeleton) -> list[ModelPart]:
    return moved(
        [
            *(ball(skin, (0.0, 0.20 * s, 0.44), (0.30, 0.30, 0.22)) for s in (1, -1)),
            box(Material(WHITE), (0.128, 0.0, 0.26), (0.03, 0.14, 0.14)),
        ],
        joints.torso,
    )


def _sash(skin: Material, joints: Skeleton) -> list[ModelPart]:
    return moved([limb(skin, (0.10, -0.14, 0.06), (0.06, 0.15, 0.48), 0.045)], joints.torso)


def _wings(_: Material, joints: Skeleton) -> list[ModelPart]:
    pale = Material((0.82, 0.82, 0.80))
    return moved(
        [
            blade(
                pale,
                (-0.12, 0.06 * s, 0.30),
                (-0.25, 0.75 * s, 0.75),
                chord=(0.0, -0.15 * s, 0.36),
                thickness=(0.05 * s, 0.0, 0.0),
            )
            for s in (1, -1)
        ],
        joints.torso,
    )


def _belly(skin: Material, joints: Skeleton) -> list[ModelPart]:
    return moved([ball(skin, (0.05, 0.0, 0.14), (0.46, 0.48, 0.42))], joints.torso)


def _mouse_mark(_: Material, joints: Skeleton) -> list[ModelPart]:
    """Rings around arms and body of a striped shirt."""
    white = Material((0.85, 0.85, 0.83))
    return moved(
        [
            ball(white, (0.0, 0.0, z), (0.272, w, 0.06))
            for z, w in ((0.08, 0.36), (0.19, 0.37), (0.30, 0.375))
        ],
        joints.torso,
    )


GARMENTS: Mapping[str, GarmentDraw] = MappingProxyType(
    {
        "skirt": flared(1.12, 0.33),
        "long skirt": flared(1.85, 0.40),
        "gown": flared(1.95, 0.56, 0.30),
        "robe": flared(1.85, 0.30, 0.62),
        "long coat": _straight(1.15, 0.185),
        "knee coat": _straight(0.72, 0.180),
        "apron": _apron,
        "overalls": _overalls,
        "bands": _bands,
        "leg bands": _leg_bands,
        "boots": _boots,
        "cape": _cape,
        "tutu": _tutu,
        "air tank": _air_tank,
        "life pack": _life_pack,
        "rucksack": _rucksack,
        "belt": _belt,
        "bow tie": _bow_tie,
        "tie": _tie,
        "ruff": _collar,
        "buttons": _buttons,
        "star": _star,
        "armour": _armour,
        "pads": _pads,
        "shoulder pads": _shoulder_pads,
        "sash": _sash,
        "wings": _wings,
        "belly": _belly,
        "rings": _mouse_mark,
        "robot joints": draw_robot_joints,
    }
)
"""Name of one of `PersonKind.garments` → how it is drawn."""
