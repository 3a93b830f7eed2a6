"""Young animals and breeds, told by their proportions and the marks of their coats."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

from texvent.scenes.models.animals import quadrupeds
from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.animals.four_legged.animal import Animal, build_animal
from texvent.scenes.models.animals.four_legged.build import Build, Coat
from texvent.scenes.models.animals.quadrupeds import CAT, DOG, HORSE
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import BLACK, WHITE, Material, fur, shade
from texvent.scenes.models.protocol import ModelPart, Noun
from texvent.scenes.models.shapes import Point, ball, limb
from texvent.scenes.scene import Colour

Extras = Callable[[Build, Coat], list[ModelPart]]


def build_sized(
    animal: Animal, size: float, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make an animal `size` times as large as its table says."""
    return build_animal(animal, colour=colour, scale=scale * size, seed=seed)


def young(animal: Animal, **changes: object) -> Animal:
    """Longer legs, a shorter trunk and a larger head than the grown animal."""
    build = animal.build
    long, wide, tall = build.body
    skull, muzzle = build.head
    small = replace(
        build,
        body=(0.84 * long, 0.96 * wide, 0.86 * tall),
        head=(1.35 * skull, 0.85 * muzzle),
        neck=0.8 * build.neck,
        horns="",
        mane="" if build.mane == "full" else build.mane,
        tail=(0.75 * build.tail[0], build.tail[1]),
    )
    return replace(animal, build=small, **changes)  # type: ignore[arg-type]


def _sides(build: Build, places: tuple[tuple[float, float], ...], size: float, skin: Material
           ) -> list[ModelPart]:  # fmt: skip
    """Round marks on both flanks: x and height as shares of half the trunk."""
    long, wide, tall = build.body
    middle = build.shoulder - 0.5 * tall
    return [
        ball(skin, (0.5 * x * long, side * 0.47 * wide * math.sqrt(max(1.0 - 0.8 * z * z, 0.1)),
                    middle + 0.5 * z * tall), (size * tall, 0.10 * wide + 0.02, size * tall))
        for x, z in places for side in (1.0, -1.0)
    ]  # fmt: skip


_SCATTER = ((0.8, 0.1), (0.5, 0.5), (0.45, -0.3), (0.15, 0.1), (-0.1, 0.6), (-0.2, -0.4),
            (-0.45, 0.2), (-0.75, 0.4), (-0.8, -0.2))  # fmt: skip


def _spots(build: Build, coat: Coat) -> list[ModelPart]:
    return _sides(build, _SCATTER, 0.24, Material(BLACK))


def _belly(hue: Colour, high: float = -0.16) -> Extras:
    """A pale chest and belly."""

    def draw(build: Build, coat: Coat) -> list[ModelPart]:
        long, wide, tall = build.body
        z = build.shoulder - 0.5 * tall
        skin = fur(hue)
        return [
            ball(skin, (0.0, 0.0, z + high * tall), (0.98 * long, 0.92 * wide, 0.76 * tall)),
            ball(skin, (0.42 * long, 0.0, z + 0.1 * tall), (0.30 * long, 0.90 * wide, 0.95 * tall)),
        ]

    return draw


def _long_coat(hue: Colour) -> Extras:
    """Hair that hangs from chest, belly and tail."""

    def draw(build: Build, coat: Coat) -> list[ModelPart]:
        long, wide, tall = build.body
        z = build.shoulder - tall
        skin = fur(hue)
        fringes = [
            ball(skin, (x * long, 0.0, z), (0.34 * long, 0.80 * wide, 0.42 * tall))
            for x in (-0.30, 0.0, 0.28)
        ]
        chest = ball(skin, (0.46 * long, 0.0, z + 0.45 * tall), (0.24 * long, wide, 1.0 * tall))
        root: Point = (-0.48 * long, 0.0, build.shoulder - 0.25 * tall)
        tip: Point = (root[0] - 0.55 * long, 0.0, root[2] - 0.10 * long)
        return [*fringes, chest, limb(skin, root, tip, 0.24 * tall)]

    return draw


def _saddle(build: Build, coat: Coat) -> list[ModelPart]:
    long, wide, tall = build.body
    middle = (-0.04 * long, 0.0, build.shoulder - 0.32 * tall)
    return [ball(fur((0.02, 0.018, 0.016)), middle, (0.98 * long, 1.06 * wide, 0.84 * tall))]


def _pompons(build: Build, coat: Coat) -> list[ModelPart]:
    long, wide, tall = build.body
    z = build.shoulder - 0.45 * tall
    ends = ((0.30 * long, 0.0, z, 1.5), (0.62 * long, 0.0, z + 1.5 * tall, 0.85),
            (-0.68 * long, 0.0, build.shoulder + 0.5 * tall, 0.5))  # fmt: skip
    return [ball(coat.trunk, (x, y, z), (s * tall, s * wide, s * tall)) for x, y, z, s in ends]


def _dog(build: dict[str, object] | None = None, **changes: object) -> Animal:
    shape = replace(DOG.build, **(build or {}))  # type: ignore[arg-type]
    return replace(DOG, build=shape, **changes)  # type: ignore[arg-type]


_GOLD: Colour = (0.58, 0.34, 0.10)
_BLACKISH: Colour = (0.022, 0.020, 0.018)
_CREAM: Colour = (0.72, 0.62, 0.46)
_TAN: Colour = (0.48, 0.26, 0.09)
_HUSKY: Colour = (0.17, 0.18, 0.20)
_SHORT_LEGS = {"shoulder": 0.34, "body": (0.78, 0.20, 0.22)}
_PRICK = {"ear": (0.11, "prick")}
_LONGHAIR = {"bushy_tail": True, "tail": (0.40, 0.2)}

_DOGS: tuple[tuple[str, Animal, float, tuple[str, ...]], ...] = (
    ("golden retriever", _dog(_LONGHAIR, colours=(_GOLD,), dark=shade(_GOLD, 0.8),
                              extras=_long_coat(shade(_GOLD, 1.25))), 1.05, ("retriever",)),
    ("labrador", _dog(colours=(_CREAM, _BLACKISH)), 1.05, ("labrador retriever",)),
    ("dalmatian", _dog(colours=((0.78, 0.77, 0.74),), dark=BLACK, extras=_spots), 1.05, ()),
    ("husky", _dog({**_PRICK, "tail": (0.34, 1.2), "bushy_tail": True}, colours=(_HUSKY,),
                   leg_colour=WHITE, dark=WHITE, extras=_belly(WHITE)), 1.05,
     ("siberian husky", "malamute", "alaskan malamute", "sled dog")),
    ("german shepherd", _dog({**_PRICK, "tail": (0.40, -0.8), "bushy_tail": True}, colours=(_TAN,),
                             dark=_BLACKISH, extras=_saddle), 1.1, ("alsatian", "police dog")),
    ("border collie", _dog({**_LONGHAIR, "ear": (0.09, "prick")}, colours=(_BLACKISH,),
                           leg_colour=WHITE, dark=WHITE, extras=_belly(WHITE, -0.30)), 0.95,
     ("collie", "sheepdog", "sheep dog")),
    ("dachshund", _dog({"shoulder": 0.28, "body": (0.80, 0.17, 0.20), "ear": (0.12, "flop")},
                       colours=((0.24, 0.08, 0.03),)), 0.85, ("sausage dog", "wiener dog")),
    ("corgi", _dog({**_SHORT_LEGS, **_PRICK, "tail": (0.06, 0.6)}, colours=((0.60, 0.28, 0.07),),
                   leg_colour=WHITE, extras=_belly(WHITE, -0.26)), 0.85, ("welsh corgi",)),
    ("poodle", _dog({"tail": (0.26, 1.3)}, colours=((0.72, 0.70, 0.66), (0.04, 0.035, 0.03)),
                    extras=_pompons), 0.9, ("toy poodle", "standard poodle")),
    ("chihuahua", _dog({"ear": (0.20, "prick"), "head": (0.26, 0.10), "thick": 0.75,
                        "body": (0.52, 0.17, 0.21)}, colours=((0.55, 0.36, 0.16),)), 0.42, ()),
    ("beagle", _dog({"ear": (0.15, "flop")}, colours=(_TAN,), leg_colour=WHITE, dark=WHITE,
                    extras=lambda b, c: [*_saddle(b, c), *_belly(WHITE, -0.30)(b, c)]), 0.75,
     ("foxhound",)),
    ("bulldog", _dog({"shoulder": 0.42, "body": (0.58, 0.32, 0.30), "head": (0.28, 0.07),
                      "thick": 1.6, "tail": (0.05, 0.3)}, colours=((0.62, 0.50, 0.36),),
                     extras=_belly(WHITE, -0.25)), 0.85, ("french bulldog",)),
    ("puppy", young(DOG), 0.48, ("puppy dog", "pup", "baby dog", "young dog")),
)  # fmt: skip

_CATS: tuple[tuple[str, Animal, float, tuple[str, ...]], ...] = (
    ("tabby", replace(CAT, colours=((0.40, 0.30, 0.20),), pattern="stripes",
                      second_colour=(0.05, 0.035, 0.025)), 1.0, ("tabby cat", "tiger cat")),
    ("ginger cat", replace(CAT, colours=((0.66, 0.30, 0.06),), pattern="stripes",
                           second_colour=(0.42, 0.14, 0.02)), 1.0,
     ("orange tabby", "marmalade cat")),
    ("siamese", replace(CAT, colours=((0.70, 0.60, 0.46),), dark=(0.05, 0.03, 0.02),
                        leg_colour=(0.05, 0.03, 0.02), extras=None), 1.0, ("siamese cat",)),
    ("kitten", young(CAT), 0.55, ("kitty cat", "baby cat", "young cat")),
)  # fmt: skip

_BROWN_COW = replace(quadrupeds.COW, build=replace(quadrupeds.COW.build, patches=False))
_BULL = replace(_BROWN_COW, extras=None, colours=((0.05, 0.025, 0.015),), dark=(0.02, 0.015, 0.012),
                build=replace(_BROWN_COW.build, thick=1.35, body=(1.90, 0.78, 0.98)))  # fmt: skip
_PONY = replace(HORSE, build=replace(
    HORSE.build, neck=0.50, body=(1.40, 0.52, 0.64), thick=1.35, shoulder=1.22, head=(0.36, 0.26)),
    colours=((0.42, 0.22, 0.08), (0.62, 0.58, 0.52)), dark=(0.66, 0.58, 0.42))  # fmt: skip
_LEOPARD = replace(
    quadrupeds.CHEETAH, extras=_spots, pattern="plain", colours=((0.62, 0.38, 0.12),)
)
_PANTHER = replace(
    quadrupeds.CHEETAH, pattern="plain", colours=((0.014, 0.014, 0.016),), dark=BLACK
)
_LIONESS = replace(quadrupeds.LION, build=replace(quadrupeds.LION.build, mane=""))

_OTHERS: tuple[tuple[str, Animal, float, tuple[str, ...]], ...] = (
    ("calf", young(replace(quadrupeds.COW, extras=None, muzzle_colour=None,
                           colours=((0.45, 0.22, 0.09),)), dark=(0.30, 0.15, 0.07)),
     0.55, ("baby cow",)),
    ("bull", _BULL, 1.1, ("ox", "steer")),
    ("foal", young(HORSE, dark=(0.06, 0.03, 0.02)), 0.58, ("colt", "filly", "baby horse")),
    ("pony", _PONY, 0.80, ("shetland pony",)),
    ("piglet", young(quadrupeds.PIG), 0.45, ("baby pig",)),
    ("lamb", young(quadrupeds.SHEEP), 0.50, ("baby sheep",)),
    ("kid goat", young(quadrupeds.GOAT), 0.50, ("baby goat",)),
    ("fawn", young(replace(quadrupeds.DEER, extras=lambda b, c: _sides(
        b, _SCATTER, 0.12, Material((0.75, 0.66, 0.5))))), 0.55, ("baby deer",)),
    ("lioness", _LIONESS, 0.95, ()),
    ("lion cub", young(_LIONESS), 0.42, ("baby lion",)),
    ("tiger cub", young(quadrupeds.TIGER), 0.42, ("baby tiger",)),
    ("bear cub", young(quadrupeds.BEAR), 0.42, ("baby bear",)),
    ("leopard", _LEOPARD, 0.95, ()),
    ("panther", _PANTHER, 0.95, ("black panther",)),
    ("bison", replace(_BULL, colours=((0.10, 0.05, 0.02),), build=replace(
        _BULL.build, mane="full", head=(0.50, 0.24), rise=-0.2)), 1.1, ("buffalo",)),
    ("reindeer", replace(quadrupeds.DEER, colours=((0.24, 0.19, 0.15),), extras=_long_coat(
        (0.60, 0.56, 0.50))), 1.05, ("caribou",)),
)  # fmt: skip

_PLURALS = {
    "puppy": ("puppies",), "calf": ("calves",), "pony": ("ponies",), "tabby": ("tabbies",),
    "husky": ("huskies",), "bison": ("bison",), "reindeer": ("reindeer",), "fawn": (),
}  # fmt: skip
NOUNS = tuple(
    Noun(name, partial(build_sized, animal, size), "ground", 1.4, "walk", same,
         _PLURALS.get(name, ()), acts=frozenset(ANIMAL_ACTS))
    for name, animal, size, same in (*_DOGS, *_CATS, *_OTHERS)
)  # fmt: skip
