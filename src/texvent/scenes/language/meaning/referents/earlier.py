"""Things that were named before by another word: "a toddler ... the child", "the red boxer"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from texvent.scenes.language.meaning.adjectives import Attributes
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.models.people.activities import PERSON_NOUNS

_CHILDREN = frozenset(
    {"toddler", "baby", "girl", "schoolboy", "schoolgirl", "teenager", "child", "student"}
)
_WOMEN = frozenset(
    {"woman", "elderly woman", "girl", "waitress", "bride", "nun", "queen", "princess", "witch",
     "ballerina", "flamenco dancer", "schoolgirl"}
)  # fmt: skip
_ADULTS = PERSON_NOUNS - _CHILDREN
_KINDS: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        "child": _CHILDREN,
        "person": PERSON_NOUNS,
        "man": _ADULTS - _WOMEN,
        "woman": _ADULTS - {"man", "elderly man", "groom", "king", "monk", "priest"},
        "dog": frozenset({"puppy", "border collie", "husky", "dachshund", "dalmatian", "poodle"}),
        "cat": frozenset({"kitten", "ginger cat", "black cat"}),
        "car": frozenset({"taxi", "police car", "racing car", "suv", "van", "sports car", "jeep"}),
        "boat": frozenset({"sailboat", "rowing boat", "canoe", "kayak", "motorboat", "ferry"}),
        "horse": frozenset({"pony", "foal"}),
    }
)
"""Noun → nouns of things that it may mean as well, where one of them was named."""
_MOST_SPLIT = 3
"""Copies of a group of which one may be told by its colour."""


def find_kind(draft: Draft, named: Sequence[int], noun: str, is_plural: bool | None) -> int | None:
    """As in "a football ... the ball", "a toddler ... the child": one of that kind.

    Args:
        draft: what was read so far.
        named: objects in the order in which they were named.
        noun: of what is looked for, said with "the".
        is_plural: whether several are said; None: either.
    """
    for index in reversed(named):
        item = draft.objects[index]
        is_ball = noun == "ball" and item.noun.endswith(noun)
        is_kind = is_ball or item.noun.split()[-1] == noun or item.noun in _KINDS.get(noun, ())
        if is_kind and is_plural in (None, item.count > 1):
            return index
    return None


def find_coloured(
    draft: Draft, noun: str, is_plural: bool | None, attributes: Attributes
) -> int | None:
    """As in "two boxers ... the red boxer": that one, or one of those without a colour."""
    if not attributes.colours or is_plural:
        return None
    colour = attributes.colours[0][0]
    mine = [n for n, one in enumerate(draft.objects) if one.noun == noun]
    same = [n for n in mine if draft.objects[n].colour == colour]
    if same:
        for word in attributes.colours[0][1]:
            word.is_used = True
        return same[-1]
    plain = [n for n in mine if draft.objects[n].colour is None and draft.objects[n].is_plural]
    if not plain or draft.objects[plain[-1]].count > _MOST_SPLIT:
        return None
    index = draft.split(plain[-1])[-1]
    attributes.colour(draft.objects[index])
    return index
