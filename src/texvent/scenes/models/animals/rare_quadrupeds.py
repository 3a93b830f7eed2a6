"""Four-legged animals that are rarer in prompts: otter to red panda, and young ones."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.animals.breeds import build_sized, young
from texvent.scenes.models.animals.four_legged.animal import Animal
from texvent.scenes.models.animals.four_legged.build import Build
from texvent.scenes.models.animals.four_legged.marks import cheeks, mask, pale_front, white_back
from texvent.scenes.models.animals.more_quadrupeds import PANDA
from texvent.scenes.models.animals.quadrupeds import CAT, DEER, ELEPHANT, FOX, WOLF, animal_noun
from texvent.scenes.models.protocol import Noun

OTTER = Animal(
    Build(0.26, (0.62, 0.17, 0.18), 0.08, 0.55, (0.14, 0.05), (0.42, -0.15), (0.03, "round"),
          stride=0.35, thick=1.2, bushy_tail=True),
    ((0.20, 0.11, 0.055),), dark=(0.03, 0.02, 0.02), face=cheeks((0.62, 0.50, 0.38)),
    extras=pale_front((0.55, 0.42, 0.30)),
)  # fmt: skip
BEAVER = Animal(
    Build(0.30, (0.55, 0.26, 0.28), 0.03, 0.4, (0.16, 0.06), (0.34, -0.25), (0.03, "round"),
          stride=0.30, thick=1.2, bushy_tail=True),
    ((0.22, 0.12, 0.05),), dark=(0.05, 0.04, 0.035), tail_ring=(0.05, 0.04, 0.035),
)  # fmt: skip
MEERKAT = Animal(
    Build(0.22, (0.34, 0.11, 0.12), 0.06, 0.9, (0.085, 0.05), (0.24, 0.5), (0.02, "round"),
          stride=0.28, thick=0.9),
    ((0.46, 0.34, 0.20),), dark=(0.05, 0.04, 0.03), face=mask,
)  # fmt: skip
MOOSE = replace(
    DEER,
    build=replace(DEER.build, shoulder=1.85, body=(1.75, 0.60, 0.80), head=(0.38, 0.44), neck=0.45,
                  rise=0.5, thick=1.0, stride=2.4),
    colours=((0.11, 0.065, 0.035),), dark=(0.05, 0.03, 0.02),
)  # fmt: skip
LLAMA = Animal(
    Build(1.15, (0.95, 0.46, 0.52), 0.80, 1.25, (0.24, 0.14), (0.22, 0.4), (0.17, "prick"),
          stride=1.5, thick=1.4, fleece=True),
    ((0.72, 0.66, 0.56), (0.45, 0.30, 0.18)), dark=(0.60, 0.52, 0.42),
)  # fmt: skip
SKUNK = replace(
    CAT,
    build=replace(CAT.build, bushy_tail=True, tail=(0.38, 0.9), body=(0.40, 0.17, 0.19),
                  ear=(0.025, "round"), head=(0.12, 0.06)),
    colours=((0.02, 0.02, 0.022),), dark=(0.04, 0.03, 0.03), face=None, extras=white_back,
    tail_ring=(0.85, 0.85, 0.83),
)  # fmt: skip
BADGER = replace(
    CAT,
    build=replace(CAT.build, tail=(0.14, 0.0), body=(0.55, 0.26, 0.26), ear=(0.03, "round"),
                  head=(0.16, 0.10), thick=1.5, neck=0.04, rise=0.3),
    colours=((0.36, 0.35, 0.33),), dark=(0.02, 0.02, 0.02), leg_colour=(0.03, 0.03, 0.03),
    face=mask, muzzle_colour=(0.80, 0.79, 0.76), extras=None,
)  # fmt: skip
RED_PANDA = replace(
    FOX,
    build=replace(FOX.build, body=(0.50, 0.22, 0.24), head=(0.17, 0.06), neck=0.05,
                  tail=(0.46, 0.1), ear=(0.07, "prick"), thick=1.5, shoulder=0.34),
    colours=((0.46, 0.13, 0.03),), face=mask, ear_colour=(0.80, 0.76, 0.70),
    tail_ring=(0.20, 0.05, 0.02),
)  # fmt: skip
_YOUNG: tuple[tuple[str, Animal, float, tuple[str, ...]], ...] = (
    ("elephant calf", young(ELEPHANT), 0.42, ("baby elephant",)),
    ("panda cub", young(PANDA), 0.45, ("baby panda",)),
    ("wolf pup", young(WOLF), 0.45, ("wolf cub", "baby wolf", "gray wolf pup", "grey wolf pup")),
    ("fox cub", young(FOX), 0.5, ("baby fox", "fox kit")),
)

NOUNS = (
    animal_noun("otter", OTTER, 0.9, ("sea otter", "river otter")),
    animal_noun("beaver", BEAVER, 0.5),
    animal_noun("meerkat", MEERKAT, 0.8),
    animal_noun("moose", MOOSE, 1.8, ("elk",), ("moose",)),
    animal_noun("llama", LLAMA, 1.2, ("alpaca",)),
    animal_noun("skunk", SKUNK, 0.7),
    animal_noun("badger", BADGER, 0.8),
    animal_noun("red panda", RED_PANDA, 0.8),
    *(
        Noun(name, partial(build_sized, animal, size), "ground", 1.2, "walk", same,
             acts=frozenset(ANIMAL_ACTS))
        for name, animal, size, same in _YOUNG
    ),
)  # fmt: skip
