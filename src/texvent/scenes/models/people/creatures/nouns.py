"""Nouns of upright animals: size, bulk, coat and head of each."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from texvent.scenes.models.animals import breeds, more_quadrupeds, quadrupeds, rare_quadrupeds
from texvent.scenes.models.animals.four_legged.animal import Animal
from texvent.scenes.models.animals.four_legged.build import Build
from texvent.scenes.models.people.creatures.creature import Creature
from texvent.scenes.models.people.creatures.names import UPRIGHT
from texvent.scenes.models.people.outfit import ADULT, PersonKind
from texvent.scenes.models.people.roles.rows import role
from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Colour

_PALE: Colour = (0.78, 0.76, 0.72)
_TAN: Colour = (0.72, 0.62, 0.50)
_PENGUIN: Colour = (0.025, 0.027, 0.032)


def _plain(hue: Colour, tail: float = 0.0, **changes: object) -> Animal:
    """The coat of what is in no table of four-legged animals."""
    build = Build(
        1.0, (1.0, 0.4, 0.4), 0.1, 0.5, (0.34, 0.12), tail=(tail, 0.0), ear=(0.1, "prick")
    )
    return replace(Animal(build, (hue,)), **changes)  # type: ignore[arg-type]


_KANGAROO = Animal(
    Build(1.4, (1.0, 0.4, 0.5), 0.2, 0.8, (0.22, 0.16), tail=(1.0, 0.0), ear=(0.22, "long")),
    ((0.36, 0.20, 0.10),), dark=(0.03, 0.025, 0.02),
)  # fmt: skip
_OTHERS: dict[str, Creature] = {
    "monkey": Creature(_plain((0.22, 0.11, 0.05), 0.9), "ape", _TAN),
    "gorilla": Creature(_plain((0.025, 0.025, 0.028), muzzle_colour=(0.10, 0.09, 0.09)), "ape"),
    "kangaroo": Creature(_KANGAROO, "", _TAN),
    "teddy bear": Creature(_plain((0.45, 0.27, 0.12)), "teddy", _TAN),
    "penguin": Creature(_plain(_PENGUIN, leg_colour=(0.75, 0.38, 0.03)), "beak", _PALE),
    "duck": Creature(_plain((0.80, 0.66, 0.10), leg_colour=(0.80, 0.38, 0.03)), "bill"),
    "chicken": Creature(_plain((0.78, 0.75, 0.70), leg_colour=(0.75, 0.45, 0.05)), "beak"),
    "owl": Creature(_plain((0.30, 0.20, 0.11), leg_colour=(0.65, 0.50, 0.12)), "beak", _TAN),
    "frog": Creature(_plain((0.10, 0.36, 0.06), dark=(0.05, 0.12, 0.03)), "frog", (0.6, 0.6, 0.35)),
}  # fmt: skip
_FRONTS: dict[str, Colour] = {
    **dict.fromkeys(("cat", "tabby", "ginger cat", "kitten", "fox", "corgi", "husky", "hamster",
                     "border collie", "beagle", "tiger", "tiger cub", "lion", "koala", "wolf",
                     "rabbit"), _PALE),
    **dict.fromkeys(("dog", "raccoon", "squirrel", "mouse", "deer", "lioness"), _TAN),
}  # fmt: skip
"""Animal → colour of its chest and belly."""
_STOUT = {"panda": 1.35, "bear": 1.35, "black bear": 1.35, "polar bear": 1.35, "bear cub": 1.3,
          "elephant": 1.5, "hippo": 1.5, "rhino": 1.4, "pig": 1.3, "teddy bear": 1.25,
          "hamster": 1.35, "koala": 1.25, "gorilla": 1.4, "penguin": 1.3, "cow": 1.25,
          "bull": 1.35, "sheep": 1.3}  # fmt: skip
_SMALL = frozenset(
    {"cat", "tabby", "ginger cat", "siamese", "kitten", "squirrel", "mouse", "rat", "hamster",
     "raccoon", "rabbit", "puppy", "chihuahua", "corgi", "dachshund", "hedgehog", "penguin",
     "duck", "chicken", "owl", "frog", "lizard", "koala", "fox", "monkey", "lamb", "piglet",
     "beagle", "otter", "beaver", "meerkat", "skunk", "badger", "red panda", "panda cub",
     "wolf pup", "fox cub"}
)  # fmt: skip
_TALL = {"elephant": 1.1, "giraffe": 1.15, "bear": 1.05, "polar bear": 1.05, "gorilla": 1.05}


def _list_animals() -> dict[str, Animal]:
    """Four-legged animals by name, of which their builders are made."""
    builders: dict[str, Any] = {
        noun.name: noun.build
        for family in (quadrupeds, more_quadrupeds, breeds, rare_quadrupeds)
        for noun in family.NOUNS
    }
    return {name: build.args[0] for name, build in builders.items()}


_ANIMALS = _list_animals()


def _creature(name: str) -> Creature:
    if name in _OTHERS:
        return _OTHERS[name]
    return Creature(_ANIMALS[name], "", _FRONTS.get(name), is_sleeved=name == "panda")


def _kind(name: str) -> PersonKind:
    small = name in _SMALL
    return replace(
        ADULT,
        height=_TALL.get(name, 0.70 if small else 0.95),
        head=1.55 if small else 1.40,
        bulk=_STOUT.get(name, 1.15),
        shirts=(),
        trousers=None,
        creature=_creature(name),
    )


NOUNS: tuple[Noun, ...] = tuple(role(noun, _kind(name)) for name, noun in UPRIGHT.items())
