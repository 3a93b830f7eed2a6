"""More four-legged animals from the same table: camel to crocodile, mouse to dinosaur."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.models.animals.four_legged.animal import Animal
from texvent.scenes.models.animals.four_legged.build import Build, Coat
from texvent.scenes.models.animals.four_legged.marks import (
    big_nose,
    cheeks,
    curled_tail,
    dark_shoulders,
    eye_patches,
    mask,
    pale_front,
)
from texvent.scenes.models.animals.quadrupeds import (
    BEAR,
    CAT,
    HORSE,
    PIG,
    animal_noun,
)
from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, spike


def _hump(build: Build, coat: Coat) -> list[ModelPart]:
    length, width, height = build.body
    z = build.shoulder - 0.05 * height
    return [
        ball(coat.trunk, (-0.04 * length, 0.0, z), (0.42 * length, 0.75 * width, 0.85 * height))
    ]


def _spines(build: Build, coat: Coat) -> list[ModelPart]:
    """Rows of spines over the back, radiating."""
    length, width, height = build.body
    z = build.shoulder - 0.5 * height
    parts = [ball(coat.dark, (-0.05 * length, 0.0, z + 0.08 * height),
                  (1.05 * length, 1.08 * width, 1.10 * height))]  # fmt: skip
    for x in (-0.42, -0.24, -0.06, 0.12, 0.28):
        for across, up in ((0.0, 0.62), (0.36, 0.46), (-0.36, 0.46), (0.52, 0.18), (-0.52, 0.18)):
            foot = (x * length, 0.8 * across * width, z + 0.8 * up * height)
            tip = ((1.35 * x - 0.06) * length, 1.5 * across * width, z + 1.45 * up * height)
            parts.append(spike(coat.hoof, foot, tip, 0.035 * length))
    return parts


def _nose_horn(build: Build, coat: Coat) -> list[ModelPart]:
    length, _, height = build.body
    skull, muzzle = build.head
    x = 0.36 * length + build.neck + 0.2 * height + 0.35 * skull + 0.75 * muzzle
    z = build.shoulder - 0.36 * height - 0.15 * skull
    bone = Material((0.45, 0.41, 0.34))
    return [spike(bone, (x, 0.0, z), (x + 0.10, 0.0, z + 0.48), 0.09)]


def _back_plates(build: Build, coat: Coat) -> list[ModelPart]:
    length, _, height = build.body
    top = build.shoulder
    return [
        spike(
            coat.dark,
            (x * length, y, top - 0.1 * height),
            (x * length - 0.03, y, top + 0.14 * height),
            0.06 * length,
        )
        for x in (-0.44, -0.30, -0.16, -0.02, 0.12, 0.26)
        for y in (0.12 * height, -0.12 * height)
    ]


_SCALES = (0.10, 0.14, 0.05)
CAMEL = Animal(
    Build(1.75, (1.50, 0.50, 0.72), 0.85, 0.75, (0.30, 0.22), (0.45, -0.9), (0.12, "prick"),
          stride=2.2, thick=0.95, mane=""),
    ((0.46, 0.28, 0.12),), extras=_hump,
)  # fmt: skip
DONKEY = replace(
    HORSE,
    build=replace(
        HORSE.build, shoulder=1.15, ear=(0.28, "long"), body=(1.15, 0.40, 0.48), neck=0.42
    ),
    colours=((0.22, 0.20, 0.19),),
)
SQUIRREL = Animal(
    Build(0.15, (0.20, 0.09, 0.11), 0.025, 0.9, (0.080, 0.025), (0.02, 1.35), (0.035, "prick"),
          stride=0.30, thick=1.1, hop=0.03),
    ((0.36, 0.13, 0.04), (0.22, 0.20, 0.18)), face=cheeks((0.72, 0.62, 0.50)),
    extras=lambda build, coat: [
        *curled_tail(build, coat), *pale_front((0.72, 0.62, 0.50))(build, coat)],
)  # fmt: skip
HEDGEHOG = Animal(
    Build(0.13, (0.22, 0.13, 0.12), 0.01, 0.2, (0.075, 0.05), (0.02, 0.2), (0.022, "round"),
          stride=0.14, thick=0.9),
    ((0.42, 0.32, 0.22),), dark=(0.13, 0.09, 0.06), hoof=(0.30, 0.24, 0.17), extras=_spines,
)  # fmt: skip
MOUSE = Animal(
    Build(0.065, (0.10, 0.045, 0.05), 0.008, 0.3, (0.036, 0.022), (0.11, 0.15), (0.030, "round"),
          stride=0.08, thick=0.8),
    ((0.30, 0.28, 0.26), (0.36, 0.25, 0.16), (0.62, 0.60, 0.58)), dark=(0.55, 0.36, 0.33),
)  # fmt: skip
RAT = replace(MOUSE, build=replace(MOUSE.build, shoulder=0.10, body=(0.18, 0.075, 0.085),
                                   head=(0.055, 0.04), tail=(0.20, 0.1), ear=(0.025, "round"),
                                   stride=0.13),
              colours=((0.16, 0.13, 0.11), (0.24, 0.21, 0.19)))  # fmt: skip
HAMSTER = Animal(
    Build(0.085, (0.12, 0.085, 0.085), 0.004, 0.4, (0.06, 0.018), (0.012, 0.3), (0.020, "round"),
          stride=0.08, thick=0.9),
    ((0.60, 0.36, 0.14), (0.66, 0.60, 0.52)), dark=(0.60, 0.42, 0.36),
)  # fmt: skip
PANDA = replace(
    BEAR,
    build=replace(BEAR.build, head=(0.52, 0.16), ear=(0.20, "round"), neck=0.14,
                  body=(1.35, 0.72, 0.80)),
    colours=((0.80, 0.79, 0.76),), dark=(0.02, 0.02, 0.02), leg_colour=(0.02, 0.02, 0.02),
    ear_colour=(0.02, 0.02, 0.02), muzzle_colour=None, face=eye_patches(), extras=dark_shoulders,
)  # fmt: skip
KOALA = replace(
    BEAR, build=replace(BEAR.build, shoulder=0.42, body=(0.40, 0.30, 0.34), neck=0.05, rise=0.7,
                        head=(0.30, 0.03), ear=(0.25, "wide"), stride=0.5, tail=(0.02, 0.0),
                        thick=1.7),
    colours=((0.36, 0.35, 0.37),), dark=(0.03, 0.03, 0.03), muzzle_colour=None, face=big_nose,
    extras=pale_front((0.74, 0.72, 0.70)),
)  # fmt: skip
RACCOON = replace(
    CAT, build=replace(CAT.build, bushy_tail=True, tail=(0.36, 0.25), ear=(0.055, "prick"),
                       thick=1.4, body=(0.44, 0.23, 0.26), head=(0.16, 0.055), shoulder=0.30),
    colours=((0.30, 0.29, 0.27),), dark=(0.03, 0.03, 0.03), face=mask,
    leg_colour=(0.06, 0.055, 0.05), muzzle_colour=(0.62, 0.60, 0.56),
    extras=None, tail_ring=(0.03, 0.03, 0.03),
)  # fmt: skip
RHINO = Animal(
    Build(1.65, (2.60, 1.05, 1.25), 0.30, 0.1, (0.52, 0.42), (0.55, -0.9), (0.18, "prick"),
          stride=1.9, thick=1.8),
    ((0.22, 0.21, 0.20),), extras=_nose_horn,
)  # fmt: skip
HIPPO = replace(
    PIG, build=replace(PIG.build, shoulder=1.45, body=(2.6, 1.25, 1.2), neck=0.20,
                       head=(0.58, 0.50), tail=(0.35, -0.6), ear=(0.10, "round"),
                       stride=1.5, thick=1.5),
    colours=((0.24, 0.17, 0.16),), dark=(0.33, 0.20, 0.19),
)  # fmt: skip
CROCODILE = Animal(
    Build(0.42, (1.60, 0.52, 0.34), 0.10, 0.05, (0.32, 0.55), (1.70, -0.12), (0.02, "round"),
          stride=0.55, thick=1.2),
    (_SCALES,), extras=_back_plates,
)  # fmt: skip
LIZARD = Animal(
    Build(0.075, (0.20, 0.080, 0.06), 0.03, 0.25, (0.065, 0.04), (0.26, -0.08), (0.004, "round"),
          stride=0.13, thick=0.8),
    ((0.50, 0.34, 0.14), (0.16, 0.44, 0.10)),
)  # fmt: skip
SAUROPOD = Animal(
    Build(3.4, (4.2, 1.9, 2.0), 4.2, 0.85, (0.62, 0.42), (4.6, -0.15), (0.02, "round"),
          stride=3.6, thick=1.7),
    ((0.16, 0.20, 0.12), (0.24, 0.19, 0.13)),
)  # fmt: skip

NOUNS = (
    animal_noun("camel", CAMEL, 1.5),
    animal_noun("donkey", DONKEY, 1.3),
    animal_noun("squirrel", SQUIRREL, 1.2),
    animal_noun("hedgehog", HEDGEHOG, 0.3),
    animal_noun("mouse", MOUSE, 0.5, (), ("mice",)),
    animal_noun("rat", RAT, 0.6),
    animal_noun("hamster", HAMSTER, 0.3),
    animal_noun("panda", PANDA, 1.0, ("panda bear", "giant panda")),
    animal_noun("koala", KOALA, 0.4, ("koala bear",)),
    animal_noun("raccoon", RACCOON, 0.9),
    animal_noun("rhino", RHINO, 1.5, ("rhinoceros",), ("rhinoceroses",)),
    animal_noun("hippo", HIPPO, 1.1, ("hippopotamus",), ("hippopotamuses",)),
    animal_noun("crocodile", CROCODILE, 0.7),
    animal_noun("lizard", LIZARD, 0.4),
    animal_noun("sauropod", SAUROPOD, 2.2),
)
"""All walk unless told otherwise."""
