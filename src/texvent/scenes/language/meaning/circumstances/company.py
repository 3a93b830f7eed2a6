"""Who or what stands around something: "surrounded by men", "a boy in a crowd", "among sheep"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import AMID, STANDING, TOGETHER
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.people.activities import SEATS

_MOST = 6
"""How many stand around where no number is said."""
_SHARED = frozenset({"stand", "sit", "lie", "walk", "run"})
"""What one does together with another."""


def is_company(draft: Draft, kind: str, subjects: Sequence[int], things: Sequence[int]) -> bool:
    """Whether others stand around the subjects: no trees or hills, which are all around.

    Args:
        draft: the objects.
        kind: of the relation; "in" is so of who is in a crowd.
        subjects: who or what is in the midst.
        things: what stands around.
    """
    if not subjects or any(_goes(draft, index) for index in (*subjects, *things)):
        return False
    nouns = [draft.noun(index) for index in things]
    if kind == "in":
        are_many = all(draft.objects[index].count > 1 for index in things)
        return are_many and all(map(is_living, [*nouns, *map(draft.noun, subjects)]))
    return kind in AMID and all(is_living(one) or one.name in SEATS for one in nouns)


def gather(draft: Draft, subjects: Sequence[int], things: Sequence[int]) -> bool:
    """Let things stand around the first subject, or around what it lies on."""
    host = subjects[0]
    for relation in draft.relations:
        if relation.kind == "on" and relation.subject == host:
            host = relation.targets[0]
            break
    for index in things:
        item = draft.objects[index]
        if not item.is_counted:
            item.count = min(item.count, _MOST)
        if not item.motions:
            item.motions.append(STANDING)
    return draft.relate("around", things, [host])


def keep_company(draft: Draft, subjects: Sequence[int], things: Sequence[int]) -> None:
    """As in "a man stands with another": both do, unless the prompt has the other do more."""
    motions = draft.objects[subjects[0]].motions
    if not motions or motions[-1].kind not in _SHARED:
        return
    for index in things:
        is_alike = is_person(draft.noun(index)) == is_person(draft.noun(subjects[0]))
        if is_living(draft.noun(index)) and is_alike and not draft.objects[index].motions:
            draft.objects[index].motions.append(motions[-1])


def stand_together(draft: Draft, word: Word, subjects: Sequence[int]) -> bool:
    """Read "together" of several objects, or of one alone, who is not; whether it is one of these.

    Copies of one object are set up where they are placed.
    """
    alive = [index for index in subjects if is_living(draft.noun(index))]
    if len(alive) == 1 < len(subjects):
        # As in "two men in caps stand together": the caps do not.
        item = draft.objects[alive[0]]
        item.side, word.is_used = TOGETHER, item.count > 1
        word.is_lost = not word.is_used
        return True
    if len(subjects) > 1:
        before = len(draft.relations)
        word.is_used = draft.relate("beside", subjects[1:], subjects[:1])
        word.relations = tuple(draft.relations[before:])
        return True
    word.is_lost = all(draft.objects[index].count == 1 for index in subjects)
    return word.is_lost


def _goes(draft: Draft, index: int) -> bool:
    return any(one.is_moving for one in draft.objects[index].motions)
