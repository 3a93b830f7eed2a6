"""Head and joints of a robot with a person's shape: a shell with a dark visor and lit eyes."""

from __future__ import annotations

import math

from texvent.scenes.models.materials import Material, glowing
from texvent.scenes.models.people.posture import Skeleton
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Affine, ball, moved, post, shift, turn_y

_VISOR = Material((0.03, 0.03, 0.035))
_JOINT = Material((0.20, 0.20, 0.21))
_EYES = glowing((0.15, 0.70, 0.95), 1.5)


def draw_robot_head(shell: Material, size: float) -> list[ModelPart]:
    """A shell around the head, in its axes; `size` is the head's height, m."""
    middle = 0.09 + 0.5 * size
    front = 0.01 + 0.62 * size
    eyes = (
        moved([_disc(_EYES, 0.10 * size)], shift(front, 0.22 * side * size, middle + 0.06 * size))
        for side in (1.0, -1.0)
    )
    return [
        ball(shell, (0.01, 0.0, middle), (1.18 * size, 1.10 * size, 1.30 * size)),
        ball(
            _VISOR,
            (0.01 + 0.20 * size, 0.0, middle + 0.04 * size),
            (0.90 * size, 0.98 * size, 0.72 * size),
        ),
        *(part for eye in eyes for part in eye),
    ]


def draw_robot_joints(shell: Material, joints: Skeleton) -> list[ModelPart]:
    """Dark joints, shoulders of the shell and a lamp on the chest, in body coordinates."""
    spots = (*joints.elbows, *joints.knees)
    return [
        *(ball(_JOINT, spot, (0.13, 0.13, 0.13)) for spot in spots),
        *(ball(shell, spot, (0.17, 0.15, 0.17)) for spot in joints.shoulders),
        *moved([_disc(_EYES, 0.045)], _on_chest(joints)),
    ]


def _disc(paint: Material, width: float) -> ModelPart:
    """A lamp that faces ahead, round, .02 m deep."""
    flat = post(paint, (0.0, 0.0, 0.0), (width, width, 0.02))
    return moved([flat], turn_y(0.5 * math.pi))[0]


def _on_chest(joints: Skeleton) -> Affine:
    """Axes [3, 4] of a place on the front of the chest."""
    chest = joints.torso.copy()
    chest[:, 3] = joints.torso[:, :3] @ (0.125, 0.0, 0.32) + joints.torso[:, 3]
    return chest
