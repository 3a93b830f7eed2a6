"""Parts that the models of objects show in any case: wheels of a car, hands of a person."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.meaning.capabilities import is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.vocabulary.scene import PARTS_SHOWN
from texvent.scenes.language.words.lexicon import Meaning

BODY_PARTS = frozenset({"hand", "finger", "fist", "arm", "head", "leg", "foot", "tail", "wing"})


def list_parts_shown(draft: Draft, things: Sequence[int], part: str) -> bool:
    """Whether the models of all these objects show a part in any case."""
    return bool(things) and all(shows_part(draft, index, part) for index in things)


def shows_part(draft: Draft, index: int, part: str) -> bool:
    """Whether the model of an object shows a part in any case."""
    noun = draft.noun(index)
    names = (noun.motion, noun.name, "person" if is_person(noun) else "")
    return any(category in names and part in parts for category, parts in PARTS_SHOWN.items())


def is_own_hand(draft: Draft, meaning: Meaning | None) -> bool:
    """As in "her fingers move", beside a girl: a part of who is named, no other hand."""
    return meaning is not None and meaning.value == "hand" and bool(list_people(draft))


def list_people(draft: Draft) -> list[int]:
    """People that are named so far, by index."""
    return [index for index in range(len(draft.objects)) if is_person(draft.noun(index))]
