"""Who looks at something stands turned to it."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import STANDING, Relation
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.capabilities import is_living
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.scope import Scope

LOOKS = frozenset({"look", "watch", "stare", "gaze", "observe", "glance", "peer", "glare"})
"""Verbs of looking: "looks at a dog", "watches a train"."""
LOOKS_TO = ("at", "toward", "towards")
"""Prepositions before what is looked at."""
_LEAST_M = 0.35
"""Shortest thing that one is seen to look at; what is smaller is held."""


def face(draft: Draft, subjects: Sequence[int], targets: Sequence[int]) -> bool:
    """As in "a man facing a robot", "two men facing each other"; whether it is read so."""
    fronted = [draft.noun(index) for index in subjects]
    if not targets or not all(is_living(one) or one.motion == "drive" for one in fronted):
        return False
    if not set(targets) >= set(subjects):
        return draft.relate("look at", list(subjects), list(targets), "opposite")
    subjects = list(targets)
    if sum(draft.objects[index].count for index in subjects) != _PAIR:
        return False
    for number, index in enumerate(subjects):
        goal = subjects[(number + 1) % len(subjects)]
        draft.relations.append(Relation("look at", index, (goal,), "opposite"))
    return True


_PAIR = 2


_SAID_TO = {"talk": ("to", "with", "at"), "wave": ("to", "at"), "bow": ("to",), "salute": ("to",),
            "laugh": ("with",), "sing": ("to",), "shout": ("at", "to")}  # fmt: skip
"""Activity → prepositions before whom it is meant for."""


def address(draft: Draft, preposition: str, scope: Scope, others: Sequence[int]) -> bool:
    """As in "talks to a man", "waves at a dog": they stand before each other; whether it is so."""
    doers = scope.subjects if scope.is_verb_shown else []
    motions = [draft.objects[index].motions[-1:] for index in doers]
    is_meant = bool(motions) and all(
        own and preposition in _SAID_TO.get(own[0].kind, ()) for own in motions
    )
    are_alive = all(is_living(draft.noun(index)) for index in others)
    return is_meant and are_alive and face(draft, doers, others)


def look_at(draft: Draft, clause: Clause, subjects: Sequence[int], targets: Sequence[int]) -> bool:
    """As in "a man watches a train": he stays in his place and faces it; whether it is read so."""
    if clause.verb_word.lemma not in LOOKS or not targets or set(targets) & set(subjects):
        return False
    if not all(is_living(draft.noun(index)) for index in subjects):
        return False
    motions = [draft.objects[index].motions for index in subjects]
    if any(one and one[-1].is_moving for one in motions) or draft.length_m(targets[0]) < _LEAST_M:
        return False
    for own in motions:
        own.extend([] if own else [STANDING])
    clause.verb_word.is_used = draft.relate("look at", list(subjects), list(targets))
    return clause.verb_word.is_used
