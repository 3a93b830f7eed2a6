"""Animals that can stand upright as people do, and what their nouns are called.

Loads nothing but the standard library, so that the sentence reader can import it.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

_ANIMALS = """
    dog, golden retriever, labrador, dalmatian, husky, german shepherd, border collie, dachshund,
    corgi, poodle, chihuahua, beagle, bulldog, puppy, cat, tabby, ginger cat, siamese, kitten,
    fox, wolf, horse, zebra, cow, calf, bull, elephant, deer, reindeer, lion, lioness, lion cub,
    tiger, tiger cub, cheetah, leopard, panther, goat, giraffe, sheep, lamb, pig, piglet, bear,
    black bear, bear cub, polar bear, panda, koala, raccoon, rabbit, squirrel, hedgehog, mouse,
    rat, hamster, camel, donkey, pony, rhino, hippo, crocodile, lizard, monkey, gorilla, kangaroo,
    teddy bear, penguin, duck, chicken, owl, frog, otter, beaver, meerkat, moose, llama, skunk,
    badger, red panda, elephant calf, panda cub, wolf pup, fox cub
"""
UPRIGHT: Mapping[str, str] = MappingProxyType(
    {name: f"upright {name}" for name in (" ".join(part.split()) for part in _ANIMALS.split(","))}
)
"""Animal, or toy → the noun of its upright body."""
OF_UPRIGHT: Mapping[str, str] = MappingProxyType({noun: name for name, noun in UPRIGHT.items()})
"""Noun of an upright body → the animal, or toy, that it is."""
