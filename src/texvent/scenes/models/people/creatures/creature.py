"""The upright body of an animal: its coat, paws, tail and head on a person's joints."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from texvent.scenes.models.animals.four_legged.animal import Animal, paint_coat
from texvent.scenes.models.animals.four_legged.build import Coat
from texvent.scenes.models.materials import Material, cloth, fur
from texvent.scenes.models.people.creatures.heads import HEADS, draw_mammal
from texvent.scenes.models.people.outfit import Outfit, PersonKind
from texvent.scenes.models.people.posture import Skeleton
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, limb
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Creature:
    """Which animal a body is of."""

    animal: Animal
    head: str = ""
    """A name of `heads.HEADS`; "" = the head of the four-legged animal."""
    front: Colour | None = None
    """Of chest and belly; None = as the trunk."""
    is_sleeved: bool = False
    """Whether the arms have the colour of the legs, as a panda's."""

    def dress(self, kind: PersonKind, *, colour: Colour | None, seed: int) -> Outfit:
        """Surfaces of its body; what it does not wear is its coat."""
        coat = paint_coat(self.animal, colour=colour, seed=seed)
        legs = coat.legs or coat.limbs
        arms = legs if self.is_sleeved else coat.limbs
        clad = cloth(paint(None, seed, "shirt", kind.shirts)) if kind.shirts else None
        below = cloth(kind.trousers) if kind.trousers is not None else None
        is_short = kind.dress == "shorts"
        sleeves = clad if clad is not None and kind.has_sleeves else None
        over = clad or coat.trunk
        return Outfit(
            skin=coat.limbs,
            hair=coat.limbs,
            shirt=over,
            legs=below or legs,
            shins=legs if is_short or below is None else below,
            shoes=legs if kind.shoes is None else Material(kind.shoes),
            sleeves=clad or arms,
            forearms=sleeves or arms,
            hands=arms if kind.gloves is None else Material(kind.gloves),
            hat=cloth(kind.hat_colour),
            garments=[(name, over if hue is None else cloth(hue)) for name, hue in kind.garments],
            bulk=kind.bulk,
            coat=coat,
        )

    def draw_head(self, coat: Coat, size: float) -> list[ModelPart]:
        """Neck and head in the axes of the base of the neck."""
        neck = limb(coat.limbs, (0.0, 0.0, -0.04), (0.01, 0.0, 0.14), 0.09)
        if self.head:
            return [neck, *HEADS[self.head](coat, size)]
        return [neck, *draw_mammal(self.animal.build, coat, size)]

    def draw_body(self, kind: PersonKind, outfit: Outfit, joints: Skeleton) -> list[ModelPart]:
        """Paws, tail, and a pale front where nothing is worn over it."""
        coat = outfit.coat
        if coat is None:
            return []
        parts = [
            ball(outfit.hands or coat.limbs, joints.hands[side], (0.115, 0.10, 0.115))
            for side in (0, 1)
        ]
        for side in (0, 1):
            x, y, z = joints.ankles[side]
            foot = (
                x + 0.05 * math.cos(joints.heading),
                y + 0.05 * math.sin(joints.heading),
                z - 0.03,
            )
            parts.append(ball(outfit.shoes, foot, (0.22, 0.14, 0.11)))
        if self.front is not None and not kind.shirts:
            parts.append(
                _on_torso(
                    joints, fur(self.front), (0.075, 0.0, 0.22), (0.16, 0.27, 0.44), kind.bulk
                )
            )
        return [*parts, *self._draw_tail(coat, joints)]

    def _draw_tail(self, coat: Coat, joints: Skeleton) -> list[ModelPart]:
        """Out and down from the back of the hips, as long as it is beside the animal's trunk."""
        build = self.animal.build
        long = min(build.tail[0] / build.body[0], 1.1) * 0.75
        if long < 0.05:
            return []
        thick = 0.17 * long if build.bushy_tail else 0.035
        root = _place(joints, (-0.10, 0.0, 0.0))
        middle = _place(joints, (-0.10 - 0.45 * long, 0.0, -0.12 * long))
        tip = _place(joints, (-0.10 - 0.80 * long, 0.0, 0.20 * long))
        paint_ = coat.tail or coat.limbs
        return [limb(paint_, root, middle, 0.8 * thick), limb(paint_, middle, tip, thick)]


def _place(joints: Skeleton, point: Point) -> Point:
    x, y, z = (float(value) for value in joints.torso @ np.array([*point, 1.0]))
    return (x, y, z)


def _on_torso(
    joints: Skeleton, skin: Material, middle: Point, size: Point, bulk: float
) -> ModelPart:
    """An ellipsoid that goes with the torso; its depth and width grow with the body's bulk."""
    turn = joints.torso[:, :3]
    scale = np.diag([0.5 * size[0] * bulk, 0.5 * size[1] * bulk, 0.5 * size[2]])
    at = joints.torso @ np.array([middle[0] * bulk, middle[1], middle[2], 1.0])
    one = ball(skin, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    return one.at(np.column_stack([turn @ scale * 2.0 @ one.to_body[:, :3], at]))
