"""What is in something by "of" and "full of": "a bowl of apples", "a box filled with books"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.meaning.capabilities import is_living
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.objects.receptacles import CARRIERS

FULL = ("full of", "filled with", "loaded with", "packed with")
_FILLING = 4
"""How many of a bare plural fill something at least."""


def read_of(draft: Draft, preposition: Word, whole: Referent, content: Referent) -> None:
    """As in "a bowl of apples"; "the window of a train" shows a window by itself.

    One of a row of chairs is beside the others; nothing is in a crow of people.
    """
    is_whole = content.group.determiner is not None or content.group.owner is not None
    is_whole |= any(is_living(draft.noun(index)) for index in whole.things)
    preposition.is_used, preposition.is_lost = not is_whole, is_whole
    if not is_whole:
        nouns = {draft.noun(index).name for index in (*whole.things, *content.things)}
        draft.relate("beside" if len(nouns) == 1 else "in", content.things, whole.things)
        return
    head = whole.group.head
    is_body = set(whole.things) <= set(content.things)
    if head is not None and head.shown_as is None and not is_body:
        head.shown_as = f"{head.text} by itself"


def fill(
    draft: Draft, word: Word, near: Referent | None, things: Sequence[int], scope: Scope
) -> bool:
    """As in "a basket full of tulips"; what a harbour is full of, is few.

    Args:
        draft: the objects.
        word: the preposition.
        near: what stands right before it, if anything.
        things: what it is full of.
        scope: what the clause is about.
    """
    if near is not None and near.kind == "place":
        word.is_lost = True
        return False
    vessels = near.things if near is not None and near.is_things else scope.subjects
    for index in things if vessels else ():
        item = draft.objects[index]
        if item.count > 1 and not item.is_counted:
            item.count = max(item.count, _FILLING)
    are_laden = bool(vessels) and all(draft.noun(index).name in CARRIERS for index in vessels)
    return draft.relate("on" if are_laden else "in", things, vessels)
