"""The number of each noun in label images, boxes and events: the same in every clip and version.

New nouns are added at the end; no number is ever given to another noun.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

BACKGROUND = 0
"""Class of what is no object: ground, sky, walls, scenery without an id."""
UNNAMED = 1000
"""Class of an object whose name is not known."""
FIRST_OTHER = 1001
"""Numbers of names that are no nouns of the embedded generator begin here."""
_NOUNS: tuple[str, ...] = (
    "airplane", "ball", "balloon", "barn", "barrier", "basketball", "bear", "bed", "bee",
    "bench", "bicycle", "bird", "boat", "bookshelf", "bottle", "box", "bridge", "building",
    "bus", "bush", "butterfly", "cactus", "candle", "car", "cat", "chair", "cheetah", "chicken",
    "child", "clock", "cloud", "cone", "cow", "crane", "cube", "cup", "cylinder", "deer", "dog",
    "dolphin", "dragonfly", "drone", "duck", "eagle", "elephant", "excavator", "fan", "fence",
    "fire engine", "fish", "flag", "flamingo", "flower", "football", "fox", "giraffe", "goat",
    "gull", "helicopter", "horse", "hot air balloon", "house", "jellyfish", "kite", "lamp",
    "lion", "man", "motorcycle", "mountain", "ostrich", "palm", "pendulum", "penguin", "person",
    "pickup", "pig", "pine", "polar bear", "police car", "pyramid", "rabbit", "rock", "rocket",
    "runner", "sailboat", "shark", "sheep", "ship", "sign", "snail", "snake", "sofa", "sphere",
    "street lamp", "suv", "table", "taxi", "tennis ball", "tiger", "tractor", "traffic cone",
    "traffic light", "train", "tree", "truck", "turtle", "ufo", "umbrella", "van", "whale",
    "wheel", "wind turbine", "windmill", "wolf", "woman", "worker", "zebra",
    "hand",
)  # fmt: skip
CLASS_IDS: Mapping[str, int] = MappingProxyType(
    {name: number for number, name in enumerate(_NOUNS, start=1)}
)
"""Noun → class id, 1, 2, ...."""


def class_ids_of(names: Iterable[str]) -> dict[str, int]:
    """The class ids of names; those of no noun are numbered in alphabetical order.

    Args:
        names: class names, such as "car".

    Returns:
        Name → class id.

    Example:
        >>> class_ids_of(["zeppelin", "airship"])
        {'airship': 1001, 'zeppelin': 1002}
    """
    asked = set(names)
    others = enumerate(sorted(asked - CLASS_IDS.keys()), start=FIRST_OTHER)
    known = {name: CLASS_IDS[name] for name in sorted(asked & CLASS_IDS.keys())}
    return known | {name: number for number, name in others}
