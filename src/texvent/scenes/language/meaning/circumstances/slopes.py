"""Up and down stairs, ladders and ramps."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.meaning.capabilities import is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.word import Word

_CLIMBED = frozenset({"stairs", "ladder"})
_SLOPES = frozenset({"stairs", "ramp", "skate ramp", "slide"})
"""What one goes up and down on; people climb stairs and ladders."""
_DROPS = frozenset({"fall", "fall over", "topple", "roll", "slide", "flip"})


def go_on_slope(draft: Draft, word: Word, things: Sequence[int], scope: Scope) -> bool:
    """As in "walks down the stairs", "rolls down a ramp"; whether it is read so.

    Args:
        draft: what they do is changed.
        word: "up" or "down".
        things: what follows it.
        scope: what the clause is about.
    """
    name = draft.noun(things[0]).name
    if not scope.movers or name not in _CLIMBED | _SLOPES:
        return False
    are_people = all(is_person(draft.noun(index)) for index in scope.movers)
    if not (are_people and name in _CLIMBED):
        return name in _SLOPES and draft.relate("on", scope.movers, things, word.text)
    if any(draft.objects[index].motions[-1].kind in _DROPS for index in scope.movers):
        return False  # who falls down the stairs does not climb
    for index in scope.movers:
        motions = draft.objects[index].motions
        motions[-1] = ObjectMotion("climb", word.text, motions[-1].pace)
    return draft.relate("work on", scope.movers, things)
