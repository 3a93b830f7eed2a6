"""Four-legged animals from one table of proportions: dog to elephant."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.animals.four_legged.animal import Animal, build_animal
from texvent.scenes.models.animals.four_legged.build import Build
from texvent.scenes.models.animals.four_legged.marks import (
    bib,
    cheeks,
    hump,
    snout,
    udder,
    whiskers,
)
from texvent.scenes.models.materials import BLACK, WHITE
from texvent.scenes.models.protocol import Noun

DOG = Animal(
    Build(
        0.52,
        (0.60, 0.21, 0.26),
        0.10,
        0.6,
        (0.23, 0.12),
        tail=(0.32, 0.75),
        ear=(0.14, "flop"),
        waist=0.72,
    ),
    ((0.30, 0.14, 0.05), (0.50, 0.30, 0.12), (0.09, 0.06, 0.045)),
)
CAT = Animal(
    Build(
        0.26,
        (0.36, 0.14, 0.155),
        0.04,
        0.80,
        (0.170, 0.02),
        tail=(0.30, 1.15),
        ear=(0.095, "prick"),
        thick=1.3,
        waist=0.88,
    ),
    ((0.52, 0.25, 0.07), (0.30, 0.28, 0.26), (0.025, 0.025, 0.028)),
    face=whiskers,
    extras=bib,
)
FOX = Animal(
    Build(
        0.38,
        (0.55, 0.15, 0.17),
        0.17,
        0.7,
        (0.14, 0.14),
        tail=(0.40, -0.2),
        ear=(0.08, "prick"),
        bushy_tail=True,
    ),
    ((0.55, 0.17, 0.03),),
    dark=(0.06, 0.03, 0.02),
    leg_colour=(0.06, 0.03, 0.02),
    face=cheeks((0.80, 0.76, 0.70)),
)
WOLF = Animal(
    Build(
        0.75,
        (0.90, 0.25, 0.30),
        0.28,
        0.6,
        (0.22, 0.20),
        tail=(0.42, -0.6),
        ear=(0.10, "prick"),
        bushy_tail=True,
    ),
    ((0.24, 0.22, 0.20),),
    face=cheeks((0.55, 0.53, 0.50)),
)
HORSE = Animal(
    Build(
        1.45,
        (1.55, 0.46, 0.58),
        0.62,
        0.85,
        (0.36, 0.36),
        tail=(0.70, -1.1),
        ear=(0.13, "prick"),
        stride=2.6,
        mane="ridge",
        bushy_tail=True,
    ),
    ((0.20, 0.085, 0.035), (0.10, 0.05, 0.025), (0.55, 0.52, 0.48)),
    dark=(0.03, 0.018, 0.012),
)
ZEBRA = Animal(
    Build(
        1.30,
        (1.40, 0.44, 0.56),
        0.62,
        0.85,
        (0.32, 0.26),
        tail=(0.50, -1.2),
        ear=(0.14, "prick"),
        stride=2.2,
        mane="ridge",
    ),
    ((0.74, 0.72, 0.68),),
    pattern="stripes",
    second_colour=(0.02, 0.02, 0.02),
    dark=BLACK,
)
COW = Animal(
    Build(
        1.38,
        (1.85, 0.72, 0.90),
        0.34,
        0.30,
        (0.40, 0.34),
        tail=(0.85, -1.45),
        ear=(0.20, "side"),
        stride=1.7,
        thick=1.25,
        horns="short",
        patches=True,
    ),
    (WHITE,),
    dark=(0.40, 0.22, 0.18),
    muzzle_colour=(0.72, 0.46, 0.40),
    ear_colour=(0.03, 0.03, 0.03),
    extras=udder,
)
ELEPHANT = Animal(
    Build(
        2.75,
        (2.90, 1.35, 1.60),
        0.45,
        0.35,
        (0.95, 0.10),
        tail=(0.90, -1.3),
        ear=(0.95, "fan"),
        stride=2.4,
        thick=2.2,
        trunk=1.9,
        horns="tusks",
    ),
    ((0.21, 0.20, 0.20),),
)
DEER = Animal(
    Build(
        1.00,
        (1.05, 0.30, 0.36),
        0.50,
        1.0,
        (0.22, 0.18),
        tail=(0.13, -0.4),
        ear=(0.13, "side"),
        stride=1.7,
        thick=0.75,
        horns="antlers",
    ),
    ((0.32, 0.17, 0.07),),
    dark=(0.08, 0.05, 0.03),
)
LION = Animal(
    Build(
        1.00,
        (1.45, 0.40, 0.48),
        0.28,
        0.55,
        (0.36, 0.20),
        tail=(0.85, -0.7),
        ear=(0.13, "round"),
        stride=1.8,
        thick=1.15,
        mane="full",
    ),
    ((0.52, 0.33, 0.13),),
    dark=(0.22, 0.10, 0.03),
    face=cheeks((0.72, 0.60, 0.42)),
)
TIGER = Animal(
    Build(
        0.98,
        (1.50, 0.38, 0.46),
        0.26,
        0.5,
        (0.32, 0.16),
        tail=(0.85, -0.6),
        ear=(0.09, "prick"),
        stride=1.8,
        thick=1.15,
    ),
    ((0.62, 0.24, 0.03),),
    pattern="stripes",
    second_colour=(0.03, 0.02, 0.015),
    dark=(0.45, 0.22, 0.18),
    muzzle_colour=WHITE,
    face=cheeks(WHITE),
)
CHEETAH = Animal(
    Build(
        0.82,
        (1.25, 0.28, 0.34),
        0.24,
        0.5,
        (0.24, 0.11),
        tail=(0.75, -0.5),
        ear=(0.07, "round"),
        stride=1.9,
    ),
    ((0.60, 0.38, 0.13),),
    pattern="checks",
    second_colour=(0.10, 0.05, 0.02),
    checks=3.4,
)
GOAT = Animal(
    Build(
        0.72,
        (0.88, 0.30, 0.36),
        0.24,
        0.8,
        (0.18, 0.15),
        tail=(0.12, 0.8),
        ear=(0.12, "side"),
        horns="short",
    ),
    ((0.60, 0.55, 0.48), (0.20, 0.13, 0.08)),
)
GIRAFFE = Animal(
    Build(
        2.70,
        (1.75, 0.62, 0.80),
        2.10,
        1.12,
        (0.40, 0.32),
        tail=(0.80, -1.4),
        ear=(0.18, "side"),
        stride=3.2,
        horns="knobs",
    ),
    ((0.66, 0.46, 0.20),),
    pattern="checks",
    second_colour=(0.24, 0.10, 0.03),
    dark=(0.20, 0.10, 0.04),
)
SHEEP = Animal(
    Build(
        0.72,
        (0.95, 0.50, 0.52),
        0.16,
        0.5,
        (0.20, 0.15),
        tail=(0.14, -1.0),
        ear=(0.11, "side"),
        fleece=True,
    ),
    ((0.72, 0.69, 0.62),),
    dark=(0.05, 0.045, 0.04),
)
PIG = Animal(
    Build(
        0.62,
        (1.00, 0.42, 0.46),
        0.10,
        0.2,
        (0.27, 0.17),
        tail=(0.14, 0.6),
        ear=(0.12, "flop"),
        thick=1.3,
    ),
    ((0.72, 0.40, 0.36),),
    dark=(0.62, 0.28, 0.26),
    face=snout((0.66, 0.32, 0.30)),
)
BEAR = Animal(
    Build(
        1.02,
        (1.45, 0.66, 0.74),
        0.22,
        0.40,
        (0.46, 0.22),
        tail=(0.10, -0.5),
        ear=(0.17, "round"),
        stride=1.7,
        thick=1.9,
    ),
    ((0.19, 0.095, 0.040),),
    dark=(0.04, 0.025, 0.02),
    muzzle_colour=(0.36, 0.22, 0.11),
    extras=hump,
)
BLACK_BEAR = replace(BEAR, colours=((0.022, 0.020, 0.020),), muzzle_colour=(0.34, 0.20, 0.09))
POLAR_BEAR = replace(
    BEAR,
    build=replace(BEAR.build, neck=0.34, head=(0.40, 0.26), ear=(0.11, "round")),
    colours=((0.78, 0.76, 0.69),),
    dark=(0.03, 0.03, 0.03),
    muzzle_colour=None,
    extras=None,
)
RABBIT = Animal(
    Build(
        0.20,
        (0.34, 0.15, 0.17),
        0.06,
        0.9,
        (0.11, 0.06),
        tail=(0.05, 0.8),
        ear=(0.15, "long"),
        stride=0.75,
        thick=1.2,
        hop=0.10,
        bushy_tail=True,
    ),
    ((0.36, 0.27, 0.18), (0.66, 0.64, 0.60)),
    dark=(0.60, 0.50, 0.46),
)


def animal_noun(
    name: str,
    animal: Animal,
    speed: float,
    synonyms: tuple[str, ...] = (),
    plurals: tuple[str, ...] = (),
) -> Noun:
    """A four-legged animal that walks at that usual speed, m/s."""
    return Noun(
        name, partial(build_animal, animal), "ground", speed, "walk", synonyms, plurals,
        acts=frozenset(ANIMAL_ACTS),
    )  # fmt: skip


NOUNS = (
    animal_noun("dog", DOG, 1.6),
    animal_noun("cat", CAT, 1.0, ("kitty",)),
    animal_noun("fox", FOX, 1.4, ("red fox",)),
    animal_noun("wolf", WOLF, 1.8, ("grey wolf", "gray wolf")),
    animal_noun("horse", HORSE, 2.0, ("stallion", "mare")),
    animal_noun("zebra", ZEBRA, 1.8),
    animal_noun("cow", COW, 1.1, (), ("cattle",)),
    animal_noun("elephant", ELEPHANT, 1.8),
    animal_noun("deer", DEER, 1.6, ("stag",), ("deer",)),
    animal_noun("lion", LION, 1.5),
    animal_noun("tiger", TIGER, 1.5),
    animal_noun("cheetah", CHEETAH, 2.0),
    animal_noun("goat", GOAT, 1.0),
    animal_noun("giraffe", GIRAFFE, 1.8),
    animal_noun("sheep", SHEEP, 0.9, ("ewe",), ("sheep",)),
    animal_noun("pig", PIG, 0.9),
    animal_noun("bear", BEAR, 1.3, ("brown bear",)),
    animal_noun("black bear", BLACK_BEAR, 1.3, ("american black bear",)),
    animal_noun("polar bear", POLAR_BEAR, 1.3),
    animal_noun("rabbit", RABBIT, 1.2, ("bunny",)),
)
