"""What goes on something: "runs along a pier", "a ball rolls over the desk"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.meaning.circumstances.put import OFF_GROUND, find_slid
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.word import Word

_DECKS = frozenset({"pier", "bridge"})
WALKED = {"along": "along", "across": "across", "over": "across", "down": "along"}
"""Preposition → way of who walks or drives over what has a deck."""


def list_goers(draft: Draft, word: Word, things: Sequence[int], scope: Scope) -> Sequence[int]:
    """As in "runs along a pier", "drives over a bridge": who goes on it, unless it flies or floats.

    Returns:
        Nothing where the preposition does not say so.
    """
    slid = find_slid(draft, word, things, scope)
    if slid:
        return slid
    goers = scope.movers or scope.subjects
    names = {draft.noun(index).name for index in things}
    if word.text not in WALKED or not names <= _DECKS:
        return ()
    are_on_foot = all(
        draft.noun(index).habitat == "ground"
        and not any(one.kind in OFF_GROUND for one in draft.objects[index].motions)
        for index in goers
    )
    return goers if are_on_foot else ()
